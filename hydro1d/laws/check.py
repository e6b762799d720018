"""One look at a law in plain Python before anything is compiled, so that the first error a user meets is readable."""

from __future__ import annotations

import math

from hydro1d.components.parameters import derived
from hydro1d.errors import DeckError
from hydro1d.laws.base import Foam, Law, Point, Response, answer_by_point

_STRAINS = (0.0, 1e-6, 1e-4, 1e-3, *(0.005 * k for k in range(1, 181)))
_STEP = 1.0  # s
_START = 1e-6  # a strain at which no foam has yielded


def check_law(law: Law) -> None:
    """Load and unload a material point. Raises DeckError, in one sentence, for a law that cannot be run.

    Stress and moduli must be finite, moduli not negative, the stiffness positive where it starts, the answer the same when
    asked twice, the state a tuple of as many floats as the law declares; a foam's curve begins along its elastic line, and
    its derived constants can be computed.
    """
    try:
        state = tuple(float(value) for value in type(law).state_variables.values())
        for strain in (*_STRAINS, *reversed(_STRAINS), -1e-3):
            point = Point(strain, 0.0, _STEP, float(law.initial_energy), 0.0)
            response = _asked(law, point, state)
            _check_response(strain, response, len(state))
            if law.respond(point, response.state) != response and not law.own_variables():
                raise ValueError(f"answers differently when asked twice at strain {strain:g}")
            state = response.state
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


def _asked(law: Law, point: Point, state: tuple[float, ...]) -> Response:
    if type(law).respond is answer_by_point:
        _check_answer(
            law.point(point.strain, max(state[0], point.strain), 0.0, point.energy, state[1:]), len(state) - 1
        )
    response = law.respond(point, state)
    if not isinstance(response, Response):
        raise ValueError(f"respond must return a Response({', '.join(Response._fields)})")
    return response


def _check_answer(answer: object, variables: int) -> None:
    """Of a law written for version 0.1."""
    if not isinstance(answer, tuple) or len(answer) != 5:
        raise ValueError("point must return (stress, tangent, stiffness, smooth, history)")
    if not isinstance(answer[4], tuple) or len(answer[4]) != variables:
        raise ValueError(f"history must be a tuple of {variables} numbers, as the class declares")


def _check_response(strain: float, response: Response, variables: int) -> None:
    for name in ("stress", "lateral_stress", "tangent", "stiffness", "viscosity"):
        value = getattr(response, name)
        if not math.isfinite(value):
            raise ValueError(f"{name} is {value} at strain {strain:g}; it must be finite")
    tangent, stiffness = response.tangent, response.stiffness
    if tangent < 0.0 or stiffness < 0.0 or (strain == 0.0 and stiffness == 0.0):
        raise ValueError(
            f"tangent {tangent:g} and stiffness {stiffness:g} Pa at strain {strain:g} must not be negative"
        )
    if not isinstance(response.state, tuple) or len(response.state) != variables:
        raise ValueError(f"state must be a tuple of {variables} numbers, as the class declares")
