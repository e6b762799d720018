"""Machine code by content: compiled once, kept in a cache folder, loaded from there ever after without importing numba.

numba's own cache would not do: it imports numba (most of a second) to load a kernel, and it misses edits of helper files.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
import hashlib
import os
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from importlib import metadata
from pathlib import Path
from types import FunctionType
from typing import Any, NamedTuple

import llvmlite.binding as llvm
import numpy as np

from hydro1d.components.parameters import Component
from hydro1d.jit import cache, compile, reach
from hydro1d.jit.versions import require_supported_compiler

_lock = threading.Lock()
_engines: list[Any] = []  # keeps the machine code alive
_addresses: dict[str, int] = {}
_listeners: list[Callable[[str], None]] = []


class Shared(NamedTuple):
    """The argument that all passes share: its name, and for each of its fields a dtype or `int`."""

    name: str
    fields: Mapping[str, Any]


class Request(NamedTuple):
    """What to compile: a name for messages; ``make``, which takes `fresh.Copies` and returns the function; ``content``,
    which names everything that the machine code depends on, or None where that cannot be named; whether it is a leaf."""

    name: str
    make: Callable[[Any], Any]
    content: str | None
    is_leaf: bool = True


def interpreted() -> bool:
    """Whether passes run as plain Python, for a debugger."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")


def address(request: Request, shared: Shared) -> int:
    """Address of the compiled function. Raises NotCompilable."""
    fields = " ".join(f"{name}:{kind}" for name, kind in shared.fields.items())
    parts = [request.name, str(request.content), fields, str(request.is_leaf), _environment()]
    key = hashlib.sha256("\n".join(parts).encode()).hexdigest()
    with _lock:
        if request.content is None:
            return _load(_compiled(request, shared)[0])
        if key not in _addresses:
            code = cache.read(key)
            if code is None:
                code, lasts = _compiled(request, shared)
                if lasts:
                    cache.write(key, code)
            _addresses[key] = _load(code)
        return _addresses[key]


def _compiled(request: Request, shared: Shared) -> tuple[bytes, bool]:
    for listener in _listeners:
        listener(request.name)
    require_supported_compiler()
    from hydro1d.jit.lowering import shared_type

    kind = shared_type(shared.name, shared.fields)
    is_integer = [field is int for field in shared.fields.values()]
    return compile.object_code(request.make, kind, is_integer, request.is_leaf)


@contextlib.contextmanager
def announcing(listener: Callable[[str], None]) -> Iterator[None]:
    """Tell ``listener`` the name of every kernel that is about to be compiled, which takes seconds."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def function(where: int) -> Callable[[int], None]:
    """A Python callable for a compiled function that takes the table of arguments alone; it releases the GIL."""
    return ctypes.CFUNCTYPE(None, ctypes.c_void_p)(where)


def table(values: Any, fields: Mapping[str, Any]) -> np.ndarray:
    """The arguments as compiled code reads them: where each array begins, and the integers."""
    return np.array(
        [value if kind is int else value.ctypes.data for value, kind in zip(values, fields.values(), strict=True)],
        dtype=np.int64,
    )


def fingerprint(component: type[Component]) -> str:
    """A digest of all that the code of a component can reach: its methods, and what these call and use.

    Raises `reach.Unreachable` where something has no lasting text, `reach.KeepsState` where it writes a global.
    """
    functions: list[FunctionType] = []
    names: list[str] = []
    for base in component.__mro__:
        if issubclass(base, Component) and base is not Component:
            for key, item in sorted(vars(base).items(), key=lambda pair: pair[0]):
                item = getattr(item, "func", item)
                if isinstance(item, FunctionType) and not key.startswith("__"):
                    names.append(f"{base.__qualname__}.{key}")
                    functions.append(item)
    return hashlib.sha256("\n".join([*names, reach.digest(*functions)]).encode()).hexdigest()


@functools.cache
def _environment() -> str:
    """Everything about this machine and installation that machine code depends on."""
    sources = sorted(Path(__file__).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()
    versions = " ".join(f"{name} {metadata.version(name)}" for name in ("numba", "llvmlite", "numpy"))
    return f"{digest} {versions} {sys.version} {llvm.get_host_cpu_name()} {compile.features()}"


def _load(code: bytes) -> int:
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), compile.target_machine())
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    _engines.append(engine)
    return engine.get_function_address("kernel")


def call_pass(where: int, arguments: np.ndarray, integers: tuple[int, ...]) -> None:
    """Call one compiled pass with its integers."""
    kinds = (ctypes.c_void_p, *(ctypes.c_int64,) * len(integers))
    ctypes.CFUNCTYPE(None, *kinds)(where)(arguments.ctypes.data, *integers)
