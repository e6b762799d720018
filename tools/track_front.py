#!/usr/bin/env python3
"""Follow the strongest compaction front through the profiles of a hydro1d result: position, speed, states beside it.

The position is by the integral measure; the speed is the difference quotient of neighbouring profiles.
"""

import argparse
import sys
from typing import NamedTuple

import numpy as np
from contents import BadFile, open_result, run_script

COLUMNS = (
    "time_s",
    "coordinate_m",
    "speed_m_per_s",
    "strain_behind",
    "strain_ahead",
    "stress_behind_Pa",
    "stress_ahead_Pa",
)


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


def track(path):
    """Rows as in COLUMNS, shape (profiles with a front, 7)."""
    rows = []
    with open_result(path) as file:
        nodes, time = file["node_coordinate"][:], file["time"][:]
        for index in range(len(time)):
            strain, stress = file["strain"][index], file["stress"][index]
            front = strongest_front(strain, file["viscosity"][index])
            if front is not None:
                sides = (strain[front.behind], strain[front.ahead], stress[front.behind], stress[front.ahead])
                rows.append((time[index], front_coordinate(front, nodes, strain), np.nan, *sides))
    table = np.array(rows).reshape(-1, len(COLUMNS))
    if len(table) > 1:
        table[:, 2] = np.gradient(table[:, 1], table[:, 0])
    return table


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="a result, RUN.h5")
    args = parser.parse_args(argv)
    table = track(args.run)
    if not len(table):
        raise BadFile(f"no compaction front in the profiles of {args.run}")
    np.savetxt(sys.stdout, table, "%.6g", ",", header=",".join(COLUMNS), comments="")


if __name__ == "__main__":
    run_script(main)
