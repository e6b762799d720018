"""The time loop: many steps in one call, past many output times. Compiled once, for all laws and boundaries.

Leapfrog (von Neumann & Richtmyer 1950, doi:10.1063/1.1699639) in its kick–drift form: forces at n take velocities from
n − ½ to n + ½, velocities take displacements and strains to n + 1. Kernels of laws and boundaries are called by their
addresses.
"""

from __future__ import annotations

import math
from typing import Any

from hydro1d.kernels import zones as zone_places
from hydro1d.kernels.ends import FORCE, MEMORY, VELOCITY
from hydro1d.kernels.history import push_end, record, sum_settled
from hydro1d.kernels.layout import (
    CADENCE,
    CFL,
    COLLAPSED,
    CYCLE,
    CYCLE_BLOCK,
    ENOUGH,
    FIRST_STEP,
    FIRST_ZONE,
    FREE_STEP,
    IMPULSE,
    IMPULSE_LOST,
    INVERTED,
    LARGEST_INPUT,
    LAST_STEP,
    LAYER,
    LIMITING_LAYER,
    NEXT_STEP,
    NOT_FINITE,
    NUMBERS,
    PACE_TIME,
    PARAMETERS,
    PASSED,
    PAUSED,
    PEAK_LEFT,
    PEAK_RIGHT,
    PEAK_STRESS,
    PROFILES,
    REACHED,
    ROW_AT_STOP,
    ROWS,
    SIZE,
    STATUS,
    STEPS,
    STOP,
    STOPS,
    TIME,
    TOP_STRAIN,
    VISCOUS_WORK,
    WORK,
    WORK_LOST,
    ZONE_MASS,
    ZONES,
    Arrays,
)
from hydro1d.kernels.memory import LINE
from hydro1d.kernels.primitives import call, offset
from hydro1d.kernels.profiles import take_profile

BLOCK = 512  # zones whose arrays stay in the first-level cache between the node pass and the zone pass
# Of the closing speed. Equal steps under a steady force add the same number to a velocity each time, and rounding errs to
# the same side: by 1e-12 of the energy in half a million. With steps that differ in the seventh digit it is a random walk.
UNEVEN = 1e-6
SETTLING = 1024  # cycles; in multiples from the first, so that nothing depends on where calls end
GROWTH = 1.1  # most by which a step exceeds the one before
LOOK = 100_000  # cycles between looks at the pace
# Of the first step, on the mean between two looks. A zone that is crushed to next to nothing keeps its stiffness, and the
# run would never end.
SLOWEST_PACE = 1e-4
SMALLEST = 1e-12  # of the first step: a mass-spring chain may bounce at 1e-10 of it and come back


