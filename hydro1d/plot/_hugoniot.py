"""The plane of strain and stress: paths of zones over the law's curve and the Rayleigh line."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hydro1d.analysis.fronts import front_path
from hydro1d.deck import Deck
from hydro1d.plot._base import GREY, PALETTE, SEQUENTIAL, legend, new_figure
from hydro1d.plot._data import RunOrPath, as_run, heading, profile_quantity, times_of
from hydro1d.plot._materials import curve, deck_of, loads_by_strain, strain_grid
from hydro1d.plot._units import Scale, scale_for
from hydro1d.store import Run

NO_CURVE = "no curve: the law is code of its user's; name the deck to have it run and drawn"
PATHS = 3
SNAPSHOTS = 5
MIN_JUMP = 0.1  # of strain: weaker fronts do not crush
GIVEN_BACK = 0.02  # of a front's jump of strain: zones that have unloaded by more are not its two sides any more
MIN_STRAIN = -0.1  # foam that opens goes to any strain; the figure does not follow
_REACH = 60  # zones on either side of a front that are looked at


class Crossing(NamedTuple):
    """A front caught at one output time: the zones within it, from behind to ahead, and the states on either side."""

    profile: int
    zones: slice
    behind: tuple[float, float]
    ahead: tuple[float, float]


def hugoniot(
    run: RunOrPath, zones: Sequence[int] | None = None, deck: Deck | str | Path | None = None
) -> tuple[Figure, Axes]:
    """Paths of zones in the (strain, stress) plane; states within the front with viscosity; curves and Rayleigh lines.

    zones: numbers of the zones whose path is drawn; three without. deck: where the laws are taken from; needed only if
    they are in a Python file of the user's. Returns the Figure and its Axes. Raises FileProblem for what the run lacks.
    """
    run = as_run(run)
    figure, axes = new_figure(1, 1, (7.0, 4.8))
    draw_hugoniot(axes[0, 0], run, zones, deck)
    axes[0, 0].set_title(heading(run), fontsize=11)
    return figure, axes[0, 0]


def draw_hugoniot(
    axes: Axes, run: Run, zones: Sequence[int] | None = None, deck: Deck | str | Path | None = None
) -> None:
    """The plane into given axes."""
    times_of(run, 2)
    strain, stress = profile_quantity(run, "strain"), profile_quantity(run, "stress")
    total = stress + (profile_quantity(run, "viscosity") if "viscosity" in run else 0.0)
    found = crossings(run)
    levels = [crossing.behind[1] for crossing in found]
    bulk = max([float(np.nanpercentile(stress, 99.5)), *levels])
    scale = scale_for("Pa", bulk)
    top = 1.12 * bulk if bulk > 0.0 else 1.0
    _draw_curves(axes, run, deck, scale, float(np.nanmax(strain)), top)
    _draw_paths(axes, run, zones, strain, stress, scale)
    _draw_crossings(axes, run, found, strain, total, scale)
    low = min(float(np.nanmin(stress)), 0.0)
    axes.set_ylim((1.05 * low if low < -0.02 * top else -0.02 * top) / scale.size, top / scale.size)
    left, right = axes.get_xlim()
    axes.set_xlim(max(left, MIN_STRAIN), right)
    axes.set_xlabel("strain ε")
    axes.set_ylabel(scale.label("stress σ"))
    legend(axes, loc="upper left")


def crossings(run: Run) -> list[Crossing]:
    """Where the proximal front stands at some of the output times, evenly spread over its life."""
    if "front_position" not in run.history or "viscosity" not in run:
        return []
    time, front = run.history["time"], front_path(run, "front_position")
    inside = np.isfinite(front)
    if not inside.any():
        return []
    where = np.interp(run.time, time[inside], front[inside])
    alive = np.flatnonzero((run.time >= time[inside][0]) & (run.time <= time[inside][-1]))
    found = [crossing for index in alive if (crossing := _crossing(run, int(index), float(where[index])))]
    if not found:
        return []
    found = found[1:] if len(found) > SNAPSHOTS else found  # the first still feels how it was started
    return [found[k] for k in sorted({round(x) for x in np.linspace(0, len(found) - 1, SNAPSHOTS)})]


def _crossing(run: Run, index: int, where: float) -> Crossing | None:
    """The front near the coordinate `where` at one output time, by its viscosity; None where it is not clear."""
    q, strain, stress = run["viscosity"][index], run["strain"][index], run["stress"][index]
    middle = int(np.clip(np.searchsorted(run["zone_coordinate"], where), 0, len(q) - 1))
    low, high = max(middle - _REACH, 0), min(middle + _REACH, len(q))
    core = low + int(np.argmax(q[low:high]))
    edge = 0.01 * q[core]
    first, last = core, core
    while first > low and q[first - 1] > edge:
        first -= 1
    while last < high - 1 and q[last + 1] > edge:
        last += 1
    behind, ahead = first - 2, last + 2
    if q[core] <= 0.0 or behind < low or ahead >= high or run["zone_layer"][behind] != run["zone_layer"][ahead]:
        return None
    if strain[behind] - strain[ahead] < MIN_JUMP or not _has_loaded(run, index, behind, ahead):
        return None
    return Crossing(index, slice(first - 2, last + 3), (strain[behind], stress[behind]), (strain[ahead], stress[ahead]))


def _has_loaded(run: Run, index: int, behind: int, ahead: int) -> bool:
    """Whether the front has just loaded the zone behind it: a Rayleigh line between unloaded zones would be invented."""
    strain, stress, largest = run["strain"][index], run["stress"][index], run["largest_strain"][index]
    jump = strain[behind] - strain[ahead]
    given_back, crushed_before = largest[behind] - strain[behind], largest[ahead] - strain[ahead]
    return bool(max(given_back, crushed_before) < GIVEN_BACK * jump and stress[behind] > stress[ahead] > 0.0)


def _draw_curves(axes: Axes, run: Run, deck: object, scale: Scale, strain: float, top: float) -> None:
    known = deck_of(run, deck)  # type: ignore[arg-type]
    if known is None:
        axes.annotate(
            NO_CURVE, (1.0, 0.0), (-4, 4), "axes fraction", "offset points", ha="right", fontsize=8, color=GREY
        )
        return
    drawn: dict[str, object] = {}
    for layer in known.layers:
        if layer.material in drawn or not loads_by_strain(layer.law):
            continue
        style = ("-", "--", "-.", ":")[len(drawn) % 4]
        drawn[layer.material] = layer.law
        strains = strain_grid(layer.law, min(max(strain * 1.05, 0.05), 0.999), 800)
        stresses, _ = curve(layer.law, strains)
        shown = stresses <= 1.5 * top
        name = f"curve of {layer.material}" if len(known.layers) > 1 else "curve of the law"
        axes.plot(
            strains[shown], stresses[shown] / scale.size, color="#000000", linewidth=1.1, linestyle=style, label=name
        )


def _draw_paths(
    axes: Axes, run: Run, zones: Sequence[int] | None, strain: np.ndarray, stress: np.ndarray, scale: Scale
) -> None:
    count = strain.shape[1]
    if zones is None:
        zones = sorted({int((k + 0.5) * count / PATHS) for k in range(PATHS)})
    for place, zone in enumerate(zones):
        if not 0 <= zone < count:
            from hydro1d.errors import DeckError

            raise DeckError(f"zone {zone} does not exist; zones count from 0 to {count - 1}")
        where = scale_for("m", run["node_coordinate"]).show(float(run["zone_coordinate"][zone]), 3)
        x, y = _broken(strain[:, zone], stress[:, zone])
        axes.plot(
            x, y / scale.size, color=PALETTE[place % 7], linewidth=1.0, marker=".",
            markersize=3, alpha=0.8, label=f"path of the zone at X = {where}",
        )  # fmt: skip


def _broken(strain: np.ndarray, stress: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A path with gaps where a front passed between two output times: a straight line there would be invented."""
    gaps = np.flatnonzero(np.abs(np.diff(strain)) > 0.05) + 1
    return np.insert(strain, gaps, np.nan), np.insert(stress, gaps, np.nan)


def _draw_crossings(
    axes: Axes, run: Run, found: Sequence[Crossing], strain: np.ndarray, total: np.ndarray, scale: Scale
) -> None:
    clock, colours = scale_for("s", run.time), matplotlib.colormaps[SEQUENTIAL]
    for place, crossing in enumerate(found):
        colour = colours(0.92 * place / max(len(found) - 1, 1))
        (far, high), (near, low) = crossing.behind, crossing.ahead
        label = "Rayleigh line" if place == 0 else None
        axes.plot(
            [near, far], [low / scale.size, high / scale.size], color=colour, linewidth=0.9, linestyle="--", label=label
        )
        inside = (crossing.profile, crossing.zones)
        text = f"σ + q in the front, {clock.show(float(run.time[crossing.profile]), 3)}"
        axes.plot(
            strain[inside], total[inside] / scale.size, linestyle="none", marker="o", markersize=4, color=colour,
            markeredgewidth=0.0, label=text,
        )  # fmt: skip
