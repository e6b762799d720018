"""The same scheme in plain numpy, for one layer of `epph`: what a first script would do."""

import math

import numpy as np

from hydro1d.laws.epph import EPPH
from hydro1d.scheme.step import GROWTH
from hydro1d.solver.program import Program
from hydro1d.solver.state import State


class Baseline:
    """Advances a `State` of one `epph` layer under a rectangular pressure, with a wall on the right."""

    def __init__(self, program: Program) -> None:
        """Take over the program's column."""
        self.column = program.column
        self.block = self.column.layers[0]
        self.law: EPPH = self.block.law  # type: ignore[assignment]
        self.pulse = self.column.left.pulse  # type: ignore[attr-defined]

    def advance(self, state: State, steps: int) -> None:
        """So many steps, in place."""
        for _ in range(steps):
            self._step(state)

    def _step(self, s: State) -> None:
        clock, mass = s.clock[0], self.column.node_mass
        step = min(clock.next_step, GROWTH * clock.free_step)
        clock.free_step = step
        last = clock.last_step
        kick = 0.5 * (last + step)
        before = s.velocity[1:-1]
        push = np.zeros(len(mass))
        early, late = clock.time - 0.25 * last, clock.time + 0.25 * step
        push[0] = (self.pulse.pressure(early) * last + self.pulse.pressure(late) * step) / (last + step)
        push[:-1] -= s.force
        push[1:] += s.force
        velocity = before + kick * push / mass
        velocity[-1] = 0.0
        s.displacement[...] += step * velocity
        self._zones(s, before, velocity, step, kick)
        s.velocity[1:-1] = velocity
        s.velocity[0], s.velocity[-1] = velocity[1], velocity[-2]
        clock.time += step
        clock.last_step = step

    def _zones(self, s: State, before: np.ndarray, velocity: np.ndarray, step: float, kick: float) -> None:
        law, size = self.law, self.block.size
        linear, smooth_linear, quadratic = self.column.viscosity.coefficients()
        jump = velocity[:-1] - velocity[1:]
        strain = (s.displacement[:-1] - s.displacement[1:]) / size
        s.increment[...] += 0.5 * kick * s.force * (before[:-1] - before[1:] + jump) / (size * law.density)
        top = s.state[0] = np.maximum(s.state[0], strain)
        over = np.maximum(top - law.densification_strain, 0.0)
        inverse = 1.0 / (over + law.densification_strain - law.yield_strain)
        extra = law.density * (over / law.shock_slope) ** 2 * inverse
        smooth = top <= law.yield_strain
        slope = (2.0 * law.density / law.shock_slope**2 * over - extra) * inverse
        tangent = np.where(over > 0.0, slope, np.where(smooth, law.modulus, 0.0))
        stiffness = np.where(smooth, law.modulus, np.maximum(law.unloading_stiffness, tangent))
        loaded = np.minimum(law.modulus * top, law.plateau_stress) + extra
        stress = np.maximum(loaded - stiffness * (top - strain), 0.0)
        around = np.concatenate([-jump[:1], jump, -jump[-1:]])
        left, right = around[:-2], around[2:]
        both, span = np.maximum(left, 0.0) * np.maximum(right, 0.0), left + right
        shared = np.minimum(both * span / (span**2 - 2.0 * both + 1e-300), np.maximum(jump, 0.0))
        closing = np.maximum(jump, 0.0) - np.where(smooth, shared, 0.0)
        beyond = np.minimum(law.hardening_strain, closing * law.hardening_slowness + 1e-30)
        room = np.minimum(1.0 - strain, np.maximum(law.densification - strain, 0.0) + beyond)
        crowding = quadratic * closing / room
        speed = np.where(smooth, smooth_linear, linear) * np.sqrt(tangent / law.density) + crowding
        s.force[:] = stress + np.where(stress > 0.0, law.density * closing * speed, 0.0)
        fastest = float((speed + crowding).max())
        stable = size / (math.sqrt(stiffness.max() / law.density + fastest**2) + fastest)
        s.clock[0].next_step = s.clock[0].cfl * stable
