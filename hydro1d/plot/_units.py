"""Units that people use: MPa, ms, mm, m/s; smaller or larger ones only where those would be unreadable."""

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

# Largest first; the number is the place of the unit that is used unless values fall below 0.01 or pass 10^5 of it.
_LADDERS: dict[str, tuple[int, tuple[tuple[float, str], ...]]] = {
    "Pa": (1, ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa"))),
    "s": (1, ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))),
    "m": (1, ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))),
    "m s-1": (1, ((1e3, "km/s"), (1.0, "m/s"), (1e-3, "mm/s"))),
    "J kg-1": (1, ((1e6, "MJ/kg"), (1e3, "kJ/kg"), (1.0, "J/kg"))),
    "J m-2": (1, ((1e6, "MJ/m²"), (1e3, "kJ/m²"), (1.0, "J/m²"))),
    "J m-3": (1, ((1e9, "GJ/m³"), (1e6, "MJ/m³"), (1e3, "kJ/m³"), (1.0, "J/m³"))),
    "Pa s": (0, ((1e3, "kPa s"), (1.0, "Pa s"))),
    "kg m-3": (0, ((1.0, "kg/m³"),)),
    "kg m-2": (0, ((1.0, "kg/m²"),)),
    "kg m-1 s-1": (0, ((1e3, "10³ kg/(m s)"), (1.0, "kg/(m s)"))),
    "1": (0, ((1.0, ""),)),
}
_MIN_SHOWN, _MAX_SHOWN = 0.01, 1e5

_WORDS = {
    "stress": "stress σ",
    "strain": "strain ε",
    "viscosity": "viscosity q",
    "density": "density ρ",
    "largest_strain": "largest strain so far",
    "maximum_strain": "largest strain",
    "position": "position x",
    "velocity": "velocity v",
    "time": "time t",
}


class Scale(NamedTuple):
    """A displayed unit: its size in SI and its name ("" for pure numbers)."""

    size: float
    unit: str

    def label(self, text: str) -> str:
        """Axis label: "stress σ (MPa)"."""
        return f"{text} ({self.unit})" if self.unit else text

    def show(self, value: float, digits: int = 4) -> str:
        """A value in SI as text with this unit: "3.6 MPa"."""
        text = f"{value / self.size:.{digits}g}"
        if "e+0" in text:  # 1.25e+03 is no way to write 1250
            text = f"{float(text):.0f}"
        return f"{text} {self.unit}".strip()


def scale_for(units: str, values: Any = None) -> Scale:
    """The unit in which to show SI values of `units`, an array or several."""
    preferred, ladder = _LADDERS.get(units, (0, ((1.0, "" if units == "1" else units),)))
    largest = _largest(values)
    place = preferred
    while largest > 0.0 and largest < _MIN_SHOWN * ladder[place][0] and place + 1 < len(ladder):
        place += 1
    while largest > _MAX_SHOWN * ladder[place][0] and place > 0:
        place -= 1
    return Scale(*ladder[place])


def words(name: str) -> str:
    """A quantity's name as an axis shows it."""
    return _WORDS.get(name, name.replace("_", " "))


def _largest(values: Any) -> float:
    if values is None:
        return 0.0
    arrays: Iterable[Any] = values if isinstance(values, list | tuple) else (values,)
    largest = 0.0
    for array in arrays:
        magnitude = np.abs(np.asarray(array, dtype=float))
        finite = magnitude[np.isfinite(magnitude)]
        largest = max(largest, float(finite.max(initial=0.0)))
    return largest