def march(
    ledger: Any, layers: Any, addresses: Any, parameters: Any, numbers: Any, end_numbers: Any, memory: Any, out: Any,
    velocity: Any, spare: Any, displacement: Any, energy: Any, gained: Any, force: Any, viscosity: Any, state: Any,
    curve: Any, tangents: Any, stiffnesses: Any, speeds: Any, mass: Any, inverse_mass: Any, coordinate: Any, rows: Any,
    probes: Any, probe_weights: Any, probe_rows: Any, stops: Any, profiles: Any, layer_count: int, zones: int,
    columns: int, variables: int,
) -> None:  # fmt: skip
    """Step until the last stop, the ledger's number of steps, full rows, enough stops, or a breakdown.

    The arguments are `Arrays`. Stops are enough only where a block of `CYCLE_BLOCK` cycles ends.
    """
    a = Arrays(
        ledger, layers, addresses, parameters, numbers, end_numbers, memory, out, velocity, spare, displacement, energy,
        gained, force, viscosity, state, curve, tangents, stiffnesses, speeds, mass, inverse_mass, coordinate, rows, probes,
        probe_weights, probe_rows, stops, profiles, layer_count, zones, columns, variables,
    )  # fmt: skip
    steps, cadence, capacity = int(ledger[STEPS]), int(ledger[CADENCE]), int(ledger[ROWS])
    recorded, taken = 0, 0
    if cadence > 0 or ledger[ROW_AT_STOP] > 0.0:
        sum_settled(a)
    ledger[PASSED], ledger[PROFILES], ledger[STOP] = 0.0, 0.0, stops[0]
    status = pass_stops(a) if ledger[TIME] >= ledger[STOP] else PAUSED
    while taken < steps and status == PAUSED and recorded < capacity and not has_enough(ledger):
        status = take_step(a, taken == 0)
        taken += 1
        if int(ledger[CYCLE]) % SETTLING == 0:
            settle(a)
        if cadence > 0 and int(ledger[CYCLE]) % cadence == 0 and status <= PAUSED:
            record(a, recorded)
            recorded += 1
        if status == REACHED:
            status = pass_stops(a)
    if ledger[ROW_AT_STOP] > 0.0 and status == REACHED and (recorded == 0 or int(ledger[CYCLE]) % max(cadence, 1) != 0):
        record(a, recorded)
        recorded += 1
    for layer in range(layer_count):  # what comes next may be another state: nothing remembered holds for it
        numbers[layer * NUMBERS + zone_places.AFRESH] = 1.0
    ledger[ROWS] = recorded
    ledger[STATUS] = status


def pass_stops(a: Arrays) -> int:
    """Take the profile of a stop that is reached, if one is wanted, and turn to the next; REACHED where it was the last."""
    ledger = a.ledger
    while ledger[TIME] >= ledger[STOP]:
        stop = int(ledger[PASSED])
        if a.stops[2 * stop + 1] > 0.0:
            take_profile(a, int(ledger[PROFILES]))
            ledger[PROFILES] += 1.0
        ledger[PASSED] += 1.0
        if ledger[PASSED] >= ledger[STOPS]:
            return REACHED
        ledger[STOP] = a.stops[2 * stop + 2]
    return PAUSED


def has_enough(ledger: Any) -> bool:
    """Whether profiles are to be handed over, where the next call may be tried again from."""
    return ledger[PASSED] >= ledger[ENOUGH] and int(ledger[CYCLE]) % CYCLE_BLOCK == 0


def take_step(a: Arrays, afresh: bool) -> int:
    """One step. Returns a status."""
    step = choose_step(a.ledger)
    kick = 0.5 * (a.ledger[LAST_STEP] + step)
    left, right = a.velocity[1], a.velocity[a.zones + 1]
    kick_ends(a, kick, step)
    for layer in range(a.layer_count):
        numbers = offset(a.numbers, layer * NUMBERS)
        per_mass = numbers[zone_places.INVERSE_SIZE] * numbers[zone_places.INVERSE_DENSITY]
        numbers[zone_places.TO_KICK], numbers[zone_places.TO_STRAIN] = 0.5 * kick * per_mass, 0.5 * step * per_mass
        numbers[zone_places.AFRESH] = 1.0 if afresh else 0.0  # within a call the kernels remember their curves
    stable, strain, layer = sweep(a, left, right, kick, step)
    return close_step(a, step, stable, strain, layer)


def choose_step(ledger: Any) -> float:
    """The stable step, grown gently, and shortened to meet the stop time: the last two steps share what is left."""
    step = min(ledger[NEXT_STEP], GROWTH * ledger[FREE_STEP])
    ledger[FREE_STEP] = step
    left = ledger[STOP] - ledger[TIME]
    if step >= left:
        step = left
    elif 2.0 * step > left:
        step = 0.5 * left
    return step


