"""Arrays for the page's script: thinned, and packed as base64."""

import base64
from typing import Any

import numpy as np

from hydro1d.plot._base import PALETTE
from hydro1d.plot._histories import END_STRESSES, PANELS, applied_pressures, extremes, recorded
from hydro1d.plot._units import Scale, scale_for, words
from hydro1d.report._theory import Theory
from hydro1d.store import Run

MAX_TIMES, MAX_POINTS, MAX_ROWS = 100, 400, 1600
THEORY_POINTS = 48
QUANTITIES = ("stress", "strain", "velocity")


def page_data(run: Run, theory: Theory | None) -> dict[str, Any]:
    """What the script of the page draws: profiles with their theory, and histories."""
    return {"profiles": _profiles(run, theory), "histories": _histories(run), "palette": list(PALETTE)}


def _profiles(run: Run, theory: Theory | None) -> dict[str, Any] | None:
    time = run.time
    if not len(time):
        return None
    rows = shown_rows(run)
    zones = len(run["zone_coordinate"])
    chosen = np.unique(np.linspace(0, zones - 1, min(zones, MAX_POINTS)).round().astype(int))
    length, clock = scale_for("m", run["node_coordinate"]), scale_for("s", time)
    position = run["position"][rows]
    centre = 0.5 * (position[:, :-1] + position[:, 1:])[:, chosen]
    panels = [_panel(run, name, rows, chosen, theory) for name in QUANTITIES if name in run]
    return {
        "time": [float(f"{value:.7g}") for value in time[rows] / clock.size],
        "clock": clock.unit,
        "x": _floats(run["zone_coordinate"][chosen] / length.size),
        "position": _packed(centre / length.size, float(np.nanmin(centre)), float(np.nanmax(centre)), length),
        "xlabel": {"lagrangian": length.label("Lagrangian coordinate X"), "laboratory": length.label("position x")},
        "panels": panels,
        "theory": _theory(run, rows, theory, [(panel["name"], panel["size"]) for panel in panels]),
    }


def shown_rows(run: Run) -> np.ndarray:
    """Numbers of the profiles that the page holds."""
    stored = len(run.time)
    return np.unique(np.linspace(0, stored - 1, min(stored, MAX_TIMES)).round().astype(int))


def telling_row(run: Run, theory: Theory | None) -> int:
    """Which of the page's profiles to show first.

    The last one at which theory and code solve the same equations; without one, that with the largest standard deviation
    of the strain, in which one part of the column is crushed and another is not.
    """
    rows = shown_rows(run)
    exact = 0 if theory is None else int(np.sum(run.time[rows] <= theory.exact_until * (1 + 1e-12))) - 1
    if exact > 0:
        return exact
    strain = np.nan_to_num(np.clip(run["strain"][rows], -0.1, 1.0))  # foam that opens goes to any strain
    return int(np.argmax(strain.std(axis=1)))


def _panel(run: Run, name: str, rows: np.ndarray, chosen: np.ndarray, theory: Theory | None) -> dict[str, Any]:
    values = run[name][rows]
    if run.describe(name).dimensions[-1] == "node":
        values = 0.5 * (values[:, :-1] + values[:, 1:])
    values = values[:, chosen]
    scale = scale_for(run.describe(name).units, values)
    low, high = _view(values)
    packed = _packed(values / scale.size, low, high, scale)
    return {"name": name, "label": scale.label(words(name)), "size": scale.size, "values": packed}


def _view(values: np.ndarray) -> tuple[float, float]:
    """Range to show: all of it, without foam that opens without bound and without a short spike."""
    finite = values[np.isfinite(values)]
    if not len(finite):
        return 0.0, 1.0
    low, high = (float(bound) for bound in np.percentile(finite, (0.5, 99.8)))
    least, most, reach = float(finite.min()), float(finite.max()), max(high - low, 1e-300)
    return (least if least > low - 1.5 * reach else low), (most if most < high + 1.5 * reach else high + 0.2 * reach)


