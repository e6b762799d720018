"""From a deck's text to a checked `Deck`: every part is built on its own, so that all errors come at once."""

import copy
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from pydantic import Field, ValidationError, field_validator

from hydro1d.boundaries.base import Boundary
from hydro1d.components.parameters import Component
from hydro1d.components.plugins import UnknownPlugin, available, find
from hydro1d.components.units import shorten
from hydro1d.deck import overrides as overriding
from hydro1d.deck.checks import cross_problems
from hydro1d.deck.messages import (
    MAX_FOUND,
    DeckProblems,
    Finding,
    Location,
    deck_error,
    findings_of,
    one_of,
    unknown_key,
    unknown_word,
)
from hydro1d.deck.model import Deck
from hydro1d.deck.parts import MAX_LAYERS, MAX_NAME, MAX_TITLE, Checkpoint, Layer, Output, Time, plain_text
from hydro1d.deck.plausible import notes_on
from hydro1d.deck.read import parse, read_text
from hydro1d.errors import DeckError
from hydro1d.laws.base import Law
from hydro1d.scheme.viscosity import Viscosity

_SECTIONS = ("title", "material", "layer", "left", "right", "time", "viscosity", "output", "checkpoint")
_LAYER_KEYS = ("material", "thickness", "zones", "velocity")  # a deck names the law by its material
_Part = TypeVar("_Part", bound=Component)


def load_deck(
    source: str | Path | Mapping[str, Any], overrides: Sequence[str] = (), folder: Path | None = None
) -> Deck:
    """Return the checked deck of a file, of a TOML text (anything with a newline), or of data as `Deck.resolved` gives.

    ``overrides`` are texts such as ``"layer[0].zones=2000"``. Files that the deck names are relative to the deck's own
    folder, or to ``folder``. Raises DeckError with all that is wrong, FileProblem if the file cannot be read.
    """
    path: Path | None = None
    text = ""
    if isinstance(source, Mapping):
        try:
            data = copy.deepcopy(dict(source))
        except RecursionError:
            raise DeckError("the deck: tables and lists nested too deeply") from None
    else:
        if isinstance(source, str) and "\n" in source:
            text = source
        else:
            path = Path(source)
            text = read_text(path)
        data = parse(text, path)
    if "quantities" in data and "layer" not in data:
        raise DeckError(f"{path or 'the deck'} is a sweep, not a deck; hydro1d sweep takes it")
    origins, found = overriding.apply(data, overrides)
    builder = _Builder(data, folder or (path.parent if path else Path.cwd()))
    parts = builder.build()
    found += builder.found
    if found:
        raise _located(path, found, text, origins)
    try:
        deck = Deck(**parts, names=builder.names, text=text, path=path)
        return deck.model_copy(update={"notes": notes_on(deck, data, builder.folder)})
    except DeckProblems as error:  # checks of the whole, which know no text
        raise _located(path, error.findings, text, origins) from None


def _located(path: Path | None, found: list[Finding], text: str, origins: dict[Location, str]) -> DeckError:
    """The exception, each problem with line and column, or with the override that brought its value."""
    from hydro1d.deck.positions import Positions  # only what is wrong has to be found

    positions = Positions(text)

    def origin_of(place: Location) -> str:
        texts = [origins[place[:length]] for length in range(len(place), 0, -1) if place[:length] in origins]
        if positions.find(place) is None:  # a table that only overrides have made
            texts += [text for path, text in origins.items() if path[: len(place)] == place]
        return f" (--set {texts[0][:100]})" if texts else ""

    def place_of(finding: Finding) -> tuple[int, int] | None:
        return None if origin_of(finding.path) else positions.find(finding.path, finding.at_key)

    return deck_error(path, found, place_of, origin_of)


