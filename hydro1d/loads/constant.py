"""A pressure step."""

from __future__ import annotations

from hydro1d.components.parameters import positive
from hydro1d.loads.base import Pulse


class Constant(Pulse):
    """p = peak for ever."""

    peak: float = positive("Pa", "pressure")

    def pressure(self, time: float) -> float:
        """The peak."""
        return self.peak
