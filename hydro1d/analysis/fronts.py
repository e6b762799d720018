"""Paths and arrival times of compaction fronts, from the front positions in the history."""

import numpy as np

from hydro1d.store import Run

FRONTS = {"front_position": 1.0, "distal_front_position": -1.0}  # direction in which each front runs
MAX_DEVIATION = 0.01  # share of the column's length; a measure that goes back or leaps farther has lost the front
MAX_DEVIATION_ZONES = 3.0  # zones; the same bound on a coarse grid, where the measure wavers by a zone or two
MIN_CRUSHED = 0.05  # share of the largest strain anywhere; a layer with less is not crushed


def front_path(run: Run, name: str) -> np.ndarray:
    """Lagrangian coordinates (m) of a front, which never goes back; NaN where there is none, and where it leaps.

    The measure of a front takes in a dozen zones on either side. Where two fronts come nearer than that, or a front dies or
    starts at an interface, it wavers by a zone or two, or strays; here the front waits until the measure has come past it.
    """
    nodes, time, sign = run["node_coordinate"], run.history["time"], FRONTS[name]
    strays = max(MAX_DEVIATION * (nodes[-1] - nodes[0]), MAX_DEVIATION_ZONES * float(np.diff(nodes).max()))
    where = np.where(_is_possible(run, run.history[name], sign), run.history[name], np.nan)
    farthest = sign * np.fmax.accumulate(sign * where)
    where = np.where(np.abs(farthest - where) <= strays, farthest, np.nan)
    advance = np.abs(np.diff(where))
    speed = advance / np.maximum(np.diff(time), 1e-300)
    known = speed[np.isfinite(speed)]
    if len(known) >= 20:  # a layer that was crushed from its other end has been passed at once
        leaps = (speed > 5.0 * np.percentile(known, 95.0)) & (advance > strays)
        where[1:][leaps] = np.nan
    return where


def _is_possible(run: Run, where: np.ndarray, sign: float) -> np.ndarray:
    """Whether a front can be at these coordinates: in a layer that is crushed, no farther than what is crushed in all."""
    nodes, crushed = run["node_coordinate"], crushed_zones(run)
    passed = np.concatenate([[0.0], np.cumsum(np.diff(nodes) * crushed)])
    inside = np.isfinite(where) & (where >= nodes[0]) & (where <= nodes[-1])
    place = np.where(inside, where, nodes[0])
    zone = np.clip(np.searchsorted(nodes, place, side="left") - 1, 0, len(crushed) - 1)
    behind = np.interp(place, nodes, passed)
    behind = behind if sign > 0.0 else passed[-1] - behind
    passable = (1.0 + 2.0 * MAX_DEVIATION - run.history["uncrushed_fraction"]) * nodes[-1]
    return inside & crushed[zone] & (behind <= passable)


def crushed_zones(run: Run) -> np.ndarray:
    """Which zones belong to layers that are crushed at all, (zone,)."""
    crushed = np.ones(len(run["node_coordinate"]) - 1, dtype=bool)
    if "largest_strain" not in run or not len(run.time) or run["largest_strain"][-1].max() <= 0.0:
        return crushed  # no profile shows which
    largest = run["largest_strain"][-1]
    for layer in run.layers:
        crushed[layer.zones] = largest[layer.zones].max() > MIN_CRUSHED * largest.max()
    return crushed


def front_arrival(run: Run, name: str, position: float) -> float:
    """When (s) a front has come to a Lagrangian position (m); NaN where it never does: where the other front was before it."""
    sign, time, paths = FRONTS[name], run.history["time"], {front: front_path(run, front) for front in FRONTS}
    known = np.isfinite(paths[name])
    times, places = time[known], sign * paths[name][known]
    end = _meeting(run, paths)
    if end is not None and known.any():
        times, places = np.append(times, end[0]), np.append(places, sign * end[1])
    passed = places >= sign * position
    if not passed.any():
        return float("nan")
    k = int(np.argmax(passed))
    if k == 0 or places[k] == places[k - 1]:
        return float(times[k])
    share = (sign * position - places[k - 1]) / (places[k] - places[k - 1])
    return float(times[k - 1] + share * (times[k] - times[k - 1]))


def _meeting(run: Run, paths: dict[str, np.ndarray]) -> tuple[float, float] | None:
    """When and where the fronts that crushed all of the column met: at its end, if there was one alone. None if none did."""
    full = run.history["uncrushed_fraction"] <= 0.0
    if not full.any():
        return None
    crushed = np.flatnonzero(crushed_zones(run))
    nodes, time = run["node_coordinate"], float(run.history["time"][int(np.argmax(full))])
    proximal, distal = (path[np.isfinite(path)] for path in paths.values())
    if not len(distal):
        return time, float(nodes[crushed[-1] + 1])
    if not len(proximal):
        return time, float(nodes[crushed[0]])
    return time, float(0.5 * (proximal[-1] + distal[-1]))
