"""Curves that come from outside: measured points, a function."""

import math
from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hydro1d.analytic._checks import Array, between, positive, require
from hydro1d.analytic.curves.base import Curve, below_one


@dataclass(frozen=True)
class Table(Curve):
    """Straight lines between measured points; beyond the last one the last line goes on.

    strains and stresses (Pa): increasing strains from above 0 to below 1, stresses that never fall, the first point
    on the elastic line of slope modulus (it is the yield point). density kg/m^3.
    """

    density: float
    modulus: float
    strains: tuple[float, ...]
    stresses: tuple[float, ...]

    def __post_init__(self) -> None:
        positive(self, "density", "modulus")
        strains, stresses = np.asarray(self.strains), np.asarray(self.stresses)
        same = len(strains) == len(stresses) >= 2
        require(same, "stresses", self.stresses, "as many as strains, at least 2")
        rising = bool(np.all(np.diff(strains) > 0.0)) and strains[0] > 0.0 and strains[-1] < 1.0
        require(rising, "strains", self.strains, "increasing, between 0 and 1")
        require(bool(np.all(np.diff(stresses) >= 0.0)), "stresses", self.stresses, "never falling")
        on_line = math.isclose(stresses[0], self.modulus * strains[0], rel_tol=1e-9)
        require(on_line, "stresses", self.stresses, "on the elastic line at the first strain")

    @property
    def corners(self) -> tuple[float, ...]:
        """Strains between which the curve is concave-up."""
        return tuple(self.strains)

    def _slopes(self) -> Array:
        lines = np.diff(self.stresses) / np.diff(self.strains)
        return np.concatenate([[self.modulus], lines, lines[-1:]])

    def _stress(self, strain: Array) -> Array:
        inside = np.interp(strain, (0.0, *self.strains), (0.0, *self.stresses))
        return inside + self._slopes()[-1] * np.maximum(strain - self.strains[-1], 0.0)

    def _tangent(self, strain: Array) -> Array:
        return self._slopes()[np.searchsorted(self.strains, strain, side="right")]

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        if stress <= self.stresses[0]:
            return stress / self.modulus
        line = min(bisect_left(self.stresses, stress), len(self.strains) - 1)
        slope = float(self._slopes()[line])
        require(slope > 0.0, "stress", stress, f"at most {self.stresses[-1]:.9g} Pa, where the table ends flat")
        strain = self.strains[line - 1] + (stress - self.stresses[line - 1]) / slope
        return below_one(strain, stress)


@dataclass(frozen=True)
class UserCurve(Curve):
    """An elastic line up to yield, then any concave-up function of strain.

    plastic(strain) returns the stress in Pa beyond yield (arrays in, arrays out), equal to yield_limit (Pa) at yield.
    density kg/m^3, modulus Pa; largest_strain is where the curve ends.
    """

    density: float
    modulus: float
    yield_limit: float
    plastic: Callable[[Array], Array]
    largest_strain: float = 1.0 - 1e-9

    def __post_init__(self) -> None:
        positive(self, "density", "modulus", "yield_limit")
        between(self, "largest_strain", self.yield_strain, 1.0)
        start = float(self.plastic(np.asarray(self.yield_strain)))
        meets = math.isclose(start, self.yield_limit, rel_tol=1e-9)
        require(meets, "plastic", start, f"the yield stress {self.yield_limit} Pa at the yield strain")

    @property
    def corners(self) -> tuple[float, ...]:
        """Strains between which the curve is concave-up."""
        return (self.yield_limit / self.modulus,)

    @property
    def strain_limit(self) -> float:
        """Largest strain at which the curve is defined."""
        return self.largest_strain

    def _stress(self, strain: Array) -> Array:
        beyond = self.plastic(np.maximum(strain, self.yield_strain))
        return np.where(strain < self.yield_strain, self.modulus * strain, beyond)

    def _tangent(self, strain: Array) -> Array:
        step = 1e-6 * (1.0 - strain)
        slope = (self.plastic(strain + step) - self.plastic(strain)) / step
        return np.where(strain < self.yield_strain, self.modulus, slope)
