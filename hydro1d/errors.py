"""The errors a user can meet. Each knows the exit code of the command line; none is shown with a traceback."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path


class Hydro1dError(Exception):
    """Base of all errors that hydro1d explains to its user."""

    exit_code = 1


@dataclass(frozen=True)
class Problem:
    """One thing wrong in a deck: where, what stands there, and what is allowed."""

    path: str
    message: str
    value: Any = None
    allowed: str = ""
    line: int | None = None
    column: int | None = None

    def __str__(self) -> str:
        place = f"line {self.line}, column {self.column}: " if self.line is not None else ""
        allowed = f"; allowed: {self.allowed}" if self.allowed else ""
        return f"{place}{self.path}: {self.message}{allowed}"


class DeckError(Hydro1dError):
    """A bad deck or a bad command line; `problems` lists everything that is wrong."""

    exit_code = 2

    def __init__(self, message: str, problems: list[Problem] | None = None) -> None:
        self.problems = problems or []
        super().__init__("\n".join([message, *(f"  {problem}" for problem in self.problems)]))


class BreakdownError(Hydro1dError):
    """The calculation broke down: an inverted zone, a NaN, a collapsing step."""

    exit_code = 3

    def __init__(self, cause: str, zone: int, time: float, cycle: int) -> None:
        self.cause, self.zone, self.time, self.cycle = cause, zone, time, cycle
        super().__init__(f"the calculation broke down in zone {zone} at t = {time:.9g} s, cycle {cycle}: {cause}")


class FileProblem(Hydro1dError):
    """A file that cannot be read or written, or is not what it should be."""

    exit_code = 4


@contextmanager
def file_problems(action: str, path: object) -> Iterator[None]:
    """Say what the system has against a file as one `FileProblem`: "cannot write run.png: no space left on device"."""
    try:
        yield
    except OSError as error:
        raise FileProblem(f"cannot {action} {path}: {error.strerror or error}") from error


class LibraryProblem(Hydro1dError):
    """A library that hydro1d needs is missing, or is of a version that it cannot work with."""

    exit_code = 4


class Interrupted(Hydro1dError):
    """Stopped by Ctrl-C or SIGTERM; `checkpoint` is the file to restart from, if there is one, `text` what else to say."""

    exit_code = 130

    def __init__(self, text: str, checkpoint: Path | None = None) -> None:
        self.text, self.checkpoint = text, checkpoint
        super().__init__(text if checkpoint is None else f"{text}\n  to go on: restart from {checkpoint}")
