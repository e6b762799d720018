"""The few operations that Python has no word for; each runs as Python here and as one machine operation when compiled.

`lowering.py` gives the compiled form of each function of this file.
"""

from __future__ import annotations

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


def larger(value: float, other: float) -> float:
    """The larger of two numbers, in any order when many are compared; who must see a NaN looks elsewhere."""
    return max(value, other)


def accumulate(total: float, value: float) -> float:
    """total + value, in any order: lets the loop keep one partial sum a vector lane."""
    return total + value


def call(functions: Sequence[Callable], which: int, *arguments: Any) -> None:
    """Call kernel number ``which`` of a table of addresses."""
    functions[which](*arguments)
