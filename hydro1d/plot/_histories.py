"""What happens in time: ends, energies, fronts, probes."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hydro1d.analysis.fronts import front_path
from hydro1d.analysis.transmission import pulse_of
from hydro1d.errors import FileProblem
from hydro1d.plot._base import GREY, legend, new_figure
from hydro1d.plot._data import RunOrPath, as_run, heading, name_of
from hydro1d.plot._frames import FRONTS
from hydro1d.plot._units import Scale, scale_for, words
from hydro1d.store import Run

# Panels that are drawn when nothing is asked for: the axis label, what is drawn in it.
PANELS: dict[str, tuple[str, ...]] = {
    "stress on the ends": ("left_stress", "right_stress"),
    "velocity of the ends": ("left_velocity", "right_velocity", "left_striker_velocity", "right_striker_velocity"),
    "energy per area": ("kinetic_energy", "internal_energy", "boundary_work", "viscous_work"),
    "compaction front": ("front_position", "distal_front_position"),
}
END_STRESSES = ("left_stress", "right_stress")
MAX_ROWS = 4000
PULSE_POINTS = 400
_STYLES = ("-", "--", "-.", ":")


def history(run: RunOrPath, quantities: Sequence[str] | None = None) -> tuple[Figure, np.ndarray]:
    """Histories, a panel for each group of quantities of one unit.

    quantities: names from the history, or "probes/stress" and the like; without, ends, energies, fronts and the stress
    of the probes. Returns the Figure and its Axes (panels,). Raises FileProblem for what the run does not have.
    """
    run = as_run(run)
    panels = _asked(run, quantities) if quantities else _usual(run)
    figure, axes = new_figure(len(panels), 1, (7.2, 0.7 + 1.9 * len(panels)), sharex=True)
    for one, (label, names) in zip(axes[:, 0], panels.items(), strict=True):
        draw_history(one, run, names, label)
    axes[-1, 0].set_xlabel(clock_of(run).label("time t"))
    figure.suptitle(heading(run), fontsize=11)
    return figure, axes[:, 0]


def clock_of(run: Run) -> Scale:
    """Display unit of the history's times."""
    if "time" not in run.history or not len(run.history["time"]):
        raise FileProblem(f"{name_of(run)} holds no history (status: {run.status})")
    return scale_for("s", run.history["time"])


def draw_history(axes: Axes, run: Run, names: Sequence[str], label: str) -> None:
    """Some quantities of one unit into given axes; with stresses of the ends also the applied pressure, and dotted its peak."""
    found = [curve for name in names for curve in _curves(run, name)]
    curves = [curve for curve in found if np.isfinite(curve[2]).any()] or found
    units = run.describe(_path(names[0])).units
    scale = scale_for(units, [_bulk(values) for _, _, values in curves])
    clock = clock_of(run)
    for place, (text, time, values) in enumerate(curves):
        x, y = extremes(time, values, MAX_ROWS)
        style = _STYLES[place % len(_STYLES)] if len(curves) <= len(_STYLES) else "-"
        axes.plot(x / clock.size, y / scale.size, label=text, linewidth=1.2, linestyle=style)
    applied = applied_pressures(run) if any(name in END_STRESSES for name in names) else []
    for text, time, values in applied:
        axes.plot(time / clock.size, values / scale.size, color=GREY, linestyle="--", linewidth=1.2, label=text)
    peak = float(run.attributes.get("peak_applied_pressure", 0.0) or 0.0)
    if units == "Pa" and peak > 0.0 and not names[0].startswith("probes/"):
        label_of_peak = "its peak" if len(applied) == 1 else "peak of the applied pressure"
        axes.axhline(peak / scale.size, color=GREY, linestyle=":", linewidth=1.0, label=label_of_peak)
    _clip(axes, [values / scale.size for _, _, values in curves])
    axes.set_ylabel(scale.label(label))
    axes.margins(x=0.01)
    legend(axes, ncols=4, loc="lower left", bbox_to_anchor=(0.0, 0.98), borderaxespad=0.0)


