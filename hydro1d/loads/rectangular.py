"""A rectangular pulse."""

from __future__ import annotations

from hydro1d.components.parameters import positive
from hydro1d.loads.base import Pulse


class Rectangular(Pulse):
    """p = peak for t < duration, then 0."""

    peak: float = positive("Pa", "pressure")
    duration: float = positive("s", "duration")

    def pressure(self, time: float) -> float:
        """The peak, then nothing."""
        return self.peak if time < self.duration else 0.0

    def breakpoints(self) -> tuple[float, ...]:
        """The end of the pulse."""
        return (self.duration,)
