"""The time loop: many steps in one call, past many output times, for all laws and boundaries.

Leapfrog in its kick–drift form: forces at n take velocities from n − ½ to n + ½, velocities take displacements and strains
to n + 1.
"""

from __future__ import annotations

import math
from typing import Any

from hydro1d.jit.primitives import at, call
from hydro1d.scheme.ends import kick_ends
from hydro1d.scheme.history import fold_sums, record
from hydro1d.scheme.profiles import take_profile
from hydro1d.scheme.records import COLLAPSED, INVERTED, NOT_FINITE, PAUSED, REACHED, Grid

# A run that breaks down is tried again from the start of a block of so many cycles, wherever calls have cut the run.
CYCLE_BLOCK = 32
BLOCK = 512  # zones whose arrays stay in the first-level cache between the node pass and the zone pass
LINE = 8  # numbers of a cache line
# Of the compression speed. Equal steps under a steady force add the same number to a velocity each time, and rounding errs to
# the same side: by 1e-12 of the energy in half a million. With steps that differ in the seventh digit it is a random walk.
UNEVEN = 1e-6
FOLDING = 1024  # cycles; in multiples from the first, so that nothing depends on where calls end
GROWTH = 1.1  # most by which a step exceeds the one before
LOOK = 100_000  # cycles between looks at the pace
# Of the first step, on the mean between two looks. A zone that is crushed to next to nothing keeps its stiffness, and the
# run would never end.
MIN_PACE = 1e-4
MIN_STEP = 1e-12  # of the first step: a mass-spring chain may bounce at 1e-10 of it and come back


def march(g: Grid) -> None:
    """Step until the last stop, the call's number of steps, full rows, enough stops, or a breakdown.

    Stops are enough only where a block of `CYCLE_BLOCK` cycles ends.
    """
    order, every = g.call, g.call.history_every
    recorded, taken = 0, 0
    if every > 0 or order.row_at_stop:
        fold_sums(g)
    order.passed_stops, order.profiles, order.stop = 0, 0, g.stops[0]
    status = pass_stops(g) if g.clock.time >= order.stop else PAUSED
    while taken < order.steps and status == PAUSED and recorded < order.row_capacity and not has_enough(g):
        order.is_fresh = taken == 0
        status = take_step(g)
        taken += 1
        if g.clock.cycle % FOLDING == 0:
            fold(g)
        if every > 0 and g.clock.cycle % every == 0 and status <= PAUSED:
            record(g, recorded)
            recorded += 1
        if status == REACHED:
            status = pass_stops(g)
    if order.row_at_stop and status == REACHED and (recorded == 0 or g.clock.cycle % max(every, 1) != 0):
        record(g, recorded)
        recorded += 1
    order.is_fresh = True  # what comes next may be another state: nothing remembered holds for it
    order.rows, order.status = recorded, status


def pass_stops(g: Grid) -> int:
    """Take the profile of a stop that is reached, if one is wanted, and turn to the next; REACHED where it was the last."""
    order = g.call
    while g.clock.time >= order.stop:
        if g.stops[2 * order.passed_stops + 1] > 0.0:
            take_profile(g, order.profiles)
            order.profiles += 1
        order.passed_stops += 1
        if order.passed_stops >= order.stops:
            return REACHED
        order.stop = g.stops[2 * order.passed_stops]
    return PAUSED


def has_enough(g: Grid) -> bool:
    """Whether profiles are to be handed over, where the next call may be tried again from."""
    return g.call.passed_stops >= g.call.enough_stops and g.clock.cycle % CYCLE_BLOCK == 0


def take_step(g: Grid) -> int:
    """One step. Returns a status."""
    step = choose_step(g)
    g.call.step, g.call.kick = step, 0.5 * (g.clock.last_step + step)
    left, right = g.velocity[1], g.velocity[g.zones + 1]
    kick_ends(g, g.call.kick, step)
    stable, strain = sweep(g, left, right)
    return close_step(g, stable, strain)


def choose_step(g: Grid) -> float:
    """The stable step (s), grown gently, and shortened to meet the stop time: the last two steps share what is left."""
    clock = g.clock
    step = min(clock.next_step, GROWTH * clock.free_step)
    clock.free_step = step
    left = g.call.stop - clock.time
    if step >= left:
        step = left
    elif 2.0 * step > left:
        step = 0.5 * left
    return step


