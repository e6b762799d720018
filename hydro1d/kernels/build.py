"""From a kernel in Python to machine code, once; from a file of object code, ever after.

numba's own cache would not do: it imports numba (most of a second) to load a kernel, and it misses edits of helper files.
Here a kernel's file is named after the content of everything that went into it, and carries a checksum.
"""

from __future__ import annotations

import contextlib
import ctypes
import dis
import functools
import gc
import hashlib
import os
import re
import stat
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import llvmlite
import llvmlite.binding as llvm

from hydro1d.components.parameters import Component
from hydro1d.jit_versions import require_supported_compiler

_CTYPES = {"p": ctypes.c_void_p, "q": ctypes.c_void_p, "i": ctypes.c_int64}
_lock = threading.Lock()
_engines: list[Any] = []  # keeps the machine code alive
_addresses: dict[str, int] = {}
_listeners: list[Callable[[str], None]] = []
_target: Any = None


def interpreted() -> bool:
    """Whether kernels run as plain Python, for a debugger."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")


def address(name: str, signature: str, content: str, make: Callable[[], Callable]) -> int:
    """Address of the compiled kernel.

    ``make`` returns the Python kernel and is called only if the kernel is not in the cache; ``content`` tells everything
    that the machine code depends on besides this package's own kernels (the source of a law, say). Raises NotCompilable.
    """
    key = hashlib.sha256("\n".join([name, signature, content, _environment()]).encode()).hexdigest()
    with _lock:
        if key not in _addresses:
            code = _read(key)
            if code is None:
                for listener in _listeners:
                    listener(name)
                require_supported_compiler()
                code = _compile(make(), signature)
                _write(key, code)
            _addresses[key] = _load(code)
        return _addresses[key]


@contextlib.contextmanager
def announcing(listener: Callable[[str], None]) -> Iterator[None]:
    """Tell ``listener`` the name of every kernel that is about to be compiled, which takes seconds."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def function(where: int, signature: str) -> Callable:
    """A Python callable for the kernel at an address; it releases the GIL."""
    return ctypes.CFUNCTYPE(None, *(_CTYPES[letter] for letter in signature))(where)


@functools.cache
def fingerprint(component: type[Component]) -> str:
    """A digest of the code of a component: its methods, the functions they call and the constants they use."""
    parts: list[str] = []
    seen: set[int] = set()
    for base in component.__mro__:
        if issubclass(base, Component) and base is not Component:
            parts.append(base.__qualname__)
            for key, item in sorted(vars(base).items(), key=lambda pair: pair[0]):
                item = getattr(item, "func", item)
                if isinstance(item, FunctionType):
                    parts.append(key)
                    _digest(item, parts, seen)
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _digest(code: FunctionType | CodeType, parts: list[str], seen: set[int]) -> None:
    scope: dict[str, Any] = {}
    if isinstance(code, FunctionType):
        scope, code = code.__globals__, code.__code__
    if id(code) in seen:
        return
    seen.add(id(code))
    parts += [code.co_code.hex(), repr(code.co_names), repr([c for c in code.co_consts if not isinstance(c, CodeType)])]
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            _digest(constant, parts, seen)
    # Globals alone: an attribute may well be called like one that has nothing to do with it.
    for name in sorted({step.argval for step in dis.get_instructions(code) if step.opname == "LOAD_GLOBAL"}):
        value = scope.get(name)
        if isinstance(value, FunctionType):
            _digest(value, parts, seen)
        elif isinstance(value, bool | int | float | tuple):
            parts.append(f"{name}={value!r}")


