"""Running a sweep: on threads of this machine, or on any executor of concurrent.futures."""

import hashlib
import json
import os
from collections.abc import Callable
from concurrent.futures import CancelledError, Executor, Future, ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from hydro1d.analysis.quantity import parse_quantity
from hydro1d.errors import DeckError, Hydro1dError, Interrupted
from hydro1d.sweep.job import Job, Stop, evaluate
from hydro1d.sweep.journal import Journal
from hydro1d.sweep.plan import Sweep
from hydro1d.sweep.table import Column, Table
from hydro1d.threads import threads_here

# Folders whose code takes no part in a run of a sweep.
_NO_PART = ("analytic", "benchmarks", "cli", "fit", "plot", "report", "studies", "templates", "verify")


def run_sweep(
    sweep: Sweep,
    *,
    executor: Executor | None = None,
    threads: int | None = None,
    journal: str | Path | None = None,
    fresh: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Table:
    """Run everything that a sweep asks for and return its table, a row a point, in the order of the points.

    Threads of this process by default (a run holds no lock while it computes); ``executor`` may be any of
    concurrent.futures. ``journal`` names a file that keeps finished rows: run again after an interruption and only the
    rest is done. A run that fails is a row whose status is "failed". The table is the same to the last bit however it
    was run. Raises Interrupted after Ctrl-C.
    """
    jobs = sweep.jobs()
    kept = Journal(Path(journal), digest(sweep), fresh) if journal is not None else None
    rows: dict[int, dict[str, Any]] = dict(kept.rows) if kept is not None else {}
    try:
        _fill(rows, jobs, executor, threads, kept, progress)
    except (KeyboardInterrupt, CancelledError):
        note = f"; run it again to go on ({journal})" if kept is not None else ""
        raise Interrupted(f"interrupted after {len(rows)} of {len(jobs)} runs{note}") from None
    finally:
        if kept is not None:
            kept.close()
    return _table(sweep, [rows[k] for k in range(len(jobs))])


def _fill(
    rows: dict[int, dict[str, Any]],
    jobs: list[Job],
    executor: Executor | None,
    threads: int | None,
    journal: Journal | None,
    progress: Callable[[float], None] | None,
) -> None:
    waiting = [k for k in range(len(jobs)) if k not in rows]
    stop = Stop()
    pool = executor or ThreadPoolExecutor(threads or threads_here())
    own: tuple = () if executor is not None else (stop,)
    futures: dict[Future, int] = {}
    try:
        futures = {pool.submit(evaluate, jobs[k], *own): k for k in waiting}
        for future in as_completed(futures):
            row = _result(future)
            rows[futures[future]] = row
            if journal is not None:
                journal.add(futures[future], row)
            if progress is not None:
                progress(len(rows) / len(jobs))
    finally:
        stop.set()
        for future in futures:
            future.cancel()
        if executor is None:
            pool.shutdown(cancel_futures=True)


def _result(future: Future) -> dict[str, Any]:
    """A job's row; what the executor itself has to complain about ends the sweep."""
    try:
        row: dict[str, Any] = future.result()
        return row
    except (Hydro1dError, KeyboardInterrupt, CancelledError):
        raise
    except Exception as error:
        raise Hydro1dError(f"the executor of the sweep failed: {type(error).__name__}: {error}") from error


def digest(sweep: Sweep) -> str:
    """What a sweep's rows depend on, as one text: its jobs, its laws, and this version of hydro1d."""
    from hydro1d.jit.build import UNKNOWN, fingerprint

    jobs = [(job.overrides, job.quantities) for job in sweep.jobs()]
    try:
        deck = Job(sweep.data, sweep.folder, sweep.overrides).deck()
        parts = [*(layer.law for layer in deck.layers), deck.left, deck.right]
        codes = [fingerprint(part) for part in parts]
        codes += [repr(part) for part in parts]  # with the values of the tables that files hold
    except DeckError:
        codes = []
    if any(code.startswith(UNKNOWN) for code in codes):
        codes.append(os.urandom(16).hex())  # rows that may be of other code are not taken over
    content = json.dumps([sweep.data, sweep.folder, jobs, codes, _code()], sort_keys=True, default=str)
    return hashlib.sha256(content.encode()).hexdigest()


def _code() -> str:
    """Hash of the package's source files that take part in a run and in the quantities taken from it."""
    package = Path(__file__).parents[1]
    sources = [path for path in sorted(package.rglob("*.py")) if path.relative_to(package).parts[0] not in _NO_PART]
    return hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()


def _table(sweep: Sweep, rows: list[dict[str, Any]]) -> Table:
    units = sweep.units()
    columns = [
        Column(
            parameter.label, units[k], f"parameter {', '.join(parameter.keys)}", [point[k] for point in sweep.points()]
        )
        for k, parameter in enumerate(sweep.parameters)
    ]
    for name in sweep.quantities:
        quantity = parse_quantity(name)
        columns.append(Column(name, quantity.units, quantity.long_name, [row[name] for row in rows]))
    columns += [
        Column("status", "", "complete or failed", [row["status"] for row in rows]),
        Column("error", "", "what went wrong", [row["error"] for row in rows]),
        Column("cycles", "1", "steps taken", [float(row["cycles"]) for row in rows]),
    ]
    return Table(columns, {"title": sweep.title})
