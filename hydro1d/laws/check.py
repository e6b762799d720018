"""One look at a law in plain Python before anything is compiled, so that the first error a user meets is readable."""

from __future__ import annotations

import math

from hydro1d.components.parameters import derived
from hydro1d.errors import DeckError
from hydro1d.laws.base import Foam, Law

_STRAINS = (0.0, 1e-6, 1e-4, 1e-3, *(0.005 * k for k in range(1, 181)))
_START = 1e-6  # a strain at which no foam has yielded


def check_law(law: Law) -> None:
    """Load and unload a material point. Raises DeckError, in one sentence, for a law that cannot be run.

    Stress and moduli must be finite, moduli not negative, the stiffness positive where it starts, the answer the same when
    asked twice, the history a tuple of as many floats as the law declares; a foam's curve begins along its elastic line, and
    its derived constants can be computed.
    """
    try:
        history = tuple(float(value) for value in type(law).history.values())
        largest, energy = 0.0, float(law.initial_energy)
        for strain in (*_STRAINS, *reversed(_STRAINS), -1e-3):
            largest = max(largest, strain)
            answer = law.point(strain, largest, 0.0, energy, history)
            _check_answer(law, strain, answer, len(history))
            if law.point(strain, largest, 0.0, energy, answer[4]) != answer and not history:
                raise ValueError(f"answers differently when asked twice at strain {strain:g}")
            history = answer[4]
        if isinstance(law, Foam):
            _check_start(law)
        _check_derived(law)
    except Exception as error:
        raise DeckError(f"law {type(law).__name__}: {_reason(law, error)}") from error


def _check_start(law: Foam) -> None:
    """Yield is where the curve leaves the elastic line; viscosity and crushing are measured by the stress there."""
    try:
        if law.yield_strain > 0.0 and law.loading(law.yield_strain)[0] > 0.0:
            return
    except ArithmeticError as error:
        raise ValueError(
            f"loading must have a stress at the yield strain, {law.yield_strain:.6g}, and raised {type(error).__name__}; a curve "
            f"that never falls below the elastic line needs a modulus above {law.modulus:.6g} Pa"
        ) from error
    stress = law.loading(_START)[0]
    raise ValueError(
        f"loading must begin along the elastic line, stress = modulus × strain up to yield: at strain {_START:g} its stress "
        f"is {stress:.6g} Pa, a slope of {stress / _START:.6g} Pa, where the modulus is {law.modulus:.6g} Pa"
    )


def _check_derived(law: Law) -> None:
    names = {name for base in type(law).__mro__ for name, item in vars(base).items() if isinstance(item, derived)}
    for name in sorted(names):
        try:
            getattr(law, name)
        except Exception as error:
            raise ValueError(f"its constant {name} cannot be computed: {_reason(law, error)}") from error


def _reason(law: Law, error: Exception) -> str:
    if isinstance(error, ValueError):
        return str(error)
    text = f"{type(error).__name__}: {error}"
    if isinstance(error, ArithmeticError):  # parameters too far apart in size for floating point
        values = {name: getattr(law, name) for name in type(law).model_fields}
        given = ", ".join(f"{name} = {value:g}" for name, value in values.items() if isinstance(value, float))
        text += f"; all that is computed must be finite, which it is not for {given}"
    return text


def _check_answer(law: Law, strain: float, answer: tuple, remembered: int) -> None:
    if not isinstance(answer, tuple) or len(answer) != 5:
        raise ValueError("point must return (stress, tangent, stiffness, smooth, history)")
    stress, tangent, stiffness, _, history = answer
    for name, value in (("stress", stress), ("tangent", tangent), ("stiffness", stiffness)):
        if not math.isfinite(value):
            raise ValueError(f"{name} is {value} at strain {strain:g}; it must be finite")
    if tangent < 0.0 or stiffness < 0.0 or (strain == 0.0 and stiffness == 0.0):
        raise ValueError(
            f"tangent {tangent:g} and stiffness {stiffness:g} Pa at strain {strain:g} must not be negative"
        )
    if not isinstance(history, tuple) or len(history) != remembered:
        raise ValueError(f"history must be a tuple of {remembered} numbers, as the class declares")
