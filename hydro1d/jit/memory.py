"""Where arrays lie in memory."""

from __future__ import annotations

import numpy as np

LINE, _PAGE = 8, 512  # of a cache line and of a page, in floats


def placed(array: np.ndarray, place: int, first: int = 0) -> np.ndarray:
    """A copy whose element ``first`` begins a cache line: a store of a whole vector across two lines costs many.

    Copies with different ``place`` begin at different offsets within a page: a processor takes a load for a repetition of
    an earlier store if their addresses agree up to there, and waits.
    """
    source = np.asarray(array, dtype=float)
    buffer = np.empty(source.size + _PAGE)
    start = (place * 5 * LINE - first - buffer.ctypes.data // 8) % _PAGE
    copy = buffer[start : start + source.size].reshape(source.shape)
    copy[...] = source
    return copy
