"""The x-t diagram."""

from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize, TwoSlopeNorm
from matplotlib.figure import Figure

from hydro1d.plot._base import DIVERGING, SEQUENTIAL, new_figure
from hydro1d.plot._data import RunOrPath, as_run, heading, profile_quantity, scaled, times_of
from hydro1d.plot._frames import check_frame, fronts, interfaces, length_label, length_scale
from hydro1d.plot._units import scale_for
from hydro1d.store import Run

MAX_ZONES, MAX_TIMES = 800, 600  # more than that no page shows
_LINES = {"proximal front": ("#ffffff", "-"), "distal front": ("#ffffff", "--")}


def xt(run: RunOrPath, quantity: str = "stress", frame: str = "lagrangian") -> tuple[Figure, Axes]:
    """Position to the right, time upwards, coloured by a quantity; compaction fronts and interfaces drawn.

    frame: "lagrangian" or "laboratory". Returns the Figure and its Axes. Raises FileProblem for what the run lacks.
    """
    run = as_run(run)
    figure, axes = new_figure(1, 1, (7.0, 5.0))
    draw_xt(axes[0, 0], run, quantity, frame)
    axes[0, 0].set_title(heading(run), fontsize=11)
    return figure, axes[0, 0]


def draw_xt(axes: Axes, run: Run, quantity: str = "stress", frame: str = "lagrangian") -> None:
    """The diagram with its colour bar into given axes."""
    check_frame(frame)
    times_of(run, 2)
    values = profile_quantity(run, quantity)
    if run.describe(quantity).dimensions[-1] == "node":
        values = 0.5 * (values[:, :-1] + values[:, 1:])
    scale, label = scaled(run, quantity)
    clock, length = scale_for("s", run.time), length_scale(run)
    x, t, shown = _mesh(run, values, frame)
    norm, colours, extend = _colours(shown / scale.size, rare_low=3.0 if "strain" in quantity else 0.1)
    mesh = axes.pcolormesh(
        x / length.size, t / clock.size, shown / scale.size, norm=norm, cmap=colours, rasterized=True, linewidth=0
    )
    axes.figure.colorbar(mesh, ax=axes, label=label, extend=extend, pad=0.02)
    _draw_interfaces(axes, run, frame)
    _draw_fronts(axes, run, frame)
    axes.grid(False)
    axes.set_xlabel(length_label(run, frame))
    axes.set_ylabel(clock.label("time t"))
    axes.set_ylim(run.time[0] / clock.size, run.time[-1] / clock.size)


def _mesh(run: Run, values: np.ndarray, frame: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges (m, s) of the cells and their values, thinned to what can be seen."""
    every, step = -(-values.shape[1] // MAX_ZONES), -(-len(values) // MAX_TIMES)
    cells = np.arange(0, values.shape[1], every)
    nodes = np.append(cells, values.shape[1])
    rows = np.arange(0, len(values), step)
    if frame != "lagrangian":  # the last state of a calculation that broke down may be nowhere
        rows = rows[np.isfinite(run["position"][rows]).all(axis=1)]
    time = run.time[rows]
    edges = np.concatenate([time[:1], 0.5 * (time[:-1] + time[1:]), time[-1:]])
    shown = values[rows][:, np.minimum(cells + every // 2, values.shape[1] - 1)]
    if frame == "lagrangian":
        return run["node_coordinate"][nodes], edges, shown
    position = run["position"][rows][:, nodes]
    between = np.concatenate([position[:1], 0.5 * (position[:-1] + position[1:]), position[-1:]])
    return between, np.broadcast_to(edges[:, None], between.shape), shown


def _colours(values: np.ndarray, rare_low: float) -> tuple[Normalize, Any, str]:
    """Colour range without the few cells that would squeeze it; a diverging map where a quantity takes both signs.

    `rare_low` is the share (%) of cells at the lower end that may fall out: foam without tension that opens at an end.
    """
    finite = values[np.isfinite(values)]
    if not len(finite):
        return Normalize(0.0, 1.0), SEQUENTIAL, "neither"
    low, high = (float(bound) for bound in np.percentile(finite, (rare_low, 99.7)))
    low, high = min(low, 0.0), max(high, 0.0)
    if high - low <= 0.0:
        return Normalize(0.0, 1.0), SEQUENTIAL, "neither"
    above, below = finite.max() > high + 0.02 * (high - low), finite.min() < low - 0.02 * (high - low)
    extend = ("neither", "max", "min", "both")[int(above) + 2 * int(below)]
    if -low > 0.05 * high:
        return TwoSlopeNorm(0.0, low, max(high, -0.05 * low)), DIVERGING, extend
    return Normalize(0.0, high), matplotlib.colormaps[SEQUENTIAL].with_extremes(under="#d0d0d0"), extend


def _draw_interfaces(axes: Axes, run: Run, frame: str) -> None:
    clock, length = scale_for("s", run.time).size, length_scale(run).size
    style: dict[str, Any] = {"color": "#ffffff", "linewidth": 1.0, "linestyle": ":"}
    for node in interfaces(run):
        if frame == "lagrangian":
            axes.axvline(run["node_coordinate"][node] / length, **style)
        else:
            axes.plot(run["position"][:, node] / length, run.time / clock, **style)
    if frame == "laboratory":
        for node in (0, -1):
            axes.plot(run["position"][:, node] / length, run.time / clock, color="#000000", linewidth=1.0)


def _draw_fronts(axes: Axes, run: Run, frame: str) -> None:
    clock, length = scale_for("s", run.time).size, length_scale(run).size
    handles = []
    for name, (time, where) in fronts(run, frame).items():
        colour, line = _LINES[name]
        axes.plot(where / length, time / clock, color="#000000", linewidth=2.6, alpha=0.55)
        handles += axes.plot(where / length, time / clock, color=colour, linewidth=1.3, linestyle=line, label=name)
    if handles:
        found = axes.legend(
            handles=handles, loc="upper left", fontsize=8, frameon=True, facecolor="#888888", edgecolor="none"
        )
        for text in found.get_texts():
            text.set_color("#ffffff")
