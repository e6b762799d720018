"""A whole deck as one frozen model; values in SI."""

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from pydantic import ConfigDict, Field, ValidationError, field_validator, model_validator

from hydro1d.boundaries.base import Boundary
from hydro1d.components.parameters import Component
from hydro1d.deck.checks import cross_problems
from hydro1d.deck.messages import deck_error, findings_of
from hydro1d.deck.parts import MAX_LAYERS, MAX_TITLE, Checkpoint, Layer, Output, Time, plain_text
from hydro1d.scheme.viscosity import Viscosity

_PACKAGES = {"law": "hydro1d.laws", "boundary": "hydro1d.boundaries", "pulse": "hydro1d.loads"}


class Deck(Component):
    """A whole deck, checked. Raises DeckError, with all that is wrong, when it is built.

    In Python::

        Deck(
            layers=[Layer(law=EPPH(...), thickness="1 m", zones=1000)],
            left=Pressure(pulse=Rectangular(peak="3.6 MPa", duration="1.53 ms")),
            right=Wall(),
            end="8 ms",
        )

    ``end`` and ``cfl`` may stand for ``time=Time(end=..., cfl=...)``. `names` holds how a deck's text calls its
    components ("layer[0].law": "my_foam.py:MyFoam"); `text` and `path` are its text and file, if it has any; `notes` are
    sentences about what is possible and hardly meant.
    """

    model_config = ConfigDict(arbitrary_types_allowed=False)

    title: str = Field("", max_length=MAX_TITLE, description="a line of text that figures and files carry")
    layers: tuple[Layer, ...] = Field(..., max_length=MAX_LAYERS)
    left: Boundary
    right: Boundary
    time: Time
    viscosity: Viscosity = Viscosity()
    output: Output = Output()
    checkpoint: Checkpoint | None = None
    names: dict[str, str] = Field(default_factory=dict, repr=False)
    text: str = Field("", repr=False)
    path: Path | None = None
    notes: tuple[str, ...] = Field((), repr=False)

    _plain_title = field_validator("title")(plain_text)

    def __init__(self, **values: Any) -> None:
        if "end" in values:
            values["time"] = {key: values.pop(key) for key in ("end", "cfl") if key in values}
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise deck_error(values.get("path"), findings_of(error, type(self), values, ())) from None

    @model_validator(mode="after")
    def _as_a_whole(self) -> Self:
        found = cross_problems(self.layers, self.left, self.right, self.time, self.output)
        if found:
            raise deck_error(self.path, found)
        # The model is frozen; only here are values filled in that follow from several parts.
        object.__setattr__(self, "output", self._resolved_output())
        object.__setattr__(self, "layers", tuple(self._named(index) for index in range(len(self.layers))))
        return self

    def _resolved_output(self) -> Output:
        count, end = self.output.profiles, self.time.end
        if not isinstance(count, int):
            return self.output
        times = (*(index * end / (count - 1) for index in range(count - 1)), end)
        return self.output.model_copy(update={"profiles": times})

    def _named(self, index: int) -> Layer:
        layer = self.layers[index]
        name = layer.material or self._name(f"layer[{index}].law", "law", layer.law)
        return layer if name == layer.material else layer.model_copy(update={"material": name})

    def _name(self, path: str, kind: str, component: Component) -> str:
        return self.names.get(path) or plugin_name(kind, type(component))

    def user_code(self) -> tuple[str, ...]:
        """The Python files of the user's that this deck names: they were run to load it."""
        return tuple(sorted({name.partition(":")[0] for name in self.names.values() if ".py" in name}))

    def resolved(self) -> dict[str, Any]:
        """The deck as plain data, values in SI, that JSON can hold and `load_deck` takes again."""
        materials: dict[str, Any] = {}
        layers = []
        for index, layer in enumerate(self.layers):
            law = {"law": self._name(f"layer[{index}].law", "law", layer.law), **_plain(layer.law)}
            name = layer.material
            while materials.setdefault(name, law) != law:  # two laws of one name, as Python allows
                name = f"{name}-{index + 1}"
            layers.append({"material": name, **_plain(layer, without=("law", "material"))})
        data = {
            "title": self.title,
            "material": materials,
            "layer": layers,
            "left": self._resolved_boundary("left", self.left),
            "right": self._resolved_boundary("right", self.right),
            "time": _plain(self.time),
            "viscosity": _plain(self.viscosity),
            "output": _plain(self.output),
        }
        return data if self.checkpoint is None else {**data, "checkpoint": _plain(self.checkpoint)}

    def _resolved_boundary(self, side: str, boundary: Boundary) -> dict[str, Any]:
        data = {"type": self._name(f"{side}.type", "boundary", boundary)}
        pulse = getattr(boundary, "pulse", None)
        if isinstance(pulse, Component):
            data |= {"pulse": self._name(f"{side}.pulse", "pulse", pulse), **_plain(pulse)}
        return {**data, **_plain(boundary, without=("pulse",))}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Deck) and self.resolved() == other.resolved()

    def __hash__(self) -> int:
        return hash(json.dumps(self.resolved(), sort_keys=True))


def _plain(component: Component, without: tuple[str, ...] = ()) -> dict[str, Any]:
    """The fields of a component as JSON holds them; None stands for "not given" and is left out."""
    values: Mapping[str, Any] = component.model_dump(mode="json", exclude=set(without), exclude_none=True)
    return dict(values)


def plugin_name(kind: str, component: type[Component]) -> str:
    """The deck's word for a built-in class ("epph-tangent"), else the file and class where it is defined."""
    package, _, module = component.__module__.rpartition(".")
    if package == _PACKAGES[kind]:
        return module.replace("_", "-")
    file = getattr(sys.modules.get(component.__module__), "__file__", None)
    return f"{Path(file).name if file else component.__module__}:{component.__qualname__}"
