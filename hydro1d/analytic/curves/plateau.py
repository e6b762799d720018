"""Foams with a flat plateau: an elastic line, the plateau, and from densification on a line (locking), Eq. 39 or Eq. 38.

R-P-P-L and E-P-P-R are the stiff ends of a locking line. Source of E-P-P-H: Harrigan, Reid & Seyed Yaghoubi 2010,
doi:10.1016/j.ijimpeng.2009.03.011.
"""

import math
from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from hydro1d.analytic._checks import Array, between, positive, require
from hydro1d.analytic.curves.base import Curve, below_one


class PlateauCurve(Curve):
    """Elastic line, flat plateau up to densification, then what `_rise` says."""

    plateau_stress: float
    densification_strain: float

    def _check_plateau(self) -> None:
        positive(self, "density", "modulus", "plateau_stress")
        between(self, "densification_strain", self.plateau_stress / self.modulus, 1.0)

    @property
    def corners(self) -> tuple[float, ...]:
        """Strains between which the curve is concave-up."""
        return (self.plateau_stress / self.modulus, self.densification_strain)

    @abstractmethod
    def _rise(self, strain: Array) -> Array:
        """Stress above the plateau, Pa, at strains of at least the densification strain."""

    @abstractmethod
    def _slope(self, strain: Array) -> Array:
        """Derivative of `_rise`, Pa."""

    def _stress(self, strain: Array) -> Array:
        crushed = np.maximum(strain, self.densification_strain)
        rise = np.where(strain > self.densification_strain, self._rise(crushed), 0.0)
        return np.minimum(self.modulus * strain, self.plateau_stress) + rise

    def _tangent(self, strain: Array) -> Array:
        crushed = np.maximum(strain, self.densification_strain)
        beyond = np.where(strain < self.densification_strain, 0.0, self._slope(crushed))
        return np.where(strain < self.plateau_stress / self.modulus, self.modulus, beyond)


@dataclass(frozen=True)
class Trilinear(PlateauCurve):
    """Elastic line, plateau, locking line: stress = plateau + locking_modulus (strain - eD) beyond densification.

    density kg/m^3, modulus Pa, plateau_stress Pa, densification_strain eD, locking_modulus Pa.
    """

    density: float
    modulus: float
    plateau_stress: float
    densification_strain: float
    locking_modulus: float

    def __post_init__(self) -> None:
        self._check_plateau()
        positive(self, "locking_modulus")

    def _rise(self, strain: Array) -> Array:
        return self.locking_modulus * (strain - self.densification_strain)

    def _slope(self, strain: Array) -> Array:
        return np.full_like(strain, self.locking_modulus)

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        rise = stress - self.plateau_stress
        if rise <= 0.0:
            return stress / self.modulus
        strain = self.densification_strain + rise / self.locking_modulus
        return below_one(strain, stress)


def stiff_rppl(density: float, plateau_stress: float, densification_strain: float, stiffness: float) -> Trilinear:
    """R-P-P-L at finite stiffness K (Pa): elastic line and locking line both of slope K."""
    return Trilinear(density, stiffness, plateau_stress, densification_strain, stiffness)


def stiff_eppr(
    density: float, modulus: float, plateau_stress: float, densification_strain: float, stiffness: float
) -> Trilinear:
    """E-P-P-R at finite stiffness K (Pa): elastic line of slope modulus, locking line of slope K."""
    return Trilinear(density, modulus, plateau_stress, densification_strain, stiffness)


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
