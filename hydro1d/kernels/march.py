"""The time loop: many steps in one call, from one event to the next. Compiled once, for all laws and boundaries.

Leapfrog (von Neumann & Richtmyer 1950, doi:10.1063/1.1699639) in its kick–drift form: forces at n take velocities from
n − ½ to n + ½, velocities take displacements and strains to n + 1. Nodes count from 0 to `zones`; in the velocity arrays
node i stands at i + 1, between a ghost at each end. Kernels of laws and boundaries are called by their addresses.
"""

from __future__ import annotations

import math
from typing import Any

from hydro1d.kernels import ends as end_places
from hydro1d.kernels import zones as zone_places
from hydro1d.kernels.memory import LINE
from hydro1d.kernels.primitives import accumulate, call, offset

# p: pointer to double, q: to integers, i: integer
SIGNATURE = "pqq" + 19 * "p" + "qpp" + "iii"

# Places in the ledger: the scalars of the state, then what this call is to do, then what it answers.
TIME, LAST_STEP, FREE_STEP, NEXT_STEP, CYCLE = range(5)
WORK, IMPULSE, VISCOUS_WORK, LARGEST_INPUT = range(5, 9)
PEAK_STRESS, PEAK_LEFT, PEAK_RIGHT, FIRST_ENERGY = range(9, 13)
LEFT_FRONT, RIGHT_FRONT, FIRST_STEP = range(13, 16)
STOP, STEPS, CADENCE, ROW_AT_STOP, CFL = range(16, 21)
STATUS, ROWS, LIMITING_LAYER = range(21, 24)
LEDGER = 24

REACHED, PAUSED, NOT_FINITE, INVERTED, COLLAPSED = range(5)

# Places in the layer table (integers) and in the layers' numbers behind the zone kernel's own.
FIRST_ZONE, ZONES, PARAMETERS = range(3)
LAYER = 3
CRUSHED_STRAIN, TOP_STRAIN, SIZE, ZONE_MASS = range(zone_places.NUMBERS + 1, zone_places.NUMBERS + 5)
NUMBERS = zone_places.NUMBERS + 5
END = 11
CARRIES = 10  # place behind the numbers of an `End`: 2 where the flow carries on beyond the end, 0 where it is mirrored
BLOCK = 512  # zones whose arrays stay in the first-level cache between the node pass and the zone pass
SCRATCH = zone_places.RESULTS  # where `out` goes on after the answers of a kernel
OUT = SCRATCH + end_places.MEMORY
WINDOW = 12  # zones on either side of a front that its integral measure takes in
GROWTH = 1.1  # most by which a step exceeds the one before
SMALLEST = 1e-12  # of the first step: a mass-spring chain may bounce at 1e-10 of it and come back


