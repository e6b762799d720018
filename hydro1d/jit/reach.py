"""All that a function's code can reach, as text: what names its machine code in the cache.

Reached are the code itself, its constants, defaults and closure, the globals that it loads, the attributes of modules that it
asks for, and all that those reach in turn: functions, constants, arrays, compiled functions of numba.
"""

from __future__ import annotations

import dis
import enum
import functools
import hashlib
import sys
from collections.abc import Iterator
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

LIBRARIES = sys.stdlib_module_names | {
    "builtins",
    "numpy",
    "numba",
    "scipy",
    "pydantic",
}  # their versions stand for them
_LOADS = ("LOAD_GLOBAL", "LOAD_NAME", "LOAD_DEREF", "LOAD_CLASSDEREF")
_ATTRIBUTES = ("LOAD_ATTR", "LOAD_METHOD")


class Unreachable(Exception):
    """Something that code can reach and that has no lasting text: its machine code must not outlive the process."""


class KeepsState(Exception):
    """A function that writes a global: compiled code has none to write."""


def digest(*functions: Any) -> str:
    """A hash of all that the functions can reach. Raises Unreachable, KeepsState."""
    parts: list[str] = []
    seen: set[int] = set()
    for function in functions:
        _describe(function, parts, seen)
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _describe(value: Any, parts: list[str], seen: set[int]) -> None:
    python = getattr(value, "py_func", value)  # of a compiled function of numba
    if isinstance(value, BuiltinFunctionType) or is_of_library(python):
        parts.append(f"{python.__module__} {getattr(python, '__qualname__', python)}")
    elif isinstance(python, FunctionType):
        _describe_function(python, parts, seen)
    elif value is None or isinstance(value, bool | int | float | complex | str | bytes | np.generic):
        parts.append(f"{type(value).__name__} {value!r}")
    elif isinstance(value, enum.Enum):
        parts.append(f"{type(value).__module__}.{type(value).__qualname__} {value.name} {value.value!r}")
    elif isinstance(value, tuple | list):
        parts.append(f"{type(value).__qualname__} of {len(value)}")
        for item in value:
            _describe(item, parts, seen)
    elif isinstance(value, dict):
        _describe(tuple(value.items()), parts, seen)
    elif isinstance(value, np.ndarray) and value.dtype.kind in "biufc":
        parts.append(f"array {value.dtype.str} {value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}")
    elif isinstance(value, enum.EnumType):
        for name, member in value.__members__.items():
            parts.append(f"{name} {member.value!r}")
    elif isinstance(value, type) and hasattr(value, "_fields"):
        parts.append(f"{value.__qualname__} {value._fields}")
    elif isinstance(value, np.ufunc | np.dtype):
        parts.append(f"numpy {value}")
    elif isinstance(value, ModuleType):
        parts.append(f"module {value.__name__}")
    else:
        raise Unreachable(f"a {type(value).__name__}")


def is_of_library(value: Any) -> bool:
    """Whether something callable belongs to Python or to a library whose version names it well enough."""
    home = getattr(value, "__module__", None) if callable(value) else None
    return isinstance(home, str) and home.split(".")[0] in LIBRARIES


def _describe_function(function: FunctionType, parts: list[str], seen: set[int]) -> None:
    if id(function) in seen:
        parts.append(f"again {function.__qualname__}")
        return
    seen.add(id(function))
    parts += _text(function.__code__)
    _describe(function.__defaults__, parts, seen)
    for name, value in sorted((function.__kwdefaults__ or {}).items()):
        parts.append(name)
        _describe(value, parts, seen)
    for chain, value in reached(function):
        parts.append(".".join(chain))
        try:
            _describe(value, parts, seen)
        except Unreachable as error:
            raise Unreachable(f"{error} called {'.'.join(chain)} in {function.__qualname__}") from None


def reached(function: FunctionType) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Names that a function loads from outside, with the values: of a module, those attributes that it asks for."""
    cells = zip(function.__code__.co_freevars, function.__closure__ or (), strict=False)
    scope = {**function.__globals__, **{name: cell.cell_contents for name, cell in cells if not _is_empty(cell)}}
    for chain in chains(function.__code__):
        if chain[0] not in scope:
            continue  # a builtin, or a name that fails when it is asked for
        value, known = scope[chain[0]], chain[:1]
        for name in chain[1:]:
            if not isinstance(value, ModuleType) or not hasattr(value, name):
                break
            value, known = getattr(value, name), (*known, name)
        yield known, value


def _is_empty(cell: Any) -> bool:
    try:
        cell.cell_contents  # noqa: B018
    except ValueError:
        return True
    return False


@functools.lru_cache(maxsize=4096)
def chains(code: CodeType) -> tuple[tuple[str, ...], ...]:
    """Names that code loads from outside, each with the attributes that it asks of it at once, sorted.

    Raises KeepsState where it writes a global.
    """
    found: set[tuple[str, ...]] = set()
    chain: tuple[str, ...] = ()
    for step in dis.get_instructions(code):
        if step.opname == "STORE_GLOBAL":
            raise KeepsState(f"{code.co_qualname} keeps {step.argval} in a global")
        if step.opname in _ATTRIBUTES and chain:
            chain = (*chain, step.argval)
            continue
        if chain:
            found.add(chain)
        is_outer = step.opname in _LOADS and (step.opname != "LOAD_DEREF" or step.argval in code.co_freevars)
        chain = (step.argval,) if is_outer else ()
    if chain:
        found.add(chain)
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            found |= set(chains(constant))
    return tuple(sorted(found))


@functools.lru_cache(maxsize=4096)
def _text(code: CodeType) -> tuple[str, ...]:
    constants = [repr(constant) for constant in code.co_consts if not isinstance(constant, CodeType)]
    inner = [line for constant in code.co_consts if isinstance(constant, CodeType) for line in _text(constant)]
    return (code.co_qualname, code.co_code.hex(), repr(code.co_names), *constants, *inner)
