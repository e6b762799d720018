"""Boundaries in (duration, pressure): the duration at which a pulse just crushes the whole column, or is just enhanced.

Both criteria are asked of the same runs. A run ends when nothing can happen any more: the load puts in momentum P T,
a wall that bears at least σP takes it out by T P/σP after the first wave has reached it, L/c0; a quarter is added.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from typing import Any

from hydro1d.errors import DeckError
from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.workshop import plain
from hydro1d.sweep import Column, Flip, Job, NoFlip, Table, evaluate, find_flip
from hydro1d.sweep.job import override

CRITERIA = ("fully_crushed", "enhanced")
NEAR = 1e-4  # how far from a duration at which a run breaks down it is tried again: far below any tolerance here
Ending = Callable[[float, float], float]  # pressure, duration -> end of the run, s


def at_rest(pressure: float, duration: float) -> float:
    """A quarter later than the time by which all momentum is gone."""
    return 1.25 * (duration * pressure / foam.PLATEAU + 1.0 / foam.RATE)


def twice_as_long(pressure: float, duration: float) -> float:
    """Twice `at_rest`."""
    return 2.0 * at_rest(pressure, duration)


def with_the_pulse(pressure: float, duration: float) -> float:
    """Nothing counts that happens when the pulse is over."""
    return duration


@dataclass(frozen=True)
class Curve:
    """One boundary: name, a deck's data with overrides, bracket as multiples of a first guess of T, end of its runs."""

    name: str
    data: Mapping[str, Any]
    overrides: tuple[str, ...] = ()
    bracket: tuple[float, float] = (0.5, 4.0)
    end: Ending = at_rest
    criteria: tuple[str, ...] = CRITERIA


@dataclass
class Point:
    """The critical durations (s) at one pressure (Pa), by criterion; NaN where there is none, and why."""

    pressure: float
    durations: dict[str, float] = field(default_factory=dict)
    monotonic: bool = True
    message: str = ""
    runs: int = 0


def critical_durations(curve: Curve, pressure: float, guess: float, tolerance: float, scan: int = 5) -> Point:
    """Both critical durations at one pressure; a run is done once for both."""
    point = Point(pressure)
    known: dict[float, dict[str, Any]] = {}

    def row_at(duration: float) -> dict[str, Any]:
        if duration not in known:
            known[duration] = evaluate_at(curve, pressure, duration, (), curve.criteria)
        return known[duration]

    for criterion in curve.criteria:

        def decide(duration: float, criterion: str = criterion) -> bool | None:
            for near in (duration, duration * (1.0 + NEAR), duration * (1.0 - NEAR)):
                row = row_at(near)
                if row["status"] != "failed" or row[criterion] == 1.0:
                    return bool(row[criterion] == 1.0)
            return None  # all broke down before the question was answered

        low, high = (guess * share for share in curve.bracket)
        try:
            flip: Flip = find_flip(decide, low, high, tolerance=tolerance, scan=scan, spacing="log")
            point.durations[criterion] = flip.value
            point.monotonic &= flip.monotonic
        except (NoFlip, DeckError) as error:
            point.durations[criterion] = math.nan
            point.message += f"{criterion}: {error} "
    point.runs = len(known)
    return point


def evaluate_at(
    curve: Curve, pressure: float, duration: float, quantities: tuple[str, ...], outcomes: tuple[str, ...]
) -> dict[str, Any]:
    """One run of a curve: its row of quantities and outcomes. It ends early when every outcome has come to yes."""
    end = override("time.end", curve.end(pressure, duration))
    texts = (override("left.peak", pressure), override("left.duration", duration), end)
    return evaluate(Job(curve.data, ".", (*curve.overrides, *texts), quantities, outcomes, stop_early=True))


def trace_curves(
    curves: Sequence[Curve],
    pressures: Sequence[float],
    guess: Callable[[float], float],
    tolerance: float,
    pool: Executor,
    scan: int = 5,
) -> dict[str, list[Point]]:
    """Every curve at every pressure, on the threads or processes of ``pool``; the slow ones begin first."""
    futures = {
        (curve.name, k): pool.submit(critical_durations, curve, pressure, guess(pressure), tolerance, scan)
        for curve in curves
        for k, pressure in enumerate(pressures)
    }
    return {curve.name: [futures[curve.name, k].result() for k in range(len(pressures))] for curve in curves}


def boundary_table(traced: Mapping[str, Sequence[Point]], pressures: Sequence[float]) -> Table:
    """A table: pressure, then a column for each curve and criterion, s."""
    columns = [Column("pressure", "Pa", "peak of the pulse", [float(p) for p in pressures])]
    for name, points in traced.items():
        for criterion in points[0].durations:
            values = [point.durations[criterion] for point in points]
            text = f"critical duration, {name}, {plain(criterion)}"
            columns.append(Column(f"{name} {criterion}", "s", text, values))
    return Table(columns)
