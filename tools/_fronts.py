"""Finding the compaction front in a profile, for the scripts beside this file: numpy only."""

from typing import NamedTuple

import numpy as np

LEAST_JUMP = 0.1  # of strain: weaker fronts are elastic waves or noise
QUIET = 0.01  # of the viscosity in the front: where it falls below, the front ends


class Front(NamedTuple):
    """Zones [first, last] within the front; zones behind and ahead of it (the front runs from behind to ahead)."""

    first: int
    last: int
    behind: int
    ahead: int


def strongest_front(strain, viscosity, margin=3):
    """The front with the largest viscosity in one profile, or None where there is no clear one."""
    core = int(np.argmax(viscosity))
    if viscosity[core] <= 0.0:
        return None
    first = last = core
    while first > 0 and viscosity[first - 1] > QUIET * viscosity[core]:
        first -= 1
    while last < len(strain) - 1 and viscosity[last + 1] > QUIET * viscosity[core]:
        last += 1
    low, high = first - margin, last + margin
    if low < 0 or high >= len(strain) or abs(strain[low] - strain[high]) < LEAST_JUMP:
        return None
    forwards = strain[low] > strain[high]  # crushed on the left: it runs to the right
    return Front(first, last, low, high) if forwards else Front(first, last, high, low)


def front_coordinate(front, node_coordinate, strain):
    """Lagrangian coordinate (m) of the front by the integral measure: where a sharp step would hold the same strain."""
    low, high = sorted((front.behind, front.ahead))
    size = np.diff(node_coordinate)[low : high + 1]
    share = (strain[low : high + 1] - strain[front.ahead]) / (strain[front.behind] - strain[front.ahead])
    crushed = float(np.sum(share * size))
    return node_coordinate[low] + crushed if front.behind < front.ahead else node_coordinate[high + 1] - crushed
