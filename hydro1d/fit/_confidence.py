"""How far the fitted parameters are to be trusted."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from hydro1d.fit._models import Parameter

_CONFIDENCE = 0.95
_NEAR_BOUND = 1e-3  # of a value: closer to a bound is at it
_FACTOR = 2.0  # a parameter that can be this many times as large, or as small, for nothing is not determined


class Confidence(NamedTuple):
    """Half of each 95 % interval, infinite for the parameters of the two masks: undetermined, at_bound."""

    half_width: np.ndarray
    undetermined: np.ndarray
    at_bound: np.ndarray


def confidence(
    parameters: Sequence[Parameter],
    values: np.ndarray,
    jacobian: np.ndarray,
    difference: Callable[[np.ndarray], np.ndarray],
) -> Confidence:
    """Intervals from the linearised covariance, and where they would deceive.

    A parameter at its bound has no interval, and the others are judged as if it were known. One is undetermined if its
    interval reaches zero, or if `difference`, law − measured as it was minimised, hardly changes when it is doubled or
    halved: behind a corner of the curve the linearised interval does not see that.
    """
    at_bound = np.array([_is_at_bound(parameter, value) for parameter, value in zip(parameters, values, strict=True)])
    residuals = difference(values)
    half = np.full(len(values), np.inf)
    half[~at_bound] = _half_widths(residuals, jacobian[:, ~at_bound])
    flat = [_is_flat(k, parameter, values, residuals, difference) for k, parameter in enumerate(parameters)]
    undetermined = ~at_bound & (~(half < np.abs(values)) | np.array(flat))
    half[undetermined] = np.inf
    return Confidence(half, undetermined, at_bound)


def _is_at_bound(parameter: Parameter, value: float) -> bool:
    """Whether a parameter stands at an end of its range; the optimiser stops a little short of it."""
    near = _NEAR_BOUND * min(abs(parameter.high - parameter.low), abs(value))
    return bool(value - parameter.low <= near or parameter.high - value <= near)


def _is_flat(
    k: int,
    parameter: Parameter,
    values: np.ndarray,
    residuals: np.ndarray,
    difference: Callable[[np.ndarray], np.ndarray],
) -> bool:
    """Whether the fit is as good, within the noise, with one parameter a factor larger or smaller."""
    freedom = max(len(residuals) - len(values), 1)
    least = float(residuals @ residuals)
    allowed = least * (1.0 + _quantile(freedom) ** 2 / freedom) + 1e-30
    for factor in (_FACTOR, 1.0 / _FACTOR):
        moved = values.copy()
        moved[k] = values[k] * factor
        if not parameter.low < moved[k] < parameter.high:
            continue
        changed = difference(moved)
        if float(changed @ changed) <= allowed:
            return True
    return False


def _half_widths(differences: np.ndarray, jacobian: np.ndarray) -> np.ndarray:
    """Half of each 95 % interval, from the linearised covariance; infinite where the curve says nothing."""
    size = np.linalg.norm(jacobian, axis=0)
    sensitive = size > 0.0
    half = np.full(len(size), np.inf)
    if not sensitive.any():
        return half
    freedom = max(len(differences) - int(sensitive.sum()), 1)
    variance = float(differences @ differences) / freedom
    _, singular, right = np.linalg.svd(jacobian[:, sensitive] / size[sensitive], full_matrices=False)
    inverse = np.divide(1.0, singular, out=np.full(len(singular), np.inf), where=singular > 1e-12 * singular[0])
    with np.errstate(invalid="ignore"):
        spread = np.sqrt(np.nansum((right.T * inverse) ** 2, axis=1) * variance)
    half[sensitive] = _quantile(freedom) * spread / size[sensitive]
    return half


def _quantile(freedom: int) -> float:
    from scipy.stats import t as student

    return float(student.ppf(0.5 + 0.5 * _CONFIDENCE, freedom))
