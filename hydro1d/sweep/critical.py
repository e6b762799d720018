"""The value of one deck key at which an outcome flips, alone or along a second key."""

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import CancelledError, Executor, Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

from hydro1d.analysis.outcome import parse_outcome
from hydro1d.analysis.transmission import NOT_REACHED
from hydro1d.errors import BreakdownError, DeckError, Interrupted
from hydro1d.sweep.base import base_data, number_of, unit_of
from hydro1d.sweep.flip import Flip, NoFlip, find_flip
from hydro1d.sweep.job import Job, Stop, evaluate, override
from hydro1d.sweep.table import Column, Table
from hydro1d.threads import threads_here

Evaluation = tuple[float, float, bool, float, str]  # along, value, answer, quantity, status


@dataclass(frozen=True)
class Search:
    """Arguments of `critical` and `trace`; see there."""

    data: Mapping[str, Any]
    folder: str
    overrides: tuple[str, ...]
    key: str
    low: float
    high: float
    outcome: str
    tolerance: float
    scan: int
    spacing: str
    units: str = ""

    def at(self, key: str, value: Any) -> Self:
        """The same search with one more key set."""
        return replace(self, overrides=(*self.overrides, override(key, value)))


@dataclass(frozen=True)
class Critical:
    """One critical value, NaN if nothing flips (`message` says so), and value, answer, quantity, status of each run.

    units: SI units of the key, empty where it has none.
    """

    value: float
    low: float
    high: float
    before: bool | None
    monotonic: bool
    evaluations: list[tuple[float, bool, float, str]]
    message: str = ""
    along: float = float("nan")
    units: str = ""
    along_units: str = ""


def critical(
    base: str | Path | Mapping[str, Any],
    key: str,
    low: Any,
    high: Any,
    outcome: str,
    *,
    overrides: Sequence[str] = (),
    tolerance: float = 1e-3,
    scan: int = 5,
    spacing: str = "linear",
    asked_to_stop: Callable[[], bool] = lambda: False,
) -> Critical:
    """The value of ``key`` between low and high at which ``outcome`` flips.

    base: a deck's file or text, or its data; low, high: numbers (SI) or texts with a unit; tolerance: relative width of
    the last bracket; scan: evaluations spread over the bracket to see whether there is one change only.
    Raises DeckError (deck, key or outcome), NoFlip, BreakdownError if a run breaks down before the outcome is settled.
    """
    return _search(prepare(base, key, low, high, outcome, overrides, tolerance, scan, spacing), asked_to_stop)


def prepare(
    base: str | Path | Mapping[str, Any],
    key: str,
    low: Any,
    high: Any,
    outcome: str,
    overrides: Sequence[str] = (),
    tolerance: float = 1e-3,
    scan: int = 5,
    spacing: str = "linear",
) -> Search:
    """Check what a search is asked, on the decks at both ends of the bracket."""
    data, folder = base_data(base)
    wanted = parse_outcome(outcome)
    if not 0.0 < tolerance < 1.0:
        raise DeckError(f"tolerance {tolerance:g} is not between 0 and 1")
    if not 2 <= scan <= 1000:
        raise DeckError(f"scan {scan} is not from 2 to 1000")
    first, last = (number_of(data, folder, key, value, overrides) for value in (low, high))
    if not first < last:
        raise DeckError(f"{key}: the bracket from {low} to {high} is empty; give the smaller value first")
    if spacing == "log" and first <= 0.0:
        raise DeckError(f"{key}: log spacing needs a bracket above zero, not {low}")
    search = Search(data, folder, tuple(overrides), key, first, last, outcome, tolerance, scan, spacing)
    deck = _job(search, first).deck()
    wanted.check(deck)
    return replace(search, units=unit_of(deck, key))


def _job(search: Search, value: float) -> Job:
    name = parse_outcome(search.outcome).quantity.name
    texts = (*search.overrides, override(search.key, value))
    return Job(search.data, search.folder, texts, (name,), (search.outcome,), stop_early=True)


