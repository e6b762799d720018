"""A stress-strain curve on first loading: what the exact solutions ask of it.

Compression positive, engineering strain. A curve is linear or concave-up between its corners, which is what the
exact solutions need: a front can only end at a corner or at the final state.
"""

import math
from abc import ABC, abstractmethod
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import quad
from scipy.optimize import brentq

from hydro1d.analytic._checks import Array, require


class Curve(ABC):
    """A stress-strain curve on first loading.

    density is the initial density (kg/m^3), modulus the elastic modulus (Pa).
    """

    density: float
    modulus: float

    @property
    def yield_strain(self) -> float:
        """Strain at which the elastic line ends."""
        return self.corners[0] if self.corners else math.inf

    @property
    def yield_stress(self) -> float:
        """Stress at which the elastic line ends, Pa."""
        return self.modulus * self.yield_strain

    @property
    def yield_velocity(self) -> float:
        """VY, material velocity behind an elastic precursor at yield, m/s (Eq. 41)."""
        return self.yield_stress / math.sqrt(self.modulus * self.density)

    @property
    def elastic_speed(self) -> float:
        """c0, elastic wave speed (Lagrangian), m/s (Eq. 40)."""
        return math.sqrt(self.modulus / self.density)

    @property
    def strain_limit(self) -> float:
        """Largest strain at which the curve is defined."""
        return 1.0 - 1e-15

    @property
    @abstractmethod
    def corners(self) -> tuple[float, ...]:
        """Increasing strains between which the curve is concave-up; the first is the yield strain."""

    @abstractmethod
    def _stress(self, strain: Array) -> Array: ...

    @abstractmethod
    def _tangent(self, strain: Array) -> Array: ...

    def stress(self, strain: ArrayLike) -> Array:
        """Stress in Pa, shape of `strain`."""
        return self._stress(np.asarray(strain, dtype=float))

    def tangent(self, strain: ArrayLike) -> Array:
        """Slope of the curve in Pa, shape of `strain`; at a corner, the slope beyond it."""
        return self._tangent(np.asarray(strain, dtype=float))

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa).

        Raises ValueError where the curve never reaches that stress.
        """
        if stress <= self.yield_stress:
            return below_one(stress / self.modulus, stress)
        highest = float(self.stress(self.strain_limit))
        require(stress <= highest, "stress", stress, f"at most {highest:.9g} Pa, where the curve ends")
        low = self.yield_strain
        return float(brentq(lambda strain: float(self.stress(strain)) - stress, low, self.strain_limit, xtol=1e-16))

    def area(self, strain: float) -> float:
        """Area under the curve from zero to `strain`, J/m^3: the quasi-static energy absorption."""
        marks = [0.0, *[corner for corner in self.corners if corner < strain], strain]
        return float(sum(quad(self.stress, *ends, epsabs=0.0, epsrel=1e-12)[0] for ends in pairwise(marks)))


def below_one(strain: float, stress: float) -> float:
    """The strain, which carries `stress` (Pa); ValueError where it is 1 or more."""
    require(strain < 1.0, "stress", stress, "less than the stress at strain 1")
    return strain
