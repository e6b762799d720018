"""The run of a column, stretch by stretch past its output times."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hydro1d.boundaries.base import Boundary, End
from hydro1d.errors import DeckError
from hydro1d.scheme import profiles, step
from hydro1d.scheme.records import CLOCK, COLLAPSED, INVERTED, LAYER_STATE, NOT_FINITE, PAUSED
from hydro1d.solver.column import Column, initial_velocities
from hydro1d.solver.program import RAISED, Program
from hydro1d.solver.raised import explain
from hydro1d.solver.sink import Frame, Sink
from hydro1d.solver.state import State
from hydro1d.variables import NODE, ZONE

ZONE_STEPS_PER_CALL = 20_000_000  # about a tenth of a second between looks at the world
# Cycles. Stretches end at multiples of it: a block that breaks down is tried again from its start, wherever output and
# checkpoints have cut the run, and a copy of the start is not made for every step.
BLOCK = step.CYCLE_BLOCK
STOPS = 16  # after which a stretch ends: profiles can be compressed while the next is calculated
MAX_VALUES = 1 << 23  # of the profiles of a stretch; in longer columns it ends at every stop
RETRIES = 3
A_STEP = 1e-9  # s, of a kick that is only tried
EASE = 1.0 / 16.0  # of the stable step, the first one: what the loads will move is not moving yet


@dataclass(frozen=True)
class Outcome:
    """How a run ended."""

    status: str
    cycles: int
    time: float
    wall_seconds: float
    message: str = ""
    zone: int | None = None
    state: State | None = None


@dataclass(frozen=True)
class CheckpointPlan:
    """When to hand over checkpoints: every so many cycles, seconds of simulated time, or seconds of wall time."""

    cycles: int | None = None
    time: float | None = None
    wall: float | None = None


def initial_state(column: Column, program: Program) -> State:
    """The column at t = 0: node velocities by the boundaries, forces, the first step, the energy to start from."""
    zones, width = column.zones, column.boundary_width
    state = State(
        clock=np.zeros(1, dtype=CLOCK).view(np.recarray),
        layer_state=np.zeros(len(column.layers), dtype=LAYER_STATE).view(np.recarray),
        velocity=np.zeros(zones + 3),
        displacement=np.zeros(zones + 1),
        energy=np.zeros(zones),
        increment=np.zeros(zones),
        force=np.zeros(zones),
        viscosity=np.zeros(zones),
        state=np.zeros((column.variables, zones)),
        boundary_state=np.zeros((4, width)),
    )
    for block in column.layers:
        state.energy[block.part] = [law.initial_energy for law in block.laws]
        for k, value in enumerate(block.law.own_variables().values()):
            state.state[1 + k, block.part] = value
    velocity = initial_velocities(column)
    for side, (name, sign, boundary) in enumerate(column.ends):
        node = -side
        speed, kept = _started(boundary, sign * velocity[node], column.node_mass[node], sign, name)
        velocity[node] = sign * speed
        state.boundary_state[side, : len(kept)] = kept
    state.velocity[1:-1] = velocity
    state.velocity[0], state.velocity[-1] = velocity[1], velocity[-2]
    _first_step(column, program, state)
    kinetic = 0.5 * np.sum(column.node_mass * velocity**2)
    state.clock[0].initial_energy = kinetic + np.sum(column.zone_mass * state.energy)
    return state


def _started(boundary: Boundary, velocity: float, mass: float, sign: float, side: str) -> tuple:
    try:
        speed, kept = boundary.start(velocity, mass, sign)
    except ValueError as error:
        raise DeckError(f"{side}: {error}") from error
    declared = len(boundary.state_variables)
    end = End(0.0, A_STEP, A_STEP, speed, 0.0, mass, 0.0, 1.0, 0.0, sign)
    # Compiled code stores as many as a kick returns: that they are those declared is seen before.
    for method, values in (("start", kept), ("kick", boundary.kick(end, kept)[2] if len(kept) == declared else kept)):
        if len(values) != declared:
            raise DeckError(
                f"{side}: {type(boundary).__name__}.{method} returns {len(values)} state variables; the class declares "
                f"{declared}: {', '.join(boundary.state_variables) or 'none'}"
            )
    return speed, kept


def _first_step(column: Column, program: Program, state: State) -> None:
    """Forces at t = 0 and the step that they allow; the first is shorter by `EASE`, and steps grow from there."""
    stable, clock = math.inf, state.clock[0]
    for number, layer in enumerate(program.own["layers"]):
        found = program.sweep_layer(state, number)
        stable = min(stable, layer.min_size / step.fastest(layer, found.stiffness, found.viscous_speed))
        clock.peak_stress = max(clock.peak_stress, found.stress)
    clock.cfl = column.cfl
    clock.next_step = clock.first_step = column.cfl * stable
    clock.free_step = EASE * column.cfl * stable / step.GROWTH
    clock.right_front = column.zones
    clock.peak_left_stress, clock.peak_right_stress = state.force[0], state.force[-1]


def solve(
    column: Column,
    sink: Sink,
    state: State | None = None,
    *,
    checkpoints: CheckpointPlan | None = None,
    progress: Callable[[State], None] | None = None,
    program: Program | None = None,
    asked_to_stop: Callable[[], bool] = lambda: False,
) -> Outcome:
    """Run a column from its state (t = 0 unless given) to its end time, handing everything over to ``sink``.

    Where the run breaks down, the last block of cycles is tried again, up to three times, with half the step each time.
    Raises DeckError for a load that makes no sense on its end of the column.
    """
    program = program or Program(column)
    begun = state is not None
    state = state if state is not None else initial_state(column, program)
    run = _Run(column, sink, state, program, checkpoints or CheckpointPlan(), progress, asked_to_stop)
    if not begun:
        run.open()
    return run.to_end()


class _Run:
    """A run under way: the stops ahead, and the clock of the loop."""

    def __init__(
        self,
        column: Column,
        sink: Sink,
        state: State,
        program: Program,
        plan: CheckpointPlan,
        progress: Callable[[State], None] | None,
        asked_to_stop: Callable[[], bool],
    ) -> None:
        self.column, self.sink, self.state, self.program = column, sink, state, program
        self.plan, self.progress, self.asked_to_stop = plan, progress, asked_to_stop
        self.loop_seconds = 0.0
        self.saved_cycle, self.saved_time, self.saved_wall = state.cycle, state.time, time.monotonic()
        profile_times = set(column.profile_times.tolist())
        times = sorted({*profile_times, *column.breakpoints, column.end_time})
        self.stops = [(time, time in profile_times) for time in times if state.time < time <= column.end_time]
        most = STOPS + BLOCK  # for a step passes one at most
        self.most_stops = most if most * program.profile_length <= MAX_VALUES else 1
        self.start = state.copy()

    def open(self) -> None:
        """Hand over the state at t = 0."""
        start = [(0.0, 0.0 in self.column.profile_times)]
        self.program.advance_past(self.state, start, steps=0, row_at_stop=True)
        self.hand_over()

    def to_end(self) -> Outcome:
        """Stretch by stretch past all stops, looking up in between."""
        while self.stops:
            if self.asked_to_stop():
                return self.outcome("interrupted")
            status = self.stretch()
            if status > PAUSED:
                return self.broken(status)
            self.hand_over()
            del self.stops[: int(self.program.call[0].passed_stops)]
            if self.progress is not None:
                self.progress(self.state)
            self.save_if_due()
        return self.outcome("complete")

    def hand_over(self) -> None:
        """What the last call recorded."""
        if self.program.call[0].rows > 0:
            self.sink.history(*self.program.recorded())
        for profile in self.program.profiles():
            self.sink.profile(frame(self.column, profile))
        self.sink.flush()

    def stretch(self) -> int:
        """One call of the time loop. Where it breaks down, the blocks before that stand; the block itself is tried again."""
        start = self.start
        start.assign(self.state)
        status = self.advance(self.steps_per_call())
        if status > PAUSED:
            sound = (self.state.cycle - 1) // BLOCK * BLOCK - start.cycle  # the last cycle is the one that broke down
            self.state.assign(start)
            status = self.advance(sound) if sound > 0 else self.retry(start)
        return status

    def retry(self, start: State) -> int:
        """A block that broke down, with half the step, a quarter, an eighth."""
        for attempt in range(1, RETRIES + 1):
            self.state.assign(start)
            clock = self.state.clock[0]
            clock.cfl = self.column.cfl * 0.5**attempt
            clock.next_step, clock.free_step = clock.next_step * 0.5**attempt, clock.free_step * 0.5**attempt
            status = self.advance(BLOCK - start.cycle % BLOCK)
            if status <= PAUSED:
                break
        self.state.clock[0].cfl = self.column.cfl
        return status

    def advance(self, steps: int) -> int:
        """Call the time loop, on the clock."""
        stops = self.stops[: self.most_stops]
        row_at_stop = stops[-1][0] == self.column.end_time
        begun = time.perf_counter()
        status = self.program.advance_past(self.state, stops, steps=steps, row_at_stop=row_at_stop, enough=STOPS)
        self.loop_seconds += time.perf_counter() - begun
        return status

    def steps_per_call(self) -> int:
        """So many that the user does not wait and the rows fit, up to a multiple of `BLOCK`."""
        length = max(ZONE_STEPS_PER_CALL // self.column.zones // BLOCK, 1) * BLOCK
        length = max(
            min(length, self.program.row_capacity * self.column.history_every or length), BLOCK
        )  # full rows end it too
        end = self.state.cycle + length
        if self.plan.cycles is not None:
            end = min(end, (self.state.cycle // self.plan.cycles + 1) * self.plan.cycles + BLOCK - 1)
        if self.plan.time is not None:
            steps = (self.saved_time + self.plan.time - self.state.time) / self.state.clock[0].next_step
            end = min(end, self.state.cycle + BLOCK + int(min(max(steps, 0.0), length)))
        return end // BLOCK * BLOCK - self.state.cycle

    def save_if_due(self) -> None:
        """Hand over a checkpoint when the plan asks for one."""
        plan, state, now = self.plan, self.state, time.monotonic()
        due = (
            (plan.cycles is not None and state.cycle // plan.cycles > self.saved_cycle // plan.cycles)
            or (plan.time is not None and state.time - self.saved_time >= plan.time)
            or (plan.wall is not None and now - self.saved_wall >= plan.wall)
        )
        if due and state.time < self.column.end_time:
            self.sink.checkpoint(state)
            self.saved_cycle, self.saved_time, self.saved_wall = state.cycle, state.time, now

    def outcome(self, status: str, message: str = "", zone: int | None = None) -> Outcome:
        """Close the sink's books."""
        self.sink.maxima({"largest_strain": self.state.state[0].copy()})
        return Outcome(status, self.state.cycle, self.state.time, self.loop_seconds, message, zone, state=self.state)

    def broken(self, status: int) -> Outcome:
        """Say which zone broke down, and why; what the last attempt recorded is handed over, and the state it ended in."""
        self.hand_over()
        state = self.state
        if status == RAISED:
            zone, cause = explain(self.column, self.program, state)
            return self.outcome("failed", cause, zone)
        strain = -np.diff(state.displacement) / np.diff(self.column.node_coordinate)
        self.program.advance_past(state, [(state.time, True)], steps=0, row_at_stop=False)
        self.hand_over()
        bad = ~np.isfinite(strain) | ~np.isfinite(state.force) | ~np.isfinite(state.increment)
        zone = int(np.argmax(bad)) if bad.any() else int(np.argmax(strain))
        cause = {
            INVERTED: f"the zone is inverted: its strain reached {strain[zone]:.6g}",
            NOT_FINITE: f"the state is not finite; the zone's strain is {strain[zone]:.6g}",
            COLLAPSED: f"the time step collapsed to {state.clock[0].next_step:.3g} s; the largest strain is "
            f"{strain[zone]:.6g}",
        }[status]
        law = self.column.layers[int(self.column.zone_layer[zone])].law
        return self.outcome("failed", cause + (law.advice if strain[zone] > 0.95 else ""), zone)


def frame(column: Column, profile: np.ndarray) -> Frame:
    """A profile as `scheme.profiles` takes it, by names; the arrays are views of it."""
    cut = profiles.HEAD + profiles.NODE_FIELDS * (column.zones + 1)
    nodes, zones = profile[profiles.HEAD : cut].reshape(-1, column.zones + 1), profile[cut:].reshape(-1, column.zones)
    names = [variable.name for variable in (*ZONE, column.zone_history[0])]
    fields = {variable.name: values for variable, values in zip(NODE, nodes, strict=True)}
    fields |= dict(zip(names, zones, strict=False))
    for name in [variable.name for variable in column.zone_history[1:]]:
        fields[name] = np.full(column.zones, np.nan)
        for block in column.layers:
            own = list(block.law.own_variables())
            if name in own:
                fields[name][block.part] = zones[len(names) + own.index(name)][block.part]
    return Frame(float(profile[0]), int(profile[1]), fields)
