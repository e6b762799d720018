"""A profile: what every node and zone shows at one time, all of it at the time of the stresses."""

from __future__ import annotations

from hydro1d.jit.primitives import at, call
from hydro1d.scheme.history import centre_ends, centred_increment, centred_velocity
from hydro1d.scheme.outputs import NODE, ZONE, Node, Zone, writer_of
from hydro1d.scheme.records import Grid
from hydro1d.scheme.zone_pass import scales

HEAD = 2  # time and cycle
NODE_FIELDS, ZONE_FIELDS = len(NODE), len(ZONE)
write_node = writer_of(NODE)
write_zone = writer_of(ZONE)


def length(zones: int, variables: int) -> int:
    """Numbers of one profile; ``variables`` is the largest strain and the most other state variables that a law has."""
    return HEAD + NODE_FIELDS * (zones + 1) + (ZONE_FIELDS + variables) * zones


def take_profile(g: Grid, number: int) -> None:
    """Profile ``number``: head, fields over nodes, fields over zones, state variables. The state is not touched."""
    zones, half = g.zones, 0.5 * g.clock.last_step
    start = number * length(zones, g.variables)
    g.profiles[start], g.profiles[start + 1] = g.clock.time, g.clock.cycle
    centre_ends(g, half)
    first_node, first_zone = start + HEAD, start + HEAD + NODE_FIELDS * (zones + 1)
    for i in range(zones + 1):
        write_node(g, Node(i, centred_velocity(g, i, half)), g.profiles, first_node + i, zones + 1)
    for layer in range(g.layer_count):
        show_layer(g, layer, first_zone)
    state = first_zone + ZONE_FIELDS * zones
    for k in range(g.variables * zones):
        g.profiles[state + k] = g.state[k]


def show_layer(g: Grid, number: int, start: int) -> None:
    """The zones of one layer; energies half a kick on, and stresses with these."""
    layer, half = at(g.layers, number), 0.5 * g.clock.last_step
    left = centred_velocity(g, layer.first, half)
    for i in range(layer.first, layer.end):
        right = centred_velocity(g, i + 1, half)
        g.seen_energy[i] = g.energy[i] + centred_increment(g, number, i, left - right)
        left = right
    call(g.passes, number, number, layer.first, layer.end, 1)
    for i in range(layer.first, layer.end):
        per_size, per_mass = scales(g, layer, i, layer.is_uniform)
        density = layer.density if layer.is_uniform else per_size / per_mass
        # Times the inverse size, as in the zone pass: a last digit off, it would exceed the largest strain so far.
        strain = (g.displacement[i] - g.displacement[i + 1]) * per_size
        write_zone(g, Zone(i, density, strain, g.seen_energy[i]), g.profiles, start + i, g.zones)
