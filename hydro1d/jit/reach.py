"""All that a function's code can reach, as text: what names its machine code in the cache.

Reached are the code itself, its constants, defaults and closure, and whatever bears a name that the code mentions: globals,
attributes of modules, methods of a component, and all that those reach in turn. That is a little too much, never too little,
and asks nothing of the instructions of one version of Python.
"""

from __future__ import annotations

import contextlib
import enum
import functools
import hashlib
import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from functools import _lru_cache_wrapper
from opcode import opmap
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from hydro1d.components.parameters import Component
from hydro1d.errors import DeckError

_LIBRARIES = {"builtins", "numpy", "numba", "scipy", "pydantic"}  # and Python's own: their versions stand for them
_PYTHON = os.path.dirname(os.__file__)
# What a library knows by a name, and that keeps nothing: functions in Python and C, classes, functions of numpy.
_NAMED = (FunctionType, BuiltinFunctionType, type, type(np.interp))
_CONSTANTS = (bool, int, float, complex, str, bytes, range, slice, type(None), type(...))
_WRITES = {opmap["STORE_GLOBAL"], opmap["DELETE_GLOBAL"]}
_IMPORTS = {opmap["IMPORT_NAME"]}


class Unreachable(Exception):
    """Something that code can reach and that has no lasting text: its machine code must not outlive the process."""


class KeepsState(DeckError):
    """A function that writes a global, which compiled code cannot; `what` says so in short."""

    def __init__(self, code: CodeType, variable: str, line: int) -> None:
        self.what = f"the global {variable}, which {code.co_qualname} writes"
        super().__init__(
            f"{code.co_filename}, line {line}: {code.co_qualname} writes the global {variable}, and compiled code keeps "
            "nothing between calls; what a law or boundary keeps are its state variables"
        )


def digest(*values: Any, methods: Mapping[str, Iterable[FunctionType]] | None = None) -> str:
    """A hash of all that functions, or classes, can reach; ``methods`` are those that they may call on a component.

    Raises Unreachable, KeepsState.
    """
    walk = _Walk(methods or {})
    for value in values:
        walk.describe(value)
    return hashlib.sha256("\n".join(walk.parts).encode()).hexdigest()


def is_of_library(value: Any) -> bool:
    """Whether a function, a class or a module belongs to Python or to a library whose version names it well enough."""
    home: Any = None  # of what is made of a library's class, which is somebody's own
    if isinstance(value, ModuleType):
        home = value.__name__
    elif isinstance(value, np.ufunc):
        home = "numpy" if getattr(np, value.__name__, None) is value else None
    elif isinstance(value, _NAMED) and isinstance(getattr(value, "__self__", None), ModuleType | type | None):
        home = value.__module__
    elif type(value).__module__.startswith("numba.core.types"):
        home = "numba"
    return isinstance(home, str) and _is_library(home.split(".")[0])


def _is_library(root: str) -> bool:
    """Whether a module of this name is a library's: a file of the user's may be called ``profile.py``, as one of Python's is."""
    if root not in sys.stdlib_module_names:
        return root in _LIBRARIES
    file = getattr(sys.modules.get(root), "__file__", None)
    return file is None or file.startswith(_PYTHON)


@functools.lru_cache(maxsize=4096)
def names(code: CodeType) -> frozenset[str]:
    """Names that code mentions: of globals, attributes, variables of functions around it, and texts that could be names."""
    texts = (text for text in code.co_consts if isinstance(text, str) and text.isidentifier())
    inner = (names(constant) for constant in code.co_consts if isinstance(constant, CodeType))
    return frozenset(code.co_names).union(code.co_freevars, texts, *inner)


_MADE = ("__", "_abc_")  # names of a class that are not its author's; of a component's, pydantic makes more


