"""The few operations that Python has no word for; each runs as Python here and as one machine operation when compiled.

`lowering.py` gives the compiled form of each function of this file.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from typing import Any


def offset(pointer: Any, start: int) -> Any:
    """The array that begins at element ``start``."""
    return pointer[start:]


def gather(pointer: Any, start: int, stride: int, count: Any) -> tuple[float, ...]:
    """``count`` elements of ``pointer`` from ``start`` on, ``stride`` apart (``count`` is a tuple of that length)."""
    return tuple(pointer[start + k * stride] for k in range(len(count)))


def scatter(pointer: Any, start: int, stride: int, values: tuple[float, ...]) -> None:
    """Store ``values`` where `gather` finds them."""
    for k, value in enumerate(values):
        pointer[start + k * stride] = value


def order(value: float) -> int:
    """An integer that sorts as the float does (NaN on top): unlike a float maximum, its reduction vectorises.

    Negative floats sort below all others, among themselves in reverse, which a running maximum from 0 never sees.
    """
    return struct.unpack("<q", struct.pack("<d", abs(value) if math.isnan(value) else value))[0]


def unorder(bits: int) -> float:
    """The float of an `order`."""
    return struct.unpack("<d", struct.pack("<q", bits))[0]


def accumulate(total: float, value: float) -> float:
    """total + value, in any order: lets the loop keep one partial sum a vector lane."""
    return total + value


def call(functions: Sequence[Callable], which: int, *arguments: Any) -> None:
    """Call kernel number ``which`` of a table of addresses."""
    functions[which](*arguments)