def march(
    ledger: Any,
    layers: Any,
    addresses: Any,
    parameters: Any,
    numbers: Any,
    end_numbers: Any,
    memory: Any,
    out: Any,
    velocity: Any,
    spare: Any,
    displacement: Any,
    energy: Any,
    force: Any,
    state: Any,
    curve: Any,
    tangents: Any,
    stiffnesses: Any,
    speeds: Any,
    mass: Any,
    inverse_mass: Any,
    coordinate: Any,
    rows: Any,
    probes: Any,
    probe_weights: Any,
    probe_rows: Any,
    layer_count: int,
    zones: int,
    columns: int,
) -> None:
    """Step until the ledger's stop time, its number of steps, full rows, or a breakdown.

    Over nodes: velocity and spare (with ghosts), displacement, mass, inverse_mass, coordinate. Over zones: energy, force
    (σ + q), state (largest strain, then the laws' history, `zones` apart). rows: history as it is recorded.
    """
    steps, cadence, capacity = int(ledger[STEPS]), int(ledger[CADENCE]), int(ledger[ROWS])
    recorded, taken, swapped = 0, 0, False
    status = REACHED if ledger[TIME] >= ledger[STOP] else PAUSED
    before, after = velocity, spare
    while taken < steps and status == PAUSED and recorded < capacity:
        step = choose_step(ledger)
        kick = 0.5 * (ledger[LAST_STEP] + step)
        kick_ends(
            ledger,
            addresses,
            parameters,
            layers,
            end_numbers,
            memory,
            out,
            before,
            after,
            displacement,
            force,
            mass,
            layer_count,
            zones,
            kick,
            step,
        )
        for layer in range(layer_count):
            numbers[layer * NUMBERS + zone_places.STEP] = step
            numbers[layer * NUMBERS + zone_places.KICK] = kick
            numbers[layer * NUMBERS + zone_places.AFRESH] = (
                1.0 if taken == 0 else 0.0
            )  # the kernels remember their curves
        stable, speed, layer = sweep(
            ledger,
            layers,
            addresses,
            parameters,
            numbers,
            end_numbers,
            out,
            before,
            after,
            displacement,
            energy,
            force,
            state,
            curve,
            tangents,
            stiffnesses,
            speeds,
            inverse_mass,
            layer_count,
            zones,
            kick,
            step,
        )
        before, after = after, before
        swapped = not swapped
        taken += 1
        status = close_step(ledger, force, zones, step, stable, speed, layer)
        if cadence > 0 and int(ledger[CYCLE]) % cadence == 0 and status <= PAUSED:
            record(
                ledger,
                layers,
                addresses,
                parameters,
                numbers,
                end_numbers,
                memory,
                out,
                before,
                after,
                displacement,
                energy,
                force,
                state,
                mass,
                inverse_mass,
                coordinate,
                offset(rows, recorded * columns),
                probes,
                probe_weights,
                offset(probe_rows, recorded * probes[0] * 4),
                layer_count,
                zones,
            )
            recorded += 1
    if swapped:
        for i in range(zones + 3):
            velocity[i] = before[i]
    if ledger[ROW_AT_STOP] > 0.0 and status == REACHED and (recorded == 0 or int(ledger[CYCLE]) % max(cadence, 1) != 0):
        record(
            ledger,
            layers,
            addresses,
            parameters,
            numbers,
            end_numbers,
            memory,
            out,
            velocity,
            spare,
            displacement,
            energy,
            force,
            state,
            mass,
            inverse_mass,
            coordinate,
            offset(rows, recorded * columns),
            probes,
            probe_weights,
            offset(probe_rows, recorded * probes[0] * 4),
            layer_count,
            zones,
        )
        recorded += 1
    for layer in range(layer_count):  # what comes next may be another state: nothing remembered holds for it
        numbers[layer * NUMBERS + zone_places.AFRESH] = 1.0
    ledger[ROWS] = recorded
    ledger[STATUS] = status


def choose_step(ledger: Any) -> float:
    """The stable step, grown gently, and shortened to meet the stop time: the last two steps share what is left."""
    step = ledger[NEXT_STEP]
    if ledger[FREE_STEP] > 0.0:
        step = min(step, GROWTH * ledger[FREE_STEP])
    ledger[FREE_STEP] = step
    left = ledger[STOP] - ledger[TIME]
    if step >= left:
        step = left
    elif 2.0 * step > left:
        step = 0.5 * left
    return step


def kick_ends(
    ledger: Any,
    addresses: Any,
    parameters: Any,
    layers: Any,
    end_numbers: Any,
    memory: Any,
    out: Any,
    before: Any,
    after: Any,
    displacement: Any,
    force: Any,
    mass: Any,
    layer_count: int,
    zones: int,
    kick: float,
    step: float,
) -> None:
    """New velocities of the two end nodes by their boundaries, and the work and impulse that these give."""
    for side in range(2):
        node, zone, sign = (0, 0, 1.0) if side == 0 else (zones, zones - 1, -1.0)
        end = offset(end_numbers, side * END)
        end[0], end[1], end[2] = ledger[TIME], ledger[LAST_STEP], step
        end[3], end[4] = sign * before[node + 1], sign * displacement[node]
        end[5], end[6] = mass[node], force[zone]
        call(
            addresses,
            layer_count + side,
            offset(parameters, layers[(layer_count + side) * LAYER + PARAMETERS]),
            end,
            offset(memory, side * end_places.MEMORY),
            out,
        )
        pushed = out[end_places.FORCE]
        after[node + 1] = sign * out[end_places.VELOCITY]
        ledger[WORK] += pushed * 0.5 * (end[3] + out[end_places.VELOCITY]) * kick
        ledger[IMPULSE] += sign * pushed * kick
    ledger[LARGEST_INPUT] = max(ledger[LARGEST_INPUT], ledger[WORK])


