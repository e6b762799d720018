"""A profile: what every node and zone shows at one time, all of it at the time of the stresses."""

from __future__ import annotations

from typing import Any

from hydro1d.kernels.history import centre_ends, centre_gain, centre_node, observe
from hydro1d.kernels.layout import (
    CYCLE,
    FIRST_ZONE,
    LAST_STEP,
    LAYER,
    NUMBERS,
    REMEMBERED,
    SIZE,
    TIME,
    ZONE_MASS,
    ZONES,
    Arrays,
)
from hydro1d.kernels.primitives import offset
from hydro1d.kernels.zones import DENSITY

HEAD = 2  # time and cycle
NODE_FIELDS, ZONE_FIELDS = 3, 5  # of every column, in the order of `variables.NODE` and `variables.ZONE`


def length(zones: int, variables: int) -> int:
    """Numbers of one profile; ``variables`` is the largest strain and the most history variables that a law has."""
    return HEAD + NODE_FIELDS * (zones + 1) + (ZONE_FIELDS + variables) * zones


def take_profile(a: Arrays, place: int) -> None:
    """One profile. The state is not touched."""
    zones, half = a.zones, 0.5 * a.ledger[LAST_STEP]
    profile = offset(a.profiles, place * length(zones, a.variables))
    profile[0], profile[1] = a.ledger[TIME], a.ledger[CYCLE]
    centre_ends(a, half, offset(a.out, REMEMBERED))
    position, speed = offset(profile, HEAD), offset(profile, HEAD + zones + 1)
    moved, strain = offset(profile, HEAD + 2 * (zones + 1)), offset(profile, HEAD + NODE_FIELDS * (zones + 1))
    for i in range(zones + 1):
        position[i] = a.coordinate[i] + a.displacement[i]
        speed[i] = centre_node(a, i, half)
        moved[i] = a.displacement[i]
    for layer in range(a.layer_count):
        show_layer(a, layer, speed, half, strain)
    state = offset(strain, ZONE_FIELDS * zones)
    for k in range(a.variables * zones):
        state[k] = a.state[k]


def show_layer(a: Arrays, layer: int, speed: Any, half: float, strain: Any) -> None:
    """The zones of one layer, from their strain on; energies half a kick on, and stresses with these."""
    first, count = a.layers[layer * LAYER + FIRST_ZONE], a.layers[layer * LAYER + ZONES]
    numbers = offset(a.numbers, layer * NUMBERS)
    stress, viscosity = offset(strain, a.zones), offset(strain, 2 * a.zones)
    density, energy = offset(strain, 3 * a.zones), offset(strain, 4 * a.zones)
    for i in range(first, first + count):
        energy[i] = centre_gain(a, i, speed[i], speed[i + 1], half, numbers[ZONE_MASS])
    observe(a, layer, first, count, offset(energy, first), offset(stress, first))
    for i in range(first, first + count):
        strain[i] = (a.displacement[i] - a.displacement[i + 1]) / numbers[SIZE]
        viscosity[i] = a.force[i] - stress[i]
        density[i] = numbers[DENSITY] / (1.0 - strain[i])
        energy[i] += a.energy[i]
