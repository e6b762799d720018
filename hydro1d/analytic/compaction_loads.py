"""Loads on a column with an elastic precursor: a rectangular pulse (Eqs. 39-47) and a striker."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hydro1d.analytic._checks import Array, length_allowed, positive, require
from hydro1d.analytic.compaction_column import CompactionColumn, Start
from hydro1d.analytic.hugoniot import compaction_hugoniot
from hydro1d.analytic.step_loading import StepLoading, pressure_step


@dataclass(frozen=True)
class CompactionPulse(CompactionColumn):
    """Rectangular pressure pulse on a column with a fixed back (with an `EPPH` curve: Eqs. 39-47).

    curve; length, m; pressure P, Pa, above yield; duration T, s. Called with (coordinate, t) in m and s until
    `end_time`, it returns `Fields`. Raises ValueError where the compaction front would overtake the precursor.
    """

    pressure: float
    duration: float

    def __post_init__(self) -> None:
        length_allowed(self.length)
        positive(self, "pressure", "duration")
        above = self.pressure > self.curve.yield_stress
        require(above, "pressure", self.pressure, f"greater than the yield stress {self.curve.yield_stress:.9g} Pa")
        fronts = len(self.loading.states) - 1
        require(fronts == 2, "pressure", self.pressure, "such that one shock follows an elastic precursor")

    @cached_property
    def loading(self) -> StepLoading:
        """Stage 1: precursor and steady compaction front, as long as the precursor runs."""
        return pressure_step(self.curve, self.pressure)

    @property
    def end_mass(self) -> float:
        """Nothing rides on the loaded end."""
        return 0.0

    @cached_property
    def _start(self) -> Start:
        final, front = self.loading.states[-1], self.loading.jumps()[-1]
        return Start(self.duration, self.duration * front.front_speed, self.duration * final.velocity, final.velocity)

    def _left_stress(self, t: Array, deceleration: Array) -> Array:
        return np.where(t <= self.duration, self.pressure, 0.0)

    def _block_stress(self, coordinate: Array, t: Array, deceleration: Array) -> Array:
        return np.where(t <= self.duration, self.pressure, self.curve.density * coordinate * deceleration)


@dataclass(frozen=True)
class CompactionStriker(CompactionColumn):
    """A rigid mass against a column with an elastic precursor and a fixed back: Scheme 1 at a finite modulus.

    curve; length, m; mass of the striker per area, kg/m^2; impact_velocity v0, m/s, above VY. The striker keeps in
    contact until `end_time`. For a curve of plateau and rigid locking this is Scheme 1 with v0 - VY for v0, eD - eY for
    eD and u - VY t for u. Raises ValueError where the compaction front would overtake the precursor.
    """

    mass: float
    impact_velocity: float

    def __post_init__(self) -> None:
        length_allowed(self.length)
        positive(self, "mass", "impact_velocity")
        curve = self.curve
        above = self.impact_velocity > curve.yield_velocity
        require(above, "impact_velocity", self.impact_velocity, f"greater than VY = {curve.yield_velocity:.9g} m/s")
        front = float(compaction_hugoniot(curve, self.impact_velocity - curve.yield_velocity).front_speed)
        slower = front < curve.elastic_speed
        require(slower, "impact_velocity", self.impact_velocity, "such that the precursor outruns the compaction front")

    @property
    def end_mass(self) -> float:
        """The striker's mass per area, kg/m^2."""
        return self.mass

    @cached_property
    def _start(self) -> Start:
        return Start(0.0, 0.0, 0.0, self.impact_velocity)

    def _left_stress(self, t: Array, deceleration: Array) -> Array:
        return self.mass * deceleration

    def _block_stress(self, coordinate: Array, t: Array, deceleration: Array) -> Array:
        return (self.mass + self.curve.density * coordinate) * deceleration
