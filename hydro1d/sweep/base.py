"""The base deck of a study, and values of its keys as SI numbers."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from hydro1d.components.fields import said_of
from hydro1d.components.parameters import Component
from hydro1d.components.units import UnitError, convert, parse_unit
from hydro1d.deck import Deck, load_deck
from hydro1d.deck.messages import path_text
from hydro1d.deck.overrides import Override, parse_override
from hydro1d.deck.read import parse, read_text
from hydro1d.errors import DeckError
from hydro1d.sweep.job import Job, override

_NUMBER_UNIT = re.compile(r"\s*[-+]?(?:\d[\d_]*\.?[\d_]*|\.\d[\d_]*)(?:[eE][-+]?\d+)?\s*(\S.*?)?\s*")


def base_data(base: str | Path | Mapping[str, Any]) -> tuple[dict[str, Any], str]:
    """A deck's data and the folder of its files: from a file, a TOML text or data. The deck itself must be right."""
    if isinstance(base, Mapping):
        data, folder = dict(base), Path.cwd()
    elif isinstance(base, str) and "\n" in base:
        data, folder = parse(base, None), Path.cwd()
    else:
        path = Path(base)
        data, folder = parse(read_text(path), path), path.resolve().parent
    return data, str(folder)


def si(value: Any) -> Any:
    """A number with a unit, as text, in SI, whatever its dimension; anything else as it is."""
    match = _NUMBER_UNIT.fullmatch(value) if isinstance(value, str) else None
    if match is None:
        return value
    try:
        dimension = parse_unit(match[1] or "1").dimension
        powers = [f"{base}^{int(power)}" for base, power in zip(("kg", "m", "s"), dimension, strict=True) if power]
        return convert(value, " ".join(powers) or "1")
    except UnitError:
        return value


def check_key(key: str) -> Override:
    """The path that ``key`` names. Raises DeckError for a text that is none."""
    parsed = parse_override(f"{key}=0")
    if not isinstance(parsed, Override):
        raise DeckError(f"{key[:100]!r} is not the path of a deck's key, such as layer[0].zones")
    return parsed


def value_problem(
    data: Mapping[str, Any], folder: str, key: str, value: Any, overrides: Sequence[str] = ()
) -> str | None:
    """What the deck has to say against this value of this key, as one sentence; None if it takes it."""
    path = path_text(check_key(key).path)
    try:
        Job(data, folder, (*overrides, override(key, value))).deck()
    except DeckError as error:
        own = [problem for problem in error.problems if problem.path.startswith((path, "--set"))]
        if not error.problems:
            return str(error)
        if own:
            allowed = f"; allowed: {own[0].allowed}" if own[0].allowed else ""
            return f"{own[0].message}{allowed}"
    return None


def number_of(data: Mapping[str, Any], folder: str, key: str, value: Any, overrides: Sequence[str] = ()) -> float:
    """The SI number that this value of this key is. Raises DeckError if the deck does not take it."""
    problem = value_problem(data, folder, key, value, overrides)
    if problem is not None:
        load_deck(dict(data), tuple(overrides), Path(folder))  # if the base itself is wrong, that comes first
        raise DeckError(f"{key} = {value}: {problem}")
    number = si(value)
    if isinstance(number, bool) or not isinstance(number, int | float):
        raise DeckError(f"{key} = {value}: not a number")
    return float(number)


def unit_of(deck: Deck, key: str) -> str:
    """The SI unit of a key's values, as in "kg/m^3"; empty for counts, words and pure numbers."""
    *place, name = check_key(key).path
    for component in _components(deck, place):
        field = type(component).model_fields.get(str(name))
        unit = said_of(field).get("unit") if field is not None else None
        if unit is not None:
            return "" if unit == "1" else str(unit)
    return ""


def _components(deck: Deck, place: Sequence[str | int]) -> list[Component]:
    """What keeps its parameters at this place of a deck's text."""
    if len(place) == 2 and place[0] == "material":
        return [layer.law for layer in deck.layers if layer.material == place[1]]
    if len(place) == 2 and place[0] == "layer":
        return [deck.layers[int(place[1])]]
    if len(place) != 1 or place[0] not in ("left", "right", "time", "viscosity", "output", "checkpoint"):
        return []
    part = getattr(deck, str(place[0]))
    return [found for found in (part, getattr(part, "pulse", None)) if isinstance(found, Component)]
