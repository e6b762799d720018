"""Rigid, plastic hardening (R-PH) foam: a striker's decaying shock and a piston's steady one.

stress = plateau + hardening strain/(1 - strain)^2, rigid below. Jump conditions from rest give
strain = v/(v + c) with c = sqrt(hardening/rho0), so the Lagrangian shock speed is v + c.
Source: Zheng, Wang, Yu, Reid & Harrigan, J. Mech. Phys. Solids 72 (2014) 93-114, doi:10.1016/j.jmps.2014.07.013.
With m = M + rho0 X (mass that moves) the striker obeys m v = M v0 - plateau t, and dX/dt = v + c gives
d(ln m)/dv = -rho0 (v + c)/(plateau + rho0 v (v + c)): elementary, so time and front are closed functions of v.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, coordinates, length_allowed, positive, times
from hydro1d.analytic._roots import bisect
from hydro1d.analytic.jumps import Fields, Jump, State
from hydro1d.analytic.rigid import FrontHistory, MomentumStriker

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(48)


@dataclass(frozen=True)
class RPHFoam:
    """Rigid, plastic hardening: density kg/m^3, plateau_stress and hardening in Pa."""

    density: float
    plateau_stress: float
    hardening: float

    def __post_init__(self) -> None:
        positive(self, "density", "plateau_stress", "hardening")

    @property
    def slowest_front(self) -> float:
        """c, the Lagrangian speed of a vanishing shock, m/s."""
        return math.sqrt(self.hardening / self.density)

    def strain(self, velocity: ArrayLike) -> Array:
        """Strain behind a shock from rest to `velocity` (m/s)."""
        velocity = np.asarray(velocity, dtype=float)
        return velocity / (velocity + self.slowest_front)

    def shock_stress(self, velocity: ArrayLike) -> Array:
        """Stress behind a shock from rest to `velocity` (m/s), Pa."""
        velocity = np.asarray(velocity, dtype=float)
        return self.plateau_stress + self.density * velocity * (velocity + self.slowest_front)

    def stress(self, strain: ArrayLike) -> Array:
        """The law itself beyond yield, Pa."""
        strain = np.asarray(strain, dtype=float)
        return self.plateau_stress + self.hardening * strain / np.square(1.0 - strain)

    def absorbed_energy(self, velocity: ArrayLike) -> Array:
        """Internal energy behind a shock from rest to `velocity` (m/s), J/kg."""
        return 0.5 * (self.plateau_stress + self.shock_stress(velocity)) * self.strain(velocity) / self.density

    def jump(self, velocity: float, coordinate: float) -> Jump:
        """The front at `coordinate` (m), crushed material moving at `velocity` (m/s)."""
        strain = float(self.strain(velocity))
        density = self.density / (1.0 - strain)
        ahead = State(0.0, self.plateau_stress, 0.0, self.density, 0.0)
        behind = State(
            velocity, float(self.shock_stress(velocity)), strain, density, float(self.absorbed_energy(velocity))
        )
        return Jump(ahead, behind, self.density, velocity + self.slowest_front, coordinate)


@dataclass(frozen=True)
class RPHPiston:
    """A piston of constant velocity (m/s) against R-PH foam; length of the column, m. Steady shock."""

    material: RPHFoam
    velocity: float
    length: float = math.inf

    def __post_init__(self) -> None:
        positive(self, "velocity")
        length_allowed(self.length)

    @property
    def end_time(self) -> float:
        """When the front reaches the far end, s."""
        return self.length / (self.velocity + self.material.slowest_front)

    def jumps(self, t: float = 0.0) -> list[Jump]:
        """The front at time t (s)."""
        return [self.material.jump(self.velocity, t * (self.velocity + self.material.slowest_front))]

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s), which broadcast; on the front, the state ahead."""
        t = times(t, self.end_time, "then the front reaches the far end")
        (front,) = self.jumps()
        crushed = coordinates(coordinate, self.length) < front.front_speed * t
        return Fields(*(np.where(crushed, b, a) for a, b in zip(front.ahead, front.behind, strict=True)))


