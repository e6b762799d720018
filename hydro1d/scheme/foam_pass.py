"""The zone pass of a foam that unloads on its steep line, faster than the general one.

Its loading curve is asked for only where the largest strain grows, and remembered: the curve may cost what it likes, and most
zones pay nothing for it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from hydro1d.jit.primitives import accumulate, at, larger
from hydro1d.scheme.records import Grid
from hydro1d.scheme.viscosity import smooth_jump, viscous_speeds
from hydro1d.scheme.zone_pass import Kind, answer, scales

CHUNK = 64  # zones that ask for their loading curve together: few, since one that crushes further makes all ask
SHORT = 256  # zones; in a column no longer than this the front is a large share, and half as many ask together


class Part(NamedTuple):
    """Zones [first, beyond) of a layer, within a block that begins at zone `block`, and what is the same for all of them.

    own: inverse size (1/m) and inverse mass (m²/kg) of each; kick, s, and half of it over the mass; density, kg/m³, and its
    inverse; c₁ where the foam crushes, c₁ where the jump is limited, and c₂. All of it is found once for all chunks.
    """

    layer: int
    block: int
    first: int
    beyond: int
    own: tuple[float, float]
    kick: float
    to_kick: float
    density: float
    per_density: float
    linear: float
    limited_linear: float
    quadratic: float


def foam_pass(law_at: Callable, kind: Kind, _first_row: int, _count: tuple) -> Callable:
    """The pass of the foam that ``law_at`` gives for a zone, as `zone_pass.zone_pass` is for any law."""
    one_law, one_size = kind

    def law_of(g: Grid, law: Any, number: int, i: int) -> Any:
        return law if one_law else law_at(g, number, i)

    def scales_of(g: Grid, own: tuple[float, float], number: int, i: int) -> tuple[float, float]:
        return own if one_size else scales(g, at(g.layers, number), i, False)

    def strain_of(g: Grid, own: tuple[float, float], number: int, i: int) -> float:
        return (g.displacement[i] - g.displacement[i + 1]) * scales_of(g, own, number, i)[0]

    def run(g: Grid, number: int, start: int, end: int, only_observe: int) -> None:
        """Advance the zones [start, end) of a layer over a step, or find `seen_stress` of these as they stand."""
        layer = at(g.layers, number)
        law, own = law_at(g, number, start), scales(g, layer, start, True)
        if only_observe > 0:
            observe(g, law, Part(number, start, start, end, own, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
            return
        kick, linear, limited_linear, quadratic = g.call.kick, layer.linear, layer.limited_linear, layer.quadratic
        is_fresh, to_kick, density = g.call.is_fresh, 0.5 * kick * own[1], law.density
        per_density = 1.0 / density
        top_stiffness, top_speed, top_stress, top_strain, power = 0.0, 0.0, 0.0, 0.0, 0.0
        chunk = CHUNK if end - start > SHORT else CHUNK // 2
        for first in range(start, end, chunk):
            beyond = first + chunk if first + chunk < end else end
            grown = turned = is_fresh
            limited = False
            for i in range(first, beyond):
                grown |= strain_of(g, own, number, i) > g.state[i]
                limited |= law_of(g, law, number, i).never_yielded(g.state[i])
            if grown:
                for i in range(first, beyond):  # a loop of its own: it vectorises where the law's functions do
                    g.state[i] = max(g.state[i], strain_of(g, own, number, i))
                    stress, tangent = law_of(g, law, number, i).loading(g.state[i])
                    turned |= tangent != g.tangents[i]
                    g.curve[i], g.tangents[i] = stress, tangent
                    # No zone's stress is ever above its loading curve, nor its strain above its largest.
                    top_stress = larger(top_stress, g.curve[i])
                    top_strain = larger(top_strain, g.state[i])
            part = Part(
                number,
                start,
                first,
                beyond,
                own,
                kick,
                to_kick,
                density,
                per_density,
                linear,
                limited_linear,
                quadratic,
            )
            if limited or turned:
                stiffness, speed, work = push_unlike(g, law, part, limited, turned)
            else:
                stiffness, speed, work = push(g, law, part, limited, turned)
            top_stiffness, top_speed, power = larger(top_stiffness, stiffness), larger(top_speed, speed), power + work
        answer(g.answer, top_stiffness, top_speed, top_stress, top_strain, power)

    def observe(g: Grid, law: Any, part: Part) -> None:
        for i in range(part.first, part.beyond):
            here, strain = law_of(g, law, part.layer, i), strain_of(g, part.own, part.layer, i)
            largest = max(g.state[i], strain)
            stress, tangent = here.loading(largest)
            g.seen_stress[i] = here.stress_below(largest - strain, stress, here.slope_below(largest, tangent))

    # Four calls make four loops, in each of which the flags are known; one call makes one loop, a third slower.
    def push_unlike(g: Grid, law: Any, part: Part, limited: bool, turned: bool) -> tuple[float, float, float]:
        if not turned:
            return push(g, law, part, limited, turned)
        if limited:
            return push(g, law, part, limited, turned)
        return push(g, law, part, limited, turned)

    def push(g: Grid, law: Any, part: Part, limited: bool, turned: bool) -> tuple[float, float, float]:
        """Energy and force of zones whose loading curve is known, without limiter or square root where none needs them.

        Returns the largest stiffness/ρ0, the largest viscous speed and the work of the viscosity.
        """
        block, number, kick = part.block, part.layer, part.kick
        top_stiffness, top_speed, power = 0.0, 0.0, 0.0
        for i in range(part.first, part.beyond):
            here = law_of(g, law, number, i)
            per_density = part.per_density if one_law else 1.0 / here.density
            density = part.density if one_law else here.density
            per_size, per_mass = scales_of(g, part.own, number, i)
            if turned:
                linear = part.limited_linear if here.never_yielded(g.state[i]) else part.linear
                g.speeds[i] = linear * math.sqrt(g.tangents[i] * per_density)
                g.stiffnesses[i] = here.slope_below(g.state[i], g.tangents[i])
            jump = g.velocity[i + 1] - g.velocity[i + 2]
            jump_before = g.velocity_before[i - block + 1] - g.velocity_before[i - block + 2]
            g.increment[i] += g.force[i] * (part.to_kick if one_size else 0.5 * kick * per_mass) * (jump_before + jump)
            power = accumulate(power, g.viscosity[i] * (jump_before + jump))
            strain = (g.displacement[i] - g.displacement[i + 1]) * per_size
            stress = here.stress_below(g.state[i] - strain, g.curve[i], g.stiffnesses[i])
            compression = max(jump, 0.0)
            if limited:
                compression -= smooth_jump(g.velocity, i, jump) if here.never_yielded(g.state[i]) else 0.0
            speed, bound = viscous_speeds(here, part.quadratic, strain, compression, g.speeds[i])
            g.viscosity[i] = 0.0 if here.is_open(stress) else density * compression * speed
            g.force[i] = stress + g.viscosity[i]
            power = accumulate(power, 0.0 * g.force[i])
            top_stiffness = larger(top_stiffness, g.stiffnesses[i] * per_density)
            top_speed = larger(top_speed, bound)
        return top_stiffness, top_speed, power

    return run