class _Walk:
    """A walk through what is reached; `parts` describes it in an order that is the same in every process."""

    def __init__(self, methods: Mapping[str, Iterable[FunctionType]]) -> None:
        self.parts: list[str] = []
        self._methods = methods
        self._seen: dict[int, tuple[int, Any]] = {}  # by id, which is unique as long as the object is held here

    def describe(self, value: Any, mentioned: frozenset[str] = frozenset()) -> None:
        """Add a value; of a module, what bears a name that is ``mentioned``."""
        value = getattr(value, "py_func", value)  # of a compiled function of numba
        kind = type(value)
        if is_of_library(value):
            self.parts.append(_name(value))
        elif isinstance(value, _CONSTANTS) and kind.__module__ == "builtins":
            self.parts.append(f"{kind.__name__} {value!r}")
        elif isinstance(value, np.ndarray | np.generic | np.dtype):
            self.parts.append(_array_text(value))
        elif isinstance(value, enum.Enum):
            self.parts.append(f"{_name(kind)} {value.name} {value.value!r}")
        elif isinstance(value, Component):
            self._once(kind, mentioned)
            self.describe({name: getattr(value, name) for name in kind.model_fields})
        elif isinstance(value, frozenset | set):
            self._all(sorted(value, key=repr), kind)
        elif isinstance(value, tuple | list):
            self._all(value, kind)
        elif isinstance(value, dict):
            self._all([part for pair in value.items() for part in pair], kind)
        elif isinstance(value, FunctionType | ModuleType | type | _lru_cache_wrapper):
            self._once(value, mentioned)
        else:
            raise Unreachable(f"an object of type {kind.__name__}")

    def _all(self, items: Iterable[Any], kind: type) -> None:
        items = list(items)
        self.parts.append(f"{_name(kind)} {getattr(kind, '_fields', '')} of {len(items)}")
        for item in items:
            self.describe(item)

    def _once(self, value: Any, mentioned: frozenset[str]) -> None:
        """What may reach itself, or be reached by many ways."""
        if isinstance(value, ModuleType):
            self._module(value, mentioned, set())
            return
        if id(value) in self._seen:
            self.parts.append(f"again {self._seen[id(value)][0]}")
            return
        self._seen[id(value)] = len(self._seen), value
        if isinstance(value, FunctionType):
            self._function(value)
        elif isinstance(value, type):
            self._class(value)
        else:
            self.describe(value.__wrapped__)

    def _module(self, module: ModuleType, mentioned: frozenset[str], above: set[int]) -> None:
        self.parts.append(f"module {module.__name__}")
        for name in sorted(mentioned & vars(module).keys()):
            value = vars(module)[name]
            self.parts.append(name)
            if isinstance(value, ModuleType) and not is_of_library(value):
                if id(value) not in above:
                    self._module(value, mentioned, above | {id(module)})
                continue
            with _named(f"{name} in {module.__name__}"):
                self.describe(value)

    def _function(self, function: FunctionType) -> None:
        code = function.__code__
        self.parts += _text(code)
        self.describe(function.__defaults__)
        self.describe(function.__kwdefaults__)
        mentioned = names(code)
        for name, value in sorted(reached(function).items()):
            self.parts.append(name)
            try:
                with _named(f"{name} in {function.__qualname__}"):
                    self.describe(value, mentioned)
            except (Unreachable, KeepsState):
                if name in _loaded(code):  # and no attribute of that name was meant
                    raise
        for name in sorted(mentioned & self._methods.keys()):
            for method in self._methods[name]:
                self._once(method, mentioned)

    def _class(self, kind: type) -> None:
        """Its functions and constants, and those of its bases."""
        if issubclass(kind, enum.Enum):
            self.parts += [f"{name} {member.value!r}" for name, member in kind.__members__.items()]
        elif issubclass(kind, tuple) and hasattr(kind, "_fields"):
            self.parts.append(f"{kind.__qualname__} {kind._fields}")
            self.describe(kind._field_defaults)  # type: ignore[attr-defined]
        else:
            for base in kind.__mro__:
                self.parts.append(_name(base))
                if base is Component or is_of_library(base):
                    continue
                for name, item in sorted(vars(base).items()):
                    if not name.startswith(_MADE + ("model_",) * issubclass(base, Component)):
                        self.parts.append(name)
                        with _named(f"{name} in {base.__qualname__}"):
                            self.describe(_function_of(item))


