"""The laws that can be fitted: parameters, where to start, how far they may go."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from hydro1d.fit._curve import MeasuredCurve
from hydro1d.fit._efficiency import Efficiency


class Parameter(NamedTuple):
    """Name and unit in a deck, starting value, bounds."""

    name: str
    unit: str
    start: float
    low: float
    high: float


def first_slope(curve: MeasuredCurve, level: float) -> float:
    """Elastic modulus to start from, Pa: the slope between a tenth and six tenths of a stress at which the curve yields."""
    rising = np.flatnonzero(curve.stress >= 0.9 * level)
    end = int(rising[0]) if len(rising) else len(curve.strain) - 1
    strain, stress = curve.strain[: end + 1], curve.stress[: end + 1]
    inside = (stress > 0.1 * level) & (stress < 0.6 * level)
    if inside.sum() >= 3:
        slope = float(np.polyfit(strain[inside], stress[inside], 1)[0])
        if slope > 0.0:
            return slope
    return level / max(float(curve.strain[end]), 1e-3)


def elastic_modulus(curve: MeasuredCurve, found: Efficiency) -> float:
    """The slope of the first loading, Pa. A curve without a knee yields, for this purpose, at its plateau stress."""
    plateau = found.plateau_stress
    yielded = float(np.interp(found.yield_strain, curve.strain, curve.stress)) if found.yield_strain > 0.0 else plateau
    return first_slope(curve, min(yielded, plateau))


def _elastic(curve: MeasuredCurve, found: Efficiency) -> Parameter:
    plateau, slope = found.plateau_stress, elastic_modulus(curve, found)
    least = 1.05 * plateau / max(float(curve.strain[-1]), 0.05)
    return Parameter("modulus", "Pa", max(slope, 1.5 * least), least, 100.0 * max(slope, 1.5 * least))


def _plateau(name: str, plateau: float) -> Parameter:
    return Parameter(name, "Pa", plateau, 0.1 * plateau, 5.0 * plateau)


def _densification(found: Efficiency, last: float) -> Parameter:
    start = min(max(found.densification_strain, 0.1), 0.97 * last)
    return Parameter("densification_strain", "1", start, 0.4 * start, min(0.98, max(last, start + 0.01)))


def _common(curve: MeasuredCurve, found: Efficiency) -> list[Parameter]:
    plateau, last = found.plateau_stress, float(curve.strain[-1])
    return [_elastic(curve, found), _plateau("plateau_stress", plateau), _densification(found, last)]


def _tangent(curve: MeasuredCurve, found: Efficiency) -> list[Parameter]:
    return [*_common(curve, found), Parameter("beta", "1", 0.5, 1e-4, 1e3), Parameter("gamma", "1", 0.7, 0.02, 0.9999)]


def _epph(curve: MeasuredCurve, found: Efficiency) -> list[Parameter]:
    return [*_common(curve, found), Parameter("shock_slope", "s/m", 1e-3, 1e-6, 1.0)]


def _trilinear(curve: MeasuredCurve, found: Efficiency) -> list[Parameter]:
    slope = 10.0 * found.plateau_stress
    return [*_common(curve, found), Parameter("locking_modulus", "Pa", slope, 1e-2 * slope, 1e4 * slope)]


def _rph(curve: MeasuredCurve, found: Efficiency) -> list[Parameter]:
    plateau = found.plateau_stress
    hardening = Parameter("hardening", "Pa", 0.1 * plateau, 1e-6 * plateau, 100.0 * plateau)
    return [_elastic(curve, found), _plateau("plateau_stress", 0.8 * plateau), hardening]


def _eph(curve: MeasuredCurve, found: Efficiency) -> list[Parameter]:
    modulus = _elastic(curve, found)
    hardening = Parameter("hardening_modulus", "Pa", 0.01 * modulus.start, 1e-8 * modulus.start, 0.9 * modulus.low)
    return [modulus, _plateau("yield_stress", 0.8 * found.plateau_stress), hardening]


# What of a law is fitted; its curve is that of `hydro1d.analysis.theory`.
MODELS: dict[str, Callable[[MeasuredCurve, Efficiency], list[Parameter]]] = {
    "epph-tangent": _tangent,
    "epph": _epph,
    "trilinear": _trilinear,
    "rph": _rph,
    "eph": _eph,
}
NEED_DENSITY = ("epph",)  # their curve depends on it, not only the speed of their waves
