"""Profiles along the column at chosen times."""

from collections.abc import Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hydro1d.plot._base import GREY, SEQUENTIAL, keep_in_view, new_figure
from hydro1d.plot._data import RunOrPath, as_run, heading, name_of, nearest, profile_quantity, scaled, times_of
from hydro1d.plot._frames import along, check_frame, interfaces, length_label, length_scale
from hydro1d.plot._units import scale_for
from hydro1d.store import Run

QUANTITIES = ("stress", "strain", "velocity")
SHOWN = 7


def profiles(
    run: RunOrPath,
    quantities: Sequence[str] = QUANTITIES,
    times: Sequence[float] | None = None,
    frame: str = "lagrangian",
) -> tuple[Figure, np.ndarray]:
    """Quantities along the column, one panel each, a line a time.

    times (s): the nearest stored ones are drawn; without, seven spread over the run. frame: "lagrangian" or
    "laboratory".
    Returns the Figure and its Axes (panels,). Raises FileProblem for what the run does not have.
    """
    run = as_run(run)
    chosen = chosen_times(run, times)
    figure, axes = new_figure(len(quantities), 1, (7.0, 0.9 + 2.1 * len(quantities)), sharex=True)
    for one, quantity in zip(axes[:, 0], quantities, strict=True):
        draw_profiles(one, run, quantity, chosen, frame)
    axes[-1, 0].set_xlabel(length_label(run, frame))
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right upper", frameon=False, fontsize=8, title="time", title_fontsize=8)
    figure.suptitle(heading(run), fontsize=11)
    return figure, axes[:, 0]


def chosen_times(run: Run, times: Sequence[float] | None = None) -> list[int]:
    """Indices of the profiles to draw."""
    time = times_of(run)
    usual = np.linspace(time[0], time[-1], SHOWN + 1)[1:] if len(time) > SHOWN else time
    return nearest(time, [float(value) for value in (usual if times is None else times)], name_of(run))


def draw_profiles(axes: Axes, run: Run, quantity: str, chosen: Sequence[int], frame: str) -> list[Any]:
    """Lines of one quantity at the profiles `chosen`."""
    values = profile_quantity(run, quantity)[list(chosen)]
    check_frame(frame)
    scale, label = scaled(run, quantity, values)
    clock, colours = scale_for("s", run.time), matplotlib.colormaps[SEQUENTIAL]
    lines = []
    for place, index in enumerate(chosen):
        colour = colours(0.92 * place / max(len(chosen) - 1, 1))
        x = along(run, quantity, index, frame) / length_scale(run).size
        text = clock.show(float(run.time[index]), 3)
        lines += axes.plot(x, values[place] / scale.size, color=colour, linewidth=1.3, label=text)
    if frame == "lagrangian":
        for node in interfaces(run):
            where = run["node_coordinate"][node] / length_scale(run).size
            axes.axvline(where, color=GREY, linewidth=0.8, linestyle=":")
    axes.set_ylabel(label)
    axes.margins(x=0.01)
    keep_in_view(axes, values / scale.size)
    return lines
