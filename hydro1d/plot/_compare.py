"""Several runs in the same axes."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hydro1d.errors import DeckError
from hydro1d.plot._base import PALETTE, keep_in_view, legend, new_figure
from hydro1d.plot._data import RunOrPath, as_run, name_of, nearest, profile_quantity, state_of, times_of
from hydro1d.plot._frames import along
from hydro1d.plot._histories import MAX_ROWS, _bulk, extremes
from hydro1d.plot._units import scale_for, words
from hydro1d.store import Run

QUANTITIES = ("right_stress", "left_velocity", "strain")


def compare(
    runs: Sequence[RunOrPath],
    quantities: Sequence[str] = QUANTITIES,
    time: float | None = None,
    labels: Sequence[str] | None = None,
) -> tuple[Figure, np.ndarray]:
    """Several runs in the same axes, a panel for each quantity.

    A quantity of the history is drawn over time, one of the profiles over the column at `time` (s; without, in the
    last one of each run). Returns the Figure and its Axes (panels,). Raises FileProblem for what a run does not have.
    """
    opened = [as_run(run) for run in runs]
    if not opened:
        raise DeckError("nothing to compare: no run given")
    names = list(labels) if labels is not None else labels_of(opened)
    figure, axes = new_figure(len(quantities), 1, (7.2, 0.8 + 2.2 * len(quantities)))
    for one, quantity in zip(axes[:, 0], quantities, strict=True):
        if all(quantity in run.history for run in opened):
            _histories(one, opened, names, quantity)
        else:
            _profiles(one, opened, names, quantity, time)
    legend(axes[0, 0])
    return figure, axes[:, 0]


def labels_of(runs: Sequence[Run]) -> list[str]:
    """What to call the runs: by title where titles differ, else by file."""
    titles = [run.title for run in runs]
    if len(set(titles)) == len(runs) and all(titles):
        names = [title.replace("$", r"\$")[:60] for title in titles]
    else:
        names = [
            run.path.stem if run.path is not None else f"{run.title or 'run'} {k + 1}" for k, run in enumerate(runs)
        ]
    return [name + state_of(run) for name, run in zip(names, runs, strict=True)]


def _histories(axes: Axes, runs: Sequence[Run], names: Sequence[str], quantity: str) -> None:
    clock = scale_for("s", [run.history["time"] for run in runs])
    usual = [_bulk(run.history[quantity]) for run in runs]
    scale = scale_for(runs[0].describe(f"history/{quantity}").units, usual)
    for place, (run, name) in enumerate(zip(runs, names, strict=True)):
        time, values = extremes(run.history["time"], run.history[quantity], MAX_ROWS)
        axes.plot(time / clock.size, values / scale.size, color=PALETTE[place % 8], linewidth=1.2, label=name)
    axes.set_xlabel(clock.label("time t"))
    axes.set_ylabel(scale.label(words(quantity)))


def _profiles(axes: Axes, runs: Sequence[Run], names: Sequence[str], quantity: str, time: float | None) -> None:
    values = [profile_quantity(run, quantity) for run in runs]
    scale, length = scale_for(runs[0].describe(quantity).units, values), scale_for("m", runs[0]["node_coordinate"])
    for place, (run, name) in enumerate(zip(runs, names, strict=True)):
        index = len(times_of(run)) - 1 if time is None else nearest(run.time, [time], name_of(run))[0]
        x = along(run, quantity, index, "lagrangian") / length.size
        axes.plot(x, values[place][index] / scale.size, color=PALETTE[place % 8], linewidth=1.2, label=name)
    keep_in_view(axes, np.concatenate([value[-1] for value in values]) / scale.size)
    when = "in the last profile" if time is None else f"at {scale_for('s', runs[0].time).show(time)}"
    axes.set_xlabel(length.label("Lagrangian coordinate X"))
    axes.set_ylabel(scale.label(f"{words(quantity)} {when}"))