class _Builder:
    """Builds the parts of a deck from plain data and collects what is wrong in `found`."""

    def __init__(self, data: dict[str, Any], folder: Path) -> None:
        self.data, self.folder = data, folder
        self.found: list[Finding] = []
        self.names: dict[str, str] = {}
        self._known_words: dict[str, str] = {}

    def build(self) -> dict[str, Any]:
        """Return the arguments of `Deck`; they are complete only if `found` stays empty."""
        unknown = [key for key in self.data if key not in _SECTIONS]
        self.found += [unknown_key((key,), _SECTIONS) for key in unknown[:MAX_FOUND]]
        parts: dict[str, Any] = {
            "title": self._title(),
            "layers": self._layers(self._materials()),
            "left": self._boundary("left"),
            "right": self._boundary("right"),
            "time": self._section("time", Time, required=True),
            "viscosity": self._section("viscosity", Viscosity),
            "output": self._section("output", Output),
            "checkpoint": self._section("checkpoint", Checkpoint) if "checkpoint" in self.data else None,
        }
        if self.found:  # else Deck does it
            known = {finding.path for finding in self.found}
            found = cross_problems(*(parts[name] for name in ("layers", "left", "right", "time", "output")))
            self.found += [finding for finding in found if finding.path not in known]
        return parts

    def _title(self) -> str:
        title = self.data.get("title", "")
        if isinstance(title, str):
            self._validated(_Title, {"title": title}, ())
            return title
        self.found.append(Finding(("title",), f"{shorten(title)} is not text", title, "text"))
        return ""

    def _table(self, path: Location, data: Any) -> dict[str, Any] | None:
        if isinstance(data, dict):
            return data
        self.found.append(Finding(path, f"{shorten(data)} is not a table", data, f"a table [{path[0]}]"))
        return None

    def _section(self, name: str, cls: type[_Part], required: bool = False) -> _Part | None:
        if required and name not in self.data:
            needs = one_of([key for key, field in cls.model_fields.items() if field.is_required()])
            self.found.append(Finding((name,), "is missing", None, f"a table [{name}] with {needs}"))
            return None
        values = self._table((name,), self.data.get(name, {}))
        return None if values is None else self._validated(cls, values, (name,))

    def _validated(self, cls: type[_Part], values: Mapping[str, Any], path: Location) -> _Part | None:
        """One component, or None and its findings."""
        try:
            return cls.model_validate(values, context={"folder": self.folder})
        except ValidationError as error:
            self.found += findings_of(error, cls, values, path)
        except (Exception, SystemExit) as error:  # a component of the user's own may raise anything
            text = f"{cls.__name__} raised {type(error).__name__}: {str(error)[:200]}"
            self.found.append(Finding(path, text))
        return None

    def _class(self, kind: str, path: Location, values: Mapping[str, Any]) -> type[Any] | None:
        """The class that the key at the end of ``path`` names."""
        name = values.get(str(path[-1]))
        if not isinstance(name, str) or len(name) > 1000:
            message = "is missing" if name is None else f"{shorten(name)} is not a name"
            names = self._words(kind)
            self.found.append(Finding(path, message, name, f'{names}, or "file.py:Class"'))
            return None
        try:
            return find(kind, name, self.folder)
        except UnknownPlugin as error:
            self.found.append(unknown_word(path, name, f"a {kind}", error.allowed))
        except (Exception, SystemExit) as error:
            text = str(error) if isinstance(error, ValueError) else f"{shorten(name)}: {type(error).__name__}: {error}"
            self.found.append(Finding(path, text[:500], name))
        return None

    def _words(self, kind: str) -> str:
        if kind not in self._known_words:
            self._known_words[kind] = one_of(sorted(available(kind)))
        return self._known_words[kind]

    def _materials(self) -> dict[str, tuple[str, Law | None]]:
        """Name → (the deck's word for the law, the law or None if it is wrong)."""
        if "material" not in self.data:
            self.found.append(
                Finding(("material",), "is missing", None, "a table [material.NAME] with law, density, …")
            )
            return {}
        materials = {}
        tables = self._table(("material",), self.data["material"]) or {}
        if len(tables) > MAX_LAYERS:
            self.found.append(Finding(("material",), f"{len(tables)} materials", None, f"at most {MAX_LAYERS}"))
            return {}
        for name, values in tables.items():
            path = ("material", name)
            if not name or len(name) > MAX_NAME:
                self.found.append(Finding(path, f"{shorten(name)} is not a name", name, "a short text", at_key=True))
            table = self._table(path, values)
            cls = self._class("law", (*path, "law"), table) if table is not None else None
            law = None
            if cls is not None and table is not None:
                law = self._validated(cls, {key: value for key, value in table.items() if key != "law"}, path)
            materials[name] = (str(table.get("law")) if table else "", law)
        return materials

    def _layers(self, materials: dict[str, tuple[str, Law | None]]) -> list[Layer] | None:
        rows = self.data.get("layer", [])
        if isinstance(rows, dict) or not isinstance(rows, list):
            self.found.append(
                Finding(("layer",), "is not a list of layers", None, "[[layer]], with two brackets", at_key=True)
            )
            return None
        if len(rows) > MAX_LAYERS:
            self.found.append(Finding(("layer",), f"{len(rows)} layers", None, f"at most {MAX_LAYERS}", at_key=True))
            return None
        layers = [self._layer(index, row, materials) for index, row in enumerate(rows)]
        return [layer for layer in layers if layer is not None] if None not in layers else None

    def _layer(self, index: int, row: Any, materials: dict[str, tuple[str, Law | None]]) -> Layer | None:
        path = ("layer", index)
        table = self._table(path, row)
        if table is None:
            return None
        name = table.get("material")
        known = list(materials) or ["the NAME of a table [material.NAME]"]
        if "material" not in table:
            self.found.append(Finding((*path, "material"), "is missing", None, one_of(known)))
        elif not isinstance(name, str) or name not in materials:
            self.found.append(unknown_word((*path, "material"), name, "a material of this deck", known))
        unknown = [key for key in table if key not in _LAYER_KEYS]
        self.found += [unknown_key((*path, key), _LAYER_KEYS) for key in unknown[:MAX_FOUND]]
        spec, law = materials.get(name, ("", None)) if isinstance(name, str) else ("", None)
        self.names[f"layer[{index}].law"] = spec
        stand_in = law if law is not None else Law.model_construct()  # the other keys are checked all the same
        own = {key: value for key, value in table.items() if key in _LAYER_KEYS}
        values = {**own, "law": stand_in, "material": name if isinstance(name, str) else ""}
        layer = self._validated(Layer, values, path)
        return layer if law is not None else None

    def _boundary(self, side: str) -> Boundary | None:
        if side not in self.data:
            types = self._words("boundary")
            self.found.append(Finding((side,), "is missing", None, f"a table [{side}] with type = {types}"))
            return None
        table = self._table((side,), self.data[side])
        cls = self._class("boundary", (side, "type"), table) if table is not None else None
        if table is None or cls is None:
            return None
        self.names[f"{side}.type"] = str(table["type"])
        values = {key: value for key, value in table.items() if key != "type"}
        return (
            self._with_pulse(side, cls, values)
            if "pulse" in cls.model_fields
            else self._validated(cls, values, (side,))
        )

    def _with_pulse(self, side: str, cls: type[Boundary], values: dict[str, Any]) -> Boundary | None:
        """The pulse's keys stand beside the boundary's own."""
        pulse_cls = self._class("pulse", (side, "pulse"), values)
        if pulse_cls is None:
            return None
        self.names[f"{side}.pulse"] = str(values["pulse"])
        own = {key: value for key, value in values.items() if key in cls.model_fields and key != "pulse"}
        known = {**pulse_cls.model_fields, **cls.model_fields}
        unknown = [key for key in values if key not in known]
        self.found += [unknown_key((side, key), known) for key in unknown[:MAX_FOUND]]
        rest = {key: value for key, value in values.items() if key not in cls.model_fields and key in known}
        pulse = self._validated(pulse_cls, rest, (side,))
        return None if pulse is None else self._validated(cls, {**own, "pulse": pulse}, (side,))


class _Title(Component):
    """The title's own checks, for a deck whose other parts are wrong."""

    title: str = Field("", max_length=MAX_TITLE)
    _plain_title = field_validator("title")(plain_text)