@dataclass(frozen=True)
class RPHStriker(MomentumStriker):
    """A rigid mass against R-PH foam with a fixed back; crushed material does not unload.

    material; mass of the striker per area, kg/m^2; impact_velocity m/s; length of the column, m.
    The stress after the striker has come to rest is NaN: undetermined in rigid bodies. ValueError after `end_time`,
    when the front reaches the back.
    """

    material: RPHFoam

    @property
    def stop_front(self) -> float:
        """Length of column crushed when the striker has come to rest, m."""
        return float(self._front_after(np.asarray(self.impact_velocity)))

    @property
    def stop_distance(self) -> float:
        """Displacement of the striker when it has come to rest, m."""
        return float(self._displacement_after(np.asarray(self.impact_velocity)))

    @cached_property
    def end_time(self) -> float:
        """When the front reaches the back, s; infinite if it never does."""
        if self.stop_front <= self.length:
            return math.inf
        last = bisect(lambda loss: self._front_after(loss) > self.length, 0.0, self.impact_velocity)
        return float(self._time_after(last))

    def history(self, t: ArrayLike) -> FrontHistory:
        """Displacement, velocity, front and stresses at times t (s)."""
        t = times(t, self.end_time, "then the front reaches the back")
        loss = bisect(lambda loss: self._time_after(loss) > t, np.zeros(t.shape), self.impact_velocity)
        loss = np.where(t >= self.stop_time, self.impact_velocity, np.where(t == 0.0, 0.0, loss))
        velocity, front = self.impact_velocity - loss, self._front_after(loss)
        stress = np.where(t > self.stop_time, np.nan, self.material.shock_stress(velocity))
        left = self._striker_stress(stress, front)
        return FrontHistory(self._displacement_after(loss), velocity, front, stress, left)

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s), which broadcast; on the front, the state ahead."""
        coordinate = coordinates(coordinate, self.length)
        now, foam = self.history(t), self.material
        crushed = coordinate < now.front
        passed = np.where(crushed, coordinate, 0.0)
        loss = bisect(lambda loss: self._front_after(loss) > passed, np.zeros(passed.shape), self.impact_velocity)
        crossing = self.impact_velocity - loss
        strain = np.where(crushed, foam.strain(crossing), 0.0)
        share = (self.mass + foam.density * passed) / (self.mass + foam.density * now.front)
        stress = np.where(crushed, now.front_stress * share, foam.plateau_stress)
        return Fields(
            np.where(crushed, now.velocity, 0.0),
            np.where(np.asarray(t) > self.stop_time, np.nan, stress),
            strain,
            foam.density / (1.0 - strain),
            np.where(crushed, foam.absorbed_energy(crossing), 0.0),
        )

    # The unknown is the loss of velocity since the impact: nothing cancels at the start, where it vanishes.

    def _crushed_mass(self, loss: Array) -> Array:
        """rho0 X when the striker has lost that much velocity."""
        foam, velocity = self.material, self.impact_velocity - loss
        excess = foam.density * loss * (self.impact_velocity + velocity + foam.slowest_front)
        half_log = 0.5 * np.log1p(excess / foam.shock_stress(velocity))
        drag = 0.5 * foam.density * foam.slowest_front * self._inverse_integral(loss)
        return self.mass * np.expm1(half_log + drag)

    def _inverse_integral(self, loss: Array) -> Array:
        """Integral of 1/shock_stress over the velocities lost."""
        foam = self.material
        middle = 0.5 * foam.slowest_front
        square = foam.plateau_stress / foam.density - middle**2
        # atan or atanh of the difference in one fraction, so that nothing cancels where the discriminant vanishes
        base = square + (self.impact_velocity - loss + middle) * (self.impact_velocity + middle)
        root = math.sqrt(abs(square))
        if root < 1e-9 * middle:
            return loss / (base * foam.density)
        inverse = np.arctan2(root * loss, base) if square > 0.0 else np.arctanh(root * loss / base)
        return inverse / (root * foam.density)

    def _front_after(self, loss: Array) -> Array:
        return self._crushed_mass(loss) / self.material.density

    def _time_after(self, loss: Array) -> Array:
        taken = self.mass * loss - self._crushed_mass(loss) * (self.impact_velocity - loss)
        return taken / self.material.plateau_stress

    def _displacement_after(self, loss: Array) -> Array:
        """Integral of v m/shock_stress over v; Gauss, since the integrand is analytic."""
        half = 0.5 * np.asarray(loss, dtype=float)[..., None]
        lost = half * (_NODES + 1.0)
        velocity, mass = self.impact_velocity - lost, self.mass + self._crushed_mass(lost)
        return np.sum(half * _WEIGHTS * velocity * mass / self.material.shock_stress(velocity), axis=-1)
