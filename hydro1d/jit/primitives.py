"""The few operations that Python has no word for; each runs as Python here and as one machine operation when compiled.

`lowering.py` gives the compiled form of each function of this file.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any


def at(records: Any, k: int) -> Any:
    """Record number ``k`` of a row of records."""
    return records[k]


def gather(array: Any, start: int, stride: int, count: tuple) -> tuple[float, ...]:
    """Elements of ``array`` from ``start`` on, ``stride`` apart; ``count`` is a tuple of as many."""
    return tuple(array[start + k * stride] for k in range(len(count)))


def scatter(array: Any, start: int, stride: int, values: tuple[float, ...]) -> None:
    """Store ``values`` where `gather` finds them."""
    for k, value in enumerate(values):
        array[start + k * stride] = value


def larger(value: float, other: float) -> float:
    """The larger of two numbers, in any order when many are compared; who must see a NaN looks elsewhere."""
    return max(value, other)


def accumulate(total: float, value: float) -> float:
    """total + value, in any order: lets a loop keep one partial sum a vector lane."""
    return total + value


def call(passes: Sequence[Callable], which: int, *integers: int) -> None:
    """Call pass number ``which`` with four integers; it works on what its caller works on.

    What it raises ends its caller too.
    """
    passes[which](*integers)
