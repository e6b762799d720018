"""A free end."""

from __future__ import annotations

from hydro1d.boundaries.base import Boundary, End, free_velocity


class Free(Boundary):
    """No force on the end."""

    supports = False

    def kick(self, end: End, state: tuple[float, ...]) -> tuple[float, float, tuple[float, ...]]:
        """Free flight under the zone's own stress."""
        return free_velocity(end, 0.0), 0.0, state
