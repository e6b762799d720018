"""A blast wave's pressure, after Friedlander (1946), doi:10.1098/rspa.1946.0046."""

from __future__ import annotations

import math

from hydro1d.components.parameters import not_negative, positive
from hydro1d.loads.base import Pulse


class Friedlander(Pulse):
    """p = peak (1 − t/duration) exp(−decay t/duration); its negative phase only with ``negative_phase = true``."""

    peak: float = positive("Pa", "pressure at t = 0")
    duration: float = positive("s", "duration of the positive phase")
    decay: float = not_negative("1", "decay coefficient", default=1.0)
    negative_phase: bool = False

    def pressure(self, time: float) -> float:
        """The modified Friedlander equation."""
        share = time / self.duration
        value = self.peak * (1.0 - share) * math.exp(-self.decay * share)
        return value if self.negative_phase else max(value, 0.0)

    def breakpoints(self) -> tuple[float, ...]:
        """The end of the positive phase."""
        return (self.duration,)
