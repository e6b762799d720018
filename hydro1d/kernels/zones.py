"""The zone phase of a step for one law: strain, energy, stress, viscosity, and what limits the next step.

One kernel a law. A column of several layers calls the kernel of each layer's law on its zones.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from hydro1d.kernels.primitives import accumulate, gather, larger, scatter

# p: pointer to double, i: integer
SIGNATURE = "ppppppppppppppiip"

# Places in `numbers`, the scalars of a call: specific energy per force and velocity jump, over half a kick and from there to
# the time of the strain (compatible work: the force that moved the nodes, on the mean of the velocities between which it
# moved them), then what stays ...
TO_KICK, TO_STRAIN, INVERSE_SIZE, INVERSE_DENSITY, DENSITY, LINEAR, SMOOTH_LINEAR, QUADRATIC = range(8)
NUMBERS = 8
AFRESH = NUMBERS  # not 0 where nothing that `foam_kernel` remembers holds
# ... and in `out`, what comes back: largest stiffness/ρ0, largest viscous speed, stress and strain, and Σ q (Δv before and
# after the kick), twice the power of the viscosity that acted in it: its exact share of the energy.
STIFFNESS, VISCOUS_SPEED, STRESS, STRAIN, VISCOUS_POWER = range(5)
RESULTS = 5

FASTEST_CLOSING = 2.0  # a step closes at most a quarter of a zone's room, also where there is no viscosity
CHUNK = 64  # zones that ask for their loading curve together: few, since one that crushes further makes all ask
SHORT = 256  # zones; in a column no longer than this the front is a large share, and half as many ask together

_DOC = """Advance ``zones`` zones over a step.

