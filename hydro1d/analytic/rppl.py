"""Scheme 1: a rigid mass strikes a column of rigid, perfectly plastic, locking material (R-P-P-L) with a fixed back.

Source: Eqs. 1-13 of Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011. The formulas in time
follow from Eq. 6, integrated: with the crushed length X = u/eD, M X + rho0 X^2/2 = (M v0 t - plateau t^2/2)/eD.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, Flags, between, coordinates, positive, times
from hydro1d.analytic.jumps import Fields, Jump, State
from hydro1d.analytic.rigid import FrontHistory, MomentumStriker


@dataclass(frozen=True)
class RPPL:
    """Rigid, perfectly plastic, locking: density kg/m^3, plateau_stress Pa, densification_strain (plain)."""

    density: float
    plateau_stress: float
    densification_strain: float

    def __post_init__(self) -> None:
        positive(self, "density", "plateau_stress")
        between(self, "densification_strain", 0.0, 1.0)

    @property
    def locked_density(self) -> float:
        """Density behind the front, kg/m^3 (Eq. 2)."""
        return self.density / (1.0 - self.densification_strain)

    @property
    def characteristic_velocity(self) -> float:
        """Velocity at which inertia doubles the plateau stress, sqrt(plateau eD/rho0), m/s."""
        return math.sqrt(self.plateau_stress * self.densification_strain / self.density)

    def shock_stress(self, velocity: ArrayLike) -> Array:
        """Stress behind a front that stops material ahead of `velocity` (m/s), Pa (Eq. 5)."""
        return self.plateau_stress + self.density * np.square(velocity) / self.densification_strain

    def absorbed_energy(self, shock_stress: ArrayLike) -> Array:
        """Internal energy behind a front of that stress (Pa), J/kg (Eq. 22 over the initial density)."""
        mean = 0.5 * (np.asarray(shock_stress, dtype=float) + self.plateau_stress)
        return mean * self.densification_strain / self.density

    def jump(self, velocity: float, coordinate: float) -> Jump:
        """The front at `coordinate` (m) behind which the crushed material moves at `velocity` (m/s)."""
        stress = float(self.shock_stress(velocity))
        energy = float(self.absorbed_energy(stress))
        ahead = State(0.0, self.plateau_stress, 0.0, self.density, 0.0)
        behind = State(velocity, stress, self.densification_strain, self.locked_density, energy)
        return Jump(ahead, behind, self.density, velocity / self.densification_strain, coordinate)

    def fields(self, crushed: Flags, velocity: ArrayLike, block_stress: Array, crossing_stress: Array) -> Fields:
        """Fields of a crushed block that moves as a rigid body and of virgin material at plateau stress.

        crushed: which points the front has passed; block_stress (Pa) there; crossing_stress (Pa): behind the front
        when it passed the point, which fixes the internal energy for good.
        """
        strain = np.where(crushed, self.densification_strain, 0.0)
        return Fields(
            np.where(crushed, velocity, 0.0),
            np.where(crushed, block_stress, self.plateau_stress),
            strain,
            self.density / (1.0 - strain),
            np.where(crushed, self.absorbed_energy(crossing_stress), 0.0),
        )


@dataclass(frozen=True)
class RPPLStriker(MomentumStriker):
    """Mass against a column of R-P-P-L (Scheme 1, Eqs. 1-13).

    material; mass of the striker per area, kg/m^2 (G/A0); impact_velocity v0, m/s; length of the column, m.
    The stress after the striker has come to rest is undetermined in rigid bodies and returned as NaN.
    Raises ValueError for times after full locking, when the stress is unbounded.
    """

    material: RPPL

    @property
    def critical_length(self) -> float:
        """Length of column that is just fully crushed, m (Eq. 13)."""
        return float(critical_length(self.material, self.mass, self.impact_velocity))

    @cached_property
    def locking_time(self) -> float:
        """When the front reaches the back, s; infinite if it never does."""
        if self.length >= self.critical_length:
            return math.inf
        momentum = self.mass * self.impact_velocity
        block = self.mass + 0.5 * self.material.density * self.length
        needed = self.material.densification_strain * self.length * block
        root = math.sqrt(momentum**2 - 2.0 * self.material.plateau_stress * needed)
        return 2.0 * needed / (momentum + root)

    def velocity_at(self, displacement: ArrayLike) -> Array:
        """v after a displacement u (m) of the striker, m/s (Eq. 8); 0 where it never gets that far."""
        material = self.material
        share = np.square(self.mass / (self.mass + material.density * self._crushed(displacement)))
        square = (self.impact_velocity**2 + material.characteristic_velocity**2) * share
        return np.sqrt(np.maximum(square - material.characteristic_velocity**2, 0.0))

    def stress_at(self, displacement: ArrayLike) -> Array:
        """Stress behind the front after a displacement u (m), Pa (Eq. 9)."""
        share = np.square(self.mass / (self.mass + self.material.density * self._crushed(displacement)))
        return self.material.shock_stress(self.impact_velocity) * share

    def deformed_length(self, displacement: ArrayLike) -> Array:
        """x, deformed length of the crushed part after a displacement u (m), m (Eqs. 1 and 2)."""
        return self._crushed(displacement) * (1.0 - self.material.densification_strain)

    def _crushed(self, displacement: ArrayLike) -> Array:
        return np.asarray(displacement, dtype=float) / self.material.densification_strain

    def history(self, t: ArrayLike) -> FrontHistory:
        """Displacement, velocity, front and stresses at times t (s)."""
        t = times(t, self.locking_time, "then the column is fully locked")
        material, moving = self.material, np.minimum(t, self.stop_time)
        momentum = np.maximum(self.mass * self.impact_velocity - material.plateau_stress * moving, 0.0)
        # The quadratic's root in the form that does not cancel for a heavy striker or a short time.
        twice = moving * (self.mass * self.impact_velocity + momentum) / material.densification_strain
        front = twice / (self.mass + np.sqrt(self.mass**2 + material.density * twice))
        velocity = momentum / (self.mass + material.density * front)
        front_stress = np.where(t > self.stop_time, np.nan, material.shock_stress(velocity))
        left_stress = self._striker_stress(front_stress, front)
        return FrontHistory(front * material.densification_strain, velocity, front, front_stress, left_stress)

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s), which broadcast; on the front, the state ahead."""
        coordinate = coordinates(coordinate, self.length)
        history = self.history(t)
        crushed = coordinate < history.front
        share = (self.mass + self.material.density * coordinate) / (self.mass + self.material.density * history.front)
        crossing = self.stress_at(np.where(crushed, coordinate, 0.0) * self.material.densification_strain)
        fields = self.material.fields(crushed, history.velocity, history.front_stress * share, crossing)
        return fields._replace(stress=np.where(np.asarray(t) > self.stop_time, np.nan, fields.stress))


