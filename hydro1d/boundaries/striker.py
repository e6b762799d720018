"""A rigid mass that strikes the end."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from hydro1d.boundaries.base import Boundary, End, free_velocity
from hydro1d.components.parameters import number, positive


class Striker(Boundary):
    """A rigid mass per area with a velocity, touching the end at t = 0. It pushes and never pulls.

    While they touch, mass and end node move as one; they part when the column would pull, and if they meet again they
    share their momentum.
    """

    mass: float = positive("kg/m^2", "mass per area")
    velocity: float = number("m/s", "velocity at t = 0, positive to the right")
    state_variables: ClassVar[dict[str, str]] = {"striker_position": "m", "striker_velocity": "m s-1"}

    def kick(self, end: End, state: tuple[float, ...]) -> tuple[float, float, tuple[float, ...]]:
        """Joint motion where they would overlap after this kick if both flew free, else that free flight."""
        position, speed = state
        step = 0.5 * (end.step_before + end.step_after)
        joint = (end.mass * end.velocity + self.mass * speed - end.stress * step) / (end.mass + self.mass)
        free = free_velocity(end, 0.0)
        # In contact the positions are equal but for rounding, and this asks whether the contact pushes: joint > free.
        touches = position + speed * step > end.displacement + free * step
        velocity = joint if touches else free
        force = end.stress + end.mass * (velocity - end.velocity) / step if touches and step > 0.0 else 0.0
        speed = joint if touches else speed
        position = (end.displacement if touches else position) + speed * end.step_after
        return velocity, force, (position, speed)

    def start(self, velocity: float, mass: float, side: float) -> tuple[float, tuple[float, ...]]:
        """Striker and end node share their momentum."""
        inward = side * self.velocity
        if inward <= velocity:
            raise ValueError(f"velocity {self.velocity:g} m/s does not close on this end of the column")
        joint = (mass * velocity + self.mass * inward) / (mass + self.mass)
        return joint, (0.0, joint)

    def report(self, kept: np.ndarray, coordinate: float, side: float) -> np.ndarray:
        """Position and velocity in the laboratory."""
        return np.array([coordinate, 0.0]) + side * kept