def applied_pressures(run: Run) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Label, times (s) and pressure (Pa) of the pulses on the ends; none for those that only code of the user's knows."""
    found = []
    for side in ("left", "right"):
        pulse = pulse_of(run, side)
        if pulse is not None:
            end = float(run.history["time"][-1])
            jumps = [time * (1.0 + step) for time in pulse.breakpoints() for step in (-1e-9, 1e-9) if time < end]
            times = np.unique(np.concatenate([np.linspace(0.0, end, PULSE_POINTS), jumps]))
            found.append((side, times, np.array([pulse.pressure(float(time)) for time in times])))
    several = len(found) > 1
    return [(f"applied pressure, {side}" if several else "applied pressure", x, y) for side, x, y in found]


def extremes(time: np.ndarray, values: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Thin a history to about `most` points that keep the largest and the smallest value of each stretch."""
    if len(time) <= most:
        return time, values
    size = -(-2 * len(time) // most)
    kept = [0, len(time) - 1]
    for start in range(0, len(time), size):
        stretch = values[start : start + size]
        if np.isfinite(stretch).all():
            kept += [start + int(np.argmin(stretch)), start + int(np.argmax(stretch))]
        else:
            kept += [start, start + len(stretch) - 1]
    chosen = np.unique(kept)
    return time[chosen], values[chosen]


def _path(name: str) -> str:
    return name if "/" in name else f"history/{name}"


def _curves(run: Run, name: str) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Label, times, values; one for each probe."""
    if name.startswith("probes/"):
        scale = scale_for("m", run["node_coordinate"])
        where = [scale.show(float(x)) for x in run.probes["probe"]]
        found = run[name]
        return [(f"{words(name[7:])} at X = {text}", run.probes["time"], found[:, k]) for k, text in enumerate(where)]
    return [(words(name), run.history["time"], recorded(run, name))]


def recorded(run: Run, name: str) -> np.ndarray:
    """A quantity of the history; of a front, its path."""
    return front_path(run, name) if name in FRONTS else run.history[name]


def _asked(run: Run, quantities: Sequence[str]) -> dict[str, tuple[str, ...]]:
    groups: dict[tuple[str, bool], list[str]] = {}
    for name in quantities:
        if name.startswith("probes/") and not len(run.probes):
            raise FileProblem(f"{name_of(run)} has no probes; ask for them in the deck, [output] probes = [...]")
        groups.setdefault((run.describe(_path(name)).units, name.startswith("probes/")), []).append(name)
    return {", ".join(words(name.rpartition("/")[2]) for name in names[:2]): tuple(names) for names in groups.values()}


def _usual(run: Run) -> dict[str, tuple[str, ...]]:
    clock_of(run)
    found = {label: tuple(name for name in names if name in run.history) for label, names in PANELS.items()}
    for label, names in list(found.items()):
        if not any(np.isfinite(run.history[name]).any() for name in names):
            del found[label]
    if len(run.probes):
        found["stress at the probes"] = ("probes/stress",)
    return found


def _bulk(values: np.ndarray) -> np.ndarray:
    """Values without a short spike, by which a unit or an axis must not be chosen."""
    finite = np.abs(values[np.isfinite(values)])
    return np.percentile(finite, 99.5) if len(finite) else np.zeros(())


def _clip(axes: Axes, curves: Sequence[np.ndarray]) -> None:
    """Cut off a spike many times higher than all the rest, and say so."""
    top = max((float(np.nanmax(values)) for values in curves if np.isfinite(values).any()), default=0.0)
    usual = max((float(_bulk(values)) for values in curves), default=0.0)
    if usual > 0.0 and top > 4.0 * usual:
        least = min(float(np.nanmin(values)) for values in curves if np.isfinite(values).any())
        axes.set_ylim(max(least, -2.0 * usual) - 0.1 * usual, 2.0 * usual)
        axes.annotate(f"peak {top:.4g}", (0.0, 1.0), (3, -2), "axes fraction", "offset points", fontsize=8, va="top")
