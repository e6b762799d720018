#!/usr/bin/env python3
"""Follow the strongest compaction front through the profiles of a hydro1d result: position, speed, states beside it.

The position is by the integral measure; the speed is the difference quotient of neighbouring profiles.
"""

import argparse
import sys

import h5py
import numpy as np
from _fronts import front_coordinate, strongest_front

COLUMNS = (
    "time_s",
    "coordinate_m",
    "speed_m_per_s",
    "strain_behind",
    "strain_ahead",
    "stress_behind_Pa",
    "stress_ahead_Pa",
)


def track(path):
    """Rows as in COLUMNS, shape (profiles with a front, 7)."""
    rows = []
    with h5py.File(path, "r") as file:
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
        raise ValueError(f"no compaction front in the profiles of {args.run}")
    np.savetxt(sys.stdout, table, "%.6g", ",", header=",".join(COLUMNS), comments="")


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:  # the reader has had enough
        sys.stderr.close()
    except (OSError, KeyError, ValueError) as error:
        sys.exit(f"track_front: {error}")
