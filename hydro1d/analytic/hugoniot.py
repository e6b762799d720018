"""Compaction shocks from the yield point of a curve: cS and strain against [v] (Figs. 8 and 9).

Source: Eqs. 34, 35 and 37 of Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from hydro1d.analytic._checks import Array, require
from hydro1d.analytic.curves import Curve


class Hugoniot(NamedTuple):
    """States behind compaction shocks into material at yield, arrays of one shape.

    velocity_jump [v] m/s; strain; stress Pa; shock_speed cS relative to the material ahead (Eq. 35), m/s;
    front_speed [v]/[strain], Lagrangian, m/s; absorbed_energy EV, J/m^3 (Eq. 22).
    """

    velocity_jump: Array
    strain: Array
    stress: Array
    shock_speed: Array
    front_speed: Array
    absorbed_energy: Array


def compaction_hugoniot(curve: Curve, velocity_jump: ArrayLike) -> Hugoniot:
    """The compaction Hugoniot of a curve at velocity jumps [v] > 0, m/s.

    Raises ValueError where the curve ends before such a shock, or where no single shock from yield exists.
    """
    velocity_jump = np.asarray(velocity_jump, dtype=float)
    strain = np.vectorize(lambda jump: compaction_strain(curve, jump), otypes=[float])(velocity_jump)
    change = strain - curve.yield_strain
    # Eq. 37 and not the curve: where locking is stiff, the curve turns the last bit of the strain into stress.
    stress = curve.yield_stress + curve.density * np.square(velocity_jump) / change
    return Hugoniot(
        velocity_jump,
        strain,
        stress,
        (1.0 - curve.yield_strain) * velocity_jump / change,
        velocity_jump / change,
        0.5 * (stress + curve.yield_stress) * change,
    )


def compaction_strain(curve: Curve, velocity_jump: float) -> float:
    """Strain behind a single shock with velocity jump [v] > 0 (m/s) into material at yield (Eq. 37).

    Raises ValueError as `compaction_hugoniot` does.
    """
    require(velocity_jump > 0.0, "velocity_jump", velocity_jump, "greater than 0")
    target = curve.density * velocity_jump**2
    highest = float(curve.stress(curve.strain_limit)) - curve.yield_stress
    fastest = math.sqrt(highest * (curve.strain_limit - curve.yield_strain) / curve.density)
    require(velocity_jump <= fastest, "velocity_jump", velocity_jump, f"at most {fastest:.9g} m/s: the curve ends")

    # The unknown is the stress: well-conditioned however stiff the locking.
    def change(rise: float) -> float:
        return curve.strain_at(curve.yield_stress + rise) - curve.yield_strain

    low = min(target / (curve.strain_limit - curve.yield_strain), highest)
    high = low
    while high < highest and high * change(high) < target:
        high = min(2.0 * high, highest)
    rise = brentq(lambda rise: rise * change(rise) - target, low, high, xtol=1e-14 * high, rtol=1e-15)
    _require_single_shock(curve, curve.yield_strain + target / rise)
    return curve.yield_strain + target / float(rise)


def _require_single_shock(curve: Curve, strain: float) -> None:
    start = curve.yield_strain
    slope = (float(curve.stress(strain)) - curve.yield_stress) / (strain - start)
    for corner in curve.corners[1:]:
        chord = curve.yield_stress + slope * (corner - start)
        below = corner >= strain or float(curve.stress(corner)) <= chord * (1.0 + 1e-12)
        require(below, "curve", curve, "below the straight line from yield to the final state (else the shock splits)")
