"""Notes on a deck: laws written for version 0.1, and units that may have been forgotten.

Plain numbers are SI, and some are implausible as such. A number with a unit is taken at its word. A plain one is SI, and 0.8
for a stress of 0.8 MPa is easily written: the deck runs, and the result is wrong by orders of magnitude. The bounds below lie
far outside the values of foams, metals and blasts.

Dimensionless decks, in which every number is of the order of one, are no mistake. Their densities tell them apart: only a deck
with a density of at least `_LIGHTEST`, or with a solid too strong for its density, is examined.
"""

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import BaseModel

from hydro1d.components import tables
from hydro1d.components.fields import said_of
from hydro1d.deck.messages import Location, path_text
from hydro1d.deck.model import Deck
from hydro1d.laws.base import Law, answer_by_point

_LIGHTEST = 5.0  # kg/m³; lighter solids are laboratory curiosities, and gases have other stresses
_STRONG = 1e5  # Pa: beyond any solid lighter than the least density below
_MAX_NAMED = 3


class _Range(NamedTuple):
    """From where to where a quantity is plausible, and the unit that is likely to be missing below and above."""

    least: float
    most: float
    below: str = ""
    above: str = ""


_MATERIAL = {
    "Pa": _Range(1e3, math.inf, "MPa"),  # the softest foams bear 1 kPa before they densify
    "kg/m^3": _Range(1.0, 3e4, "g/cm^3", "g/m^3"),  # the heaviest metals have 23 000
}
_COLUMN = {
    "m": _Range(0.0, 1e2, above="mm"),
    "m/s": _Range(0.0, 2e4, above="mm/s"),
    "s": _Range(0.0, 1.0, above="ms"),
}
_LOAD = {"Pa": _Range(1e2, math.inf, "MPa"), **_COLUMN}  # a blast may be weak


class _Number(NamedTuple):
    """A number of the deck without a unit, and the SI unit that it has by rule."""

    path: Location
    value: float
    unit: str
    of: str = ""  # what the number is of a value that is more than one

    def __str__(self) -> str:
        written = f"{self.of} {path_text(self.path)}" if self.of else f"{path_text(self.path)} = {self.value:g}"
        return f"{written} is {self.value:g} {self.unit}"


def notes_on(deck: Deck, data: Mapping[str, Any], folder: Path) -> tuple[str, ...]:
    """What a user should look at again; `data` are the deck's values as they were written."""
    return (*_former_laws(deck), *_units_that_lack(deck, data, folder))


def _former_laws(deck: Deck) -> tuple[str, ...]:
    """A sentence about the laws that answer as version 0.1 asked them to."""
    kinds = [type(layer.law) for layer in deck.layers]
    former = dict.fromkeys(kind.__name__ for kind in kinds if vars(kind).get("respond") is answer_by_point)
    if not former:
        return ()
    return (
        f"{', '.join(former)}: point, as version 0.1 asked it, runs as it did; respond can say more (docs/own-law.md)",
    )


def _units_that_lack(deck: Deck, data: Mapping[str, Any], folder: Path) -> tuple[str, ...]:
    """A sentence about the numbers that lack a unit, it seems."""
    laws = {layer.material: layer.law for layer in deck.layers}
    if not any(law.density >= _LIGHTEST or _is_too_strong(law) for law in laws.values()):
        return ()
    odd = [(number, usual) for number, usual in _all(deck, laws, data, folder) if usual]
    if not odd:
        return ()
    named = ", ".join(str(number) for number, _ in odd[:_MAX_NAMED])
    more = f" and {len(odd) - _MAX_NAMED} more" if len(odd) > _MAX_NAMED else ""
    first, usual = odd[0]
    return (f'is a unit missing? {named}{more}: a number without a unit is SI; "{first.value:g} {usual}" has one',)


def _all(deck: Deck, laws: Mapping[str, Law], data: Mapping[str, Any], folder: Path) -> Iterator[tuple[_Number, str]]:
    """Every plain number of the deck, with the unit that it seems to lack or nothing."""
    for name, law in laws.items():
        path, table = ("material", name), data.get("material", {}).get(name, {})
        for number in [*_numbers(path, table, type(law)), *_largest(path, table, law, folder)]:
            light = number.unit == "kg/m^3" and not _is_too_strong(law)  # the least density is for solids
            yield number, "" if light and number.value < _LIGHTEST else _lacking(number, _MATERIAL)
    for index, (layer, table) in enumerate(zip(deck.layers, data.get("layer", ()), strict=False)):
        for number in _numbers(("layer", index), table, type(layer)):
            yield number, _lacking(number, _COLUMN)
    for side in ("left", "right"):
        boundary = getattr(deck, side)
        for part in (boundary, getattr(boundary, "pulse", None)):
            if isinstance(part, BaseModel):
                for number in _numbers((side,), data.get(side, {}), type(part)):
                    yield number, _lacking(number, _LOAD)
    for number in _numbers(("time",), data.get("time", {}), type(deck.time)):
        yield number, _lacking(number, _COLUMN)


def _lacking(number: _Number, ranges: Mapping[str, _Range]) -> str:
    """The unit that a number seems to lack; "" where it is plausible as it stands, or zero, or its unit has no range."""
    known, size = ranges.get(number.unit), abs(number.value)
    if known is None or size == 0.0:
        return ""
    return known.below if size < known.least else known.above if size > known.most else ""


def _is_too_strong(law: Law) -> bool:
    """Whether a solid is lighter than any and stronger than such a one could be: its density lacks a unit."""
    stresses = [getattr(law, key) for key, unit in _units(type(law)).items() if unit == "Pa"]
    strongest = max((value for value in stresses if isinstance(value, float)), default=0.0)
    return law.density < _MATERIAL["kg/m^3"].least and strongest >= _STRONG and law.initial_energy == 0.0


def _units(cls: type[BaseModel]) -> dict[str, str]:
    """Unit of each field that has one."""
    return {key: str(said_of(field)["unit"]) for key, field in cls.model_fields.items() if "unit" in said_of(field)}


def _numbers(path: Location, table: Mapping[str, Any], cls: type[BaseModel]) -> list[_Number]:
    return [
        _Number((*path, key), float(table[key]), unit)
        for key, unit in _units(cls).items()
        if isinstance(table.get(key), int | float) and not isinstance(table[key], bool)
    ]


def _largest(path: Location, table: Mapping[str, Any], law: Law, folder: Path) -> list[_Number]:
    """The largest stress of each curve that a material is given without a unit."""
    found = []
    for key, field in type(law).model_fields.items():
        units = tuple(said_of(field).get("units", ()))
        if units and key in table and not _has_unit(table[key], units, folder):
            found.append(_Number((*path, key), max(pair[1] for pair in getattr(law, key)), units[1], "the end of"))
    return found


def _has_unit(table: Any, units: tuple[str, ...], folder: Path) -> bool:
    """Whether the second column of a table, in the deck or in a file, was given with a unit."""
    if not isinstance(table, str):
        return any(isinstance(row[1], str) for row in table)
    try:
        return bool(tables.read_rows(table, (units[0], units[1]), folder)[1][1])
    except tables.TableError:  # changed since the law read it
        return True
