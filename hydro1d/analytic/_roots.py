"""Vectorised root finding for monotone functions."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, Flags

_HALVINGS = 70  # past 2**-53 of the bracket, so that the result is exact to the last bit or two


def bisect(rises_above: Callable[[Array], Flags], low: ArrayLike, high: ArrayLike) -> Array:
    """Where `rises_above` (a boolean array, False then True along the bracket) changes, elementwise.

    Bisection and not Newton: the functions here have kinks, and square-root ends where fronts stop.
    """
    lower, upper = (np.array(side, dtype=float) for side in np.broadcast_arrays(low, high))
    for _ in range(_HALVINGS):
        middle = 0.5 * (lower + upper)
        above = np.asarray(rises_above(middle), dtype=bool)
        upper = np.where(above, middle, upper)
        lower = np.where(above, lower, middle)
    return 0.5 * (lower + upper)
