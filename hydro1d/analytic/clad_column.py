"""A cladding plate on R-P-P-L with a fixed back under any pressure pulse: closed form in time.

Momentum of plate and crushed block, (M + rho0 u/eD) du/dt = J with J = integral of (p - plateau), is integrated once
more: M u + rho0 u^2/(2 eD) = integral of J, a quadratic for u. Scheme 1 (mass with momentum, no pressure) and the
R-P-P-L pulse (no mass) are its ends. The same jump conditions as Eqs. 1-7 of Harrigan, Reid & Seyed Yaghoubi 2010,
doi:10.1016/j.ijimpeng.2009.03.011; the clad foam under a pulse: Hanssen, Enstock & Langseth, Int. J. Impact Eng. 27
(2002) 593-618, doi:10.1016/S0734-743X(01)00155-5.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, coordinates, length_allowed, not_negative, require, times
from hydro1d.analytic._roots import bisect
from hydro1d.analytic.jumps import Fields, Jump
from hydro1d.analytic.pulses import Pulse
from hydro1d.analytic.rigid import FrontHistory
from hydro1d.analytic.rppl import RPPL

ENDS = "then the plate rests or the column is locked"


@dataclass(frozen=True)
class CladColumn:
    """A plate on a column of R-P-P-L, a pulse on the plate.

    material; mass of the plate per area, kg/m^2 (0: none); pulse, above the plateau stress at t = 0; length, m.
    Valid until `stop_time`, when the plate comes to rest for the first time, or `locking_time`: ValueError after it.
    """

    material: RPPL
    mass: float
    pulse: Pulse
    length: float = math.inf

    def __post_init__(self) -> None:
        not_negative(self, "mass")
        length_allowed(self.length)
        start, plateau = float(self.pulse.pressure(0.0)), self.material.plateau_stress
        require(start > plateau, "pulse.pressure(0)", start, f"greater than the plateau stress {plateau} Pa")
        impulse, late = float(self.pulse.impulse(1e9)), 1e9 * plateau
        require(impulse < late, "pulse.impulse", impulse, "less than what the plateau stress can take")

    def _momentum(self, t: Array) -> Array:
        """J: momentum of plate and block per area."""
        return self.pulse.impulse(t) - self.material.plateau_stress * t

    @cached_property
    def stop_time(self) -> float:
        """When the plate comes to rest in a column long enough, s."""
        # The momentum rises from zero first, so look for its first sign change on a scan, finer and finer.
        latest = float(self.pulse.impulse(1e9)) / self.material.plateau_stress
        scan = np.concatenate([np.geomspace(1e-6, 1.0, 4000), [1.0 + 1e-9]]) * latest
        falls = self._momentum(scan) <= 0.0
        first = int(np.argmax(falls))
        require(bool(falls[first]) and first > 0, "pulse", self.pulse, "one that moves the plate and lets it stop")
        return float(bisect(lambda t: self._momentum(t) <= 0.0, scan[first - 1], scan[first]))

    @cached_property
    def locking_time(self) -> float:
        """When the front reaches the back, s; infinite if it never does."""
        if float(self._front(np.asarray(self.stop_time))) <= self.length:
            return math.inf
        return float(bisect(lambda t: self._front(t) > self.length, 0.0, self.stop_time))

    @property
    def end_time(self) -> float:
        """The plate rests or the column is locked, s."""
        return min(self.stop_time, self.locking_time)

    @property
    def critical_length(self) -> float:
        """Length of column that the pulse just fully crushes, m."""
        return float(self._front(np.asarray(self.stop_time)))

    def _front(self, t: Array) -> Array:
        twice = 2.0 * (self.pulse.impulse_integral(t) - 0.5 * self.material.plateau_stress * t**2)
        crushing = np.maximum(twice, 0.0) / self.material.densification_strain
        root = self.mass + np.sqrt(self.mass**2 + self.material.density * crushing)
        return crushing / np.where(root > 0.0, root, 1.0)

    def _velocity(self, t: Array, front: Array) -> Array:
        block = self.mass + self.material.density * front
        rise = float(self.pulse.pressure(0.0)) - self.material.plateau_stress
        at_once = math.sqrt(self.material.densification_strain * rise / self.material.density)  # Eq. 25
        moving = np.maximum(self._momentum(t), 0.0) / np.where(block > 0.0, block, 1.0)
        return np.where(block > 0.0, moving, at_once)

    def history(self, t: ArrayLike) -> FrontHistory:
        """Displacement, velocity, front and stresses at times t (s); left_stress is between plate and column."""
        t = times(t, self.end_time, ENDS)
        front = self._front(t)
        velocity = self._velocity(t, front)
        stress = self.material.shock_stress(velocity)
        left = self._block_stress(np.zeros_like(t), t, front, stress)
        return FrontHistory(front * self.material.densification_strain, velocity, front, stress, left)

    def _block_stress(self, coordinate: Array, t: Array, front: Array, front_stress: Array) -> Array:
        """Linear from the pressure at the outside of the plate to the stress behind the front."""
        block = self.mass + self.material.density * front
        share = (self.mass + self.material.density * coordinate) / np.where(block > 0.0, block, 1.0)
        pressure = self.pulse.pressure(t)
        return pressure + np.where(block > 0.0, share, 1.0) * (front_stress - pressure)

    def jumps(self, t: float) -> list[Jump]:
        """The front at time t (s)."""
        history = self.history(t)
        return [self.material.jump(float(history.velocity), float(history.front))]

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s), which broadcast; on the front, the state ahead."""
        coordinate = coordinates(coordinate, self.length)
        t = times(t, self.end_time, ENDS)
        now = self.history(t)
        crushed = coordinate < now.front
        passed = np.where(crushed, coordinate, 0.0)
        moments = bisect(lambda time: self._front(time) > passed, np.zeros(passed.shape), self.end_time)
        crossing = self.material.shock_stress(self._velocity(moments, self._front(moments)))
        block_stress = self._block_stress(passed, t, now.front, now.front_stress)
        return self.material.fields(crushed, now.velocity, block_stress, crossing)
