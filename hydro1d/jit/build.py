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
from typing import Any, NamedTuple

import llvmlite.binding as llvm
import numpy as np

from hydro1d.components.parameters import Component
from hydro1d.jit import cache, compile, reach
from hydro1d.jit.versions import require_supported_compiler

UNKNOWN = "unknown: "
_LONGEST = 300  # characters of what is unknown
_lock = threading.Lock()
_engines: list[Any] = []  # keeps the machine code alive, and what it holds addresses of
_addresses: dict[str, int] = {}
_listeners: list[Callable[[str], None]] = []
_readers: list[Callable[[str], None]] = []
_noted: set[str] = set()


class Shared(NamedTuple):
    """The argument that all passes share: its name, and for each of its fields a dtype or `int`."""

    name: str
    fields: Mapping[str, Any]


class Request(NamedTuple):
    """What to compile: a name for messages; ``make``, which takes `fresh.Copies` and returns the function; ``content``,
    which answers with all that the machine code depends on, or raises `reach.Unreachable`; whether it is a leaf; whose code
    it is, for notes."""

    name: str
    make: Callable[[Any], Any]
    content: Callable[[], str]
    is_leaf: bool = True
    owner: str = "hydro1d"


def interpreted() -> bool:
    """Whether passes run as plain Python, for a debugger."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")


def address(request: Request, shared: Shared) -> int:
    """Address of the compiled function. Raises NotCompilable, `reach.KeepsState`."""
    try:
        content = request.content()
    except reach.Unreachable as error:
        with _lock:
            _note_perishable(request, f"it depends on {error}, which has no lasting name")
            return _loaded(_compiled(request, shared))
    fields = " ".join(f"{name}:{kind}" for name, kind in shared.fields.items())
    parts = [request.name, content, fields, str(request.is_leaf), _environment()]
    key = hashlib.sha256("\n".join(parts).encode()).hexdigest()
    with _lock:
        if key not in _addresses:
            code = cache.read(key)
            if code is not None:
                _addresses[key] = _loaded(compile.MachineCode(code))
            else:
                _addresses[key] = _loaded(_kept(key, request, shared))
        return _addresses[key]


def _kept(key: str, request: Request, shared: Shared) -> compile.MachineCode:
    """New machine code, which goes into the cache if it lasts."""
    made = _compiled(request, shared)
    if made.perishes:
        _note_perishable(request, made.perishes)
        return made
    problem = cache.write(key, made.code)
    if problem:
        _note(f"machine code cannot be kept and is compiled anew in every run: {problem}")
    return made


def _compiled(request: Request, shared: Shared) -> compile.MachineCode:
    for listener in _listeners:
        listener(request.name)
    require_supported_compiler()
    from hydro1d.jit.lowering import shared_type

    kind = shared_type(shared.name, shared.fields)
    is_integer = [field is int for field in shared.fields.values()]
    return compile.machine_code(request.make, kind, is_integer, request.is_leaf)


def _note_perishable(request: Request, why: str) -> None:
    _note(f"{request.owner} is compiled anew in every run, some seconds each: {why}")


def _note(text: str) -> None:
    """Tell who listens, each once."""
    if text not in _noted:
        for reader in _readers:
            reader(text)
            _noted.add(text)


@contextlib.contextmanager
def noting(reader: Callable[[str], None]) -> Iterator[None]:
    """Tell ``reader`` what a user should know about machine code that cannot be kept, each sentence once."""
    _readers.append(reader)
    try:
        yield
    finally:
        _readers.remove(reader)


@contextlib.contextmanager
def announcing(listener: Callable[[str], None]) -> Iterator[None]:
    """Tell ``listener`` the name of every kernel that is about to be compiled, which takes seconds."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def function(where: int) -> Callable[[int], int]:
    """A Python callable for a compiled function that takes the table of arguments alone; it releases the GIL.

    It answers with 1 where an exception was raised, which ends it at once, else with 0.
    """
    return ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p)(where)


def table(values: Any, fields: Mapping[str, Any]) -> np.ndarray:
    """The arguments as compiled code reads them: where each array begins, and the integers."""
    return np.array(
        [value if kind is int else value.ctypes.data for value, kind in zip(values, fields.values(), strict=True)],
        dtype=np.int64,
    )


def fingerprint(component: Component) -> str:
    """A digest of all that the code of a component can reach, compiled or not, and of the components that it holds.

    Where something has no lasting text it is `UNKNOWN` and what that is.
    """
    parts = [component, *(part for part in vars(component).values() if isinstance(part, Component))]
    try:
        return reach.digest(*(type(part) for part in parts))
    except reach.Unreachable as error:
        return f"{UNKNOWN}{error}"[:_LONGEST]
    except reach.KeepsState as error:  # in plain Python; where it would be compiled it is refused
        return f"{UNKNOWN}{error.what}"[:_LONGEST]


@functools.cache
def _environment() -> str:
    """Everything about this machine and installation that machine code depends on."""
    sources = sorted(Path(__file__).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()
    versions = " ".join(f"{name} {_version(name)}" for name in ("numba", "llvmlite", "numpy"))
    return f"{digest} {versions} {sys.version} {llvm.get_host_cpu_name()} {compile.features()}"


def _version(library: str) -> str:
    """Of what is installed; what is not is missed only by who has to compile."""
    try:
        return metadata.version(library)
    except metadata.PackageNotFoundError:
        return "none"


def _loaded(made: compile.MachineCode) -> int:
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), compile.target_machine())
    engine.add_object_file(llvm.ObjectFileRef.from_data(made.code))
    engine.finalize_object()
    _engines.append((engine, made.holds))
    return engine.get_function_address("kernel")


def call_pass(where: int, arguments: np.ndarray, integers: tuple[int, ...]) -> int:
    """Call one compiled pass with its integers; the answer is that of `function`."""
    kinds = (ctypes.c_void_p, *(ctypes.c_int64,) * len(integers))
    return ctypes.CFUNCTYPE(ctypes.c_int32, *kinds)(where)(arguments.ctypes.data, *integers)
