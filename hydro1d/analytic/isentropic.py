"""A smooth compression (or expansion) of an ideal gas by a piston: a simple wave, exact until a shock forms.

In Lagrangian coordinates the characteristics that leave the piston at time tau are straight lines
coordinate = C (t - tau), with C = rho c/rho0, and carry the piston's state: c = c0 + (gamma - 1) v/2 and isentropic.
Source: Courant & Friedrichs, Supersonic Flow and Shock Waves, 1948, chapter III, doi:10.1007/978-1-4684-9364-1.
Measures a scheme's order in space and time: the piston's path has three continuous derivatives at its start and end.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar

from hydro1d.analytic._checks import Array, coordinates, length_allowed, positive, require, times
from hydro1d.analytic._roots import bisect
from hydro1d.analytic.jumps import Fields


@dataclass(frozen=True)
class SimpleWave:
    """Gas at rest, compressed from coordinate 0 by a piston that accelerates smoothly to `velocity` over `rise_time`.

    density kg/m^3, pressure Pa, gamma: the gas at rest; velocity of the piston at last, m/s (negative: expansion);
    rise_time s; length of the gas, m (its far end is not reached before `end_time`).
    Drive a solver with `piston_velocity(t)`. There are no jumps; ValueError after `end_time`.
    """

    density: float
    pressure: float
    velocity: float
    rise_time: float
    gamma: float = 1.4
    length: float = math.inf

    def __post_init__(self) -> None:
        positive(self, "density", "pressure", "rise_time")
        require(math.isfinite(self.gamma) and self.gamma > 1.0, "gamma", self.gamma, "finite and greater than 1")
        length_allowed(self.length)
        slowest = -2.0 * self.sound_speed / (self.gamma - 1.0)
        require(self.velocity > slowest, "velocity", self.velocity, f"greater than {slowest:.9g} m/s (escape speed)")

    @property
    def sound_speed(self) -> float:
        """Sound speed of the gas at rest, m/s."""
        return math.sqrt(self.gamma * self.pressure / self.density)

    def piston_velocity(self, t: ArrayLike) -> Array:
        """Velocity of the piston at times t (s), m/s: a polynomial step of degree 7."""
        s = np.clip(np.asarray(t, dtype=float) / self.rise_time, 0.0, 1.0)
        return self.velocity * s**4 * (35.0 + s * (-84.0 + s * (70.0 - 20.0 * s)))

    def piston_displacement(self, t: ArrayLike) -> Array:
        """Displacement of the piston at times t (s), m."""
        t = np.asarray(t, dtype=float)
        s = np.clip(t / self.rise_time, 0.0, 1.0)
        risen = s**5 * (7.0 + s * (-14.0 + s * (10.0 - 2.5 * s)))
        return self.velocity * (self.rise_time * risen + np.maximum(t - self.rise_time, 0.0))

    @cached_property
    def shock_time(self) -> float:
        """When the first characteristics cross, s; infinite for an expansion."""
        if self.velocity <= 0.0:
            return math.inf
        starts = np.linspace(0.0, self.rise_time, 2001)[1:-1]
        first = int(np.argmin(self._crossing_time(starts)))
        low, high = starts[max(first - 1, 0)], starts[min(first + 1, len(starts) - 1)]
        best = minimize_scalar(
            lambda tau: float(self._crossing_time(np.asarray(tau))),
            bounds=(low, high),
            method="bounded",
            options={"xatol": 1e-10 * self.rise_time},
        )
        return float(best.fun)

    @property
    def end_time(self) -> float:
        """When a shock forms or the head of the wave reaches the far end, s."""
        return min(self.shock_time, self.length / self.sound_speed)

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at the Lagrangian coordinate (m) and t (s), which broadcast."""
        velocity = self.piston_velocity(self._departure(coordinate, t))
        sound = self._relative_sound_speed(velocity)
        relative_density = sound ** (2.0 / (self.gamma - 1.0))
        density = self.density * relative_density
        stress = self.pressure * sound ** (2.0 * self.gamma / (self.gamma - 1.0))
        return Fields(velocity, stress, 1.0 - 1.0 / relative_density, density, stress / ((self.gamma - 1.0) * density))

    def displacement(self, coordinate: ArrayLike, t: ArrayLike) -> Array:
        """Displacement of the material of a Lagrangian coordinate (m) at time t (s), m.

        Along a characteristic d(u)/dt = v + C du/dX = v - C strain, which is constant there.
        """
        start = self._departure(coordinate, t)
        velocity = self.piston_velocity(start)
        sound = self._relative_sound_speed(velocity)
        strain = 1.0 - sound ** (-2.0 / (self.gamma - 1.0))
        rate = velocity - self._front_speed(velocity) * strain
        return self.piston_displacement(start) + rate * (np.asarray(t, dtype=float) - start)

    def _departure(self, coordinate: ArrayLike, t: ArrayLike) -> Array:
        """Time at which the characteristic through (coordinate, t) left the piston; t = coordinate = 0 ahead of it."""
        coordinate, t = np.broadcast_arrays(
            coordinates(coordinate, self.length),
            times(t, self.end_time, "then a shock forms or the far end is reached"),
        )
        undisturbed = coordinate >= self.sound_speed * t
        start = bisect(lambda tau: self._front_speed(self.piston_velocity(tau)) * (t - tau) < coordinate, 0.0 * t, t)
        # Ahead of the wave the state is that of rest at any time before the start.
        return np.where(undisturbed, 0.0, start)

    def _relative_sound_speed(self, velocity: Array) -> Array:
        return 1.0 + 0.5 * (self.gamma - 1.0) * velocity / self.sound_speed

    def _front_speed(self, velocity: Array) -> Array:
        exponent = (self.gamma + 1.0) / (self.gamma - 1.0)
        return self.sound_speed * self._relative_sound_speed(velocity) ** exponent

    def _crossing_time(self, start: Array) -> Array:
        """When the characteristics that leave around `start` cross: start + C/(dC/dstart)."""
        s = start / self.rise_time
        acceleration = self.velocity * 140.0 * (s * (1.0 - s)) ** 3 / self.rise_time
        relative_rate = 0.5 * (self.gamma + 1.0) * acceleration / self.sound_speed
        return start + self._relative_sound_speed(self.piston_velocity(start)) / relative_rate