def kick_ends(a: Arrays, kick: float, step: float) -> None:
    """New velocities of the two end nodes by their boundaries, and the work and impulse that these give."""
    ledger = a.ledger
    for side in range(2):
        node, sign = (0, 1.0) if side == 0 else (a.zones, -1.0)
        push_end(a, side, offset(a.memory, side * MEMORY), step)
        velocity, pushed = a.out[VELOCITY], a.out[FORCE]
        add(ledger, WORK, WORK_LOST, pushed * 0.5 * (sign * a.velocity[node + 1] + velocity) * kick)
        a.velocity[node + 1] = sign * velocity
        add(ledger, IMPULSE, IMPULSE_LOST, sign * pushed * kick)
    ledger[LARGEST_INPUT] = max(ledger[LARGEST_INPUT], ledger[WORK])


def add(ledger: Any, place: int, lost: int, amount: float) -> None:
    """Add to a sum of the ledger; what rounding takes off goes into the next addition (Kahan 1965).

    A steady load on a steady step adds the same number each time, and rounding then errs to the same side.
    """
    amount += ledger[lost]
    total = ledger[place] + amount
    ledger[lost] = amount - (total - ledger[place])
    ledger[place] = total


def sweep(a: Arrays, left: float, right: float, kick: float, step: float) -> tuple[float, float, int]:
    """Node phase and zone phase, block by block from left to right; `left` and `right` were the velocities of the ends.

    Returns the largest stable step, the largest strain and the layer that limits.
    """
    ledger, out, velocity = a.ledger, a.out, a.velocity
    a.displacement[0] += step * velocity[1]
    a.displacement[a.zones] += step * velocity[a.zones + 1]
    before, base = a.spare, 0
    before[1] = left
    stable, strain, limiting, node = math.inf, -math.inf, 0, 1
    for layer in range(a.layer_count):
        first = a.layers[layer * LAYER + FIRST_ZONE]
        last = first + a.layers[layer * LAYER + ZONES]
        numbers = offset(a.numbers, layer * NUMBERS)
        stiffness, speed = 0.0, 0.0
        for start in range(first, last, BLOCK):
            end = min(start + BLOCK, last)
            for i in range(start, node):  # what the block before has kicked already
                before[i - start + 1] = before[i - base + 1]
            base = start
            node = kick_nodes(a, layer, node, start, end, kick, step)
            if end == a.zones:
                before[end - start + 1] = right
            push_zones(a, layer, numbers, before, start, end)
            # `not <=` and not `>`: a NaN must win.
            if not out[zone_places.STIFFNESS] <= stiffness:
                stiffness = out[zone_places.STIFFNESS]
            if not out[zone_places.VISCOUS_SPEED] <= speed:
                speed = out[zone_places.VISCOUS_SPEED]
            numbers[TOP_STRAIN] = max(numbers[TOP_STRAIN], out[zone_places.STRAIN])
            strain = max(strain, out[zone_places.STRAIN])
            ledger[PEAK_STRESS] = max(ledger[PEAK_STRESS], out[zone_places.STRESS])
            ledger[VISCOUS_WORK] += 0.5 * out[zone_places.VISCOUS_POWER] * kick
        bound = numbers[SIZE] / fastest(numbers, stiffness, speed)
        if stable == stable and not bound >= stable:
            stable, limiting = bound, layer
    return stable, strain, limiting


def fastest(numbers: Any, stiffness: float, speed: float) -> float:
    """The speed that a layer's step must resolve, of its waves (stiffness/ρ0) and of its viscosity or closing zones.

    Without viscosity the faster of both, and not their sum: a step that follows the motion pumps the shortest waves of a
    mass–spring chain, from which nothing takes energy.
    """
    if numbers[zone_places.LINEAR] + numbers[zone_places.SMOOTH_LINEAR] + numbers[zone_places.QUADRATIC] > 0.0:
        return math.sqrt(stiffness + speed * speed) + speed
    waves, closing = math.sqrt(stiffness), 2.0 * speed
    return (closing if closing > waves else waves) + UNEVEN * speed  # a NaN among the waves stays


