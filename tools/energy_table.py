#!/usr/bin/env python3
"""The energy balance of one or several hydro1d results as a table, kJ/m^2: where did the work go?"""

import argparse

import numpy as np
from contents import BadFile, open_result, run_script

COLUMNS = ("work", "kinetic", "internal", "dissipated in fronts", "share of fronts", "imbalance")


def balance(path):
    """The values of COLUMNS at the end of a run, SI; the imbalance is the largest of the run, relative."""
    with open_result(path) as file:
        history = file["history"]
        if not len(history["history_time"]):
            raise BadFile(f"{path} holds no history yet")
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
    rows = [(path, balance(path)) for path in args.runs]
    print(f"{'run':<{wide}}" + "".join(f"{name:>22}" for name in COLUMNS))
    for path, (*energies, share, imbalance) in rows:
        cells = [f"{value / 1e3:>22.6g}" for value in energies]
        part = f"{100 * share:>20.4g} %" if share == share else f"{'–':>22}"
        print(f"{path:<{wide}}" + "".join(cells) + part + f"{imbalance:>22.1e}")


if __name__ == "__main__":
    run_script(main)