def _theory(
    run: Run, rows: np.ndarray, theory: Theory | None, panels: list[tuple[str, float]]
) -> dict[str, Any] | None:
    """Fields of the theory at the times for which it holds, at a few points and on both sides of every front."""
    held = [] if theory is None else [int(row) for row in rows if 0.0 < run.time[row] <= theory.until]
    if theory is None or not held:
        return None
    nodes, length = run["node_coordinate"], scale_for("m", run["node_coordinate"])
    grids = np.array([_points(theory, float(run.time[row]), float(nodes[-1])) for row in held])
    found = [theory.fields(x, float(run.time[row])) for x, row in zip(grids, held, strict=True)]
    columns = {}
    for name, size in panels:
        values = np.array([getattr(fields, name) for fields in found]) / size
        columns[name] = _packed(values, float(np.nanmin(values)), float(np.nanmax(values)), Scale(1.0, ""))
    x = _packed(grids / length.size, 0.0, float(nodes[-1]), length)
    return {"first": int(np.searchsorted(rows, held[0])), "count": len(held), "x": x, "panels": columns}


def _points(theory: Theory, time: float, length: float) -> np.ndarray:
    """THEORY_POINTS coordinates, those beside the fronts among them."""
    sides = [jump.coordinate + step * length for jump in theory.jumps(time) for step in (-1e-7, 1e-7)]
    inside = [side for side in sides if 0.0 < side < length]
    even = np.linspace(0.0, length, THEORY_POINTS - len(inside) + 2)[1:-1]
    return np.sort(np.concatenate([even, inside]))


def _packed(values: np.ndarray, low: float, high: float, scale: Scale) -> dict[str, Any]:
    """Values as 16-bit numbers between two bounds (SI), 65535 for those that are not finite; all shown in `scale`."""
    bottom, top = low / scale.size, high / scale.size
    span = top - bottom if top > bottom else 1.0
    share = np.clip((values - bottom) / span, 0.0, 1.0) * 65534.0
    numbers = np.where(np.isfinite(values), np.nan_to_num(share).round(), 65535).astype("<u2")
    return {"low": bottom, "high": bottom + span, "shape": list(values.shape), "data": _base64(numbers)}


def _floats(values: np.ndarray) -> str:
    return _base64(np.asarray(values).astype("<f4"))


def _base64(array: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")


def _histories(run: Run) -> dict[str, Any]:
    clock = scale_for("s", run.history["time"])
    panels = []
    for label, names in PANELS.items():
        found = [(words(name), run.history["time"], recorded(run, name)) for name in names if name in run.history]
        if any(name in END_STRESSES for name in names):
            found += applied_pressures(run)
        panels.append(_history(label, found, run.describe(f"history/{names[0]}").units, clock))
    panels += _shares(run, clock)
    panels += _probes(run, clock)
    return {"xlabel": clock.label("time t"), "clock": clock.unit, "panels": [panel for panel in panels if panel]}


def _shares(run: Run, clock: Scale) -> list[dict[str, Any] | None]:
    time, history = run.history["time"], run.history
    return [
        _history("uncrushed share", [("uncrushed", time, history["uncrushed_fraction"])], "1", clock),
        _history("energy imbalance", [("energy error", time, history["energy_error"])], "1", clock),
    ]


def _probes(run: Run, clock: Scale) -> list[dict[str, Any] | None]:
    if not len(run.probes):
        return []
    length = scale_for("m", run["node_coordinate"])
    names = [f"X = {length.show(float(x))}" for x in run.probes["probe"][: len(PALETTE)]]
    return [
        _history(
            f"{words(quantity)} at the probes",
            [(name, run.probes["time"], run.probes[quantity][:, k]) for k, name in enumerate(names)],
            run.describe(f"probes/{quantity}").units,
            clock,
        )
        for quantity in ("stress", "strain", "velocity")
    ]


def _history(
    label: str, curves: list[tuple[str, np.ndarray, np.ndarray]], units: str, clock: Scale
) -> dict[str, Any] | None:
    curves = [curve for curve in curves if np.isfinite(curve[2]).any()]
    if not curves:
        return None
    usual = [np.nanpercentile(np.abs(values), 99.5) for _, _, values in curves]
    scale = scale_for(units, usual)
    series = []
    for name, time, values in curves:
        x, y = extremes(time, values, MAX_ROWS)
        series.append({"name": name, "x": _floats(x / clock.size), "y": _floats(y / scale.size)})
    return {"label": scale.label(label), "unit": scale.unit, "series": series, "usual": max(usual) / scale.size}
