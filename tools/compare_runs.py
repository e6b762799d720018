#!/usr/bin/env python3
"""Compare two hydro1d results of the same zoning: the largest difference of each quantity, over its largest value.

Exit code 0 if all lie within the tolerance, 1 if not, 4 if a file cannot be read.
"""

import argparse

import h5py
import numpy as np
from contents import open_result, run_script


def differences(first, second):
    """Rows (name, largest difference, largest value) for all arrays of numbers that both files have."""
    rows = []
    with open_result(first) as a, open_result(second) as b:
        names = []
        a.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
        for name in names:
            if name in b and a[name].dtype.kind == "f" and a[name].ndim >= 1:
                rows.append((name, *_difference(a[name][...], b[name][...])))
    return rows


def _difference(a, b):
    if a.shape != b.shape:
        return np.inf, np.inf
    gap = np.abs(a - b)
    gap[np.isnan(a) & np.isnan(b)] = 0.0
    gap[np.isnan(gap)] = np.inf
    finite = np.abs(a[np.isfinite(a)])
    return float(gap.max(initial=0.0)), float(finite.max(initial=0.0))


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", help="a result")
    parser.add_argument("second", help="another")
    parser.add_argument("--tolerance", type=float, default=1e-9, help="relative, default 1e-9")
    args = parser.parse_args(argv)
    rows = differences(args.first, args.second)
    worst = 0.0
    print(f"{'quantity':<34}{'largest difference':>20}{'relative':>12}")
    for name, gap, size in rows:
        relative = 0.0 if gap == 0.0 else gap / size if 0.0 < size < np.inf else np.inf
        worst = max(worst, relative)
        print(f"{name:<34}{gap:>20.6g}{relative:>12.3g}" + ("   other shape" if gap == size == np.inf else ""))
    print("the same" if worst == 0.0 else f"largest relative difference {worst:.3g}")
    return 0 if worst <= args.tolerance else 1


if __name__ == "__main__":
    run_script(main)
