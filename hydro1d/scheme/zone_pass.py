"""The zone pass of a step for one law: strain, energy, stress, viscosity, and what limits the next step.

One pass a law. A column of several layers calls the pass of each layer's law on its zones.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from hydro1d.jit.primitives import accumulate, at, gather, larger, scatter
from hydro1d.laws.base import Point
from hydro1d.scheme.records import Grid
from hydro1d.scheme.viscosity import smooth_jump, viscous_speeds


class Kind(NamedTuple):
    """What is known of a layer before its pass is made: whether all zones have one law, and one size and mass."""

    one_law: bool
    one_size: bool


def zone_pass(law_at: Callable, kind: Kind, first_row: int, count: tuple) -> Callable:
    """The pass of the law that ``law_at`` gives for a zone of a layer.

    Its state variables stand from row ``first_row`` of `Grid.state` on, one an entry of ``count``. Row 0 is the largest
    strain, which the scheme keeps where the law does not.
    """

    one_law, one_size = kind
    has_advanced = len(count) + first_row > 1  # state variables of its own, which are those after the step already

    def run(g: Grid, number: int, start: int, end: int, only_observe: int) -> None:
        """Advance the zones [start, end) of a layer over a step, or find `seen_stress` of these as they stand."""
        if only_observe > 0:
            observe(g, number, start, end)
            return
        layer, zones, step, kick = at(g.layers, number), g.zones, g.call.step, g.call.kick
        law, own = law_at(g, number, start), scales(g, layer, start, True)
        top_stiffness, top_speed, top_stress, top_strain, power = 0.0, 0.0, 0.0, 0.0, 0.0
        for i in range(start, end):
            law = law if one_law else law_at(g, number, i)
            per_size, per_mass = own if one_size else scales(g, layer, i, False)
            jump = g.velocity[i + 1] - g.velocity[i + 2]
            jump_before = g.velocity_before[i - start + 1] - g.velocity_before[i - start + 2]
            strain = (g.displacement[i] - g.displacement[i + 1]) * per_size
            # Compatible work: the force that moved the nodes, on the mean of the velocities between which it moved them.
            g.increment[i] += g.force[i] * (0.5 * kick * per_mass) * (jump_before + jump)
            power = accumulate(power, g.viscosity[i] * (jump_before + jump))
            energy = g.energy[i] + (g.increment[i] + g.force[i] * (0.5 * step * per_mass) * jump)
            old = gather(g.state, first_row * zones + i, zones, count)
            response = law.respond(Point(strain, jump * per_size * step, step, energy, 0.0), old)
            per_density, limited = 1.0 / law.density, response.limit_viscosity
            compression = max(jump, 0.0) - (smooth_jump(g.velocity, i, jump) if limited else 0.0)
            linear = layer.limited_linear if limited else layer.linear
            wave = linear * math.sqrt(response.tangent * per_density)
            speed, bound = viscous_speeds(law, layer.quadratic, strain, compression, wave)
            g.viscosity[i] = 0.0 if law.is_open(response.stress) else law.density * compression * speed
            if first_row > 0:
                g.state[i] = max(g.state[i], strain)
            scatter(g.state, first_row * zones + i, zones, response.state)
            g.force[i] = response.stress + g.viscosity[i]
            power = accumulate(power, 0.0 * g.force[i])
            top_stiffness = larger(top_stiffness, response.stiffness * per_density)
            top_speed = larger(top_speed, bound)
            top_stress = larger(top_stress, response.stress)
            top_strain = larger(top_strain, strain)
        answer(g.answer, top_stiffness, top_speed, top_stress, top_strain, power)

    def observe(g: Grid, number: int, start: int, end: int) -> None:
        if has_advanced:  # asked again it would advance them again
            for i in range(start, end):
                g.seen_stress[i] = g.force[i] - g.viscosity[i]
            return
        layer, zones, step = at(g.layers, number), g.zones, g.clock.last_step
        law, own = law_at(g, number, start), scales(g, layer, start, True)
        for i in range(start, end):
            law = law if one_law else law_at(g, number, i)
            per_size, _ = own if one_size else scales(g, layer, i, False)
            strain = (g.displacement[i] - g.displacement[i + 1]) * per_size
            increment = (g.velocity[i + 1] - g.velocity[i + 2]) * per_size * step
            old = gather(g.state, first_row * zones + i, zones, count)
            response = law.respond(Point(strain, increment, step, g.seen_energy[i], 0.0), old)
            g.seen_stress[i] = response.stress

    return run


def scales(g: Grid, layer: Any, i: int, is_uniform: bool) -> tuple[float, float]:
    """Inverse size (1/m) and inverse mass (m²/kg) of a zone."""
    if is_uniform:
        return layer.inverse_size, layer.inverse_zone_mass
    return g.inverse_size[i], g.inverse_zone_mass[i]


def answer(found: Any, stiffness: float, speed: float, stress: float, strain: float, power: float) -> None:
    """Hand back the maxima over the zones. They do not see a NaN; the sum of the power does."""
    found.stiffness = stiffness if power == power else math.nan
    found.viscous_speed, found.stress, found.strain, found.viscous_power = speed, stress, strain, power
