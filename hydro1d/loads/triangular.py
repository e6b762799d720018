"""A triangular pulse."""

from __future__ import annotations

from hydro1d.components.parameters import positive
from hydro1d.loads.base import Pulse


class Triangular(Pulse):
    """p = peak (1 − t/duration), then 0."""

    peak: float = positive("Pa", "pressure at t = 0")
    duration: float = positive("s", "duration")

    def pressure(self, time: float) -> float:
        """A straight line to zero."""
        return max(self.peak * (1.0 - time / self.duration), 0.0)

    def breakpoints(self) -> tuple[float, ...]:
        """The end of the pulse."""
        return (self.duration,)
