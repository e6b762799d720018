"""A row of the history, all of it at the time of the stresses: energies, momentum, fronts, and what the probes see."""

from __future__ import annotations

import math
from typing import Any

from hydro1d.kernels.ends import FORCE, MEMORY, VELOCITY
from hydro1d.kernels.layout import (
    CRUSHED_STRAIN,
    END,
    FIRST_ENERGY,
    FIRST_ZONE,
    IMPULSE,
    LARGEST_INPUT,
    LAST_STEP,
    LAYER,
    LEFT_FRONT,
    NUMBERS,
    PARAMETERS,
    PEAK_LEFT,
    PEAK_RIGHT,
    PEAK_STRESS,
    RIGHT_FRONT,
    SCRATCH,
    SETTLED,
    SIZE,
    TIME,
    TOP_STRAIN,
    VISCOUS_WORK,
    WORK,
    YIELD_STRAIN,
    ZONE_MASS,
    ZONES,
    Arrays,
)
from hydro1d.kernels.primitives import accumulate, call, offset
from hydro1d.kernels.zones import INVERSE_SIZE

WINDOW = 12  # zones on either side of a front that its integral measure takes in


def record(a: Arrays, place: int) -> None:
    """One row of the history, and of the probes. The state is not touched."""
    ledger, half = a.ledger, 0.5 * a.ledger[LAST_STEP]
    row = offset(a.rows, place * a.columns)
    work, impulse = centre_ends(a, half, offset(row, 21))
    kinetic, momentum, exchange = sum_nodes(a, half)
    stored, uncrushed = sum_zones(a)
    internal = stored - 0.5 * half * exchange
    put_in = ledger[FIRST_ENERGY] + max(ledger[LARGEST_INPUT], work)
    row[0], row[1] = ledger[TIME], ledger[LAST_STEP]
    row[2], row[3] = a.force[0], a.force[a.zones - 1]
    row[4], row[5] = a.spare[1], a.spare[a.zones + 1]
    row[6], row[7] = a.coordinate[0] + a.displacement[0], a.coordinate[a.zones] + a.displacement[a.zones]
    row[8], row[9], row[10], row[11] = kinetic, internal, work, ledger[VISCOUS_WORK]
    row[12] = (kinetic + internal - ledger[FIRST_ENERGY] - work) / put_in if put_in > 0.0 else 0.0
    row[13], row[14] = momentum, impulse
    row[15], row[16], row[17] = ledger[PEAK_STRESS], ledger[PEAK_LEFT], ledger[PEAK_RIGHT]
    row[18], row[19] = fronts(a)
    row[20] = uncrushed
    for k in range(a.probes[0]):
        look(a, k, half, offset(a.probe_rows, (place * a.probes[0] + k) * 4))


def push_end(a: Arrays, side: int, memory: Any, step: float) -> None:
    """Call the boundary of a side: `out` holds the new velocity of its node and its force, both inward."""
    node, zone, sign = (0, 0, 1.0) if side == 0 else (a.zones, a.zones - 1, -1.0)
    end = offset(a.end_numbers, side * END)
    end[0], end[1], end[2] = a.ledger[TIME], a.ledger[LAST_STEP], step
    end[3], end[4] = sign * a.velocity[node + 1], sign * a.displacement[node]
    end[5], end[6] = a.mass[node], a.force[zone]
    which = a.layer_count + side
    call(a.addresses, which, offset(a.parameters, a.layers[which * LAYER + PARAMETERS]), end, memory, a.out)


def centre_ends(a: Arrays, half: float, remembered: Any) -> tuple[float, float]:
    """Velocities of the end nodes half a kick on, and what the boundaries remember; boundary work and impulse up to then.

    The velocities go to the spare array.
    """
    work, impulse = a.ledger[WORK], a.ledger[IMPULSE]
    for side in range(2):
        node, sign = (0, 1.0) if side == 0 else (a.zones, -1.0)
        scratch = offset(a.out, SCRATCH)
        for k in range(MEMORY):
            scratch[k] = a.memory[side * MEMORY + k]
        push_end(a, side, scratch, 0.0)
        for k in range(MEMORY):
            remembered[side * MEMORY + k] = scratch[k]
        pushed = a.out[FORCE]
        a.spare[node + 1] = sign * a.out[VELOCITY]
        work += pushed * 0.5 * sign * (a.velocity[node + 1] + a.spare[node + 1]) * half
        impulse += sign * pushed * half
    return work, impulse