def _search(search: Search, asked_to_stop: Callable[[], bool]) -> Critical:
    wanted = parse_outcome(search.outcome)
    kept: list[tuple[float, bool, float, str]] = []

    def shown(value: float) -> str:
        return f"{value:.6g} {search.units}".rstrip()

    def decide(value: float) -> bool:
        row = evaluate(_job(search, value), asked_to_stop)
        answer, quantity = row[search.outcome] == 1.0, row[wanted.quantity.name]
        if row["status"] == "interrupted":
            raise Interrupted("interrupted")
        if row["status"] == "failed" and not answer:
            raise BreakdownError(f"at {search.key} = {shown(value)}: {row['error']}", -1, float("nan"), row["cycles"])
        if wanted.quantity.name in ("enhanced", "enhancement") and math.isnan(quantity):
            raise DeckError(f"at {search.key} = {shown(value)}: {NOT_REACHED}; choose a later time.end")
        kept.append((value, answer, quantity, row["status"]))
        return answer

    flip: Flip = find_flip(
        decide,
        search.low,
        search.high,
        tolerance=search.tolerance,
        scan=search.scan,
        spacing=search.spacing,
        shown=shown,
    )
    return Critical(flip.value, flip.low, flip.high, flip.before, flip.monotonic, kept, units=search.units)


def trace(
    base: str | Path | Mapping[str, Any],
    key: str,
    low: Any,
    high: Any,
    outcome: str,
    along: str,
    values: Sequence[Any],
    *,
    overrides: Sequence[str] = (),
    tolerance: float = 1e-3,
    scan: int = 5,
    spacing: str = "linear",
    executor: Executor | None = None,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> list[Critical]:
    """`critical` for every value of a second key: a boundary. Points where nothing flips or a run breaks down say so.

    Runs on threads of this process unless ``executor`` (any of concurrent.futures) is given. Results are in the order
    of ``values``.
    """
    search = prepare(base, key, low, high, outcome, (*overrides, override(along, values[0])), tolerance, scan, spacing)
    along_units = unit_of(_job(search, search.low).deck(), along)
    numbers = [number_of(search.data, search.folder, along, value, overrides) for value in values]
    search = prepare(base, key, low, high, outcome, overrides, tolerance, scan, spacing)
    stop = Stop()
    pool = executor or ThreadPoolExecutor(threads or threads_here())
    try:
        futures: list[Future] = []
        for number in numbers:
            arguments = (search.at(along, number), number)
            futures.append(pool.submit(_point, *arguments, *(() if executor else (stop,))))
        return [replace(point, along_units=along_units) for point in _gathered(futures, progress)]
    except (KeyboardInterrupt, Interrupted, CancelledError):
        stop.set()
        raise Interrupted("interrupted") from None
    finally:
        if executor is None:
            pool.shutdown(cancel_futures=True)


def _gathered(futures: list[Future], progress: Callable[[float], None] | None) -> list[Critical]:
    from concurrent.futures import as_completed

    for done, future in enumerate(as_completed(futures), 1):
        future.result()
        if progress is not None:
            progress(done / len(futures))
    return [future.result() for future in futures]


def _never() -> bool:
    return False


def _point(search: Search, along: float, asked_to_stop: Callable[[], bool] = _never) -> Critical:
    nothing = (float("nan"), float("nan"), float("nan"))
    try:
        return replace(_search(search, asked_to_stop), along=along)
    except NoFlip as error:
        kept = [(value, answer, float("nan"), "complete") for value, answer in error.evaluations]
        return Critical(*nothing, error.answer, True, kept, str(error), along, search.units)
    except (BreakdownError, DeckError) as error:
        return Critical(*nothing, None, True, [], " ".join(str(error).split()), along, search.units)


def evaluations_table(points: Sequence[Critical], key: str, outcome: str, along: str | None = None) -> Table:
    """Every run of a search: the key's value, the answer, the quantity behind it."""
    quantity = parse_outcome(outcome).quantity
    rows = [(point.along, *kept) for point in points for kept in point.evaluations]
    columns = (
        []
        if along is None
        else [Column(along, points[0].along_units, "the key along which was searched", [row[0] for row in rows])]
    )
    columns += [
        Column(key, points[0].units, "the key searched", [row[1] for row in rows]),
        Column("outcome", "1", f"1 if {outcome}", [float(row[2]) for row in rows]),
        Column(quantity.name, quantity.units, quantity.long_name, [row[3] for row in rows]),
        Column("status", "", "how the run ended", [row[4] for row in rows]),
    ]
    return Table(columns)


def boundary_table(points: Sequence[Critical], key: str, outcome: str, along: str) -> Table:
    """The boundary: the critical value of the key for each value of the other."""
    return Table(
        [
            Column(along, points[0].along_units, "the key along which was searched", [point.along for point in points]),
            Column(key, points[0].units, f"value at which {outcome} flips", [point.value for point in points]),
            Column("low", points[0].units, "lower end of the last bracket", [point.low for point in points]),
            Column("high", points[0].units, "upper end of the last bracket", [point.high for point in points]),
            Column("monotonic", "1", "1 if one change was seen", [float(point.monotonic) for point in points]),
            Column("message", "", "why there is no value", [point.message for point in points]),
        ]
    )
