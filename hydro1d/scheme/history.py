"""A row of the history: energies, momentum, fronts and what the probes see, all at the time of the stresses.

Velocities are known half a step before the stresses, so a row kicks them on by half a step, without touching the state.
"""

from __future__ import annotations

import math

from hydro1d.jit.primitives import accumulate, at, call
from hydro1d.scheme.ends import node_of, push_end, sign_of
from hydro1d.scheme.fronts import crushed_strain, fronts
from hydro1d.scheme.outputs import HISTORY, PROBE, Moment, Seen, writer_of
from hydro1d.scheme.records import Grid
from hydro1d.scheme.zone_pass import scales

write_history = writer_of(HISTORY)
write_probe = writer_of(PROBE)
COLUMNS, PROBE_COLUMNS = len(HISTORY), len(PROBE)


def record(g: Grid, number: int) -> None:
    """Row ``number`` of the history, and of the probes."""
    start = number * (COLUMNS + 2 * g.boundary_width)
    write_history(g, moment(g), g.rows, start, 1)
    for k in range(2 * g.boundary_width):
        g.rows[start + COLUMNS + k] = g.boundary_state[2 * g.boundary_width + k]
    for k in range(g.probe_count):
        write_probe(g, seen_by(g, k), g.probe_rows, (number * g.probe_count + k) * PROBE_COLUMNS, 1)


def moment(g: Grid) -> Moment:
    """Sums over the column at the time of the stresses."""
    clock, half = g.clock, 0.5 * g.clock.last_step
    work, impulse = centre_ends(g, half)
    kinetic, momentum, exchange = sum_nodes(g, half)
    stored, uncrushed = sum_zones(g)
    internal = stored - 0.5 * half * exchange
    put_in = clock.initial_energy + max(clock.max_boundary_work, work)
    error = (kinetic + internal - clock.initial_energy - work) / put_in if put_in > 0.0 else 0.0
    proximal, distal = fronts(g)
    return Moment(
        kinetic_energy=kinetic,
        internal_energy=internal,
        energy_error=error,
        momentum=momentum,
        boundary_work=work,
        boundary_impulse=impulse,
        front_position=proximal,
        distal_front_position=distal,
        uncrushed_fraction=uncrushed,
    )


def centre_ends(g: Grid, half: float) -> tuple[float, float]:
    """Boundary work (J/m²) and impulse (Pa s) half a kick on.

    The ends' records hold their velocities then; what the boundaries keep then stands behind what they keep now.
    """
    work, impulse, width = g.clock.boundary_work, g.clock.boundary_impulse, g.boundary_width
    for side in range(2):
        node, sign, place = node_of(g, side), sign_of(side), (2 + side) * width
        for k in range(width):
            g.boundary_state[place + k] = g.boundary_state[side * width + k]
        end = push_end(g, side, place, 0.0)
        end.centred_velocity = sign * end.new_velocity
        work += end.force * 0.5 * sign * (g.velocity[node + 1] + end.centred_velocity) * half
        impulse += sign * end.force * half
    return work, impulse


def centred_velocity(g: Grid, node: int, half: float) -> float:
    """Velocity (m/s) of a node half a kick on, after `centre_ends`."""
    if node == 0:
        return at(g.ends, 0).centred_velocity
    if node == g.zones:
        return at(g.ends, 1).centred_velocity
    return g.velocity[node + 1] + half * (g.force[node - 1] - g.force[node]) * g.inverse_mass[node]


def sum_nodes(g: Grid, half: float) -> tuple[float, float, float]:
    """Kinetic energy and momentum half a kick on, and the exchange between nodes and zones.

    The exchange, Σ v (f_left − f_right) with twice the mean velocity of the half kick, is minus what the forces give to the
    zones: Σ f Δv, summed by parts.
    """
    kinetic, momentum, exchange = 0.0, 0.0, 0.0
    for number in range(g.layer_count):
        layer = at(g.layers, number)
        if layer.is_uniform:
            squares, speeds, given = sum_shared(g, layer.first, layer.end, layer.zone_mass, half)
        else:
            squares, speeds, given = 0.0, 0.0, 0.0
            for node in range(layer.first + 1, layer.end):
                square, speed, own = sum_node(g, node, half)
                squares, speeds, given = squares + square, speeds + speed, given + own
        kinetic, momentum, exchange = kinetic + squares, momentum + speeds, exchange + given
    for number in range(g.layer_count + 1):  # nodes between layers, and the ends
        square, speed, given = sum_node(g, g.zones if number == g.layer_count else at(g.layers, number).first, half)
        kinetic, momentum, exchange = kinetic + square, momentum + speed, exchange + given
    return 0.5 * kinetic, momentum, exchange