def kick_nodes(a: Arrays, layer: int, node: int, start: int, end: int, kick: float, step: float) -> int:
    """Velocities and displacements of the nodes from ``node`` on that the zones [start, end) need; the node to go on from.

    What the velocities were goes to the spare array, from ``start`` on. This runs ahead of the zone pass by the two nodes
    that the last zone's limiter looks at, and on to the end of a cache line; going right, it never meets a force that is
    already new.
    """
    velocity, before, force, displacement = a.velocity, a.spare, a.force, a.displacement
    ahead = max(min((end + 1) // LINE * LINE + LINE + 1, a.zones), node)
    while node < ahead:
        while node >= a.layers[layer * LAYER + FIRST_ZONE] + a.layers[layer * LAYER + ZONES]:
            layer += 1
        first = a.layers[layer * LAYER + FIRST_ZONE]
        last = min(first + a.layers[layer * LAYER + ZONES], ahead) if node > first else node + 1
        # Within a layer all nodes weigh the same: an array less to go through the memory.
        inverse_mass = 1.0 / a.numbers[layer * NUMBERS + ZONE_MASS] if node > first else a.inverse_mass[node]
        for i in range(node, last):
            before[i - start + 1] = velocity[i + 1]
            velocity[i + 1] += kick * (force[i - 1] - force[i]) * inverse_mass
            displacement[i] += step * velocity[i + 1]
        node = last
    velocity[0], velocity[a.zones + 2] = (
        velocity[2],
        velocity[a.zones],
    )  # mirrored: an end zone shares its jump with nobody
    return ahead


def push_zones(a: Arrays, layer: int, numbers: Any, before: Any, start: int, end: int) -> None:
    """Call a layer's zone kernel on some of its zones; `before` begins with the node on the left of the first."""
    call(
        a.addresses, layer, offset(a.parameters, a.layers[layer * LAYER + PARAMETERS]), numbers,
        offset(a.velocity, start), before, offset(a.displacement, start), offset(a.energy, start), offset(a.gained, start),
        offset(a.force, start), offset(a.viscosity, start), offset(a.state, start), offset(a.curve, start),
        offset(a.tangents, start), offset(a.stiffnesses, start), offset(a.speeds, start), end - start, a.zones, a.out,
    )  # fmt: skip


def settle(a: Arrays) -> None:
    """Add what zones have gained to their energy, and leave in it what rounding takes off.

    A zone that is crushed hard and then gains next to nothing in each of a million steps would lose all of that.
    """
    for i in range(a.zones):
        total = a.energy[i] + a.gained[i]
        a.gained[i] -= total - a.energy[i]
        a.energy[i] = total
    sum_settled(a)


def close_step(a: Arrays, step: float, stable: float, strain: float, layer: int) -> int:
    """Move the clock, keep the maxima of every cycle, and see whether the state is sound."""
    ledger = a.ledger
    left = ledger[STOP] - ledger[TIME]
    ledger[TIME] = ledger[STOP] if step >= left else ledger[TIME] + step
    ledger[LAST_STEP] = step
    ledger[CYCLE] += 1.0
    ledger[PEAK_LEFT] = max(ledger[PEAK_LEFT], a.force[0])
    ledger[PEAK_RIGHT] = max(ledger[PEAK_RIGHT], a.force[a.zones - 1])
    ledger[LIMITING_LAYER] = layer
    ledger[NEXT_STEP] = ledger[CFL] * stable
    if not strain < 1.0:
        return INVERTED
    if not 0.0 < stable < math.inf:
        return NOT_FINITE
    if ledger[NEXT_STEP] < SMALLEST * ledger[FIRST_STEP] or ledger[TIME] + ledger[NEXT_STEP] == ledger[TIME]:
        return COLLAPSED
    if int(ledger[CYCLE]) % LOOK == 0:
        pace = (ledger[TIME] - ledger[PACE_TIME]) / LOOK
        ledger[PACE_TIME] = ledger[TIME]
        if pace < SLOWEST_PACE * ledger[FIRST_STEP]:
            return COLLAPSED
    return REACHED if ledger[TIME] >= ledger[STOP] else PAUSED
