"""The node pass of a step: velocities by the forces of the zones on both sides, displacements by the velocities."""

from __future__ import annotations

from hydro1d.jit.primitives import at
from hydro1d.scheme.records import Grid


def kick_nodes(g: Grid, number: int, node: int, beyond: int, block: int) -> None:
    """Kick and move the nodes [node, beyond), of which the first lies within or left of layer ``number``.

    What the velocities were goes to `velocity_before`, where node ``block`` stands at 1.
    """
    kick, step = g.call.kick, g.call.step
    while node < beyond:
        while node >= at(g.layers, number).end:
            number += 1
        layer = at(g.layers, number)
        # Between layers, and in layers whose zones differ, each node has a mass of its own.
        shares_mass = node > layer.first and layer.is_uniform
        last = min(layer.end, beyond) if node > layer.first else node + 1
        inverse_mass = 1.0 / layer.zone_mass
        for i in range(node, last):
            g.velocity_before[i - block + 1] = g.velocity[i + 1]
            per_mass = inverse_mass if shares_mass else g.inverse_mass[i]
            g.velocity[i + 1] += kick * (g.force[i - 1] - g.force[i]) * per_mass
            g.displacement[i] += step * g.velocity[i + 1]
        node = last
