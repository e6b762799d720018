"""The run of a column, stretch by stretch past its output times."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hydro1d.boundaries.base import Boundary
from hydro1d.errors import DeckError
from hydro1d.kernels import layout, march, profiles
from hydro1d.kernels import zones as zone_places
from hydro1d.kernels.ends import MEMORY
from hydro1d.kernels.program import Program
from hydro1d.solver.column import Column, initial_velocities
from hydro1d.solver.sink import Frame, Sink
from hydro1d.solver.state import State
from hydro1d.variables import NODE, ZONE

ZONE_STEPS_PER_CALL = 20_000_000  # about a tenth of a second between looks at the world
# Cycles. Stretches end at multiples of it: a block that breaks down is tried again from its start, wherever output and
# checkpoints have cut the run, and a copy of the start is not made for every step.
BLOCK = layout.CYCLE_BLOCK
STOPS = 16  # after which a stretch ends: profiles can be compressed while the next is calculated
MOST_VALUES = 1 << 23  # of the profiles of a stretch; in longer columns it ends at every stop
RETRIES = 3
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
    zones, slabs = column.zones, column.slabs
    variables = 1 + max(len(slab.law.history) for slab in slabs)
    state = State(
        ledger=np.zeros(layout.LEDGER),
        velocity=np.zeros(zones + 3),
        displacement=np.zeros(zones + 1),
        energy=np.zeros(zones),
        gained=np.zeros(zones),
        force=np.zeros(zones),
        viscosity=np.zeros(zones),
        material=np.zeros((variables, zones)),
        memory=np.zeros((2, MEMORY)),
        numbers=np.zeros((len(slabs), layout.NUMBERS)),
    )
    viscosity = column.viscosity.coefficients()
    for slab, numbers in zip(slabs, state.numbers, strict=True):
        density = slab.law.density
        numbers[: zone_places.NUMBERS] = (0.0, 0.0, 1.0 / slab.size, 1.0 / density, density, *viscosity)
        numbers[layout.CRUSHED_STRAIN], numbers[layout.SIZE] = slab.law.crushed_strain, slab.size
        numbers[layout.YIELD_STRAIN] = getattr(slab.law, "yield_strain", 0.0)
        numbers[layout.ZONE_MASS] = slab.size * density
        state.energy[slab.part] = slab.law.initial_energy
        for k, value in enumerate(slab.law.history.values()):
            state.material[1 + k, slab.part] = value
    velocity = initial_velocities(column)
    for side, (_, sign, boundary) in enumerate(column.ends):
        node = -side
        speed, memory = _started(boundary, sign * velocity[node], column.node_mass[node], sign, column.ends[side][0])
        velocity[node] = sign * speed
        state.memory[side, : len(memory)] = memory
    state.velocity[1:-1] = velocity
    state.velocity[0], state.velocity[-1] = velocity[1], velocity[-2]
    _first_step(column, program, state)
    kinetic = 0.5 * np.sum(column.node_mass * velocity**2)
    state.ledger[layout.FIRST_ENERGY] = kinetic + np.sum(column.zone_mass * state.energy)
    return state


def _started(boundary: Boundary, velocity: float, mass: float, sign: float, side: str) -> tuple:
    try:
        return boundary.start(velocity, mass, sign)
    except ValueError as error:
        raise DeckError(f"{side}: {error}") from error


def _first_step(column: Column, program: Program, state: State) -> None:
    """Forces at t = 0 and the step that they allow; the first is shorter by `EASE`, and steps grow from there."""
    stable = math.inf
    for layer, slab in enumerate(column.slabs):
        out = program.sweep_layer(state, layer)
        fastest = march.fastest(state.numbers[layer], out[zone_places.STIFFNESS], out[zone_places.VISCOUS_SPEED])
        stable = min(stable, slab.size / fastest)
        state.ledger[layout.PEAK_STRESS] = max(state.ledger[layout.PEAK_STRESS], out[zone_places.STRESS])
    state.ledger[layout.CFL] = column.cfl
    state.ledger[layout.NEXT_STEP] = state.ledger[layout.FIRST_STEP] = column.cfl * stable
    state.ledger[layout.FREE_STEP] = EASE * column.cfl * stable / march.GROWTH
    state.ledger[layout.RIGHT_FRONT] = column.zones
    state.ledger[layout.PEAK_LEFT], state.ledger[layout.PEAK_RIGHT] = state.force[0], state.force[-1]


def set_ends(column: Column, program: Program) -> None:
    """Impedance and initial stress that the boundaries may ask for."""
    for side, (slab, sign) in enumerate(((column.slabs[0], 1.0), (column.slabs[-1], -1.0))):
        law = slab.law
        history = tuple(law.history.values())
        stress, _, stiffness, _, _ = law.point(0.0, 0.0, 0.0, law.initial_energy, history)
        program.end_numbers[side, 7:10] = math.sqrt(law.density * stiffness), stress, sign


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
    set_ends(column, program)
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
        times = sorted({*profile_times, *column.corners, column.end_time})
        self.stops = [(time, time in profile_times) for time in times if state.time < time <= column.end_time]
        most = STOPS + BLOCK  # for a step passes one at most
        self.most_stops = most if most * program.profile_length <= MOST_VALUES else 1
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
            if status > layout.PAUSED:
                return self.broken(status)
            self.hand_over()
            del self.stops[: int(self.state.ledger[layout.PASSED])]
            if self.progress is not None:
                self.progress(self.state)
            self.save_if_due()
        return self.outcome("complete")

    def hand_over(self) -> None:
        """What the last call recorded."""
        if self.state.ledger[layout.ROWS] > 0:
            self.sink.history(*self.program.recorded(self.state))
        for profile in self.program.profiles(self.state):
            self.sink.profile(frame(self.column, profile))
        self.sink.flush()

    def stretch(self) -> int:
        """One call of the time loop. Where it breaks down, the blocks before that stand; the block itself is tried again."""
        start = self.start
        start.assign(self.state)
        status = self.advance(self.steps_per_call())
        if status > layout.PAUSED:
            sound = (self.state.cycle - 1) // BLOCK * BLOCK - start.cycle  # the last cycle is the one that broke down
            self.state.assign(start)
            status = self.advance(sound) if sound > 0 else self.retry(start)
        return status

    def retry(self, start: State) -> int:
        """A block that broke down, with half the step, a quarter, an eighth."""
        for attempt in range(1, RETRIES + 1):
            self.state.assign(start)
            self.state.ledger[layout.CFL] = self.column.cfl * 0.5**attempt
            self.state.ledger[[layout.NEXT_STEP, layout.FREE_STEP]] *= 0.5**attempt
            status = self.advance(BLOCK - start.cycle % BLOCK)
            if status <= layout.PAUSED:
                break
        self.state.ledger[layout.CFL] = self.column.cfl
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
            steps = (self.saved_time + self.plan.time - self.state.time) / self.state.ledger[layout.NEXT_STEP]
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
        self.sink.maxima({"largest_strain": self.state.material[0].copy()})
        return Outcome(status, self.state.cycle, self.state.time, self.loop_seconds, message, zone, state=self.state)

    def broken(self, status: int) -> Outcome:
        """Say which zone broke down, and why; what the last attempt recorded is handed over, and the state it ended in."""
        self.hand_over()
        state = self.state
        strain = -np.diff(state.displacement) / np.diff(self.column.node_coordinate)
        self.program.advance_past(state, [(state.time, True)], steps=0, row_at_stop=False)
        self.hand_over()
        bad = ~np.isfinite(strain) | ~np.isfinite(state.force) | ~np.isfinite(state.gained)
        zone = int(np.argmax(bad)) if bad.any() else int(np.argmax(strain))
        cause = {
            layout.INVERTED: f"the zone is inverted: its strain reached {strain[zone]:.6g}",
            layout.NOT_FINITE: f"the state is not finite; the zone's strain is {strain[zone]:.6g}",
            layout.COLLAPSED: f"the time step collapsed to {state.ledger[layout.NEXT_STEP]:.3g} s; the largest strain is "
            f"{strain[zone]:.6g}",
        }[status]
        law = self.column.slabs[int(self.column.zone_layer[zone])].law
        return self.outcome("failed", cause + (law.advice if strain[zone] > 0.95 else ""), zone)


def frame(column: Column, profile: np.ndarray) -> Frame:
    """A profile as `kernels.profiles` takes it, by names; the arrays are views of it."""
    cut = profiles.HEAD + profiles.NODE_FIELDS * (column.zones + 1)
    nodes, zones = profile[profiles.HEAD : cut].reshape(-1, column.zones + 1), profile[cut:].reshape(-1, column.zones)
    names = [variable.name for variable in (*ZONE, column.zone_history[0])]
    fields = {variable.name: values for variable, values in zip(NODE, nodes, strict=True)}
    fields |= dict(zip(names, zones, strict=False))
    for name in [variable.name for variable in column.zone_history[1:]]:
        fields[name] = np.full(column.zones, np.nan)
        for slab in column.slabs:
            if name in slab.law.history:
                own = zones[len(names) + list(slab.law.history).index(name)]
                fields[name][slab.part] = own[slab.part]
    return Frame(float(profile[0]), int(profile[1]), fields)