velocity, velocity_before (node i at i + 1; at n + ½ and n − ½) and displacement (new) are over nodes; energy (specific, at
the last settling), gained (since then), force (σ + q) and viscosity (q) over zones; state holds the largest strain and then
the law's history, each `stride` long. curve, tangents, stiffnesses and speeds are what `foam_kernel` remembers: stress and
tangent of the loading curve, stiffness, speed of the linear viscosity. The number of zones is negative to observe: `force`
becomes the stress alone, nothing else changes. A NaN anywhere comes back as the stiffness.
"""


def zone_kernel(unpack: Callable, history_count: tuple[float, ...]) -> Callable:
    """The kernel of the law that ``unpack`` builds from its parameters; the law has one history variable an entry."""

    def sweep(
        parameters: Any, numbers: Any, velocity: Any, velocity_before: Any, displacement: Any, energy: Any, gained: Any,
        force: Any, viscosity: Any, state: Any, curve: Any, tangents: Any, stiffnesses: Any, speeds: Any, zones: int,
        stride: int, out: Any,
    ) -> None:  # fmt: skip
        law = unpack(parameters)
        if zones < 0:
            observe(law, history_count, numbers, velocity, displacement, energy, gained, force, state, -zones, stride)
            return
        per_size, per_density, density = numbers[INVERSE_SIZE], numbers[INVERSE_DENSITY], numbers[DENSITY]
        linear, smooth_linear, quadratic = numbers[LINEAR], numbers[SMOOTH_LINEAR], numbers[QUADRATIC]
        to_kick, to_strain = numbers[TO_KICK], numbers[TO_STRAIN]
        top_stiffness, top_speed, top_stress, top_strain, power = 0.0, 0.0, 0.0, 0.0, 0.0
        for i in range(zones):
            jump = velocity[i + 1] - velocity[i + 2]
            strain = (displacement[i] - displacement[i + 1]) * per_size
            largest = max(state[i], strain)
            jump_before = velocity_before[i + 1] - velocity_before[i + 2]
            gained[i] += force[i] * to_kick * (jump_before + jump)
            power = accumulate(power, viscosity[i] * (jump_before + jump))
            now = energy[i] + (gained[i] + force[i] * to_strain * jump)
            history = gather(state, stride + i, stride, history_count)
            stress, tangent, stiffness, smooth, history = law.point(strain, largest, jump * per_size, now, history)
            closing = max(jump, 0.0) - (shared_jump(velocity, i, jump) if smooth else 0.0)
            approach = closing / law.room(strain, closing)
            crowding = quadratic * approach
            speed = (smooth_linear if smooth else linear) * math.sqrt(tangent * per_density) + crowding
            viscosity[i] = 0.0 if law.is_open(stress) else density * closing * speed
            state[i] = largest
            scatter(state, stride + i, stride, history)
            force[i] = stress + viscosity[i]
            power = accumulate(power, 0.0 * force[i])
            top_stiffness = larger(top_stiffness, stiffness)
            top_speed = larger(top_speed, speed + max(quadratic, FASTEST_CLOSING) * approach)
            top_stress = larger(top_stress, stress)
            top_strain = larger(top_strain, strain)
        answer(out, top_stiffness * per_density, top_speed, top_stress, top_strain, power)

    sweep.__doc__ = _DOC
    return sweep


def foam_kernel(unpack: Callable, _history_count: tuple[float, ...]) -> Callable:
    """The kernel of a `Foam` that unloads on its steep line.

    Its loading curve is asked for only where the largest strain grows, and remembered: the curve may cost what it likes, and
    most zones pay nothing for it.
    """

    def sweep(
        parameters: Any, numbers: Any, velocity: Any, velocity_before: Any, displacement: Any, energy: Any, gained: Any,
        force: Any, viscosity: Any, state: Any, curve: Any, tangents: Any, stiffnesses: Any, speeds: Any, zones: int,
        stride: int, out: Any,
    ) -> None:  # fmt: skip
        law = unpack(parameters)
        per_size, per_density = numbers[INVERSE_SIZE], numbers[INVERSE_DENSITY]
        if zones < 0:
            # `observe` for such a foam: a loop that vectorises, and two functions less to compile.
            for i in range(-zones):
                strain = (displacement[i] - displacement[i + 1]) * per_size
                largest = max(state[i], strain)
                stress, tangent = law.loading(largest)
                force[i] = law.stress_below(largest - strain, stress, law.slope_below(largest, tangent))
            return
        zone = Zones(numbers, velocity, velocity_before, displacement, gained, force, viscosity, state, curve, tangents,
                     stiffnesses, speeds)  # fmt: skip
        top_stiffness, top_speed, top_stress, top_strain, power = 0.0, 0.0, 0.0, 0.0, 0.0
        chunk = CHUNK if zones > SHORT else CHUNK // 2
        for start in range(0, zones, chunk):
            end = start + chunk if start + chunk < zones else zones  # min() of integers is a function more to compile
            grown = turned = numbers[AFRESH] != 0.0
            smooth = False
            for i in range(start, end):
                grown |= (displacement[i] - displacement[i + 1]) * per_size > state[i]
                smooth |= law.never_yielded(state[i])
            if grown:
                for i in range(start, end):  # a loop of its own: it vectorises where the law's functions do
                    state[i] = max(state[i], (displacement[i] - displacement[i + 1]) * per_size)
                    stress, tangent = law.loading(state[i])
                    turned |= tangent != tangents[i]
                    curve[i], tangents[i] = stress, tangent
                    # No zone's stress is ever above its loading curve, nor its strain above its largest.
                    top_stress = larger(top_stress, curve[i])
                    top_strain = larger(top_strain, state[i])
            stiffness, speed, work = push(law, zone, start, end, smooth, turned)
            top_stiffness, top_speed, power = larger(top_stiffness, stiffness), larger(top_speed, speed), power + work
        answer(out, top_stiffness * per_density, top_speed, top_stress, top_strain, power)

    sweep.__doc__ = _DOC
    return sweep


class Zones(NamedTuple):
    """What `push` works on; see the kernels' own documentation."""

    numbers: Any
    velocity: Any
    velocity_before: Any
    displacement: Any
    gained: Any
    force: Any
    viscosity: Any
    state: Any
    curve: Any
    tangents: Any
    stiffnesses: Any
    speeds: Any