def sum_shared(g: Grid, first: int, end: int, mass: float, half: float) -> tuple[float, float, float]:
    """m v², m v and exchange of the nodes within a layer, which share one mass."""
    velocity, force = g.velocity, g.force
    inverse_mass, speeds, squares, exchange = 1.0 / mass, 0.0, 0.0, 0.0
    for i in range(first + 1, end):
        pull = force[i - 1] - force[i]
        speed = velocity[i + 1] + half * pull * inverse_mass
        speeds = accumulate(speeds, speed)
        squares = accumulate(squares, speed * speed)
        exchange = accumulate(exchange, (velocity[i + 1] + speed) * pull)
    return mass * squares, mass * speeds, exchange


def sum_node(g: Grid, node: int, half: float) -> tuple[float, float, float]:
    """m v², m v and exchange of one node."""
    pull = (g.force[node - 1] if node > 0 else 0.0) - (g.force[node] if node < g.zones else 0.0)
    speed, mass = centred_velocity(g, node, half), g.node_mass[node]
    return mass * speed * speed, mass * speed, (g.velocity[node + 1] + speed) * pull


def fold_sums(g: Grid) -> None:
    """The energy of each layer's zones as last folded: the same for many rows."""
    for number in range(g.layer_count):
        layer, energy = at(g.layers, number), 0.0
        if layer.is_uniform:
            for i in range(layer.first, layer.end):
                energy = accumulate(energy, g.energy[i])
        else:
            for i in range(layer.first, layer.end):
                energy = accumulate(energy, g.energy[i] / g.inverse_zone_mass[i])
        at(g.layer_state, number).folded_energy = energy


def sum_zones(g: Grid) -> tuple[float, float]:
    """Internal energy (J/m²) as stored, half a kick behind; share of the crushable length that is not crushed.

    The share is NaN where nothing can be crushed.
    """
    stored, length, crushable = 0.0, 0.0, 0.0
    for number in range(g.layer_count):
        layer, own = at(g.layers, number), at(g.layer_state, number)
        crushed = crushed_strain(g, number)
        mass, size = (layer.zone_mass, layer.zone_size) if layer.is_uniform else (1.0, 1.0)
        energy, uncrushed, whole = 0.0, 0.0, 0.0
        for i in range(layer.first, layer.end):
            own_mass, own_size = (1.0, 1.0) if layer.is_uniform else (1.0 / g.inverse_zone_mass[i], g.size[i])
            energy = accumulate(energy, g.increment[i] * own_mass)
            uncrushed = accumulate(uncrushed, 0.0 if g.state[i] > crushed else own_size)
            whole = accumulate(whole, own_size)
        stored += (own.folded_energy + energy) * mass
        if crushed < math.inf:
            length += uncrushed * size
            crushable += whole * size
    return stored, length / crushable if crushable > 0.0 else math.nan


def seen_by(g: Grid, number: int) -> Seen:
    """What a probe sees half a kick on, after `centre_ends`."""
    half, probe = 0.5 * g.clock.last_step, at(g.probes, number)
    zone, share = probe.zone, probe.share
    layer = at(g.layers, probe.layer)
    left, right = centred_velocity(g, zone, half), centred_velocity(g, zone + 1, half)
    g.seen_energy[zone] = g.energy[zone] + centred_increment(g, probe.layer, zone, left - right)
    call(g.passes, probe.layer, probe.layer, zone, zone + 1, 1)
    moved = (1.0 - share) * g.displacement[zone] + share * g.displacement[zone + 1]
    per_size, _ = scales(g, layer, zone, layer.is_uniform)
    return Seen(
        position=(1.0 - share) * g.coordinate[zone] + share * g.coordinate[zone + 1] + moved,
        velocity=(1.0 - share) * left + share * right,
        strain=(g.displacement[zone] - g.displacement[zone + 1]) * per_size,
        stress=g.seen_stress[zone],
    )


def centred_increment(g: Grid, number: int, zone: int, jump: float) -> float:
    """Energy increment (J/kg) of a zone half a kick on, where its velocity jump (m/s) then is ``jump``."""
    layer, half = at(g.layers, number), 0.5 * g.clock.last_step
    mass = layer.zone_mass if layer.is_uniform else 1.0 / g.inverse_zone_mass[zone]
    jumps = g.velocity[zone + 1] - g.velocity[zone + 2] + jump
    return g.increment[zone] + 0.5 * half * g.force[zone] * jumps / mass
