"""What a pulse is: a pressure in time, and the times of its breakpoints."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from hydro1d.components.parameters import Component


class Pulse(Component):
    """Base of all pulses. `pressure` is compiled like a law's point function."""

    def pressure(self, time: float) -> float:
        """Pressure (Pa) at ``time`` (s) ≥ 0, never asked for exactly at a breakpoint."""
        raise NotImplementedError

    def breakpoints(self) -> tuple[float, ...]:
        """Times (s) of jumps and kinks."""
        return ()

    def peak_pressure(self) -> float:
        """The largest pressure, Pa."""
        return float(getattr(self, "peak", 0.0))


def interpolate(times: Sequence[float], values: Sequence[float], points: int, time: float) -> float:
    """Value of a table at ``time``: linear between its points, constant before the first and after the last."""
    low, high = 0, int(points)
    while high - low > 1:
        middle = (low + high) // 2
        if time >= times[middle]:
            low = middle
        else:
            high = middle
    if time <= times[0] or low == int(points) - 1:
        return values[low]
    share = (time - times[low]) / (times[low + 1] - times[low])
    return values[low] + share * (values[low + 1] - values[low])


def check_times(table: Sequence[Sequence[float]]) -> None:
    """Raise ValueError unless the times of a table rise from 0 or above."""
    times = [row[0] for row in table]
    if times[0] < 0.0 or any(later <= earlier for earlier, later in itertools.pairwise(times)):
        raise ValueError("table must have times that rise strictly from 0 or above")
