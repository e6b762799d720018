"""An exponential pulse."""

from __future__ import annotations

import math

from hydro1d.components.parameters import positive
from hydro1d.loads.base import Pulse


class Exponential(Pulse):
    """p = peak exp(−t/decay)."""

    peak: float = positive("Pa", "pressure at t = 0")
    decay: float = positive("s", "decay time")

    def pressure(self, time: float) -> float:
        """The decaying exponential."""
        return self.peak * math.exp(-time / self.decay)
