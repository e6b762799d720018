"""A user's files with functions of one number, each reaching something in its own way; run as a script, it asks them all.

python questions.py FOLDER NAME…    prints {name: answer, or what refuses it, or null}, notes, and whether something was compiled
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from hydro1d.components.user_files import load_module
from hydro1d.errors import DeckError
from hydro1d.jit import build, reach
from hydro1d.jit.refusals import NotCompilable

X = 0.3
FIELDS = {"numbers": "f8"}
SHARED = build.Shared("Numbers", FIELDS)

# Every 1.5 of these becomes 2.5 when the files are edited.
FILES = {
    "deep.py": """
from numba import njit

FACTOR = 1.5

def scaled(x):
    return FACTOR * x

@njit
def quickly(x):
    return FACTOR * x
""",
    "parts/__init__.py": "",
    "parts/inner.py": "SLOPE = 1.5\n\ndef line(x):\n    return SLOPE * x\n",
    "shape.py": """
import enum
from collections import namedtuple

import numpy as np
from numba import njit

import deep
import parts.inner as inner
from parts.inner import line as inner_line

Pair = namedtuple("Pair", "first second")

class Kind(enum.IntEnum):
    SOFT = int(2.0 * 1.5)

SLOPE = 1.5
TABLE = 1.5 * np.arange(5.0)
GRID = np.asfortranarray(1.5 * np.arange(12.0).reshape(3, 4))
STRIDED = (1.5 * np.arange(40.0))[::4]
BIG = 1.5 * np.arange(150_000.0)
TRIPLE = (1.0, 1.5, 2)
PAIR = Pair(1.5, 0.0)
NESTED = ((1.5, Pair(0.5, 1.0)), 3)

def line(x):
    return 1.5 * x

def deeper(x):
    return 2.0 * deep.scaled(x)

def by_default(x, slope=1.5):
    return slope * x

def made(slope):
    def line(x):
        return slope * x
    return line

from_closure = made(1.5)

@njit
def compiled(x):
    return deep.quickly(x) + SLOPE

FUNCTIONS = (compiled, line)
KEPT = {"slope": 1.5}
""",
    "questions.py": """
import ctypes, ctypes.util, math
import numpy as np
import shape
from shape import by_default, compiled as quick, TABLE

j0 = ctypes.CDLL(ctypes.util.find_library("m")).j0
j0.restype, j0.argtypes = ctypes.c_double, [ctypes.c_double]

def constant(x): return shape.SLOPE * x
def helper(x): return shape.line(x)
def helper_of_helper(x): return shape.deeper(x)
def default(x): return by_default(x)
def closure(x): return shape.from_closure(x)
def compiled(x): return quick(x)
def compiled_of_module(x): return shape.compiled(x)
def array(x): return TABLE[2] * x
def array_of_module(x): return shape.TABLE[3] * x
def columns(x): return shape.GRID[2, 1] * x
def strided(x): return shape.STRIDED[3] * x
def triple(x): return shape.TRIPLE[1] * x
def pair(x): return shape.PAIR.first * x + shape.PAIR[1]
def nested(x): return shape.NESTED[0][0] * x + shape.NESTED[0][1].second
def function_of_tuple(x): return shape.FUNCTIONS[0](x)
def function_by_number(x): return shape.FUNCTIONS[int(x)](x)
def chain(x): return shape.inner.SLOPE * x
def function_of_chain(x): return shape.inner.line(x) + shape.inner_line(x)
def renamed(x):
    module = shape
    return module.SLOPE * x
def member(x): return x * shape.Kind.SOFT.value
def chosen(x):
    module = shape.inner if x > 0.0 else shape.inner
    return module.SLOPE * x
def mathematics(x):
    return (math.erf(x) + math.expm1(x) + math.log1p(x) + math.hypot(x, 1.0) + math.atan2(x, 2.0) + math.floor(x)
        + math.copysign(x, -1.0) + math.lgamma(1.0 + x) + x % 0.25 + x**0.3 + math.cosh(x) + abs(x) + shape.SLOPE)

def power(x): return 1.0 if x > 9.0 else 1.5 * power(x + 1.0)

def large(x): return shape.BIG[100_000] * x
def gamma(x): return math.gamma(1.0 + x) * shape.SLOPE
def exponent(x): return math.ldexp(x, 3) + math.frexp(x)[0] * shape.SLOPE
def foreign(x): return j0(x) * shape.SLOPE

def printing(x):
    print(x)
    return x
def factorial(n): return 1.0 if n <= 1 else n * factorial(n - 1)
def recursive(x): return factorial(5) * x
def one(x): return 0.0 if x <= 0.0 else other(x - 1.0)
def other(x): return one(x - 1.0)
def dictionary(x): return shape.KEPT["slope"] * x
def counting(x):
    global count
    count = 1
    return x
""",
}
LAST = [
    "constant",
    "helper",
    "helper_of_helper",
    "default",
    "closure",
    "compiled",
    "compiled_of_module",
    "array",
    "array_of_module",
    "columns",
    "strided",
    "triple",
    "pair",
    "nested",
    "function_of_tuple",
    "chain",
    "function_of_chain",
    "renamed",
    "member",
    "chosen",
    "power",
    "mathematics",
]
PERISH = ("large", "gamma", "exponent", "foreign")
REFUSED = {
    "printing": "questions.printing: it makes an object",
    "recursive": "questions.factorial: it calls itself",
    "one": "questions.one: it calls itself|questions.other: it calls itself",
    "dictionary": "KEPT",
    "function_by_number": "questions.function_by_number: ",
    "counting": "questions.py, line .*: counting writes the global count",
}


def write(folder: Path, old: str = "1.5", new: str = "1.5") -> None:
    """Write the files, with all that is ``old`` edited."""
    for name, text in FILES.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text.replace(old, new))


def questions(folder: Path) -> Any:
    """The module of the questions."""
    return load_module(folder / "questions.py")


def answered(question: Callable[[float], float], x: float = X) -> float:
    """The answer of the compiled question. Raises NotCompilable, DeckError."""

    def run(g: Any, _a: int, _b: int, _c: int, _d: int) -> None:
        g.numbers[0] = question(g.numbers[1])

    request = build.Request("question", lambda _: run, lambda: reach.digest(run), owner=question.__qualname__)
    numbers = np.array([0.0, x])
    where = build.address(request, SHARED)
    if build.call_pass(where, build.table([numbers], FIELDS), (0, 0, 0, 0)):
        raise ArithmeticError("raised")
    return float(numbers[0])


def said(question: Callable[[float], float]) -> float | str:
    """The answer, or what refuses it."""
    try:
        return answered(question)
    except NotCompilable as refused:
        failed = refused.failures[0]
        return f"questions.{failed.function.__qualname__}: {failed.error}"
    except DeckError as error:
        return str(error)


if __name__ == "__main__":
    notes: list[str] = []
    compiled: list[str] = []
    module = questions(Path(sys.argv[1]))
    with build.noting(notes.append), build.announcing(compiled.append):
        answers = {name: said(getattr(module, name)) for name in sys.argv[2:]}
    print(json.dumps({"answers": answers, "notes": notes, "compiled": bool(compiled)}))
