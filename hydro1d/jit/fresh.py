"""Copies of plain functions that numba can compile, with all that they call copied too.

numba keeps what it has compiled of a function for as long as that lives, with the values of its globals at the time. Copies
that are made for one kernel alone cannot be stale.
"""

from __future__ import annotations

from types import CellType, FunctionType, ModuleType
from typing import Any

import numpy as np
from numba import njit

from hydro1d.jit import primitives
from hydro1d.jit.reach import is_of_library, names, reached

LEAN = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}  # for what only compiled code calls


class Copies:
    """The copies made for one kernel: one of each function and of each array."""

    def __init__(self) -> None:
        """None yet; `owners` tells whose copy a function is."""
        self.owners: dict[FunctionType, FunctionType] = {}
        self._compiled: dict[FunctionType, Any] = {}
        self._arrays: dict[int, tuple[np.ndarray, np.ndarray]] = {}  # by id, with the original, which keeps its id

    def compiled(self, function: FunctionType, **options: Any) -> Any:
        """What compiled code calls in place of a function."""
        if function not in self._compiled:
            cells = tuple(CellType() for _ in function.__closure__ or ())
            copy = _copy(function, {}, cells)
            self._compiled[function] = njit(**{**LEAN, **options})(copy)  # before its scope: it may call itself
            self._fill(copy, function)
        return self._compiled[function]

    def plain(self, function: FunctionType) -> FunctionType:
        """A copy that is itself not compiled, but calls what is."""
        cells = tuple(CellType() for _ in function.__closure__ or ())
        copy = _copy(function, {}, cells)
        self._fill(copy, function)
        return copy

    def _fill(self, copy: FunctionType, function: FunctionType) -> None:
        """Give a copy its globals and the variables around it."""
        mentioned, shadows = names(function.__code__), {}  # type: ignore[var-annotated]
        seen = {name: self._seen(value, mentioned, shadows) for name, value in reached(function).items()}
        copy.__globals__.update(function.__globals__)
        copy.__globals__.update({name: value for name, value in seen.items() if name in function.__globals__})
        for name, cell in zip(function.__code__.co_freevars, copy.__closure__ or (), strict=True):
            if name in seen:
                cell.cell_contents = seen[name]
        self.owners[copy] = function

    def _seen(self, value: Any, mentioned: frozenset[str], shadows: dict[int, ModuleType]) -> Any:
        """What a copy sees in place of a value."""
        value = getattr(value, "py_func", value)  # of a function that numba has compiled already
        if isinstance(value, np.ndarray):
            # A machine code that holds a large array's address, or a strided one's, holds that of an array which stays.
            return self._arrays.setdefault(id(value), (value, np.array(value, order="C")))[1]
        if type(value) is tuple or hasattr(type(value), "_fields"):
            items = [self._seen(item, mentioned, shadows) for item in value]
            return tuple(items) if type(value) is tuple else type(value)(*items)
        if is_of_library(value) or not isinstance(value, FunctionType | ModuleType):
            return value
        if isinstance(value, FunctionType):
            return value if value.__module__ == primitives.__name__ else self.compiled(value)
        if id(value) not in shadows:
            shadows[id(value)] = shadow = ModuleType(value.__name__)
            shadow.__dict__.update(value.__dict__)
            for name in mentioned & vars(value).keys():
                setattr(shadow, name, self._seen(vars(value)[name], mentioned, shadows))
        return shadows[id(value)]


def _copy(function: FunctionType, scope: dict[str, Any], cells: tuple[CellType, ...]) -> FunctionType:
    copy = FunctionType(function.__code__, scope, function.__name__, function.__defaults__, cells)
    copy.__kwdefaults__, copy.__qualname__, copy.__module__ = (
        function.__kwdefaults__,
        function.__qualname__,
        function.__module__,
    )
    return copy