def sweep(g: Grid, left: float, right: float) -> tuple[float, float]:
    """Node pass and zone pass, block by block from left to right; `left` and `right` (m/s) were the ends' velocities.

    Returns the largest stable step (s) and the largest strain; the clock keeps the layer that limits.
    """
    step, velocity, found = g.call.step, g.velocity, g.answer
    g.displacement[0] += step * velocity[1]
    g.displacement[g.zones] += step * velocity[g.zones + 1]
    before, base = g.velocity_before, 0
    before[1] = left
    stable, strain, node = math.inf, -math.inf, 1
    for number in range(g.layer_count):
        layer, own = at(g.layers, number), at(g.layer_state, number)
        stiffness, speed = 0.0, 0.0
        for start in range(layer.first, layer.end, BLOCK):
            end = min(start + BLOCK, layer.end)
            for i in range(start, node):  # what the block before has kicked already
                before[i - start + 1] = before[i - base + 1]
            base = start
            # The node pass runs ahead by the two nodes that the last zone's limiter looks at, and on to the end of a cache
            # line; going right, it never meets a force that is already new.
            ahead = max(min((end + 1) // LINE * LINE + LINE + 1, g.zones), node)
            call(g.passes, g.layer_count + 2, number, node, ahead, start)
            node = ahead
            # Mirrored: an end zone shares its jump with nobody.
            velocity[0], velocity[g.zones + 2] = velocity[2], velocity[g.zones]
            if end == g.zones:
                before[end - start + 1] = right
            call(g.passes, number, number, start, end, 0)
            # `not <=` and not `>`: a NaN must win.
            if not found.stiffness <= stiffness:
                stiffness = found.stiffness
            if not found.viscous_speed <= speed:
                speed = found.viscous_speed
            own.max_strain = max(own.max_strain, found.strain)
            strain = max(strain, found.strain)
            g.clock.peak_stress = max(g.clock.peak_stress, found.stress)
            g.clock.viscous_work += 0.5 * found.viscous_power * g.call.kick
        bound = layer.min_size / fastest(layer, stiffness, speed)
        if stable == stable and not bound >= stable:
            stable, g.clock.limiting_layer = bound, number
    return stable, strain


def fastest(layer: Any, stiffness: float, speed: float) -> float:
    """The speed (m/s) that a layer's step must resolve, of its waves (stiffness/ρ0) and of its viscosity or closing zones.

    Without viscosity the faster of both, and not their sum: a step that follows the motion pumps the shortest waves of a
    mass–spring chain, from which nothing takes energy.
    """
    if layer.linear + layer.limited_linear + layer.quadratic > 0.0:
        return math.sqrt(stiffness + speed * speed) + speed
    waves, closing = math.sqrt(stiffness), 2.0 * speed
    return (closing if closing > waves else waves) + UNEVEN * speed  # a NaN among the waves stays


def fold(g: Grid) -> None:
    """Add the increments of the zones to their energy, and leave in them what rounding takes off.

    A zone that is crushed hard and then gains next to nothing in each of a million steps would lose all of that.
    """
    for i in range(g.zones):
        total = g.energy[i] + g.increment[i]
        g.increment[i] -= total - g.energy[i]
        g.energy[i] = total
    fold_sums(g)


def close_step(g: Grid, stable: float, strain: float) -> int:
    """Move the clock, keep the maxima of every cycle, and see whether the state is sound."""
    clock, stop, step = g.clock, g.call.stop, g.call.step
    left = stop - clock.time
    clock.time = stop if step >= left else clock.time + step
    clock.last_step = step
    clock.cycle += 1
    clock.peak_left_stress = max(clock.peak_left_stress, g.force[0])
    clock.peak_right_stress = max(clock.peak_right_stress, g.force[g.zones - 1])
    clock.next_step = clock.cfl * stable
    if not strain < 1.0:
        return INVERTED
    if not 0.0 < stable < math.inf:
        return NOT_FINITE
    if clock.next_step < MIN_STEP * clock.first_step or clock.time + clock.next_step == clock.time:
        return COLLAPSED
    if clock.cycle % LOOK == 0:
        pace = (clock.time - clock.pace_time) / LOOK
        clock.pace_time = clock.time
        if pace < MIN_PACE * clock.first_step:
            return COLLAPSED
    return REACHED if clock.time >= stop else PAUSED
