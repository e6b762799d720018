"""One straight line and two: elastic, and elastic with linear plastic hardening."""

import math
from dataclasses import dataclass

import numpy as np

from hydro1d.analytic._checks import Array, between, positive
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
