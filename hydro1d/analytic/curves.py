"""Stress-strain curves on first loading, independent of the solver's laws.

Compression positive, engineering strain. A curve is linear or concave-up between its corners, which is what the
exact solutions need: a front can only end at a corner or at the final state.
"""

import math
from abc import ABC, abstractmethod
from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import quad
from scipy.optimize import brentq

from hydro1d.analytic._checks import Array, between, positive, require


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
    def stress(self, strain: ArrayLike) -> Array:
        """Stress in Pa, shape of `strain`."""

    @abstractmethod
    def tangent(self, strain: ArrayLike) -> Array:
        """Slope of the curve in Pa, shape of `strain`; at a corner, the slope beyond it."""

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa).

        Raises ValueError where the curve never reaches that stress.
        """
        if stress <= self.yield_stress:
            return stress / self.modulus
        highest = float(self.stress(self.strain_limit))
        require(stress <= highest, "stress", stress, f"at most {highest:.9g} Pa, where the curve ends")
        low = self.yield_strain
        return float(brentq(lambda strain: float(self.stress(strain)) - stress, low, self.strain_limit, xtol=1e-16))

    def area(self, strain: float) -> float:
        """Area under the curve from zero to `strain`, J/m^3: the quasi-static energy absorption."""
        marks = [0.0, *[corner for corner in self.corners if corner < strain], strain]
        pieces = [quad(self._stress_at, *ends, epsabs=0.0, epsrel=1e-12)[0] for ends in pairwise(marks)]
        return float(sum(pieces))

    def _stress_at(self, strain: float) -> float:
        return float(self.stress(strain))


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

    def stress(self, strain: ArrayLike) -> Array:
        """Stress, Pa, shape of `strain`."""
        return self.modulus * np.asarray(strain, dtype=float)

    def tangent(self, strain: ArrayLike) -> Array:
        """Slope of the curve, Pa, shape of `strain`."""
        return np.full_like(np.asarray(strain, dtype=float), self.modulus)


class _PlateauCurve(Curve):
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

    def stress(self, strain: ArrayLike) -> Array:
        """Stress, Pa, shape of `strain`."""
        strain = np.asarray(strain, dtype=float)
        crushed = np.maximum(strain, self.densification_strain)
        rise = np.where(strain > self.densification_strain, self._rise(crushed), 0.0)
        return np.minimum(self.modulus * strain, self.plateau_stress) + rise

    def tangent(self, strain: ArrayLike) -> Array:
        """Slope of the curve, Pa, shape of `strain`."""
        strain = np.asarray(strain, dtype=float)
        crushed = np.maximum(strain, self.densification_strain)
        beyond = np.where(strain < self.densification_strain, 0.0, self._slope(crushed))
        return np.where(strain < self.plateau_stress / self.modulus, self.modulus, beyond)


@dataclass(frozen=True)
class EPPH(_PlateauCurve):
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
class TangentEPPH(_PlateauCurve):
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


@dataclass(frozen=True)
class Trilinear(_PlateauCurve):
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
        require(strain < 1.0, "stress", stress, "less than the stress at strain 1")
        return strain


def stiff_rppl(density: float, plateau_stress: float, densification_strain: float, stiffness: float) -> Trilinear:
    """R-P-P-L at finite stiffness K (Pa): elastic line and locking line both of slope K."""
    return Trilinear(density, stiffness, plateau_stress, densification_strain, stiffness)


def stiff_eppr(
    density: float, modulus: float, plateau_stress: float, densification_strain: float, stiffness: float
) -> Trilinear:
    """E-P-P-R at finite stiffness K (Pa): elastic line of slope modulus, locking line of slope K."""
    return Trilinear(density, modulus, plateau_stress, densification_strain, stiffness)


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

    def stress(self, strain: ArrayLike) -> Array:
        """Stress, Pa, shape of `strain`."""
        strain = np.asarray(strain, dtype=float)
        plastic = np.maximum(strain - self.yield_strain, 0.0)
        return np.minimum(self.modulus * strain, self.yield_limit) + self.hardening_modulus * plastic

    def tangent(self, strain: ArrayLike) -> Array:
        """Slope of the curve, Pa, shape of `strain`."""
        return np.where(np.asarray(strain) < self.yield_strain, self.modulus, self.hardening_modulus)

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        plastic = max(stress - self.yield_limit, 0.0) / self.hardening_modulus
        strain = min(stress, self.yield_limit) / self.modulus + plastic
        require(strain < 1.0, "stress", stress, "less than the stress at strain 1")
        return strain


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
        crossings = (
            float(brentq(self._over_elastic, 0.0, peak, xtol=1e-17)),
            float(brentq(self._over_elastic, peak, self.strain_limit, xtol=1e-16)),
        )
        object.__setattr__(self, "_corners", crossings)

    @property
    def corners(self) -> tuple[float, ...]:
        """Strains between which the curve is concave-up."""
        crossings: tuple[float, ...] = self.__dict__["_corners"]
        return crossings

    def _over_elastic(self, strain: float) -> float:
        return float(self._hardening_stress(strain)) - self.modulus * strain

    def _strain_farthest_below(self) -> float:
        if self.hardening >= self.modulus:
            return 0.0
        return float(brentq(lambda e: self.modulus * (1.0 - e) ** 3 - self.hardening * (1.0 + e), 0.0, 1.0))

    def _hardening_stress(self, strain: ArrayLike) -> Array:
        strain = np.asarray(strain, dtype=float)
        return self.plateau_stress + self.hardening * strain / np.square(1.0 - strain)

    def stress(self, strain: ArrayLike) -> Array:
        """Stress, Pa, shape of `strain`."""
        return np.minimum(self.modulus * np.asarray(strain, dtype=float), self._hardening_stress(strain))

    def tangent(self, strain: ArrayLike) -> Array:
        """Slope of the curve, Pa, shape of `strain`."""
        strain = np.asarray(strain, dtype=float)
        plastic = (strain >= self.corners[0]) & (strain < self.corners[1])
        return np.where(plastic, self.hardening * (1.0 + strain) / (1.0 - strain) ** 3, self.modulus)

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        rise = max(stress - self.plateau_stress, 0.0)
        root = math.sqrt(self.hardening * (4.0 * rise + self.hardening))
        strain = max(stress / self.modulus, 2.0 * rise / (2.0 * rise + self.hardening + root))
        require(strain < 1.0, "stress", stress, "less than the stress at strain 1")
        return strain


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

    def stress(self, strain: ArrayLike) -> Array:
        """Stress, Pa, shape of `strain`."""
        strain = np.asarray(strain, dtype=float)
        inside = np.interp(strain, (0.0, *self.strains), (0.0, *self.stresses))
        return inside + self._slopes()[-1] * np.maximum(strain - self.strains[-1], 0.0)

    def tangent(self, strain: ArrayLike) -> Array:
        """Slope of the curve, Pa, shape of `strain`."""
        return self._slopes()[np.searchsorted(self.strains, np.asarray(strain), side="right")]

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        if stress <= self.stresses[0]:
            return stress / self.modulus
        line = min(bisect_left(self.stresses, stress), len(self.strains) - 1)
        slope = float(self._slopes()[line])
        require(slope > 0.0, "stress", stress, f"at most {self.stresses[-1]:.9g} Pa, where the table ends flat")
        strain = self.strains[line - 1] + (stress - self.stresses[line - 1]) / slope
        require(strain < 1.0, "stress", stress, "less than the stress at strain 1")
        return strain


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

    def stress(self, strain: ArrayLike) -> Array:
        """Stress, Pa, shape of `strain`."""
        strain = np.asarray(strain, dtype=float)
        beyond = self.plastic(np.maximum(strain, self.yield_strain))
        return np.where(strain < self.yield_strain, self.modulus * strain, beyond)

    def tangent(self, strain: ArrayLike) -> Array:
        """Slope of the curve, Pa, shape of `strain`."""
        strain = np.asarray(strain, dtype=float)
        step = 1e-6 * (1.0 - strain)
        slope = (self.plastic(strain + step) - self.plastic(strain)) / step
        return np.where(strain < self.yield_strain, self.modulus, slope)
