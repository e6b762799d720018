"""The kick of an end node by its boundary. One pass a boundary (and pulse)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hydro1d.boundaries.base import End
from hydro1d.jit.primitives import at, call, gather, scatter
from hydro1d.scheme.records import Grid


def end_pass(boundary_at: Callable, count: tuple) -> Callable:
    """The pass of the boundary that ``boundary_at`` gives; it has one state variable an entry of ``count``."""

    def run(g: Grid, side: int, place: int, _end: int, _task: int) -> None:
        """New velocity and force (inward) of an end node; the state variables at ``place`` are advanced."""
        boundary, e = boundary_at(g, side, 0), at(g.ends, side)
        end = End(
            time=e.time,
            step_before=e.step_before,
            step_after=e.step_after,
            velocity=e.velocity,
            displacement=e.displacement,
            mass=e.mass,
            stress=e.stress,
            impedance=e.impedance,
            initial_stress=e.initial_stress,
            side=e.side,
        )
        velocity, force, state = boundary.kick(end, gather(g.boundary_state, place, 1, count))
        scatter(g.boundary_state, place, 1, state)
        e.new_velocity, e.force = velocity, force

    return run


def sign_of(side: int) -> float:
    """1 on the left end, −1 on the right: a velocity that counts to the right, times this, is inward."""
    return 1.0 if side == 0 else -1.0


def node_of(g: Grid, side: int) -> int:
    """The node at an end."""
    return 0 if side == 0 else g.zones


def push_end(g: Grid, side: int, place: int, step: float) -> Any:
    """Ask the boundary of a side, whose state variables stand at ``place``; its `END` record holds the answer, inward."""
    node, sign = node_of(g, side), sign_of(side)
    end = at(g.ends, side)
    end.time, end.step_before, end.step_after = g.clock.time, g.clock.last_step, step
    end.velocity, end.displacement = sign * g.velocity[node + 1], sign * g.displacement[node]
    end.mass, end.stress = g.node_mass[node], g.force[0 if side == 0 else g.zones - 1]
    call(g.passes, g.layer_count + side, side, place, 0, 0)
    return end


def kick_ends(g: Grid, kick: float, step: float) -> None:
    """New velocities of the two end nodes by their boundaries, and the work and impulse that these give."""
    clock = g.clock
    for side in range(2):
        node, sign = node_of(g, side), sign_of(side)
        end = push_end(g, side, side * g.boundary_width, step)
        work = end.force * 0.5 * (sign * g.velocity[node + 1] + end.new_velocity) * kick
        g.velocity[node + 1] = sign * end.new_velocity
        clock.boundary_work, clock.boundary_work_remainder = add(
            clock.boundary_work, clock.boundary_work_remainder, work
        )
        clock.boundary_impulse, clock.boundary_impulse_remainder = add(
            clock.boundary_impulse, clock.boundary_impulse_remainder, sign * end.force * kick
        )
    clock.max_boundary_work = max(clock.max_boundary_work, clock.boundary_work)


def add(total: float, remainder: float, amount: float) -> tuple[float, float]:
    """A sum and what rounding took off it, which goes into the next addition (Kahan 1965, doi:10.1145/363707.363723).

    A steady load on a steady step adds the same number each time, and rounding then errs to the same side.
    """
    amount += remainder
    new = total + amount
    return new, amount - (new - total)