@functools.cache
def _environment() -> str:
    """Everything about this machine and installation that machine code depends on."""
    sources = sorted(Path(__file__).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()
    return f"{digest} {llvmlite.__version__} {sys.version} {llvm.get_host_cpu_name()} {_features()}"


def _machine() -> Any:
    global _target
    if _target is None:
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        _target = llvm.Target.from_default_triple()
    return _target.create_target_machine(cpu=llvm.get_host_cpu_name(), features=_features(), opt=3, reloc="pic")


@functools.cache
def _features() -> str:
    """This processor's, and its whole vector registers: LLVM is shy of them for the sake of code that uses few."""
    return ",".join([llvm.get_host_cpu_features().flatten(), "-prefer-256-bit"])


def _compile(kernel: Callable, signature: str) -> bytes:
    """Object code with one public symbol, ``kernel``."""
    from numba import njit, types

    from hydro1d.kernels.lowering import LEAN, POINTER, make_compilable, only_lowered
    from hydro1d.kernels.refusals import noticed

    letters = {"p": POINTER, "q": types.CPointer(types.int64), "i": types.int64}
    make_compilable(kernel)
    kinds = tuple(letters[letter] for letter in signature)
    # With the options of what it calls: numba would compile that again for a caller with others.
    options: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract", "arcp"}, "_nrt": False, **LEAN}
    dispatcher: Any = njit(**options)(kernel)
    with noticed(), only_lowered(), _without_garbage_collection():
        dispatcher.compile(kinds)
    native = dispatcher.overloads[kinds].fndesc.mangled_name
    module = llvm.parse_assembly(_with_entry(dispatcher.inspect_llvm(kinds), native, signature))
    for defined in module.functions:
        if not defined.is_declaration and defined.name != "kernel":
            defined.linkage = "internal"
            defined.add_function_attribute("alwaysinline")  # only within `kernel` is it known that no arrays overlap
    machine = _machine()
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    tuning.loop_vectorization = tuning.loop_interleaving = True
    tuning.inlining_threshold = 10_000
    passes = llvm.create_pass_builder(machine, tuning)
    passes.getModulePassManager().run(module, passes)
    return machine.emit_object(module)


@contextlib.contextmanager
def _without_garbage_collection() -> Iterator[None]:
    """numba makes millions of objects and keeps most of them: looking for garbage among them takes 5 to 8 % of its time."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def _with_entry(code: str, native: str, signature: str) -> str:
    """numba's module with an entry that promises LLVM what numba cannot: the arrays of a call never overlap.

    numba calls the C library's square root, which keeps a loop from being vectorised; LLVM's own is the same number.
    """
    code = re.sub(r"@sqrt\b", "@llvm.sqrt.f64", code)
    kinds = ["i64" if letter == "i" else "ptr noalias" for letter in signature]
    declared = ", ".join(f"{kind} %a{k}" for k, kind in enumerate(kinds))
    passed = ", ".join(f"{kind.split()[0]} %a{k}" for k, kind in enumerate(kinds))
    flushes = "q" in signature and "x86_64" in llvm.get_process_triple()  # the time loop, which calls the others
    flush, restore, declarations = _FLUSH if flushes else ("", "", "")
    return f"""{code}
{declarations}
define void @kernel({declared}) {{
  %unused_result = alloca ptr
  %unused_error = alloca ptr
{flush}
  %status = call i32 @{native}(ptr %unused_result, ptr %unused_error, {passed})
{restore}
  ret void
}}
"""


# Ahead of a wave the motion fades into numbers below 1e-308, on which these processors take a hundred times as long: inside
# a kernel such numbers count as zero (bits 6 and 15 of the control register).
_FLUSH = (
    """  %before = alloca i32
  %inside = alloca i32
  call void @llvm.x86.sse.stmxcsr(ptr %before)
  %control = load i32, ptr %before
  %flushing = or i32 %control, 32832
  store i32 %flushing, ptr %inside
  call void @llvm.x86.sse.ldmxcsr(ptr %inside)""",
    "  call void @llvm.x86.sse.ldmxcsr(ptr %before)",
    "declare void @llvm.x86.sse.stmxcsr(ptr)\ndeclare void @llvm.x86.sse.ldmxcsr(ptr)",
)


def _load(code: bytes) -> int:
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _machine())
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    _engines.append(engine)
    return engine.get_function_address("kernel")


def cache_folder() -> Path:
    """Where object code is kept: ``HYDRO1D_CACHE_DIR``, else the user's cache folder."""
    named = os.environ.get("HYDRO1D_CACHE_DIR")
    if named:
        return Path(named)
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path(os.path.expanduser("~")) / ".cache") / "hydro1d"


def _read(key: str) -> bytes | None:
    """The object code of an earlier run, if it is whole, and nobody else could have put it there."""
    path = cache_folder() / f"{key}.o"
    try:
        with path.open("rb") as file:
            if not _is_ours(os.fstat(file.fileno())):
                return None
            content = file.read()
    except OSError:
        return None
    digest, code = content[:32], content[32:]
    return code if code and hashlib.sha256(code).digest() == digest else None


def _is_ours(found: os.stat_result) -> bool:
    """Machine code is run: it must be this user's, or root's, and writable by nobody else."""
    if not hasattr(os, "getuid"):
        return True
    return found.st_uid in (os.getuid(), 0) and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


def _write(key: str, code: bytes) -> None:
    """Keep the object code for later runs; a cache that cannot be written costs time, not the run.

    Written beside its place and renamed: another process sees the whole file or none.
    """
    temporary = None
    try:
        folder = cache_folder()
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=folder, delete=False) as file:  # readable by its owner alone
            temporary = Path(file.name)
            file.write(hashlib.sha256(code).digest() + code)
        temporary.replace(folder / f"{key}.o")
    except OSError:
        if temporary is not None:
            with contextlib.suppress(OSError):
                temporary.unlink()
