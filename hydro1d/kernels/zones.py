"""The zone phase of a step for one law: strain, energy, stress, viscosity, and what limits the next step.

One kernel a law. A column of several layers calls the kernel of each layer's law on its zones.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from hydro1d.kernels.primitives import accumulate, gather, order, scatter, unorder

# p: pointer to double, i: integer
SIGNATURE = "ppppppppiip"

# Places in `numbers`, the scalars of a call ...
STEP, KICK, INVERSE_SIZE, INVERSE_DENSITY, DENSITY, LINEAR, SMOOTH_LINEAR, QUADRATIC = range(8)
NUMBERS = 8
# ... and in `out`, what comes back: largest stiffness/ρ0, largest viscous speed, stress and strain, work of the viscosity.
STIFFNESS, VISCOUS_SPEED, STRESS, STRAIN, VISCOUS_POWER = range(5)
RESULTS = 5

ADVANCE, OBSERVE = 0, 1


def zone_kernel(unpack: Callable, history_count: tuple[float, ...]) -> Callable:
    """The kernel of the law that ``unpack`` builds from its parameters; the law has one history variable an entry."""

    def sweep(
        parameters: Any,
        numbers: Any,
        velocity: Any,
        velocity_before: Any,
        displacement: Any,
        energy: Any,
        force: Any,
        state: Any,
        zones: int,
        stride: int,
        out: Any,
    ) -> None:
        """Advance ``zones`` zones over a step.

        velocity, velocity_before (node i at i + 1; at n + ½ and n − ½) and displacement (new) are over nodes; energy
        (specific) and force (σ + q) over zones; state holds the largest strain and then the law's history, each `stride`
        long. The number of zones is negative to observe: `force` becomes the stress alone, nothing else changes.
        """
        law = unpack(parameters)
        step, half_kick = numbers[STEP], 0.5 * numbers[KICK]
        per_size, per_density, density = numbers[INVERSE_SIZE], numbers[INVERSE_DENSITY], numbers[DENSITY]
        linear, smooth_linear, quadratic = numbers[LINEAR], numbers[SMOOTH_LINEAR], numbers[QUADRATIC]
        work = per_size * per_density  # per unit force, velocity jump and time: what a zone gains per mass

        if zones < 0:
            for i in range(-zones):
                strain = (displacement[i] - displacement[i + 1]) * per_size
                rate = (velocity[i + 1] - velocity[i + 2]) * per_size
                history = gather(state, stride + i, stride, history_count)
                largest = max(state[i], strain)
                stress, _, _, _, _ = law.point(strain, largest, rate, energy[i], history)
                force[i] = stress
            return

        top_stiffness, top_speed, top_stress, top_strain = order(0.0), order(0.0), order(0.0), order(0.0)
        power = 0.0
        for i in range(zones):
            jump = velocity[i + 1] - velocity[i + 2]
            jump_before = velocity_before[i + 1] - velocity_before[i + 2]
            strain = (displacement[i] - displacement[i + 1]) * per_size
            largest = max(state[i], strain)

            # Compatible work: the force that moved the nodes, on the velocity with which it moved them.
            gained = energy[i] + work * force[i] * half_kick * (jump_before + jump)
            energy[i] = gained
            now = gained + 0.5 * step * work * force[i] * jump  # at the time of the strain, to second order
            history = gather(state, stride + i, stride, history_count)
            stress, tangent, stiffness, smooth, history = law.point(strain, largest, jump * per_size, now, history)

            # Where the flow is smooth, the part of the jump that the neighbours share is no shock.
            left, right = velocity[i] - velocity[i + 1], velocity[i + 2] - velocity[i + 3]
            shared = max(min(min(0.5 * (left + right), 2.0 * min(left, right)), jump), 0.0)
            closing = max(jump, 0.0) - (shared if smooth else 0.0)
            crowding = quadratic * closing / law.room(strain, closing)
            speed = (smooth_linear if smooth else linear) * math.sqrt(tangent * per_density) + crowding
            viscosity = density * closing * speed

            state[i] = largest
            scatter(state, stride + i, stride, history)
            force[i] = stress + viscosity
            power = accumulate(power, viscosity * jump)
            top_stiffness = max(top_stiffness, order(stiffness))
            top_speed = max(top_speed, order(speed + crowding))
            top_stress = max(top_stress, order(stress))
            top_strain = max(top_strain, order(strain))
        out[STIFFNESS] = unorder(top_stiffness) * per_density
        out[VISCOUS_SPEED] = unorder(top_speed)
        out[STRESS] = unorder(top_stress)
        out[STRAIN] = unorder(top_strain)
        out[VISCOUS_POWER] = power

    return sweep
