"""A rigid wall."""

from __future__ import annotations

from hydro1d.boundaries.base import Boundary, End, free_velocity, reaction


class Wall(Boundary):
    """Holds the end still; unless ``bonded``, only in compression: a node that the column pulls away flies free."""

    bonded: bool = True

    def kick(self, end: End, state: tuple[float, ...]) -> tuple[float, float, tuple[float, ...]]:
        """No motion, or free flight inward until the gap closes."""
        free = free_velocity(end, 0.0)
        leaves = not self.bonded and (free > 0.0 or end.displacement + free * end.step_after > 0.0)
        if leaves:
            return free, 0.0, state
        # Whatever is left of a closing gap is closed by this very step.
        velocity = -end.displacement / end.step_after if end.step_after > 0.0 else 0.0
        return velocity, reaction(end, velocity), state

    def start(self, velocity: float, mass: float, side: float) -> tuple[float, tuple[float, ...]]:
        """The node at the wall stands still unless it is free to leave."""
        return (velocity if not self.bonded and velocity > 0.0 else 0.0), ()