def centre_node(a: Arrays, node: int, half: float) -> float:
    """Velocity of a node half a kick on, after `centre_ends`."""
    if node == 0 or node == a.zones:
        return a.spare[node + 1]
    return a.velocity[node + 1] + half * (a.force[node - 1] - a.force[node]) * a.inverse_mass[node]


def sum_nodes(a: Arrays, half: float) -> tuple[float, float, float]:
    """Kinetic energy and momentum half a kick on, and the exchange between nodes and zones.

    The exchange, Σ v (f_left − f_right) with twice the mean velocity of the half kick, is minus what the forces give to the
    zones: Σ f Δv, summed by parts.
    """
    velocity, force = a.velocity, a.force
    kinetic, momentum, exchange = 0.0, 0.0, 0.0
    for layer in range(a.layer_count):
        first = a.layers[layer * LAYER + FIRST_ZONE]
        mass = a.numbers[layer * NUMBERS + ZONE_MASS]  # of each node within the layer
        inverse_mass, speeds, squares = 1.0 / mass, 0.0, 0.0
        for i in range(first + 1, first + a.layers[layer * LAYER + ZONES]):
            pull = force[i - 1] - force[i]
            speed = velocity[i + 1] + half * pull * inverse_mass
            speeds = accumulate(speeds, speed)
            squares = accumulate(squares, speed * speed)
            exchange = accumulate(exchange, (velocity[i + 1] + speed) * pull)
        momentum += mass * speeds
        kinetic += mass * squares
    for layer in range(a.layer_count + 1):  # nodes between layers, and the ends
        node = a.zones if layer == a.layer_count else a.layers[layer * LAYER + FIRST_ZONE]
        pull = (force[node - 1] if node > 0 else 0.0) - (force[node] if node < a.zones else 0.0)
        speed = centre_node(a, node, half)
        momentum += a.mass[node] * speed
        kinetic += a.mass[node] * speed * speed
        exchange += (velocity[node + 1] + speed) * pull
    return 0.5 * kinetic, momentum, exchange


def sum_settled(a: Arrays) -> None:
    """The energy of each layer's zones at the last settling: the same for many rows."""
    for layer in range(a.layer_count):
        first, energy = a.layers[layer * LAYER + FIRST_ZONE], 0.0
        for i in range(first, first + a.layers[layer * LAYER + ZONES]):
            energy = accumulate(energy, a.energy[i])
        a.numbers[layer * NUMBERS + SETTLED] = energy


def sum_zones(a: Arrays) -> tuple[float, float]:
    """Internal energy as stored, half a kick behind; share of the crushable length that is not crushed (NaN: none is)."""
    stored, length, crushable = 0.0, 0.0, 0.0
    for layer in range(a.layer_count):
        numbers = offset(a.numbers, layer * NUMBERS)
        first = a.layers[layer * LAYER + FIRST_ZONE]
        zones = a.layers[layer * LAYER + ZONES]
        crushed = crushed_strain(numbers)
        energy, count = 0.0, 0.0
        for i in range(first, first + zones):
            energy = accumulate(energy, a.gained[i])
            count = accumulate(count, 0.0 if a.state[i] > crushed else 1.0)
        stored += (numbers[SETTLED] + energy) * numbers[ZONE_MASS]
        if crushed < math.inf:
            length += count * numbers[SIZE]
            crushable += zones * numbers[SIZE]
    return stored, length / crushable if crushable > 0.0 else math.nan


def look(a: Arrays, probe: int, half: float, seen: Any) -> None:
    """Position, velocity, strain and stress at a probe."""
    zone, layer, share = a.probes[1 + 2 * probe], a.probes[2 + 2 * probe], a.probe_weights[probe]
    numbers = offset(a.numbers, layer * NUMBERS)
    stress, gained = offset(a.out, SCRATCH), offset(a.out, SCRATCH + 1)
    left, right = centre_node(a, zone, half), centre_node(a, zone + 1, half)
    gained[0] = centre_gain(a, zone, left, right, half, numbers[ZONE_MASS])
    observe(a, layer, zone, 1, gained, stress)
    moved = (1.0 - share) * a.displacement[zone] + share * a.displacement[zone + 1]
    seen[0] = (1.0 - share) * a.coordinate[zone] + share * a.coordinate[zone + 1] + moved
    seen[1] = (1.0 - share) * left + share * right
    seen[2] = (a.displacement[zone] - a.displacement[zone + 1]) * numbers[INVERSE_SIZE]
    seen[3] = stress[0]


