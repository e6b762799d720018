"""One run of many: from a base deck and overrides to a row of numbers. Picklable, so it can run anywhere."""

import json
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hydro1d.analysis.outcome import parse_outcome
from hydro1d.analysis.quantity import parse_quantity
from hydro1d.api import column_of
from hydro1d.deck import Deck, load_deck
from hydro1d.errors import DeckError, Hydro1dError
from hydro1d.solver.column import Column
from hydro1d.solver.driver import BLOCK, solve
from hydro1d.solver.driver import Outcome as Ending
from hydro1d.solver.program import Program
from hydro1d.store import Layout, MemorySink, Run

_WORK_PER_LOOK = 300_000  # zone steps between looks at the history: some tenths of a millisecond
_ROWS = 4096

Row = dict[str, Any]


@dataclass(frozen=True)
class Job:
    """A run to do: `data` is the base deck as plain data, `overrides` as in ``--set``, `folder` where its files lie.

    `quantities` and `outcomes` are taken from the run by name; `stop_early` ends it when all outcomes are settled.
    """

    data: Mapping[str, Any]
    folder: str
    overrides: tuple[str, ...]
    quantities: tuple[str, ...] = ()
    outcomes: tuple[str, ...] = ()
    stop_early: bool = False

    def deck(self) -> Deck:
        """The deck; it stores no more profiles than quantities need. Raises DeckError."""
        lean = {**self.data, "output": {**self.data.get("output", {}), "profiles": 2, "probes": []}}
        lean.pop("checkpoint", None)
        return load_deck(lean, self.overrides, Path(self.folder))


def override(key: str, value: Any) -> str:
    """``key=value`` as ``--set`` takes it, for a number, text, truth value or list."""
    return f"{key}={_toml(value)}"


def _toml(value: Any) -> str:
    if isinstance(value, bool | str):
        return json.dumps(value)
    if isinstance(value, np.generic):
        return _toml(value.item())
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    return repr(value)


def evaluate(job: Job, asked_to_stop: Callable[[], bool] = lambda: False) -> Row:
    """Run a job. Its row tells how it ended: "complete", "decided", "failed" (with `error`) or "interrupted"."""
    nothing = {name: float("nan") for name in (*job.quantities, *job.outcomes)}
    try:
        deck = job.deck()
        run, ending = simulate(deck, job.outcomes if job.stop_early else (), asked_to_stop)
    except Hydro1dError as error:
        return {"status": "failed", "error": _one_line(error), "cycles": 0, **nothing}
    except (ArithmeticError, ValueError, RuntimeError, MemoryError) as error:  # a user's law may raise anything
        return {"status": "failed", "error": _one_line(error), "cycles": 0, **nothing}
    row: Row = {"status": ending.status, "error": ending.message, "cycles": ending.cycles}
    row |= nothing
    row |= {name: float(parse_outcome(name).of(run, deck)) for name in job.outcomes}
    if ending.status != "failed":  # the quantity named like the outcome is NaN where the run decides nothing
        row |= {name: parse_quantity(name).take(run, deck) for name in job.quantities}
    return row


def _one_line(error: BaseException) -> str:
    if isinstance(error, DeckError) and error.problems:
        return "; ".join(str(problem) for problem in error.problems)
    return " ".join((str(error) or type(error).__name__).split())


class _Watch(MemorySink):
    """Keeps a run in memory and looks at every last row that comes in: is the question answered?"""

    def __init__(self, column: Column, settled: Sequence[Callable[[Mapping[str, float]], bool] | None]) -> None:
        super().__init__(Layout.of(column))
        self._names = [variable.name for variable in column.history_variables]
        self._settled = settled
        self.decided = False

    def history(self, block: np.ndarray, probes: np.ndarray) -> None:
        super().history(block, probes)
        if self._settled and len(block) and None not in self._settled:
            row = dict(zip(self._names, block[-1].tolist(), strict=True))
            self.decided = all(look(row) for look in self._settled if look is not None)


def simulate(
    deck: Deck, outcomes: Sequence[str] = (), asked_to_stop: Callable[[], bool] = lambda: False
) -> tuple[Run, Ending]:
    """Run a deck in memory, also to its breakdown; stop when every one of ``outcomes`` has come to yes for good."""
    column = column_of(deck)
    looks = [parse_outcome(text).settled(deck) for text in outcomes]
    sink = _Watch(column, looks)
    rows = _ROWS
    if looks and None not in looks:
        least = -(-BLOCK // column.history_every)  # of a stretch that ends where the next may be tried again from
        rows = int(np.clip(_WORK_PER_LOOK // (column.zones * column.history_every), least, _ROWS))
    program = Program(column, rows)
    ending = solve(column, sink, program=program, asked_to_stop=lambda: sink.decided or asked_to_stop())
    if ending.status == "failed" and ending.state is not None:  # what was reached up to there counts
        program.advance(ending.state, stop=ending.state.time, steps=0, row_at_stop=True)
        sink.history(*program.recorded())
    status = "decided" if ending.status == "interrupted" and sink.decided else ending.status
    ending = Ending(status, ending.cycles, ending.time, ending.wall_seconds, ending.message, ending.zone, ending.state)
    return sink.finish(status, ending.cycles, ending.wall_seconds), ending


class Stop:
    """A flag that ends the runs of threads; it stays behind when a job goes to another process."""

    def __init__(self) -> None:
        self._event = threading.Event()

    def set(self) -> None:
        """Ask every worker to stop."""
        self._event.set()

    def __call__(self) -> bool:
        """Whether the workers were asked to stop."""
        return self._event.is_set()
