"""The suite: its cases, how they are run, and the count that makes a case that did not run a failure."""

import importlib
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from fnmatch import fnmatchcase

from hydro1d.threads import threads_here
from hydro1d.verify.rows import Case, Effort, Panel, Row, Table, failure

# In the order of the report. A module that is missing here would be missed silently, hence the total below.
MODULES = (
    "step_loading",
    "hugoniot",
    "rppl_striker",
    "rppl_pulse",
    "epph_pulse",
    "front_energy",
    "rph_striker",
    "clad_plate",
    "taylor_plate",
    "elastic_bar",
    "riemann",
    "noh",
    "smooth",
    "symmetry",
)
CASES = 40
ROWS = 1265


@dataclass(frozen=True)
class Report:
    """Rows and panels of one case, and how long it took (s)."""

    case: Case
    rows: tuple[Row, ...]
    panels: tuple[Panel, ...]
    seconds: float

    @property
    def passed(self) -> bool:
        """Whether every row passed."""
        return all(row.passed for row in self.rows)


def all_cases() -> list[Case]:
    """Every registered case."""
    return [case for name in MODULES for case in importlib.import_module(f"hydro1d.verify.cases.{name}").CASES]


def chosen(patterns: Sequence[str]) -> list[Case]:
    """Cases whose name matches one of the patterns (``*`` stands for anything); all without patterns."""
    cases = all_cases()
    return [case for case in cases if not patterns or any(fnmatchcase(case.name, pattern) for pattern in patterns)]


def registered_whole(cases: Sequence[Case]) -> Row | None:
    """A failure if the registry itself does not hold what the suite says it has."""
    rows = sum(case.rows for case in cases)
    if len(cases) == CASES and rows == ROWS and len({case.name for case in cases}) == CASES:
        return None
    return failure(
        "suite", "registered rows", f"{len(cases)} cases with {rows} rows are registered, not {CASES} with {ROWS}"
    )


def run_case(case: Case, effort: Effort) -> Report:
    """Run one case. Whatever it raises, and any row that is missing, becomes a row that fails."""
    begun = time.perf_counter()
    table = Table(case.name)
    try:
        case.study(table, effort)
    except Exception as error:
        where = traceback.extract_tb(error.__traceback__)[-1]
        table.rows.append(
            failure(case.name, "ran to its end", f"{type(error).__name__}: {error} ({where.name}, line {where.lineno})")
        )
    else:
        if len(table.rows) != case.rows:
            table.rows.append(
                failure(case.name, "number of rows", f"{len(table.rows)} rows where {case.rows} are registered")
            )
    return Report(case, tuple(table.rows), tuple(table.panels), time.perf_counter() - begun)


def run_suite(
    cases: Sequence[Case],
    *,
    full: bool = False,
    workers: int | None = None,
    done: Callable[[Report], None] = lambda _: None,
) -> list[Report]:
    """Run cases on threads (the compiled time loop lets go of the interpreter's lock), in the order given.

    ``done`` is told of every report, in that order, as soon as it and those before it are there.
    """
    reports = []
    with ThreadPoolExecutor(workers or threads_here()) as pool:
        for report in _in_order(pool, cases, Effort(full)):
            done(report)
            reports.append(report)
    return reports


def _in_order(pool: ThreadPoolExecutor, cases: Sequence[Case], effort: Effort) -> Iterator[Report]:
    futures = [pool.submit(run_case, case, effort) for case in cases]
    try:
        for future in futures:
            yield future.result()
    finally:
        for future in futures:
            future.cancel()