def centre_gain(a: Arrays, zone: int, left: float, right: float, half: float, mass: float) -> float:
    """What a zone has gained half a kick on, where its nodes then move at `left` and `right`."""
    jump = a.velocity[zone + 1] - a.velocity[zone + 2] + left - right
    return a.gained[zone] + 0.5 * half * a.force[zone] * jump / mass


def observe(a: Arrays, layer: int, first: int, count: int, gained: Any, stress: Any) -> None:
    """Stress alone of ``count`` zones of a layer from ``first`` on, which have `gained` so much."""
    call(
        a.addresses, layer, offset(a.parameters, a.layers[layer * LAYER + PARAMETERS]), offset(a.numbers, layer * NUMBERS),
        offset(a.velocity, first), offset(a.velocity, first), offset(a.displacement, first), offset(a.energy, first),
        gained, stress, a.out, offset(a.state, first), a.out, a.out, a.out, a.out, -count, a.zones, a.out,
    )  # fmt: skip


def crushed_strain(numbers: Any) -> float:
    """The layer's densification strain, or half of its largest strain so far; what has not yielded is not crushed."""
    given = numbers[CRUSHED_STRAIN]
    return given if given == given else max(0.5 * numbers[TOP_STRAIN], numbers[YIELD_STRAIN])


def fronts(a: Arrays) -> tuple[float, float]:
    """Lagrangian positions of the compaction fronts that run from the left and from the right end; NaN where none runs.

    A layer that cannot be crushed (a plate before the foam) is passed over.
    """
    zones = a.zones
    left, right = int(a.ledger[LEFT_FRONT]), int(a.ledger[RIGHT_FRONT])
    while left > 0 and not is_passed(a, left - 1):
        left -= 1
    while left < zones and is_passed(a, left):
        left += 1
    while right < zones and not is_passed(a, right):
        right += 1
    while right > 0 and is_passed(a, right - 1):
        right -= 1
    a.ledger[LEFT_FRONT], a.ledger[RIGHT_FRONT] = left, right
    proximal, distal = math.nan, math.nan
    if left < right:
        if left > 0 and can_crush(a, left - 1):
            first, beyond = zones_of_layer(a, left)
            start, end = max(left - WINDOW, first), min(left + WINDOW, beyond, right)
            proximal = a.coordinate[start]
            if start < left:
                proximal += crushed_length(a, start, end, start, end - 1)
        if right < zones and can_crush(a, right):
            first, beyond = zones_of_layer(a, right - 1)
            start, end = max(right - WINDOW, first, left), min(right + WINDOW, beyond)
            distal = a.coordinate[end]
            if right < end:
                distal -= crushed_length(a, start, end, end - 1, start)
    return proximal, distal


def is_passed(a: Arrays, zone: int) -> bool:
    """Whether a front has no more to do in a zone: it is crushed, or never can be."""
    return a.state[zone] > crushed_strain_of(a, zone) or not can_crush(a, zone)


def can_crush(a: Arrays, zone: int) -> bool:
    """Whether the zone's layer has a strain at which it counts as crushed."""
    return crushed_strain_of(a, zone) < math.inf


def crushed_strain_of(a: Arrays, zone: int) -> float:
    """`crushed_strain` of the layer that a zone belongs to."""
    return crushed_strain(offset(a.numbers, layer_of(a, zone) * NUMBERS))


def layer_of(a: Arrays, zone: int) -> int:
    """Which layer a zone belongs to."""
    layer = a.layer_count - 1
    while a.layers[layer * LAYER + FIRST_ZONE] > zone:
        layer -= 1
    return layer


def zones_of_layer(a: Arrays, zone: int) -> tuple[int, int]:
    """First zone of the layer that a zone belongs to, and the one beyond its last: strains are compared within one layer."""
    layer = layer_of(a, zone)
    first = a.layers[layer * LAYER + FIRST_ZONE]
    return first, first + a.layers[layer * LAYER + ZONES]


def crushed_length(a: Arrays, start: int, end: int, behind: int, ahead: int) -> float:
    """Σ (ε − ε_A)/(ε_B − ε_A) ΔX over zones: unlike a half level, it does not see how far the front is smeared.

    ε is the largest strain so far, so that what happens to a zone behind the front does not move the front.
    """
    length = 0.0
    for i in range(start, end):
        above = a.state[i] - a.state[ahead]
        share = above / (a.state[behind] - a.state[ahead]) if a.state[behind] > a.state[ahead] else 0.0
        length += min(max(share, 0.0), 1.0) * (a.coordinate[i + 1] - a.coordinate[i])
    return length
