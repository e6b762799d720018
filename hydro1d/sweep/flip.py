"""Bisection for the number at which a yes/no answer changes."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from hydro1d.errors import Hydro1dError


class NoFlip(Hydro1dError):
    """The answer is the same at every number tried in the bracket."""

    exit_code = 2

    def __init__(self, text: str, answer: bool, evaluations: list[tuple[float, bool]]) -> None:
        self.answer, self.evaluations = answer, evaluations
        super().__init__(text)


@dataclass(frozen=True)
class Flip:
    """The answer changes between `low` and `high`: from `before` to its opposite.

    `evaluations` holds every (value, answer) in the order of the search; `monotonic` is False when they show more
    than one change, and then this is the lowest one.
    """

    low: float
    high: float
    before: bool
    monotonic: bool
    evaluations: list[tuple[float, bool]] = field(repr=False)

    @property
    def value(self) -> float:
        """Middle of what is left of the bracket."""
        return 0.5 * (self.low + self.high)


def scan_points(low: float, high: float, scan: int, spacing: str = "linear") -> list[float]:
    """``scan`` values from low to high, both included."""
    make = np.geomspace if spacing == "log" else np.linspace
    return [low, *(float(value) for value in make(low, high, scan)[1:-1]), high]


def find_flip(
    decide: Callable[[float], bool | None],
    low: float,
    high: float,
    *,
    tolerance: float = 1e-3,
    scan: int = 5,
    spacing: str = "linear",
    shown: Callable[[float], str] = "{:.6g}".format,
) -> Flip:
    """Bracket the change of ``decide`` between low and high to a relative ``tolerance``.

    ``scan`` evaluations spread over the whole bracket come first and show whether there is just one change; bisection
    follows. None for an answer means that there is none; such values of the scan are left out. ``shown`` writes
    values in messages. Raises NoFlip if all agree, and if bisection meets a None.
    """
    answers = [(value, decide(value)) for value in scan_points(low, high, max(scan, 2), spacing)]
    evaluations = [(value, bool(answer)) for value, answer in answers if answer is not None]
    if not evaluations:
        raise NoFlip(f"there is no answer from {shown(low)} to {shown(high)}", False, [])
    changes = [k for k in range(len(evaluations) - 1) if evaluations[k][1] != evaluations[k + 1][1]]
    if not changes:
        answer = evaluations[0][1]
        text = f"the outcome is {'yes' if answer else 'no'} from {shown(low)} to {shown(high)}: nothing flips in this bracket"
        raise NoFlip(text, answer, evaluations)
    before = evaluations[changes[0]][1]
    (a, _), (b, _) = evaluations[changes[0]], evaluations[changes[0] + 1]
    while abs(b - a) > tolerance * max(abs(a), abs(b)):
        middle = 0.5 * (a + b)
        if middle in (a, b):
            break
        found = decide(middle)
        if found is None:
            raise NoFlip(f"there is no answer at {shown(middle)}, between no and yes", before, evaluations)
        answer = bool(found)
        evaluations.append((middle, answer))
        a, b = (middle, b) if answer == before else (a, middle)
    return Flip(min(a, b), max(a, b), before if a <= b else not before, len(changes) == 1, evaluations)
