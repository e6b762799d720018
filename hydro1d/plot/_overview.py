"""One figure that says what happened."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from hydro1d.plot._base import as_run, heading, legend, new_figure
from hydro1d.plot._frames import length_label
from hydro1d.plot._histories import clock_of, draw_history
from hydro1d.plot._hugoniot import draw_hugoniot
from hydro1d.plot._profiles import chosen_times, draw_profiles
from hydro1d.plot._xt import draw_xt

if TYPE_CHECKING:
    from pathlib import Path

    from hydro1d.deck import Deck
    from hydro1d.plot._base import RunOrPath


def overview(run: RunOrPath, deck: Deck | str | Path | None = None) -> tuple[Figure, np.ndarray]:
    """The x-t diagram, stresses on the ends, profiles of stress and the Hugoniot plane. Axes (2, 2)."""
    run = as_run(run)
    figure, axes = new_figure(2, 2, (12.0, 8.0))
    draw_xt(axes[0, 0], run)
    draw_history(axes[0, 1], run, ("left_stress", "right_stress"), "stress on the ends")
    axes[0, 1].set_xlabel(clock_of(run).label("time t"))
    draw_profiles(axes[1, 0], run, "stress", chosen_times(run), "lagrangian")
    axes[1, 0].set_xlabel(length_label(run, "lagrangian"))
    legend(axes[1, 0], title="time", title_fontsize=8)
    draw_hugoniot(axes[1, 1], run, deck=deck)
    figure.suptitle(heading(run), fontsize=12)
    return figure, axes
