"""A column at rest whose end is loaded by a constant pressure or velocity from t = 0: a few fronts, steady states.

On a curve that is concave-up between corners the fronts are the edges of the smallest concave majorant of the curve
between zero and the final strain: an elastic precursor to yield and a compaction shock behind it (Eqs. 31-37, 40, 41
of Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011); one single shock from rest where the
Rayleigh line from rest to the final state is steeper than the elastic line, so that the compaction front would
overtake the precursor; linear waves where the curve is straight (E-P-H: no shock, plastic wave at sqrt(H/rho0)).
The majorant is the entropy solution: Liu, J. Math. Anal. Appl. 53 (1976) 78-88, doi:10.1016/0022-247X(76)90146-3.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from hydro1d.analytic._checks import coordinates, length_allowed, require, times
from hydro1d.analytic.curves import Curve
from hydro1d.analytic.jumps import Fields, Jump, State, rest_state, shock_jump, shocked_state


@dataclass(frozen=True)
class StepLoading:
    """The fronts and zones that lead from rest to a final strain, loaded at coordinate 0.

    curve: the material; final_strain: behind the last front; length of the column in m (infinite: half-space).
    Made by `pressure_step` and `piston`.
    """

    curve: Curve
    final_strain: float
    length: float = math.inf

    def __post_init__(self) -> None:
        length_allowed(self.length)
        limit = self.curve.strain_limit
        require(0.0 < self.final_strain <= limit, "final_strain", self.final_strain, f"within (0, {limit:.9g}]")

    @cached_property
    def states(self) -> tuple[State, ...]:
        """The zones' states, from rest (far end) to the loaded end."""
        states = [rest_state(self.curve.density)]
        for strain in front_strains(self.curve, self.final_strain):
            states.append(shocked_state(self.curve.density, states[-1], strain, float(self.curve.stress(strain))))
        return tuple(states)

    def jumps(self, t: float = 0.0) -> list[Jump]:
        """The fronts at time t, fastest first."""
        fronts = [shock_jump(self.curve.density, ahead, behind) for ahead, behind in pairwise(self.states)]
        return [replace(front, coordinate=front.front_speed * t) for front in fronts]

    @property
    def end_time(self) -> float:
        """When the fastest front reaches the far end, s."""
        return self.length / self.jumps()[0].front_speed

    @property
    def overtaken(self) -> bool:
        """Whether the curve yields on the way and yet a single shock runs from rest to the final state."""
        return len(self.states) == 2 and self.final_strain > self.curve.yield_strain

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s), which broadcast; on a front, the state ahead.

        Raises ValueError after `end_time`, when the fastest front has reached the far end, and outside the column.
        """
        t = times(t, self.end_time, "then the fastest front reaches the far end")
        coordinate = coordinates(coordinate, self.length)
        zone = sum((coordinate < front.front_speed * t).astype(int) for front in self.jumps())
        return Fields(*(np.asarray(values)[zone] for values in zip(*self.states, strict=True)))


def pressure_step(curve: Curve, pressure: float, length: float = math.inf) -> StepLoading:
    """A constant pressure (Pa) on the end of a column of `length` (m).

    Raises ValueError for a pressure that is not positive or that the curve never reaches.
    """
    require(math.isfinite(pressure) and pressure > 0.0, "pressure", pressure, "finite and greater than 0")
    return StepLoading(curve, curve.strain_at(pressure), length)


def piston(curve: Curve, velocity: float, length: float = math.inf) -> StepLoading:
    """A piston of constant velocity (m/s, into the column) against a column of `length` (m).

    Raises ValueError for a velocity that is not positive or that needs more than the curve has.
    """
    require(math.isfinite(velocity) and velocity > 0.0, "velocity", velocity, "finite and greater than 0")
    limit = curve.strain_limit
    fastest = loaded_velocity(curve, limit)
    require(velocity <= fastest, "velocity", velocity, f"at most {fastest:.9g} m/s, where the curve ends")
    strain = brentq(lambda e: loaded_velocity(curve, e) - velocity, 0.0, limit, xtol=1e-17, rtol=1e-15)
    return StepLoading(curve, float(strain), length)


def loaded_velocity(curve: Curve, strain: float) -> float:
    """Velocity of material brought from rest to `strain` by the fronts, m/s."""
    if strain == 0.0:
        return 0.0
    strains = np.array([0.0, *front_strains(curve, strain)])
    rises = np.diff(curve.stress(strains)) * np.diff(strains)
    return float(np.sum(np.sqrt(rises / curve.density)))


def front_strains(curve: Curve, final_strain: float) -> list[float]:
    """Strains behind the fronts from rest to `final_strain`, fastest first: the corners of the concave majorant."""
    hull = [0.0]
    for strain in (*(corner for corner in curve.corners if corner < final_strain), final_strain):
        while len(hull) > 1 and _slope(curve, hull[-2], hull[-1]) <= _slope(curve, hull[-1], strain):
            hull.pop()
        hull.append(strain)
    return hull[1:]


def _slope(curve: Curve, start: float, end: float) -> float:
    return (float(curve.stress(end)) - float(curve.stress(start))) / (end - start)
