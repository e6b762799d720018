"""Curves without a plateau: elastic, elastic with linear hardening (E-P-H), and plastic hardening (R-PH) at a finite modulus."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.optimize import brentq

from hydro1d.analytic._checks import Array, between, positive, require
from hydro1d.analytic.curves.base import Curve, below_one


@dataclass(frozen=True)
class Elastic(Curve):
    """stress = E strain. density kg/m^3, modulus Pa."""

    density: float
    modulus: float

    def __post_init__(self) -> None:
        positive(self, "density", "modulus")

    @property
    def corners(self) -> tuple[float, ...]:
        """Strains between which the curve is concave-up."""
        return ()

    def _stress(self, strain: Array) -> Array:
        return self.modulus * strain

    def _tangent(self, strain: Array) -> Array:
        return np.full_like(strain, self.modulus)


@dataclass(frozen=True)
class EPH(Curve):
    """Elastic, linear plastic hardening: two lines. No shock: the plastic front is a linear wave, sqrt(H/rho0).

    density kg/m^3, modulus Pa, yield_limit Pa (the yield stress), hardening_modulus H in Pa, less than modulus.
    """

    density: float
    modulus: float
    yield_limit: float
    hardening_modulus: float

    def __post_init__(self) -> None:
        positive(self, "density", "modulus", "yield_limit", "hardening_modulus")
        between(self, "hardening_modulus", 0.0, self.modulus)

    @property
    def corners(self) -> tuple[float, ...]:
        """Strains between which the curve is concave-up."""
        return (self.yield_limit / self.modulus,)

    @property
    def plastic_speed(self) -> float:
        """Lagrangian speed of the plastic wave, m/s."""
        return math.sqrt(self.hardening_modulus / self.density)

    def _stress(self, strain: Array) -> Array:
        plastic = np.maximum(strain - self.yield_strain, 0.0)
        return np.minimum(self.modulus * strain, self.yield_limit) + self.hardening_modulus * plastic

    def _tangent(self, strain: Array) -> Array:
        return np.where(strain < self.yield_strain, self.modulus, self.hardening_modulus)

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        plastic = max(stress - self.yield_limit, 0.0) / self.hardening_modulus
        strain = min(stress, self.yield_limit) / self.modulus + plastic
        return below_one(strain, stress)


@dataclass(frozen=True)
class RPH(Curve):
    """Plastic hardening behind an elastic line: stress = min(E strain, plateau + hardening strain/(1 - strain)^2).

    Source: Zheng, Wang, Yu, Reid & Harrigan, JMPS 2014, doi:10.1016/j.jmps.2014.07.013 (rigid there: E infinite).
    density kg/m^3, modulus E, plateau_stress and hardening in Pa. The elastic line bounds the curve once more near
    strain 1, hence the second corner. Raises ValueError where the modulus is so low that nothing ever yields.
    """

    density: float
    modulus: float
    plateau_stress: float
    hardening: float

    def __post_init__(self) -> None:
        positive(self, "density", "modulus", "plateau_stress", "hardening")
        peak = self._strain_farthest_below()
        reached = peak > 0.0 and self._over_elastic(peak) < 0.0
        require(reached, "modulus", self.modulus, "high enough for the elastic line to reach the hardening curve")

    @cached_property
    def corners(self) -> tuple[float, ...]:
        """The two strains at which elastic line and hardening curve cross."""
        peak = self._strain_farthest_below()
        first = float(brentq(self._over_elastic, 0.0, peak, xtol=1e-17))
        return first, float(brentq(self._over_elastic, peak, self.strain_limit, xtol=1e-16))

    def _over_elastic(self, strain: float) -> float:
        return self._hardening_stress(strain) - self.modulus * strain

    def _strain_farthest_below(self) -> float:
        if self.hardening >= self.modulus:
            return 0.0
        return float(brentq(lambda e: self.modulus * (1.0 - e) ** 3 - self.hardening * (1.0 + e), 0.0, 1.0))

    def _hardening_stress(self, strain: Any) -> Any:
        return self.plateau_stress + self.hardening * strain / np.square(1.0 - strain)

    def _stress(self, strain: Array) -> Array:
        return np.minimum(self.modulus * strain, self._hardening_stress(strain))

    def _tangent(self, strain: Array) -> Array:
        plastic = (strain >= self.corners[0]) & (strain < self.corners[1])
        return np.where(plastic, self.hardening * (1.0 + strain) / (1.0 - strain) ** 3, self.modulus)

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        rise = max(stress - self.plateau_stress, 0.0)
        root = math.sqrt(self.hardening * (4.0 * rise + self.hardening))
        strain = max(stress / self.modulus, 2.0 * rise / (2.0 * rise + self.hardening + root))
        return below_one(strain, stress)
