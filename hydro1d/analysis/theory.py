"""The theory of each law: its loading curve in closed form, for those laws that `hydro1d.analytic` knows.

Laws know nothing of the theory and the theory nothing of the laws; they meet here, in one line a law.
"""

from collections.abc import Callable, Mapping
from inspect import signature
from typing import Any

from hydro1d import analytic


def _eph(density: float, modulus: float, yield_stress: float, hardening_modulus: float) -> analytic.Curve:
    return analytic.EPH(density, modulus, yield_stress, hardening_modulus)


def _rppl(density: float, plateau_stress: float, densification_strain: float, stiffness: float) -> analytic.Curve:
    return analytic.stiff_rppl(density, plateau_stress, densification_strain, stiffness * plateau_stress)


def _eppr(
    density: float, modulus: float, plateau_stress: float, densification_strain: float, stiffness: float
) -> analytic.Curve:
    return analytic.stiff_eppr(density, modulus, plateau_stress, densification_strain, stiffness * plateau_stress)


# The word of a law in a deck, and what makes its curve from those of the law's keys that it names, in SI units.
CURVES: dict[str, Callable[..., analytic.Curve]] = {
    "elastic": analytic.Elastic,
    "epph": analytic.EPPH,
    "epph-tangent": analytic.TangentEPPH,
    "trilinear": analytic.Trilinear,
    "rppl": _rppl,
    "eppr": _eppr,
    "eph": _eph,
    "rph": analytic.RPH,
}


def curve_of(law: Mapping[str, Any]) -> analytic.Curve | None:
    """The loading curve of a law from its table in a deck (the word under "law", numbers in SI units).

    None for a law without a theory. Raises KeyError for a parameter that is missing or no number, ValueError where the
    parameters make no curve.
    """
    make = CURVES.get(str(law.get("law")))
    if make is None:
        return None
    numbers = {key: float(value) for key, value in law.items() if type(value) in (int, float)}
    return make(**{key: numbers[key] for key in signature(make).parameters})