def critical_length(material: RPPL, mass: ArrayLike, impact_velocity: ArrayLike) -> Array:
    """lCR1, length of column that a striker (kg/m^2, m/s) just fully crushes, m (Eq. 13); arrays broadcast."""
    ratio = np.square(np.asarray(impact_velocity, dtype=float) / material.characteristic_velocity)
    # sqrt(1 + r) - 1 in the form that keeps its digits for slow strikers
    return np.asarray(mass, dtype=float) / material.density * ratio / (np.sqrt(1.0 + ratio) + 1.0)


def full_locking_velocity(material: RPPL, mass: ArrayLike, length: ArrayLike) -> Array:
    """vD, impact velocity at which a striker (kg/m^2) just locks a column of `length` (m), m/s (Eqs. 10, 11)."""
    ratio = material.density * np.asarray(length, dtype=float) / np.asarray(mass, dtype=float)
    return material.characteristic_velocity * np.sqrt(ratio * (ratio + 2.0))


def energy_ratio(material: RPPL, mass: ArrayLike, length: ArrayLike) -> Array:
    """psi, energy absorbed at full locking, dynamic over quasi-static (Eq. 12)."""
    core = material.density * np.asarray(length, dtype=float)
    return 1.0 + core / (2.0 * np.asarray(mass, dtype=float))
