"""A piston of given velocity."""

from __future__ import annotations

import numpy as np
from pydantic import model_validator

from hydro1d.boundaries.base import Boundary, End, reaction
from hydro1d.components.parameters import derived, number, pairs
from hydro1d.loads.base import check_times, interpolate


class Piston(Boundary):
    """The end moves with a given velocity, positive to the right: a constant, or a table, linear between its points."""

    velocity: float | None = number("m/s", "constant velocity", default=None)
    table: tuple[tuple[float, float], ...] | None = pairs("s", "m/s", "time and velocity", default=None)

    @model_validator(mode="after")
    def _one_of_two(self) -> Piston:
        if (self.velocity is None) == (self.table is None):
            raise ValueError("needs either velocity or table")
        if self.table is not None:
            check_times(self.table)
        return self

    def kick(self, end: End, state: tuple[float, ...]) -> tuple[float, float, tuple[float, ...]]:
        """The velocity of the middle of the step that follows."""
        velocity = end.side * interpolate(self.times, self.velocities, self.points, end.time + 0.5 * end.step_after)
        return velocity, reaction(end, velocity), state

    def start(self, velocity: float, mass: float, side: float) -> tuple[float, tuple[float, ...]]:
        """Velocity (m/s) of the piston."""
        return side * float(self.velocities[0]), ()

    def breakpoints(self) -> tuple[float, ...]:
        """Times (s) of the points of the table."""
        return tuple(float(time) for time in self.times[1:]) if self.table is not None else ()

    @derived
    def times(self) -> np.ndarray:
        """Times of the points, s."""
        return np.array([0.0] if self.table is None else [time for time, _ in self.table])

    @derived
    def velocities(self) -> np.ndarray:
        """Velocities at the points, m/s."""
        return np.array([self.velocity] if self.table is None else [velocity for _, velocity in self.table])

    @derived
    def points(self) -> int:
        """Number of points."""
        return len(self.times)