@contextlib.contextmanager
def _named(name: str) -> Iterator[None]:
    """Tell under what name the unreachable was come upon: the innermost."""
    try:
        yield
    except Unreachable as error:
        raise Unreachable(str(error) if " called " in str(error) else f"{error} called {name}") from None


def reached(function: FunctionType) -> dict[str, Any]:
    """What a function mentions of its globals and of the variables around it, by name."""
    mentioned, scope = names(function.__code__), function.__globals__
    found = {name: scope[name] for name in mentioned & scope.keys()}
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        try:
            found[name] = cell.cell_contents
        except ValueError:  # empty: it fails when it is asked for
            found.pop(name, None)
    return found


def _loaded(code: CodeType) -> set[str]:
    """Names that code loads from outside itself."""
    import dis

    loads = ("LOAD_GLOBAL", "LOAD_NAME", "LOAD_FROM_DICT_OR_GLOBALS")
    found = {str(step.argval) for step in dis.get_instructions(code) if step.opname in loads}
    inner = [_loaded(constant) for constant in code.co_consts if isinstance(constant, CodeType)]
    return found.union(code.co_freevars, *inner)


@functools.lru_cache(maxsize=4096)
def _text(code: CodeType) -> tuple[str, ...]:
    """What the code itself depends on. Raises KeepsState where it writes a global, Unreachable where it imports somebody's."""
    instructions = set(code.co_code[::2])
    if instructions & _WRITES:
        name, line = _operand(code, _WRITES)
        raise KeepsState(code, name, line)
    imported = _operand(code, _IMPORTS)[0] if instructions & _IMPORTS else "hydro1d"
    if imported.split(".")[0] != "hydro1d" and not _is_library(imported.split(".")[0]):
        raise Unreachable(f"an import called {imported} in {code.co_qualname}")
    shape = (code.co_argcount, code.co_posonlyargcount, code.co_kwonlyargcount, code.co_flags, code.co_varnames)
    outer = (code.co_names, code.co_freevars, code.co_cellvars, code.co_exceptiontable)
    parts = [code.co_qualname, code.co_code.hex(), repr(shape), repr(outer)]
    for constant in code.co_consts:
        parts += _text(constant) if isinstance(constant, CodeType) else [_constant_text(constant)]
    return tuple(parts)


def _constant_text(constant: Any) -> str:
    """A constant of code; texts of a set come in another order in every process."""
    return f"set {sorted(map(repr, constant))}" if isinstance(constant, frozenset) else repr(constant)


def _operand(code: CodeType, wanted: set[int]) -> tuple[str, int]:
    """Name and line of the first of these instructions."""
    import dis

    found = next(step for step in dis.get_instructions(code) if step.opcode in wanted)
    return str(found.argval), found.positions.lineno or 0 if found.positions else 0


def _array_text(value: Any) -> str:
    if isinstance(value, np.dtype):
        return f"dtype {value!r}"
    if value.dtype.hasobject:
        raise Unreachable("an array of objects")
    return f"{type(value).__name__} {value.dtype!r} {value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}"


def _function_of(item: Any) -> Any:
    """The function within a method of any kind, a property, a cached constant; anything else as it is."""
    for inside in ("__func__", "fget", "func", "wrapped"):
        item = getattr(item, inside, item)
    return item


def _name(value: Any) -> str:
    """Where something is at home, and its name there."""
    own = getattr(value, "__qualname__", None) or getattr(value, "__name__", None) or repr(value)
    return f"{getattr(value, '__module__', None)}.{own}"
