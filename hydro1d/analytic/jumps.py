"""Jump conditions across a front in a one-dimensional continuum, any law.

Source: Eqs. 20-22 and 31-37 of Harrigan, Reid & Seyed Yaghoubi, Int. J. Impact Eng. 37 (2010) 918-927,
doi:10.1016/j.ijimpeng.2009.03.011. A is the state ahead of the front, B the one behind, [f] = f_B - f_A.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, require


class State(NamedTuple):
    """State of a material point: velocity (m/s), stress (Pa), strain (-), density (kg/m^3), internal energy (J/kg)."""

    velocity: float
    stress: float
    strain: float
    density: float
    internal_energy: float


class Fields(NamedTuple):
    """As `State`, as arrays of the shape to which coordinate and time broadcast."""

    velocity: Array
    stress: Array
    strain: Array
    density: Array
    internal_energy: Array


class Residuals(NamedTuple):
    """Relative residuals of the jump conditions; 0 for a front that satisfies them to the last digit of its states."""

    mass: float
    momentum: float
    energy: float


@dataclass(frozen=True)
class Jump:
    """A front: the states ahead of it and behind it, and how fast it runs through the material.

    initial_density in kg/m^3 at zero strain; front_speed in m/s is Lagrangian (metres of initial column a second),
    negative for a front that runs to the left; coordinate in m is where the front is, Lagrangian.
    The states may be measured ones: nothing here assumes that they satisfy the conditions.
    """

    ahead: State
    behind: State
    initial_density: float
    front_speed: float
    coordinate: float = 0.0

    @property
    def velocity(self) -> float:
        """[v], m/s."""
        return self.behind.velocity - self.ahead.velocity

    @property
    def strain(self) -> float:
        """[strain]."""
        return self.behind.strain - self.ahead.strain

    @property
    def stress(self) -> float:
        """[stress], Pa."""
        return self.behind.stress - self.ahead.stress

    @property
    def shock_speed(self) -> float:
        """cS, the speed relative to the material just ahead, m/s (Eq. 35)."""
        return (1.0 - self.ahead.strain) * self.front_speed

    @property
    def laboratory_speed(self) -> float:
        """VS = vA + cS, m/s (Eq. 33)."""
        return self.ahead.velocity + self.shock_speed

    @property
    def mass_rate(self) -> float:
        """Mass the front passes in unit time and area, kg/(m^2 s) (Eq. 36)."""
        return self.initial_density * self.front_speed

    @property
    def absorbed_energy(self) -> float:
        """EV, the energy absorbed across the front per initial volume, J/m^3 (Eq. 22)."""
        return float(absorbed_energy(self.ahead.stress, self.behind.stress, self.strain))

    def residuals(self) -> Residuals:
        """How far the states are from Eqs. 31 (mass), 32 (momentum) and 22 (energy).

        Each is the difference of the two sides over the larger of them. What the last digit of the states alone makes
        of the difference does not count: a weak jump is the small difference of two large stresses, and no number
        held as a double says more about it.
        """
        stored = self.initial_density * (self.behind.internal_energy - self.ahead.internal_energy)
        last = State(*(math.ulp(a) + math.ulp(b) for a, b in zip(self.ahead, self.behind, strict=True)))
        mean_stress = 0.5 * (abs(self.ahead.stress) + abs(self.behind.stress))
        of_energy = self.initial_density * last.internal_energy + mean_stress * last.strain
        return Residuals(
            mass=_relative_difference(
                self.velocity, self.front_speed * self.strain, last.velocity + abs(self.front_speed) * last.strain
            ),
            momentum=_relative_difference(
                self.stress, self.mass_rate * self.velocity, last.stress + abs(self.mass_rate) * last.velocity
            ),
            energy=_relative_difference(stored, self.absorbed_energy, of_energy + 0.5 * abs(self.strain) * last.stress),
        )


def _relative_difference(left: float, right: float, digits: float) -> float:
    """|left − right| beyond `digits`, the rounding of what they were made of, over the larger of the two."""
    scale = max(abs(left), abs(right))
    return max(abs(left - right) - digits, 0.0) / scale if scale > 0.0 else 0.0


def density(initial_density: ArrayLike, strain: ArrayLike) -> Array:
    """Density, kg/m^3, at an engineering compressive strain (Eq. 34)."""
    return np.asarray(initial_density, dtype=float) / (1.0 - np.asarray(strain, dtype=float))


def shock_speed(strain_ahead: ArrayLike, velocity_jump: ArrayLike, strain_jump: ArrayLike) -> Array:
    """cS, the shock speed relative to the material just ahead, m/s (Eq. 35)."""
    return (1.0 - np.asarray(strain_ahead, dtype=float)) * np.asarray(velocity_jump) / np.asarray(strain_jump)


def stress_jump(initial_density: ArrayLike, velocity_jump: ArrayLike, strain_jump: ArrayLike) -> Array:
    """[stress] = rho0 [v]^2/[strain], Pa (Eq. 37)."""
    return np.asarray(initial_density, dtype=float) * np.square(velocity_jump) / np.asarray(strain_jump)


def absorbed_energy(stress_ahead: ArrayLike, stress_behind: ArrayLike, strain_jump: ArrayLike) -> Array:
    """EV = (stress_B + stress_A) [strain]/2, energy absorbed per initial volume, J/m^3 (Eq. 22)."""
    return 0.5 * (np.asarray(stress_behind, dtype=float) + np.asarray(stress_ahead)) * np.asarray(strain_jump)


def striker_work(shock_stress: ArrayLike, displacement: ArrayLike) -> Array:
    """Work of the shock stress on the element it crushes, per area, J/m^2 (Eq. 20)."""
    return np.asarray(shock_stress, dtype=float) * np.asarray(displacement)


def element_kinetic_energy(initial_density: float, velocity: ArrayLike, crushed_length: ArrayLike) -> Array:
    """Kinetic energy that the element gains, per area, J/m^2 (Eq. 21); crushed_length is its initial length."""
    return 0.5 * initial_density * np.square(velocity) * np.asarray(crushed_length, dtype=float)


def shocked_state(initial_density: float, ahead: State, strain: float, stress: float, direction: int = 1) -> State:
    """The state behind a shock into `ahead` that ends at (strain, stress) of the material's curve.

    direction is 1 for a front that runs to the right, -1 to the left. Raises ValueError where the stress does not rise
    with the strain: no front connects such states (Eq. 37).
    """
    product = (stress - ahead.stress) * (strain - ahead.strain)
    require(product >= 0.0, "stress", stress, f"on the far side of {ahead.stress} Pa, as the strain is")
    change = direction * float(np.sign(strain - ahead.strain)) * float(np.sqrt(product / initial_density))
    gained = float(absorbed_energy(ahead.stress, stress, strain - ahead.strain)) / initial_density
    return State(
        ahead.velocity + change,
        stress,
        strain,
        float(density(initial_density, strain)),
        ahead.internal_energy + gained,
    )


def shock_jump(initial_density: float, ahead: State, behind: State, direction: int = 1) -> Jump:
    """The front between two states, with the speed that momentum asks for (Eqs. 35 and 37)."""
    slope = (behind.stress - ahead.stress) / (behind.strain - ahead.strain)
    return Jump(ahead, behind, initial_density, direction * float(np.sqrt(slope / initial_density)))


def rest_state(initial_density: float) -> State:
    """Material never loaded, at rest."""
    return State(0.0, 0.0, 0.0, initial_density, 0.0)
