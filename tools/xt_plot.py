#!/usr/bin/env python3
"""Draw the x-t diagram of a hydro1d result with h5py, numpy and matplotlib alone: a start for figures of your own."""

import argparse

import numpy as np
from contents import BadFile, open_result, run_script
from matplotlib.figure import Figure


def xt_figure(path, quantity="stress", laboratory=False):
    """A matplotlib Figure: position to the right, time upwards, colour by a quantity over (time, zone)."""
    with open_result(path) as file:
        if quantity not in file or file[quantity].ndim != 2:
            raise BadFile(f"no profiles of {quantity!r} in {path}")
        time, values = file["time"][:], file[quantity][:]
        units, text = file[quantity].attrs["units"], file[quantity].attrs["long_name"]
        nodes = (
            file["position"][:] if laboratory else np.broadcast_to(file["node_coordinate"][:], file["position"].shape)
        )
    if len(time) < 2:
        raise BadFile(f"{path} holds fewer than two profiles")
    if values.shape[1] == nodes.shape[1]:  # over nodes: to the zones between
        values = 0.5 * (values[:, :-1] + values[:, 1:])
    centres = 0.5 * (nodes[:, :-1] + nodes[:, 1:])
    figure = Figure(figsize=(7, 5), layout="constrained")
    axes = figure.subplots()
    clock = np.broadcast_to(time[:, None], centres.shape)
    mesh = axes.pcolormesh(centres * 1e3, clock * 1e3, values, shading="nearest", cmap="viridis", rasterized=True)
    figure.colorbar(mesh, label=f"{text} ({units})")
    axes.set_xlabel(f"{'position x' if laboratory else 'Lagrangian coordinate X'} (mm)")
    axes.set_ylabel("time t (ms)")
    return figure


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", help="a result, RUN.h5")
    parser.add_argument("-q", "--quantity", default="stress", help="default stress")
    parser.add_argument("--laboratory", action="store_true", help="positions in the laboratory, not in the material")
    parser.add_argument("-o", "--output", default="xt.png", help="PNG, SVG or PDF; default xt.png")
    args = parser.parse_args(argv)
    if not args.output.endswith((".png", ".svg", ".pdf")):
        parser.error(f"{args.output}: a figure's name ends in .png, .svg or .pdf")
    xt_figure(args.run, args.quantity, args.laboratory).savefig(args.output, dpi=150)
    print(args.output)


if __name__ == "__main__":
    run_script(main)
