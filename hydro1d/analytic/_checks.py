"""Validation shared by the analytic solutions: one message format, NaN never passes."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def require(condition: bool, name: str, value: object, allowed: str) -> None:
    """Raise ValueError naming the parameter, its value and what is allowed, unless `condition` holds."""
    if not condition:
        raise ValueError(f"{name} = {value!r} is not allowed: {name} must be {allowed}")


def positive(solution: object, *names: str) -> None:
    """Require the named attributes to be finite and greater than zero."""
    for name in names:
        value = getattr(solution, name)
        require(math.isfinite(value) and value > 0.0, name, value, "finite and greater than 0")


def not_negative(solution: object, *names: str) -> None:
    """Require the named attributes to be finite and at least zero."""
    for name in names:
        value = getattr(solution, name)
        require(math.isfinite(value) and value >= 0.0, name, value, "finite and at least 0")


def between(solution: object, name: str, low: float, high: float) -> None:
    """Require low < attribute < high."""
    value = getattr(solution, name)
    require(low < value < high, name, value, f"between {low:g} and {high:g}, both excluded")


def length_allowed(length: float) -> None:
    """Require a positive column length; infinite stands for a half-space."""
    require(length > 0.0, "length", length, "greater than 0 (infinite for a half-space)")


def times(t: ArrayLike, end: float = math.inf, reason: str = "") -> Array:
    """Times as an array, all in [0, end]; `reason` says why the solution ends there."""
    why = f" ({reason})" if reason and math.isfinite(end) else ""
    return _within("t", t, end, f"within [0, {end:.9g}] s{why}")


def coordinates(coordinate: ArrayLike, length: float) -> Array:
    """Lagrangian coordinates as an array, all in [0, length]."""
    return _within("coordinate", coordinate, length, f"within [0, {length:.9g}] m")


def finite(name: str, values: ArrayLike) -> Array:
    """Any finite numbers as an array."""
    array = np.asarray(values, dtype=float)
    _require_all(np.isfinite(array), name, array, "finite")
    return array


def _within(name: str, values: ArrayLike, end: float, allowed: str) -> Array:
    array = np.asarray(values, dtype=float)
    _require_all((array >= 0.0) & (array <= end), name, array, allowed)
    return array


def _require_all(good: Flags, name: str, values: Array, allowed: str) -> None:
    """As `require`, for arrays: the message shows the first value that is not allowed."""
    if not np.all(good):
        require(False, name, float(values[~good].flat[0]), allowed)
