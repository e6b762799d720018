"""What a series of runs, or of values in time, shows: orders, limits, means and crossings."""

import numpy as np
from numpy.typing import ArrayLike


def mean_over(t: ArrayLike, values: ArrayLike, start: float, end: float) -> float:
    """Mean over a stretch of time of values that are linear between the times."""
    t, values = np.asarray(t, dtype=float), np.asarray(values, dtype=float)
    inside = (t > start) & (t < end)
    times = np.concatenate([[start], t[inside], [end]])
    return float(np.trapezoid(np.interp(times, t, values), times) / (end - start))


def order(zones: ArrayLike, errors: ArrayLike) -> float:
    """Observed order: slope of the least-squares line through log error against log zone size."""
    values = np.maximum(np.abs(np.asarray(errors, dtype=float)), 1e-300)
    return float(-np.polyfit(np.log(np.asarray(zones, dtype=float)), np.log(values), 1)[0])


def extrapolate(parameters: ArrayLike, values: ArrayLike, power: float) -> float:
    """Limit of values that approach it as parameter^(−power): the least-squares line in that variable, at zero."""
    return float(np.polyfit(np.asarray(parameters, dtype=float) ** -power, np.asarray(values, dtype=float), 1)[1])


def crossing(t: ArrayLike, values: ArrayLike, level: float = 0.0) -> float:
    """First time at which values fall to a level, by linear interpolation; NaN if they never do."""
    t, values = np.asarray(t, dtype=float), np.asarray(values, dtype=float)
    below = np.flatnonzero((values[1:] <= level) & (values[:-1] > level))
    if not len(below):
        return float("nan")
    k = int(below[0])
    return float(t[k] + (t[k + 1] - t[k]) * (values[k] - level) / (values[k] - values[k + 1]))
