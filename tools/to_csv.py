#!/usr/bin/env python3
"""Write a hydro1d result as CSV: the history, the probes, or the profiles at one time, one column a quantity."""

import argparse
import contextlib
import sys

import h5py
import numpy as np
from contents import BadFile, open_result, run_script


def columns_of(file, what, time=None):
    """Names with units and the arrays of one table: "history", "probes", "zones" or "nodes"."""
    if what in ("history", "probes"):
        if what not in file:
            raise BadFile(f"no {what} in {file.filename}")
        return _group(file[what])
    stored = file["time"][:]
    row = len(stored) - 1 if time is None else int(np.argmin(np.abs(stored - time)))
    dimension = what[:-1]  # "zone" or "node"
    names = [name for name in file if isinstance(file[name], h5py.Dataset)]
    columns = {_label(file[f"{dimension}_coordinate"]): file[f"{dimension}_coordinate"][:]}
    for name in names:
        data = file[name]
        if data.ndim == 2 and data.shape == (len(stored), file[dimension].size) and _over(data, dimension):
            columns[_label(data)] = data[row]
    return columns, float(stored[row])


def _group(group):
    columns = {}
    for data in group.values():
        if data.ndim == 1 and len(data) == len(group["history_time"]):
            columns[_label(data)] = data[:]
        elif data.ndim == 2:
            columns |= {f"{_label(data)} probe {k}": data[:, k] for k in range(data.shape[1])}
    first = _label(group["history_time"])
    return {first: columns.pop(first), **columns}, None


def _over(data, dimension):
    scales = data.dims[1].values()
    return any(scale.name.rpartition("/")[2] == dimension for scale in scales)


def _label(data):
    return f"{data.name.rpartition('/')[2]} ({data.attrs.get('units', '1')})"


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", help="a result, RUN.h5")
    parser.add_argument("what", nargs="?", default="history", choices=("history", "probes", "zones", "nodes"))
    parser.add_argument(
        "-t", "--time", type=float, help="time of the profile, s; the nearest is taken, default the last"
    )
    parser.add_argument("-o", "--output", help="default: standard output")
    args = parser.parse_args(argv)
    with open_result(args.run) as file:
        columns, time = columns_of(file, args.what, args.time)
    with open(args.output, "w") if args.output else contextlib.nullcontext(sys.stdout) as stream:
        if time is not None:
            print(f"# time {time:.9g} s", file=stream)
        np.savetxt(stream, np.column_stack(list(columns.values())), "%.9g", ",", header=",".join(columns), comments="")


if __name__ == "__main__":
    run_script(main)
