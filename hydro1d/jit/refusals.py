"""What numba cannot compile, told to its author: which file, which function, which line, and why in a sentence.

numba wraps the reason in one message for every function on the way to it. Its events tell of each function as it fails, the
innermost first; the first that is neither numba's nor hydro1d's is the author's.
"""

from __future__ import annotations

import dis
import linecache
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType
from typing import Any, NamedTuple

from hydro1d.components.parameters import Component
from hydro1d.errors import DeckError

_PACKAGE = Path(__file__).resolve().parent.parent
_MAY_USE = (
    "compiled functions may use floats, if, loops, min, max, abs, functions of math, self.parameter and their own methods; "
    "no arrays, lists, text, exceptions"
)
_SIGNATURE = re.compile(r"^\s*>>> (.+)$", re.MULTILINE)
_RAISED_FROM = re.compile(r"\s*Raised from .* \((\d+)\)$")
_MAKE_OBJECTS = ("BUILD_LIST", "BUILD_SET", "BUILD_MAP", "BUILD_STRING", "FORMAT_VALUE")
UNRESOLVED = ".numba.unresolved$"  # numba's name for a function that is still being compiled where it is called
_LONGEST = 200  # characters of what numba said


class Failure(NamedTuple):
    """A function that numba gave up, and why."""

    function: FunctionType
    error: BaseException


class NotCompilable(Exception):
    """A kernel that numba cannot compile; `failures` are the functions that failed on the way, innermost first."""

    def __init__(self, failures: list[Failure], error: BaseException) -> None:
        self.failures = failures
        super().__init__(f"numba cannot compile a kernel: {error}")


def makers_of_objects(text: str, owners: Iterable[FunctionType]) -> list[Failure]:
    """Of numba's module, the functions that make Python's objects or ask for memory, which machine code here does without."""
    error = RuntimeError("it makes an object (a list, an array, a text)")
    bodies = [part.split("\n}", 1)[0] for part in re.split(r"(?m)^define ", text)[1:]]
    guilty = " ".join(body.split("\n", 1)[0] for body in bodies if re.search(r"@_?(NRT_|Py|numba_unpickle)", body))
    return [Failure(owner, error) for owner in owners if _symbol(owner) in guilty]


def callers_of_themselves(text: str, owners: Iterable[FunctionType]) -> list[Failure]:
    """Of numba's module, the functions that call themselves: numba leaves the address of such a call to its own loader."""
    error = RuntimeError("it calls itself; a loop can do the same")
    guilty = " ".join(re.findall(re.escape(UNRESOLVED) + r'[^"]*', text))
    return [Failure(owner, error) for owner in owners if _symbol(owner) in guilty]


def _symbol(function: FunctionType) -> str:
    """What the names that numba gives to a function's code contain."""
    return f"{len(function.__name__)}{function.__name__}B"


@contextmanager
def noticed(copies: Any) -> Iterator[None]:
    """Raise NotCompilable, from numba's own error, where compiling fails."""
    from numba.core import event

    failures: list[Failure] = []

    class Listener(event.Listener):
        def on_start(self, event: Any) -> None:
            pass

        def on_end(self, event: Any) -> None:
            error = sys.exception()
            if error is not None:
                function = event.data["dispatcher"].py_func
                failures.append(Failure(copies.owners.get(function, function), error))

    try:
        with event.install_listener("numba:compile", Listener()):
            yield
    except Exception as error:
        raise NotCompilable(failures, error) from error


def explanation(component: type[Component], failures: list[Failure]) -> DeckError | None:
    """The error for the author of a component; None where the component is hydro1d's own, whose fault it is not."""
    home = _home(component)
    if _is_ours(home):
        return None
    own = next((failure for failure in failures if not _is_ours(failure.function.__code__.co_filename)), None)
    if own is None:  # its functions compile, but what they return does not fit
        reason = _reason(failures[0].error, component) if failures else "numba fails on it and gives no reason"
        return DeckError(f"{home}: {component.__name__} cannot be compiled: {reason}\n  {_MAY_USE}")
    file, line = own.function.__code__.co_filename, _line(own)
    source = linecache.getline(file, line).strip() if line else ""
    place = f"{file}, line {line}" if line else file
    text = f"{place}: {own.function.__qualname__} cannot be compiled: {_reason(own.error, component)}"
    return DeckError("\n  ".join(filter(None, [text, source, _MAY_USE])))


def _home(component: type[Component]) -> str:
    """The file of a class: its module's, else that of its methods."""
    codes = [item.__code__.co_filename for item in vars(component).values() if isinstance(item, FunctionType)]
    return getattr(sys.modules.get(component.__module__), "__file__", None) or next(iter(codes), "<unknown>")


def _is_ours(file: str) -> bool:
    """Whether a source file is hydro1d's or numba's."""
    import numba

    return any(Path(file).is_relative_to(package) for package in (_PACKAGE, Path(numba.__file__).parent))


def _line(failure: Failure) -> int:
    """The line that numba complains of, 0 where it names none."""
    place = getattr(failure.error, "loc", None)
    if place is not None and place.filename == failure.function.__code__.co_filename:
        return int(place.line)
    named = _RAISED_FROM.search(str(failure.error))
    if named:
        return int(named[1])
    made = (step.positions for step in dis.get_instructions(failure.function) if step.opname in _MAKE_OBJECTS)
    return next((place.lineno for place in made if place and place.lineno), 0)


def _reason(error: BaseException, component: type[Component]) -> str:
    """The first sentence of what numba says that is about the code."""
    text = str(error)
    rows = [row.strip() for row in text.splitlines() if row.strip() and not row.startswith("Failed in nopython mode")]
    if not rows:
        return "numba fails on it and gives no reason"
    reason = _RAISED_FROM.sub("", rows[0])
    called = _SIGNATURE.search(text)
    if reason.startswith("No implementation of function") and called:
        reason = f"numba has no {called[1]}"
    if "FORMAT_SIMPLE" in reason or "FORMAT_WITH_SPEC" in reason:  # the opcodes that Python 3.13 makes of them
        reason = "f-strings are not supported"
    reason = re.sub(r"Literal\[\w+\]\(([^()]*)\)", r"\1", re.sub(r"<iv=[^>]*>", "", reason))
    reason = reason.replace(f"{component.__module__}.{component.__qualname__}", component.__name__)
    return reason if len(reason) <= _LONGEST else reason[:_LONGEST] + "…"
