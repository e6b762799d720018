"""Scheme 2, the "energy balance" for a mass on R-P-P-L: wrong, kept to show by how much.

It assumes that the front absorbs no more than the quasi-static energy plateau*eD, and so does not conserve momentum.
Source: Eqs. 14-19 of Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011. The time follows
from Eq. 17 by dt = du/v; with u = umax (1 - w^2) the integrand is sqrt(1 + b - b w^2), elementary.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, times
from hydro1d.analytic._roots import bisect
from hydro1d.analytic.rigid import FrontHistory, RigidStriker
from hydro1d.analytic.rppl import RPPL


@dataclass(frozen=True)
class EnergyBalanceStriker(RigidStriker):
    """Mass against a column of R-P-P-L by Scheme 2 (Eqs. 14-19).

    material; mass of the striker per area, kg/m^2; impact_velocity v0, m/s; length of the column, m.
    Raises ValueError for times after full locking. No jumps: its front violates the momentum condition.
    """

    material: RPPL

    @property
    def critical_length(self) -> float:
        """Length of column that is just fully crushed, m (Eq. 19)."""
        return float(critical_length(self.material, self.mass, self.impact_velocity))

    @property
    def stop_time(self) -> float:
        """When the striker comes to rest if the column does not lock fully before, s."""
        return float(self._time_at(np.asarray(1.0)))

    @property
    def locking_time(self) -> float:
        """When the front reaches the back, s; infinite if it never does."""
        if self.length >= self.critical_length:
            return math.inf
        share = self.length / self.critical_length
        return float(self._time_at(np.asarray(share / (1.0 + math.sqrt(1.0 - share)))))

    def velocity_at(self, displacement: ArrayLike) -> Array:
        """v after a displacement u (m), m/s (Eq. 17); 0 where it never gets that far."""
        displacement = np.asarray(displacement, dtype=float)
        square = self.impact_velocity**2 - 2.0 * self.material.plateau_stress * displacement / self.mass
        block = 1.0 + self.material.density * displacement / (self.mass * self.material.densification_strain)
        return np.sqrt(np.maximum(square, 0.0) / block)

    def stress_at(self, displacement: ArrayLike) -> Array:
        """Stress behind the front after a displacement u (m), Pa (Eq. 14)."""
        return energy_balance_stress(self.material, self.velocity_at(displacement))

    def history(self, t: ArrayLike) -> FrontHistory:
        """Displacement, velocity, front and stresses at times t (s); stresses are NaN once it is at rest.

        left_stress is what decelerates the striker, by Eq. 16.
        """
        t = times(t, self.locking_time, "then the column is fully locked")
        loss = bisect(lambda loss: self._time_at(loss) > t, np.zeros(t.shape), 1.0)
        loss = np.where(t >= self.stop_time, 1.0, np.where(t == 0.0, 0.0, loss))
        front = self.critical_length * loss * (2.0 - loss)
        displacement = front * self.material.densification_strain
        stress = np.where(t > self.stop_time, np.nan, self.stress_at(displacement))
        left_stress = self._striker_stress(stress, front)
        return FrontHistory(displacement, self.velocity_at(displacement), front, stress, left_stress)

    def _time_at(self, loss: Array) -> Array:
        """Time at which u = umax (1 - w^2), w = 1 - loss: nothing cancels at the start, where the loss vanishes."""
        b = self.material.density * self.critical_length / self.mass
        w, crushed = 1.0 - loss, loss * (2.0 - loss)
        root = np.sqrt(1.0 + b * crushed)
        # Integral of sqrt(1 + b - b w^2) from w to 1; both differences are written as products.
        product = crushed * (1.0 - b * w**2) / (1.0 + w * root)
        angle = np.arctan2(math.sqrt(b) * (1.0 + b) * crushed / (root + w), root + b * w)
        path = 0.5 * (product + (1.0 + b) / math.sqrt(b) * angle)
        return 2.0 * self.critical_length * self.material.densification_strain / self.impact_velocity * path


def energy_balance_stress(material: RPPL, velocity: ArrayLike) -> Array:
    """Stress that Scheme 2 puts behind the front, Pa (Eq. 14)."""
    return material.plateau_stress + 0.5 * material.density * np.square(velocity) / material.densification_strain


def critical_length(material: RPPL, mass: ArrayLike, impact_velocity: ArrayLike) -> Array:
    """Length of column that a striker (kg/m^2, m/s) just fully crushes by Scheme 2, m (Eq. 19)."""
    kinetic = 0.5 * np.asarray(mass, dtype=float) * np.square(impact_velocity)
    return kinetic / (material.plateau_stress * material.densification_strain)


def full_locking_velocity(material: RPPL, mass: ArrayLike, length: ArrayLike) -> Array:
    """vD by Scheme 2, impact velocity that just locks a column of `length` (m), m/s (Eq. 18)."""
    longest = np.asarray(length, dtype=float) * material.densification_strain
    return np.sqrt(2.0 * longest * material.plateau_stress / np.asarray(mass, dtype=float))
