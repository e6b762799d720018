#!/usr/bin/env python3
"""The energy balance of one or several hydro1d results as a table, kJ/m^2: where did the work go?"""

import argparse
import sys

import h5py
import numpy as np

COLUMNS = ("work", "kinetic", "internal", "dissipated in fronts", "share of fronts", "imbalance")


def balance(path):
    """The values of COLUMNS at the end of a run, SI; the imbalance is the largest of the run, relative."""
    with h5py.File(path, "r") as file:
        history = file["history"]
        kinetic, internal = history["kinetic_energy"][:], history["internal_energy"][:]
        work, viscous = history["boundary_work"][-1], history["viscous_work"][-1]
        imbalance = np.nanmax(np.abs(history["energy_error"][:]))
    gain = internal[-1] - internal[0]
    share = viscous / gain if gain > 0.0 else np.nan
    return work, kinetic[-1], internal[-1], viscous, share, imbalance


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", nargs="+", help="results")
    args = parser.parse_args(argv)
    wide = max(len(name) for name in args.runs) + 2
    print(f"{'run':<{wide}}" + "".join(f"{name:>22}" for name in COLUMNS))
    for path in args.runs:
        *energies, share, imbalance = balance(path)
        cells = [f"{value / 1e3:>22.6g}" for value in energies]
        print(f"{path:<{wide}}" + "".join(cells) + f"{100 * share:>20.4g} %" + f"{imbalance:>22.1e}")


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:  # the reader has had enough
        sys.stderr.close()
    except (OSError, KeyError, ValueError) as error:
        sys.exit(f"energy_table: {error}")
