"""A column with an elastic precursor, crushed from both ends: extended shock theory, two stages.

Source: Eqs. 39-47 of Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011, there for E-P-P-H under
a rectangular pulse; here for any curve with one compaction shock, and for a striker as well (the same equations with
the striker's mass in m1 and v0 as the initial velocity: the finite-modulus answer beside Scheme 1). Crushed material
unloads rigidly. Regions (Figs. 10, 11): I untouched, II at yield moving at VY, III crushed by the proximal front,
IV crushed at the fixed back by the distal front, which starts when the precursor arrives there.
In Lagrangian terms m1 + m = M + rho0 X, with X the coordinate of the proximal front.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import OdeSolution, solve_ivp

from hydro1d.analytic._checks import Array, Flags, coordinates, times
from hydro1d.analytic._roots import bisect
from hydro1d.analytic.curves import Curve
from hydro1d.analytic.hugoniot import Hugoniot, compaction_hugoniot, compaction_strain
from hydro1d.analytic.jumps import Fields, Jump, State, rest_state, shocked_state


class ColumnHistory(NamedTuple):
    """What happens at the ends and at the fronts, arrays of the shape of t.

    displacement u (m) and velocity v (m/s) of the loaded end; front, distal_front: Lagrangian coordinates (m), the
    latter NaN before the precursor arrives; laboratory_front X of Eqs. 42 and 47 (m); front_stress behind the proximal
    front, left_stress on the loaded end, right_stress on the fixed back (Pa).
    """

    displacement: Array
    velocity: Array
    front: Array
    distal_front: Array
    laboratory_front: Array
    front_stress: Array
    left_stress: Array
    right_stress: Array


class Start(NamedTuple):
    """Where the decaying front starts: time, crushed length, displacement and velocity of the loaded end."""

    time: float
    front: float
    displacement: float
    velocity: float


@dataclass(frozen=True)
class CompactionColumn(ABC):
    """What pulse and striker share: the decaying front, the distal front, the fields.

    curve: the material; length of the column with its fixed back, m.
    """

    curve: Curve
    length: float

    @property
    @abstractmethod
    def end_mass(self) -> float:
        """Mass per area that rides on the loaded end, kg/m^2."""

    @property
    @abstractmethod
    def _start(self) -> Start: ...

    @abstractmethod
    def _left_stress(self, t: Array, deceleration: Array) -> Array: ...

    @abstractmethod
    def _block_stress(self, coordinate: Array, t: Array, deceleration: Array) -> Array: ...

    @property
    def wave_arrival(self) -> float:
        """When the elastic precursor reaches the back, s."""
        return self.length / self.curve.elastic_speed

    @property
    def momentum(self) -> float:
        """Momentum of the block relative to VY at the start of the decay, less what yield took before, kg/(m s)."""
        start = self._start
        relative = start.velocity - self.curve.yield_velocity
        return (self.end_mass + self.curve.density * start.front) * relative + self.curve.yield_stress * start.time

    @property
    def arrest_time(self) -> float:
        """When the block would slow down to VY, by the momentum integral of Eq. 45, s."""
        return self.momentum / self.curve.yield_stress

    @cached_property
    def distal_jump(self) -> Jump:
        """The front that the precursor leaves at the fixed back: [v] = VY; coordinate is where it starts."""
        mirrored = self._compaction(self.curve.yield_velocity)
        behind = mirrored.behind._replace(velocity=0.0)
        return replace(mirrored, behind=behind, front_speed=-mirrored.front_speed, coordinate=self.length)

    @cached_property
    def meeting_time(self) -> float:
        """When the two fronts meet, s; infinite if the block has slowed down to VY before."""
        last = self.arrest_time
        if not self._front(np.asarray(last)) > self._distal_front(last):
            return math.inf
        return float(bisect(lambda t: self._front(t) > self._distal_front(t), 0.0, last))

    @property
    def end_time(self) -> float:
        """Where the theory ends: the fronts meet, or the block has slowed down to VY, s."""
        return min(self.meeting_time, self.arrest_time)

    def history(self, t: ArrayLike) -> ColumnHistory:
        """Ends and fronts at times t (s); ValueError after `end_time`."""
        t = self._times(t)
        curve = self.curve
        displacement, velocity, front = self._motion(t)
        front_stress = self._front_stress(velocity - curve.yield_velocity)
        deceleration = self._deceleration(t, front, front_stress)
        arrived = t >= self.wave_arrival
        return ColumnHistory(
            displacement,
            velocity,
            front,
            np.where(arrived, self._distal_front(t), np.nan),
            (1.0 - curve.yield_strain) * front + curve.yield_velocity * t,
            front_stress,
            self._left_stress(t, deceleration),
            np.where(arrived, self.distal_jump.behind.stress, 0.0),
        )

    def uncrushed_share(self, t: ArrayLike) -> Array:
        """Share of the column that neither front has passed, shape of t (s)."""
        t = self._times(t)
        return (np.minimum(self._distal_front(t), self.length) - self._front(t)) / self.length

    def momentum_residual(self, t: ArrayLike) -> Array:
        """(m1 + m)(v - VY) against its closed form (Eq. 45 integrated), over the momentum at the start."""
        t = np.maximum(self._times(t), self._start.time)
        _, velocity, front = self._motion(t)
        block = self.end_mass + self.curve.density * front
        closed = self.momentum - self.curve.yield_stress * t
        return (block * (velocity - self.curve.yield_velocity) - closed) / self.momentum

    def jumps(self, t: float) -> list[Jump]:
        """The fronts at time t (s): precursor (while it runs), proximal, distal (once it runs)."""
        history = self.history(t)
        speed = self.curve.elastic_speed
        jumps = []
        if t < self.wave_arrival:
            rest = rest_state(self.curve.density)
            jumps.append(Jump(rest, self._yielded, self.curve.density, speed, speed * t))
        relative = float(history.velocity) - self.curve.yield_velocity
        if relative > 0.0:
            jumps.append(replace(self._compaction(relative), coordinate=float(history.front)))
        if t >= self.wave_arrival:
            jumps.append(replace(self.distal_jump, coordinate=float(history.distal_front)))
        return jumps

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s), which broadcast; ValueError outside the column and after `end_time`."""
        t = self._times(t)
        coordinate = coordinates(coordinate, self.length)
        _, velocity, front = self._motion(t)
        resistance = self._front_stress(velocity - self.curve.yield_velocity)
        deceleration = self._deceleration(t, front, resistance)
        distal = np.minimum(self._distal_front(t), self.length)
        regions = [coordinate < front, coordinate > distal, coordinate < self.curve.elastic_speed * t]
        crushed = self._crushed_fields(coordinate, t, velocity, deceleration, regions[0])
        zones = zip(crushed, self.distal_jump.behind, self._yielded, rest_state(self.curve.density), strict=True)
        return Fields(*(np.select(regions, [np.asarray(v) for v in values[:3]], values[3]) for values in zones))

    def _crushed_fields(
        self, coordinate: Array, t: Array, velocity: Array, deceleration: Array, inside: Flags
    ) -> Fields:
        crossed = np.where(inside, self._relative_velocity_at_crossing(np.where(inside, coordinate, 0.0)), 1.0)
        behind = self._hugoniot(crossed)
        energy = self._yielded.internal_energy + behind.absorbed_energy / self.curve.density
        stress = self._block_stress(coordinate, t, deceleration)
        return Fields(velocity, stress, behind.strain, self.curve.density / (1.0 - behind.strain), energy)

    def _relative_velocity_at_crossing(self, coordinate: Array) -> Array:
        """[v] of the front when it passed the coordinate."""
        places, back = np.unique(coordinate, return_inverse=True)
        moments = bisect(lambda t: self._front(t) > places, np.zeros(places.shape), self.end_time)
        _, velocity, _ = self._motion(moments)
        return (velocity - self.curve.yield_velocity)[back].reshape(coordinate.shape)

    @property
    def _yielded(self) -> State:
        curve = self.curve
        return shocked_state(curve.density, rest_state(curve.density), curve.yield_strain, curve.yield_stress)

    def _compaction(self, relative_velocity: float) -> Jump:
        """A compaction shock to the right with that [v] into material at yield."""
        shock = compaction_hugoniot(self.curve, relative_velocity)
        behind = State(
            self.curve.yield_velocity + relative_velocity,
            float(shock.stress),
            float(shock.strain),
            self.curve.density / (1.0 - float(shock.strain)),
            self._yielded.internal_energy + float(shock.absorbed_energy) / self.curve.density,
        )
        return Jump(self._yielded, behind, self.curve.density, float(shock.front_speed))

    def _times(self, t: ArrayLike) -> Array:
        return times(t, self.end_time, "then the fronts meet or the block has slowed down to VY")

    def _distal_front(self, t: ArrayLike) -> Array:
        return self.length + self.distal_jump.front_speed * np.maximum(
            np.asarray(t, dtype=float) - self.wave_arrival, 0
        )

    def _front(self, t: Array) -> Array:
        return self._motion(t)[2]

    def _front_stress(self, relative_velocity: Array) -> Array:
        moving = np.maximum(relative_velocity, 1e-9 * self._start.velocity)
        return self._hugoniot(moving).stress

    def _hugoniot(self, velocity_jump: Array) -> Hugoniot:
        """States behind the front; each velocity jump once, since this is the slow part."""
        different, back = np.unique(velocity_jump, return_inverse=True)
        states = compaction_hugoniot(self.curve, different)
        return Hugoniot(*(values[back].reshape(velocity_jump.shape) for values in states))

    def _motion(self, t: Array) -> tuple[Array, Array, Array]:
        """Displacement, velocity and crushed length of the block."""
        start = self._start
        decaying = t > start.time
        share = np.minimum(t / start.time, 1.0) if start.time > 0.0 else np.ones_like(t)
        moments = np.clip(t, start.time, self.arrest_time).ravel()
        later = (self._decay(moments) if t.size else moments).reshape(3, *t.shape)  # scipy takes no empty array
        velocity = np.where(decaying, later[0], start.velocity)
        front = np.where(decaying, later[1], start.front * share)
        return np.where(decaying, later[2], start.displacement * share), velocity, front

    def _deceleration(self, t: Array, front: Array, front_stress: Array) -> Array:
        """Of the block, m/s^2 (Eq. 46); none while a pulse holds it at constant velocity."""
        start, block = self._start, self.end_mass + self.curve.density * front
        free = (t > start.time) | (start.time == 0.0)
        return np.where(free, front_stress / np.where(block > 0.0, block, 1.0), 0.0)

    @cached_property
    def _decay(self) -> OdeSolution:
        """Velocity, crushed length and displacement against time (Eqs. 36 and 46)."""
        start = self._start
        result = solve_ivp(
            self._rates,
            (start.time, self.arrest_time),
            [start.velocity, start.front, start.displacement],
            method="DOP853",
            rtol=1e-12,
            atol=1e-13,
            max_step=(self.arrest_time - start.time) / 100.0,
            dense_output=True,
        )
        assert result.sol is not None
        return result.sol

    def _rates(self, t: float, state: Array) -> list[float]:
        velocity, front, _ = state
        curve = self.curve
        # At rest relative to VY the front still has the strain of densification to jump: the limit of a weak shock.
        relative = max(velocity - curve.yield_velocity, 1e-9 * self._start.velocity)
        change = compaction_strain(curve, relative) - curve.yield_strain
        resistance = curve.yield_stress + curve.density * relative**2 / change
        return [-resistance / (self.end_mass + curve.density * front), relative / change, velocity]
