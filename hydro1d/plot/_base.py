"""What all figures share: how they look, how they are written."""

import io
import os
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hydro1d.errors import DeckError, file_problems
from hydro1d.plot._matplotlib import without_latex

# Okabe & Ito's colours, told apart by colour-blind readers; black is for laws and theory.
PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8C6D31", "#000000")
GREY = "#777777"
SEQUENTIAL, DIVERGING = "viridis", "RdBu_r"
FORMATS = (".png", ".svg", ".pdf")


class Picture(Figure):
    """A matplotlib Figure that a notebook shows by itself; no pyplot, hence no global state, and no LaTeX."""

    def draw(self, renderer: Any) -> None:
        """Draw on a canvas."""
        with without_latex(self):
            super().draw(renderer)

    def savefig(self, *arguments: Any, **options: Any) -> None:
        """Write a file, as Figure does."""
        with without_latex(self):
            super().savefig(*arguments, **options)

    def _repr_png_(self) -> bytes:
        stream = io.BytesIO()
        self.savefig(stream, format="png", dpi=100)
        return stream.getvalue()


def new_figure(
    rows: int = 1, columns: int = 1, size: tuple[float, float] = (6.4, 4.0), **options: Any
) -> tuple[Any, Any]:
    """A Picture and its Axes, an array (rows, columns); `size` in inches."""
    figure = Picture(figsize=size, layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    for one in axes.flat:
        dress(one)
    return figure, axes


def dress(axes: Axes) -> None:
    """The common look of all axes."""
    axes.set_prop_cycle(color=list(PALETTE))
    axes.grid(True, color="#e4e4e4", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(GREY)
    axes.tick_params(color=GREY, labelsize=9)
    axes.xaxis.label.set_fontsize(10)
    axes.yaxis.label.set_fontsize(10)


def legend(axes: Axes, **options: Any) -> None:
    """A legend without a frame, if anything is labelled."""
    if axes.get_legend_handles_labels()[0]:
        look = {"fontsize": 8, "frameon": True, "framealpha": 0.85, "edgecolor": "none", "borderpad": 0.2}
        axes.legend(**{**look, **options})


def keep_in_view(axes: Axes, values: np.ndarray) -> None:
    """Limit the vertical axis where a few values lie many times farther out than all the rest.

    A foam that bears no tension opens without bound at a free end; its strain there must not flatten all other lines.
    """
    finite = values[np.isfinite(values)]
    if not len(finite):
        return
    low, high = (float(bound) for bound in np.percentile(finite, (0.5, 99.5)))
    reach = high - low
    if reach <= 0.0:
        return
    least, most = float(finite.min()), float(finite.max())
    if least < low - 3.0 * reach or most > high + 3.0 * reach:
        bottom = low if least < low - 3.0 * reach else least
        top = high + 0.2 * reach if most > high + 3.0 * reach else most
        axes.set_ylim(bottom - 0.06 * reach, top + 0.06 * reach)


def save(figure: Figure, path: str | os.PathLike[str], dpi: int = 150) -> Path:
    """Write PNG, SVG or PDF, by the name's ending. Raises DeckError for another ending, FileProblem for a bad place."""
    target = Path(path)
    if target.suffix.lower() not in FORMATS:
        raise DeckError(f"{target}: a figure's name ends in {', '.join(FORMATS)}")
    dates = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(target.suffix.lower())
    with file_problems("write", target), matplotlib.rc_context({"svg.hashsalt": "hydro1d"}):
        figure.savefig(target, dpi=dpi, metadata=dates)
    return target
