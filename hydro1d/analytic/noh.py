"""Planar Noh problem for any gamma: a gas that runs against a wall and is stopped by one shock.

Source: W. F. Noh, J. Comput. Phys. 72 (1987) 78-120, doi:10.1016/0021-9991(87)90074-X, cold gas; here with any initial
pressure: then the shock speed is the root of a quadratic, as for a piston (Landau & Lifshitz, Fluid Mechanics, 99).
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, coordinates, length_allowed, not_negative, positive, require, times
from hydro1d.analytic.jumps import Fields, Jump, State


@dataclass(frozen=True)
class Noh:
    """A gas of `speed` (m/s, to the left) against a wall at coordinate 0.

    gamma > 1; density kg/m^3; initial pressure Pa; length of the gas, m (its far end must move as the gas does).
    Called with (coordinate, t): Lagrangian coordinate and time; `laboratory(x, t)` takes positions at time t.
    """

    gamma: float = 5.0 / 3.0
    density: float = 1.0
    speed: float = 1.0
    pressure: float = 0.0
    length: float = math.inf

    def __post_init__(self) -> None:
        require(math.isfinite(self.gamma) and self.gamma > 1.0, "gamma", self.gamma, "finite and greater than 1")
        positive(self, "density", "speed")
        not_negative(self, "pressure")
        length_allowed(self.length)

    @property
    def front_speed(self) -> float:
        """Lagrangian speed of the shock, which is its speed relative to the gas ahead, m/s."""
        quarter = 0.25 * (self.gamma + 1.0) * self.speed
        return quarter + math.sqrt(quarter**2 + self.gamma * self.pressure / self.density)

    @property
    def wall_speed(self) -> float:
        """Speed of the shock away from the wall, m/s."""
        return self.front_speed - self.speed

    @property
    def ahead(self) -> State:
        """The gas that still runs."""
        energy = self.pressure / ((self.gamma - 1.0) * self.density)
        return State(-self.speed, self.pressure, 0.0, self.density, energy)

    @property
    def behind(self) -> State:
        """The gas at rest."""
        density = self.density * self.front_speed / self.wall_speed
        pressure = self.pressure + self.density * self.front_speed * self.speed
        energy = pressure / ((self.gamma - 1.0) * density)
        return State(0.0, pressure, self.speed / self.front_speed, density, energy)

    @property
    def end_time(self) -> float:
        """When the shock reaches the far end, s."""
        return self.length / self.front_speed

    def jumps(self, t: float = 0.0) -> list[Jump]:
        """The shock at time t (s)."""
        return [Jump(self.ahead, self.behind, self.density, self.front_speed, self.front_speed * t)]

    def position(self, coordinate: ArrayLike, t: ArrayLike) -> Array:
        """Where the material of a Lagrangian coordinate (m) is at time t (s), m."""
        coordinate, t = np.asarray(coordinate, dtype=float), times(t, self.end_time)
        stopped = coordinate * self.wall_speed / self.front_speed
        return np.where(coordinate < self.front_speed * t, stopped, coordinate - self.speed * t)

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at the Lagrangian coordinate (m) and t (s), which broadcast; on the front, the state ahead."""
        t = times(t, self.end_time, "then the shock reaches the far end")
        return self._fields(coordinates(coordinate, self.length) < self.front_speed * t)

    def laboratory(self, x: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at positions x >= 0 (m) at time t (s)."""
        t = times(t, self.end_time, "then the shock reaches the far end")
        return self._fields(coordinates(x, math.inf) < self.wall_speed * t)

    def _fields(self, shocked: ArrayLike) -> Fields:
        return Fields(*(np.where(shocked, b, a) for a, b in zip(self.ahead, self.behind, strict=True)))
