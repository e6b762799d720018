"""Copies of plain functions that numba can compile, with all that they call copied too.

numba keeps what it has compiled of a function for as long as that lives, with the values of its globals at the time. Copies
that are made for one kernel alone cannot be stale.
"""

from __future__ import annotations

from types import CellType, FunctionType, ModuleType
from typing import Any

from numba import njit

from hydro1d.jit import primitives
from hydro1d.jit.reach import is_of_library, reached

LEAN = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}  # for what only compiled code calls


class Copies:
    """The copies made for one kernel: one of each function."""

    def __init__(self) -> None:
        """None yet; `owners` tells whose copy a function is."""
        self.owners: dict[FunctionType, FunctionType] = {}
        self._compiled: dict[FunctionType, Any] = {}

    def compiled(self, function: FunctionType, **options: Any) -> Any:
        """What compiled code calls in place of a function."""
        if function not in self._compiled:
            cells = tuple(CellType() for _ in function.__closure__ or ())
            copy = _copy(function, {}, cells)
            self._compiled[function] = njit(**{**LEAN, **options})(copy)  # before its scope: it may call itself
            copy.__globals__.update(self._scope(function))
            for cell, original in zip(cells, function.__closure__ or (), strict=True):
                cell.cell_contents = self._seen(original.cell_contents)
            self.owners[copy] = function
        return self._compiled[function]

    def plain(self, function: FunctionType) -> FunctionType:
        """A copy that is itself not compiled, but calls what is."""
        cells = tuple(CellType(self._seen(cell.cell_contents)) for cell in function.__closure__ or ())
        copy = _copy(function, self._scope(function), cells)
        self.owners[copy] = function
        return copy

    def _scope(self, function: FunctionType) -> dict[str, Any]:
        """The globals of a function, with compiled copies in place of functions: its own, and those of modules."""
        scope = dict(function.__globals__)
        modules: dict[str, ModuleType] = {}
        for (name, *rest), value in reached(function):
            seen = self._seen(value)
            if name not in function.__globals__ or seen is value:
                continue
            holder: Any = scope
            key = path = name
            for part in rest:
                if path not in modules:
                    modules[path] = _shadow(_get(holder, key))
                    _set(holder, key, modules[path])
                holder, key, path = modules[path], part, f"{path}.{part}"
            _set(holder, key, seen)
        return scope

    def _seen(self, value: Any) -> Any:
        """What a copy sees in place of a value."""
        function = getattr(value, "py_func", value)  # of a function that numba has compiled already
        if not isinstance(function, FunctionType) or is_of_library(function):
            return value
        return function if function.__module__ == primitives.__name__ else self.compiled(function)


def _copy(function: FunctionType, scope: dict[str, Any], cells: tuple[CellType, ...]) -> FunctionType:
    copy = FunctionType(function.__code__, scope, function.__name__, function.__defaults__, cells)
    copy.__kwdefaults__, copy.__qualname__, copy.__module__ = (
        function.__kwdefaults__,
        function.__qualname__,
        function.__module__,
    )
    return copy


def _shadow(module: ModuleType) -> ModuleType:
    copy = ModuleType(module.__name__)
    copy.__dict__.update(module.__dict__)
    return copy


def _get(holder: Any, key: str) -> Any:
    return holder[key] if isinstance(holder, dict) else getattr(holder, key)


def _set(holder: Any, key: str, value: Any) -> None:
    if isinstance(holder, dict):
        holder[key] = value
    else:
        setattr(holder, key, value)
