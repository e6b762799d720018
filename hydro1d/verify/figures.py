"""Figures of the report as inline SVG, drawn by matplotlib without a display."""

import io
import re
from typing import Any

import numpy as np

from hydro1d.plot import Picture
from hydro1d.verify.rows import Line, Panel

EXACT, RUNS = "#222222", ("#1769aa", "#d1495b", "#3a7d44", "#8d6a9f", "#c98b1d", "#4f9da6")
TINY = 1e-18  # what a logarithmic axis shows in place of zero
MAX_COLUMNS = 3
MAX_POINTS = 700  # of a line: a figure as wide as a column of text shows no more


def svg(panels: tuple[Panel, ...], prefix: str) -> str:
    """All panels of a case, three abreast; ``prefix`` keeps the ids of several figures on one page apart."""
    import matplotlib

    style: Any = {
        "svg.fonttype": "none",
        "svg.hashsalt": prefix,
        "font.family": "sans-serif",
        "font.size": 9.0,
        "axes.titlesize": 9.5,
    }
    columns = min(len(panels), MAX_COLUMNS)
    rows = -(-len(panels) // columns)
    with matplotlib.rc_context(style):
        figure = Picture(figsize=(4.6 * columns, 3.3 * rows), layout="constrained")
        grid = np.atleast_1d(figure.subplots(rows, columns)).ravel()
        for axes, panel in zip(grid, panels, strict=False):
            _draw(axes, panel)
        for axes in grid[len(panels) :]:
            axes.set_axis_off()
        out = io.StringIO()
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    return _inline(out.getvalue(), prefix, 100 * columns // MAX_COLUMNS)


LOOKS: dict[str, dict[str, Any]] = {
    "exact": {"linestyle": "-", "linewidth": 2.2, "alpha": 0.45},
    "points": {"linestyle": "none", "marker": "o", "markersize": 3.0, "markerfacecolor": "none"},
    "run": {"linestyle": "-", "linewidth": 1.0},
    "convergence": {"linestyle": "-", "marker": "o", "markersize": 3.5, "linewidth": 1.0},
}


def _draw(axes: Any, panel: Panel) -> None:
    colours = iter(RUNS * 3)
    for item in panel.lines:
        x, y = _thinned(item)
        colour = EXACT if item.style == "exact" else next(colours)
        y, look = (np.maximum(np.abs(y), TINY), "convergence") if panel.log else (y, item.style)
        axes.plot(x, y, color=colour, label=item.label or None, **LOOKS[look])
    if panel.log:
        axes.set(xscale="log", yscale="log")
    axes.set_title(panel.title)
    axes.set_xlabel(panel.x_label)
    axes.set_ylabel(panel.y_label)
    axes.grid(True, which="major", linewidth=0.4, alpha=0.4)
    if any(item.label for item in panel.lines):
        axes.legend(frameon=False, fontsize=8.0)
    if panel.log:
        _slope(axes, panel)


def _slope(axes: Any, panel: Panel) -> None:
    """A line of first order for the eye, below the data."""
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

    x = np.unique(np.concatenate([item.x for item in panel.lines]))
    lowest = min(float(np.min(np.maximum(np.abs(item.y), TINY))) for item in panel.lines)
    power = 1.0 if panel.x_label == "zones" else 0.5
    axes.loglog(x, 0.6 * lowest * (x[-1] / x) ** power, ":", color="#888888", linewidth=1.0)
    name = "order 1" if power == 1.0 else "order ½"
    axes.annotate(name, (x[0], 0.6 * lowest * (x[-1] / x[0]) ** power), color="#666666", fontsize=7.5, va="bottom")
    axes.xaxis.set_major_locator(FixedLocator(list(x)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def _thinned(item: Line) -> tuple[np.ndarray, np.ndarray]:
    """At most MAX_POINTS points, and no NaN at the ends of the thinning."""
    step = max(1, len(item.x) // (MAX_POINTS if item.style != "points" else 150))
    return item.x[::step], item.y[::step]


def _inline(text: str, prefix: str, percent: int) -> str:
    """The <svg> element alone, its ids made unique, as wide as its column allows."""
    body = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg") :], flags=re.DOTALL)
    body = re.sub(r'\bid="([^"]+)"', rf'id="{prefix}-\1"', body)
    body = re.sub(r'(xlink:href="#|url\(#)', rf"\g<1>{prefix}-", body)
    body = re.sub(r' height="[\d.]+pt"', "", body, count=1)
    return re.sub(r'(<svg\b[^>]*?) width="[^"]+"', rf'\1 width="{percent}%"', body, count=1)
