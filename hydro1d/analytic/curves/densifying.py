"""E-P-P-H: elastic, perfectly plastic, hardening, by Eq. 39 and by Eq. 38.

Source: Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011.
"""

import math
from dataclasses import dataclass

import numpy as np

from hydro1d.analytic._checks import Array, positive, require
from hydro1d.analytic.curves.plateau import PlateauCurve


@dataclass(frozen=True)
class EPPH(PlateauCurve):
    """Elastic, perfectly plastic, hardening: the curve that makes [v] linear in strain (Eq. 39).

    stress = plateau + rho0 ((strain - eD)/s)^2/(strain - eY) beyond densification; defined up to strain 1.
    density kg/m^3, modulus Pa, plateau_stress Pa, densification_strain eD, shock_slope s in s/m.
    """

    density: float
    modulus: float
    plateau_stress: float
    densification_strain: float
    shock_slope: float

    def __post_init__(self) -> None:
        self._check_plateau()
        positive(self, "shock_slope")

    @property
    def strain_limit(self) -> float:
        """Largest strain at which the curve is defined."""
        return 1.0

    def _rise(self, strain: Array) -> Array:
        excess = strain - self.densification_strain
        return self.density * np.square(excess / self.shock_slope) / (strain - self.yield_strain)

    def _slope(self, strain: Array) -> Array:
        ratio = (strain - self.densification_strain) / (strain - self.yield_strain)
        return self.density / self.shock_slope**2 * ratio * (2.0 - ratio)

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        rise = stress - self.plateau_stress
        if rise <= 0.0:
            return stress / self.modulus
        plateau_length = self.densification_strain - self.yield_strain
        half = 0.5 * self.shock_slope**2 * rise / self.density
        strain = self.densification_strain + half + math.sqrt(half * (half + 2.0 * plateau_length))
        highest = float(self.stress(1.0))
        require(strain <= 1.0, "stress", stress, f"at most {highest:.9g} Pa, where the curve ends at strain 1")
        return strain


@dataclass(frozen=True)
class TangentEPPH(PlateauCurve):
    """Elastic, perfectly plastic, hardening as a tangent, unbounded as the strain approaches 1 (Eq. 38).

    stress = plateau {1 + beta [tan((1 - gamma + gamma (strain - eD)/(1 - eD)) pi/2) - tan((1 - gamma) pi/2)]}
    beyond densification. density kg/m^3, modulus Pa, plateau_stress Pa; densification_strain eD, beta, gamma plain.
    """

    density: float
    modulus: float
    plateau_stress: float
    densification_strain: float
    beta: float
    gamma: float

    def __post_init__(self) -> None:
        self._check_plateau()
        positive(self, "beta", "gamma")
        require(self.gamma <= 1.0, "gamma", self.gamma, "greater than 0 and at most 1")

    def _cofactor_angle(self, strain: Array) -> Array:
        # pi/2 minus the angle of Eq. 38: exact near strain 1, where the angle itself loses all its digits.
        return 0.5 * math.pi * self.gamma * (1.0 - strain) / (1.0 - self.densification_strain)

    @property
    def _offset(self) -> float:
        return math.tan(0.5 * math.pi * (1.0 - self.gamma))

    def _rise(self, strain: Array) -> Array:
        return self.plateau_stress * self.beta * (1.0 / np.tan(self._cofactor_angle(strain)) - self._offset)

    def _slope(self, strain: Array) -> Array:
        rate = 0.5 * math.pi * self.gamma / (1.0 - self.densification_strain)
        return self.plateau_stress * self.beta * rate / np.square(np.sin(self._cofactor_angle(strain)))

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        if stress <= self.plateau_stress:
            return stress / self.modulus
        cotangent = (stress / self.plateau_stress - 1.0) / self.beta + self._offset
        span = 2.0 * (1.0 - self.densification_strain) / (math.pi * self.gamma)
        return 1.0 - span * math.atan2(1.0, cotangent)
