"""A pressure pulse on the end."""

from __future__ import annotations

from hydro1d.boundaries.base import Boundary, End, free_velocity
from hydro1d.loads.base import Pulse


class Pressure(Boundary):
    """The pressure of a pulse acts on the end."""

    pulse: Pulse

    def kick(self, end: End, state: tuple[float, ...]) -> tuple[float, float, tuple[float, ...]]:
        """Each half of the kick takes the pressure at its own middle, so a jump at a step's end acts in full."""
        step = end.step_before + end.step_after
        before = self.pulse.pressure(end.time - 0.25 * end.step_before)
        after = self.pulse.pressure(end.time + 0.25 * end.step_after)
        force = (before * end.step_before + after * end.step_after) / step if step > 0.0 else after
        return free_velocity(end, force), force, state

    def breakpoints(self) -> tuple[float, ...]:
        """Times (s) of the breakpoints of the pulse."""
        return self.pulse.breakpoints()

    def peak(self) -> float:
        """Largest pressure (Pa) of the pulse."""
        return self.pulse.peak_pressure()
