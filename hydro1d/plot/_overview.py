"""The overview of a run: four panels in one figure."""

from collections.abc import Callable
from pathlib import Path
from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hydro1d.deck import Deck
from hydro1d.errors import FileProblem
from hydro1d.plot._base import GREY, legend, new_figure
from hydro1d.plot._data import RunOrPath, as_run, heading
from hydro1d.plot._frames import length_label
from hydro1d.plot._histories import END_STRESSES, clock_of, draw_history
from hydro1d.plot._hugoniot import draw_hugoniot
from hydro1d.plot._profiles import chosen_times, draw_profiles
from hydro1d.plot._xt import draw_xt
from hydro1d.store import Run


def overview(run: RunOrPath, deck: Deck | str | Path | None = None) -> tuple[Figure, np.ndarray]:
    """The x-t diagram, stresses on the ends, profiles of stress and the Hugoniot plane. Axes (2, 2).

    A panel for which a partial result holds too little says so. Raises FileProblem where that is every panel.
    """
    run = as_run(run)
    figure, axes = new_figure(2, 2, (12.0, 8.0))
    panels: list[Callable[[Axes], None]] = [
        lambda one: draw_xt(one, run),
        lambda one: _ends(one, run),
        lambda one: _profiles(one, run),
        lambda one: draw_hugoniot(one, run, deck=deck),
    ]
    lacking = [error for one, panel in zip(axes.flat, panels, strict=True) if (error := _drawn(one, panel)) is not None]
    if len(lacking) == len(panels):
        raise lacking[0]
    figure.suptitle(heading(run), fontsize=12)
    return figure, axes


def _drawn(axes: Axes, panel: Callable[[Axes], None]) -> FileProblem | None:
    """Draw a panel, or say in its place what the run lacks."""
    try:
        panel(axes)
    except FileProblem as error:
        axes.clear()
        axes.set_axis_off()
        axes.text(0.5, 0.5, fill(str(error), 60), ha="center", va="center", fontsize=9, color=GREY)
        return error
    return None


def _ends(axes: Axes, run: Run) -> None:
    axes.set_xlabel(clock_of(run).label("time t"))
    draw_history(axes, run, END_STRESSES, "stress on the ends")


def _profiles(axes: Axes, run: Run) -> None:
    draw_profiles(axes, run, "stress", chosen_times(run), "lagrangian")
    axes.set_xlabel(length_label(run, "lagrangian"))
    legend(axes, title="time", title_fontsize=8)