def push(law: Any, zone: Zones, start: int, end: int, smooth: bool, turned: bool) -> tuple[float, float, float]:
    """Energy and force of zones whose loading curve is known: a loop without limiter or square root where none needs them.

    Four calls with constants make four loops; with the flags as variables LLVM makes one, a third slower.
    """
    if smooth and turned:
        return push_zones(law, zone, start, end, True, True)
    if smooth:
        return push_zones(law, zone, start, end, True, False)
    if turned:
        return push_zones(law, zone, start, end, False, True)
    return push_zones(law, zone, start, end, False, False)


def push_zones(law: Any, zone: Zones, start: int, end: int, limited: bool, turned: bool) -> tuple[float, float, float]:
    """The loop of `push`. Where the tangent of the loading curve has changed, so do stiffness and speed.

    Returns the largest stiffness, the largest viscous speed and the work of the viscosity.
    """
    numbers, velocity, before, moved, gained, force, viscosity, state, curve, tangents, stiffnesses, speeds = zone
    per_size, density, quadratic = numbers[INVERSE_SIZE], numbers[DENSITY], numbers[QUADRATIC]
    linear, smooth_linear, per_density = numbers[LINEAR], numbers[SMOOTH_LINEAR], numbers[INVERSE_DENSITY]
    to_kick = numbers[TO_KICK]
    top_stiffness, top_speed, power = 0.0, 0.0, 0.0
    for i in range(start, end):
        if turned:
            speeds[i] = (smooth_linear if law.never_yielded(state[i]) else linear) * math.sqrt(
                tangents[i] * per_density
            )
            stiffnesses[i] = law.slope_below(state[i], tangents[i])
        jump = velocity[i + 1] - velocity[i + 2]
        jump_before = before[i + 1] - before[i + 2]
        gained[i] += force[i] * to_kick * (jump_before + jump)
        power = accumulate(power, viscosity[i] * (jump_before + jump))
        strain = (moved[i] - moved[i + 1]) * per_size
        stress = law.stress_below(state[i] - strain, curve[i], stiffnesses[i])
        closing = max(jump, 0.0)
        if limited:
            closing -= shared_jump(velocity, i, jump) if law.never_yielded(state[i]) else 0.0
        approach = closing / law.room(strain, closing)
        crowding = quadratic * approach
        speed = speeds[i] + crowding
        viscosity[i] = 0.0 if law.is_open(stress) else density * closing * speed
        force[i] = stress + viscosity[i]
        power = accumulate(power, 0.0 * force[i])
        top_stiffness = larger(top_stiffness, stiffnesses[i])
        top_speed = larger(top_speed, speed + max(quadratic, FASTEST_CLOSING) * approach)
    return top_stiffness, top_speed, power


def shared_jump(velocity: Any, i: int, jump: float) -> float:
    """The part of a closing zone's velocity jump that its neighbours share: where the flow is smooth, that is no shock.

    The mean of both slopes by van Albada, van Leer & Roberts (1982): it bends where others have corners, at which a shock
    leaves noise behind from zone to zone.
    """
    left, right = velocity[i] - velocity[i + 1], velocity[i + 2] - velocity[i + 3]
    both, span = max(left, 0.0) * max(right, 0.0), left + right
    return min(both * span / (span * span - 2.0 * both + 1e-300), max(jump, 0.0))


def answer(out: Any, stiffness: float, speed: float, stress: float, strain: float, power: float) -> None:
    """Hand the maxima back. They do not see a NaN; the sum does."""
    out[STIFFNESS] = stiffness if power == power else math.nan
    out[VISCOUS_SPEED] = speed
    out[STRESS] = stress
    out[STRAIN] = strain
    out[VISCOUS_POWER] = power


def observe(
    law: Any, history_count: Any, numbers: Any, velocity: Any, displacement: Any, energy: Any, gained: Any, stresses: Any,
    state: Any, zones: int, stride: int,
) -> None:  # fmt: skip
    """The stress alone of each zone as it stands."""
    per_size = numbers[INVERSE_SIZE]
    for i in range(zones):
        strain = (displacement[i] - displacement[i + 1]) * per_size
        rate = (velocity[i + 1] - velocity[i + 2]) * per_size
        history = gather(state, stride + i, stride, history_count)
        stress, _, _, _, _ = law.point(strain, max(state[i], strain), rate, energy[i] + gained[i], history)
        stresses[i] = stress