def sweep(
    ledger: Any,
    layers: Any,
    addresses: Any,
    parameters: Any,
    numbers: Any,
    end_numbers: Any,
    out: Any,
    before: Any,
    after: Any,
    displacement: Any,
    energy: Any,
    force: Any,
    state: Any,
    curve: Any,
    tangents: Any,
    stiffnesses: Any,
    speeds: Any,
    inverse_mass: Any,
    layer_count: int,
    zones: int,
    kick: float,
    step: float,
) -> tuple[float, float, int]:
    """Node phase and zone phase, block by block from left to right.

    The node pass runs ahead of the zone pass by the two nodes that the last zone's limiter looks at, and on to the end of a
    cache line; going right, it never meets a force that is already new. Returns the largest stable step, the largest strain and
    the layer that limits.
    """
    displacement[0] += step * after[1]
    displacement[zones] += step * after[zones + 1]
    stable, strain, limiting, node = math.inf, -math.inf, 0, 1
    for layer in range(layer_count):
        first = layers[layer * LAYER + FIRST_ZONE]
        last = first + layers[layer * LAYER + ZONES]
        constants = offset(numbers, layer * NUMBERS)
        stiffness, speed = 0.0, 0.0
        for start in range(first, last, BLOCK):
            end = min(start + BLOCK, last)
            ahead = min((end + 1) // LINE * LINE + LINE + 1, zones)
            for i in range(node, ahead):
                after[i + 1] = before[i + 1] + kick * (force[i - 1] - force[i]) * inverse_mass[i]
                displacement[i] += step * after[i + 1]
            node = max(node, ahead)
            after[0] = after[2] + end_numbers[CARRIES] * (after[1] - after[2])
            after[zones + 2] = after[zones] + end_numbers[END + CARRIES] * (after[zones + 1] - after[zones])
            call(
                addresses,
                layer,
                offset(parameters, layers[layer * LAYER + PARAMETERS]),
                constants,
                offset(after, start),
                offset(before, start),
                offset(displacement, start),
                offset(energy, start),
                offset(force, start),
                offset(state, start),
                offset(curve, start),
                offset(tangents, start),
                offset(stiffnesses, start),
                offset(speeds, start),
                end - start,
                zones,
                out,
            )
            # `not <=` and not `>`: a NaN must win.
            if not out[zone_places.STIFFNESS] <= stiffness:
                stiffness = out[zone_places.STIFFNESS]
            if not out[zone_places.VISCOUS_SPEED] <= speed:
                speed = out[zone_places.VISCOUS_SPEED]
            constants[TOP_STRAIN] = max(constants[TOP_STRAIN], out[zone_places.STRAIN])
            strain = max(strain, out[zone_places.STRAIN])
            ledger[PEAK_STRESS] = max(ledger[PEAK_STRESS], out[zone_places.STRESS])
            ledger[VISCOUS_WORK] += out[zone_places.VISCOUS_POWER] * step
        size = constants[SIZE] / (math.sqrt(stiffness + speed * speed) + speed)
        if stable == stable and not size >= stable:
            stable, limiting = size, layer
    return stable, strain, limiting


def close_step(ledger: Any, force: Any, zones: int, step: float, stable: float, strain: float, layer: int) -> int:
    """Move the clock, keep the maxima of every cycle, and see whether the state is sound."""
    left = ledger[STOP] - ledger[TIME]
    ledger[TIME] = ledger[STOP] if step >= left else ledger[TIME] + step
    ledger[LAST_STEP] = step
    ledger[CYCLE] += 1.0
    ledger[PEAK_LEFT] = max(ledger[PEAK_LEFT], force[0])
    ledger[PEAK_RIGHT] = max(ledger[PEAK_RIGHT], force[zones - 1])
    ledger[LIMITING_LAYER] = layer
    ledger[NEXT_STEP] = ledger[CFL] * stable
    if not strain < 1.0:
        return INVERTED
    if not 0.0 < stable < math.inf:
        return NOT_FINITE
    if ledger[NEXT_STEP] < SMALLEST * ledger[FIRST_STEP] or ledger[TIME] + ledger[NEXT_STEP] == ledger[TIME]:
        return COLLAPSED
    return REACHED if ledger[TIME] >= ledger[STOP] else PAUSED


def record(
    ledger: Any,
    layers: Any,
    addresses: Any,
    parameters: Any,
    numbers: Any,
    end_numbers: Any,
    memory: Any,
    out: Any,
    velocity: Any,
    centred: Any,
    displacement: Any,
    energy: Any,
    force: Any,
    state: Any,
    mass: Any,
    inverse_mass: Any,
    coordinate: Any,
    row: Any,
    probes: Any,
    probe_weights: Any,
    probe_row: Any,
    layer_count: int,
    zones: int,
) -> None:
    """One row of the history, and of the probes, at the time of the stresses.

    Velocities, energies and the boundaries' work are taken half a kick on, to that very time; the state is not touched.
    """
    half = 0.5 * ledger[LAST_STEP]
    work, impulse = centre(
        ledger,
        addresses,
        parameters,
        layers,
        end_numbers,
        memory,
        out,
        velocity,
        centred,
        displacement,
        force,
        mass,
        inverse_mass,
        layer_count,
        zones,
        half,
    )
    kinetic, momentum = 0.0, 0.0
    for i in range(zones + 1):
        kinetic = accumulate(kinetic, 0.5 * mass[i] * centred[i + 1] * centred[i + 1])
        momentum = accumulate(momentum, mass[i] * centred[i + 1])
    internal, length, crushable = 0.0, 0.0, 0.0
    for layer in range(layer_count):
        first = layers[layer * LAYER + FIRST_ZONE]
        last = first + layers[layer * LAYER + ZONES]
        constants = offset(numbers, layer * NUMBERS)
        crushed = crushed_strain(constants)
        zone_mass, size = constants[ZONE_MASS], constants[SIZE]
        for i in range(first, last):
            jump = velocity[i + 1] - velocity[i + 2] + centred[i + 1] - centred[i + 2]
            internal = accumulate(internal, zone_mass * energy[i] + 0.5 * half * force[i] * jump)
            length = accumulate(length, 0.0 if state[i] > crushed else size)
        if crushed < math.inf:
            crushable += size * (last - first)
        else:
            length -= size * (last - first)
    total = kinetic + internal
    put_in = ledger[FIRST_ENERGY] + max(ledger[LARGEST_INPUT], work)
    row[0], row[1] = ledger[TIME], ledger[LAST_STEP]
    row[2], row[3] = force[0], force[zones - 1]
    row[4], row[5] = centred[1], centred[zones + 1]
    row[6], row[7] = coordinate[0] + displacement[0], coordinate[zones] + displacement[zones]
    row[8], row[9], row[10], row[11] = kinetic, internal, work, ledger[VISCOUS_WORK]
    row[12] = (total - ledger[FIRST_ENERGY] - work) / put_in if put_in > 0.0 else 0.0
    row[13], row[14] = momentum, impulse
    row[15], row[16], row[17] = ledger[PEAK_STRESS], ledger[PEAK_LEFT], ledger[PEAK_RIGHT]
    row[18], row[19] = fronts(ledger, layers, numbers, state, coordinate, layer_count, zones)
    row[20] = max(length, 0.0) / crushable if crushable > 0.0 else math.nan
    for k in range(2 * end_places.MEMORY):
        row[21 + k] = memory[k]
    for k in range(probes[0]):
        zone, layer = probes[1 + 2 * k], probes[2 + 2 * k]
        constants, share, probe = offset(numbers, layer * NUMBERS), probe_weights[k], offset(probe_row, 4 * k)
        observed = offset(out, SCRATCH)
        call(
            addresses,
            layer,
            offset(parameters, layers[layer * LAYER + PARAMETERS]),
            constants,
            offset(velocity, zone),
            offset(velocity, zone),
            offset(displacement, zone),
            offset(energy, zone),
            observed,
            offset(state, zone),
            out,
            out,
            out,
            out,
            -1,
            zones,
            out,
        )
        probe[3] = observed[0]
        probe[2] = (displacement[zone] - displacement[zone + 1]) * constants[zone_places.INVERSE_SIZE]
        probe[1] = (1.0 - share) * centred[zone + 1] + share * centred[zone + 2]
        moved = (1.0 - share) * displacement[zone] + share * displacement[zone + 1]
        probe[0] = (1.0 - share) * coordinate[zone] + share * coordinate[zone + 1] + moved


def centre(
    ledger: Any,
    addresses: Any,
    parameters: Any,
    layers: Any,
    end_numbers: Any,
    memory: Any,
    out: Any,
    velocity: Any,
    centred: Any,
    displacement: Any,
    force: Any,
    mass: Any,
    inverse_mass: Any,
    layer_count: int,
    zones: int,
    half: float,
) -> tuple[float, float]:
    """Velocities half a kick on, at the time of the stresses; boundary work and impulse up to then."""
    work, impulse = ledger[WORK], ledger[IMPULSE]
    for i in range(1, zones):
        centred[i + 1] = velocity[i + 1] + half * (force[i - 1] - force[i]) * inverse_mass[i]
    for side in range(2):
        node, zone, sign = (0, 0, 1.0) if side == 0 else (zones, zones - 1, -1.0)
        end, scratch = offset(end_numbers, side * END), offset(out, SCRATCH)
        end[0], end[1], end[2] = ledger[TIME], ledger[LAST_STEP], 0.0
        end[3], end[4] = sign * velocity[node + 1], sign * displacement[node]
        end[5], end[6] = mass[node], force[zone]
        for k in range(end_places.MEMORY):
            scratch[k] = memory[side * end_places.MEMORY + k]
        call(
            addresses,
            layer_count + side,
            offset(parameters, layers[(layer_count + side) * LAYER + PARAMETERS]),
            end,
            scratch,
            out,
        )
        centred[node + 1] = sign * out[end_places.VELOCITY]
        work += out[end_places.FORCE] * 0.5 * (end[3] + out[end_places.VELOCITY]) * half
        impulse += sign * out[end_places.FORCE] * half
    return work, impulse


def crushed_strain(constants: Any) -> float:
    """The layer's densification strain, or half of its largest strain so far."""
    given = constants[CRUSHED_STRAIN]
    return given if given == given else 0.5 * constants[TOP_STRAIN]


def fronts(
    ledger: Any, layers: Any, numbers: Any, state: Any, coordinate: Any, layer_count: int, zones: int
) -> tuple[float, float]:
    """Lagrangian positions of the compaction fronts that run from the left and from the right end; NaN where none runs.

    A layer that cannot be crushed (a plate before the foam) is passed over.
    """
    left, right = int(ledger[LEFT_FRONT]), int(ledger[RIGHT_FRONT])
    while left > 0 and not is_passed(layers, numbers, state, layer_count, left - 1):
        left -= 1
    while left < zones and is_passed(layers, numbers, state, layer_count, left):
        left += 1
    while right < zones and not is_passed(layers, numbers, state, layer_count, right):
        right += 1
    while right > 0 and is_passed(layers, numbers, state, layer_count, right - 1):
        right -= 1
    ledger[LEFT_FRONT], ledger[RIGHT_FRONT] = left, right
    proximal, distal = math.nan, math.nan
    if left < right:
        if left > 0 and is_crushed(layers, numbers, state, layer_count, left - 1):
            start, end = max(left - WINDOW, 0), min(left + WINDOW, right)
            proximal = coordinate[start] + crushed_length(state, coordinate, start, end, start, end - 1)
        if right < zones and is_crushed(layers, numbers, state, layer_count, right):
            start, end = max(right - WINDOW, left), min(right + WINDOW, zones)
            distal = coordinate[end] - crushed_length(state, coordinate, start, end, end - 1, start)
    return proximal, distal


def is_passed(layers: Any, numbers: Any, state: Any, layer_count: int, zone: int) -> bool:
    """Whether a front has no more to do in a zone: it is crushed, or never can be."""
    crushed = crushed_strain(offset(numbers, layer_of(layers, layer_count, zone) * NUMBERS))
    return state[zone] > crushed or crushed == math.inf


def is_crushed(layers: Any, numbers: Any, state: Any, layer_count: int, zone: int) -> bool:
    """Whether a zone's largest strain has passed what its layer calls crushed."""
    return state[zone] > crushed_strain(offset(numbers, layer_of(layers, layer_count, zone) * NUMBERS))


def layer_of(layers: Any, layer_count: int, zone: int) -> int:
    """Number of the layer that a zone belongs to."""
    layer = layer_count - 1
    while layers[layer * LAYER + FIRST_ZONE] > zone:
        layer -= 1
    return layer


def crushed_length(state: Any, coordinate: Any, start: int, end: int, behind: int, ahead: int) -> float:
    """Σ (ε − ε_A)/(ε_B − ε_A) ΔX over zones: unlike a half level, it does not see how far the front is smeared.

    ε is the largest strain so far, so that what happens to a zone behind the front does not move the front.
    """
    length = 0.0
    for i in range(start, end):
        share = (state[i] - state[ahead]) / (state[behind] - state[ahead]) if state[behind] > state[ahead] else 0.0
        length += min(max(share, 0.0), 1.0) * (coordinate[i + 1] - coordinate[i])
    return length
