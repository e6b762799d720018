"""A pressure step."""

from __future__ import annotations

from hydro1d.boundaries.pulses.base import Pulse
from hydro1d.parameters import positive


class Constant(Pulse):
    """p = peak for ever."""

    peak: float = positive("Pa", "pressure")

    def pressure(self, time: float) -> float:
        """The peak."""
        return self.peak
