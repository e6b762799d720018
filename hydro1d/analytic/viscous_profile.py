"""Steady profile of a compaction front under artificial viscosity: what a captured front looks like.

A steady front has v - vA = C (strain - strain_A), so stress + q follows the Rayleigh line exactly:
q = stress_A + rho0 C^2 (strain - strain_A) - stress(strain). With q = dv (c2 rho dv + c1 rho0 c), where
dv = h C |d strain/dX| is the velocity jump over a zone of initial width h, rho the current density and
c = sqrt(tangent/rho0), the slope at each strain is the root of a quadratic, and the profile an integral over strain.
This q is that of a material which does not lock, room 1 - strain; the solver gives foams with a plateau less room.
Source: von Neumann & Richtmyer, J. Appl. Phys. 21 (1950) 232-237, doi:10.1063/1.1699639 (quadratic term, gas); Eq. 37
of Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011, for the line.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import OdeSolution, solve_ivp

from hydro1d.analytic._checks import Array, finite, not_negative, positive, require
from hydro1d.analytic.curves import Curve
from hydro1d.analytic.hugoniot import compaction_hugoniot
from hydro1d.analytic.jumps import Fields

_CUT = 1e-9  # the profile approaches its end states, or one of them, only at infinity


@dataclass(frozen=True)
class ViscousProfile:
    """Compaction front with velocity jump [v] (m/s) into material at yield, smeared by viscosity.

    curve; velocity_jump m/s; zone_width h, m (initial); linear c1 and quadratic c2 > 0 of q. Called with
    (coordinate, t) it returns `Fields`; the stress is without q, which `viscosity(strain)` gives; the internal energy
    includes the work of q; the middle of the front, halfway in strain, is at front_speed t.
    """

    curve: Curve
    velocity_jump: float
    zone_width: float
    linear: float
    quadratic: float

    def __post_init__(self) -> None:
        positive(self, "velocity_jump", "zone_width")
        not_negative(self, "linear", "quadratic")
        require(self.quadratic > 0.0, "quadratic", self.quadratic, "greater than 0 (no other term acts on a plateau)")

    @cached_property
    def _ends(self) -> tuple[float, float, float]:
        """Strain ahead, strain behind, Lagrangian front speed."""
        shock = compaction_hugoniot(self.curve, self.velocity_jump)
        return self.curve.yield_strain, float(shock.strain), float(shock.front_speed)

    @property
    def front_speed(self) -> float:
        """Lagrangian speed, m/s."""
        return self._ends[2]

    def viscosity(self, strain: ArrayLike) -> Array:
        """q, Pa, where the front has this strain: Rayleigh line less curve."""
        strain = np.asarray(strain, dtype=float)
        ahead, behind, speed = self._ends
        line = self.curve.yield_stress + self.curve.density * speed**2 * (strain - ahead)
        inside = (strain > ahead) & (strain < behind)
        return np.where(inside, np.maximum(line - self.curve.stress(strain), 0.0), 0.0)

    def zone_velocity_jump(self, strain: ArrayLike) -> Array:
        """dv over a zone, m/s, where the front has this strain: root of q = dv (c2 rho dv + c1 rho0 c)."""
        strain = np.asarray(strain, dtype=float)
        density = self.curve.density
        square = self.quadratic * density / (1.0 - strain)
        wave = self.linear * np.sqrt(density * self.curve.tangent(strain))
        q = self.viscosity(strain)
        root = wave + np.sqrt(wave**2 + 4.0 * square * q)
        return 2.0 * q / np.where(root > 0.0, root, 1.0)

    def slope(self, strain: ArrayLike) -> Array:
        """d strain/d coordinate, 1/m, where the front has this strain (negative)."""
        return -self.zone_velocity_jump(strain) / (self.zone_width * self.front_speed)

    @property
    def thickness(self) -> float:
        """Strain jump over the steepest slope, m."""
        ahead, behind, _ = self._ends
        strains = np.linspace(ahead, behind, 4001)[1:-1]
        return (behind - ahead) / float(np.max(np.abs(self.slope(strains))))

    @cached_property
    def _branches(self) -> tuple[OdeSolution, OdeSolution]:
        """Distance from the middle, in zones, over strain: ahead of the middle and behind it."""
        ahead, behind, _ = self._ends
        middle, cut = 0.5 * (ahead + behind), _CUT * (behind - ahead)
        return self._integrate(middle, ahead + cut), self._integrate(middle, behind - cut)

    def _integrate(self, start: float, end: float) -> OdeSolution:
        def rate(strain: float, _: Array) -> Array:
            return np.atleast_1d(1.0 / (self.slope(strain) * self.zone_width))

        result = solve_ivp(rate, (start, end), [0.0], method="DOP853", rtol=1e-10, atol=1e-10, dense_output=True)
        assert result.sol is not None
        return result.sol

    def distance(self, strain: ArrayLike) -> Array:
        """Distance of this strain ahead of the middle of the front, m."""
        strain = np.asarray(strain, dtype=float)
        ahead, behind, _ = self._ends
        middle, cut = 0.5 * (ahead + behind), _CUT * (behind - ahead)
        low = self._branches[0](np.clip(strain, ahead + cut, middle).ravel())[0]
        high = self._branches[1](np.clip(strain, middle, behind - cut).ravel())[0]
        return self.zone_width * np.where(strain.ravel() < middle, low, high).reshape(strain.shape)

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s), which broadcast; a half-space both ways."""
        place = finite("coordinate", coordinate) - self.front_speed * finite("t", t)
        distances, strains = self._table
        strain = np.interp(-place, -distances, strains, left=self._ends[0], right=self._ends[1])
        curve, change = self.curve, strain - self._ends[0]
        velocity = curve.yield_velocity + self.front_speed * change
        line = curve.yield_stress + 0.5 * curve.density * self.front_speed**2 * change
        energy = (0.5 * curve.yield_stress * curve.yield_strain + line * change) / curve.density
        return Fields(velocity, curve.stress(strain), strain, curve.density / (1.0 - strain), energy)

    @cached_property
    def _table(self) -> tuple[Array, Array]:
        """Distances and strains, dense at both ends."""
        ahead, behind, _ = self._ends
        share = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, 20001))
        strains = ahead + (behind - ahead) * np.clip(share, _CUT, 1.0 - _CUT)
        return self.distance(strains), strains
