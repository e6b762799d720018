"""How numba compiles the primitives, and the record types through which compiled code sees components."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from types import FunctionType
from typing import Any
from unittest.mock import patch

import numpy as np
from llvmlite import ir
from numba import _dynfunc, types  # type: ignore[attr-defined]
from numba.core import cgutils
from numba.core.codegen import CPUCodeLibrary, JITCodeLibrary
from numba.core.compiler_lock import global_compiler_lock
from numba.core.cpu import CPUContext
from numba.extending import (
    intrinsic,
    lower_builtin,
    make_attribute_wrapper,
    models,
    overload,
    overload_method,
    register_jitable,
    register_model,
    type_callable,
)
from numba.np import linalg

from hydro1d.components.parameters import Component, derived
from hydro1d.kernels import primitives

LEAN = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}  # for what only compiled code calls

POINTER = types.CPointer(types.float64)
_INTEGER, _DOUBLE = ir.IntType(64), ir.DoubleType()
_ANY_ORDER = ("nnan", "nsz")


def _primitive(function: Callable, kind: Callable) -> Callable:
    """Register how LLVM does a primitive: ``kind`` of its arguments' types is the type of its value.

    An `overload` would do, and cost one more function to infer, lower and inline for each.
    """

    def register(generate: Callable) -> Callable:
        type_callable(function)(lambda _context: kind)
        return lower_builtin(function, types.VarArg(types.Any))(generate)

    return register


@_primitive(primitives.offset, lambda pointer, start: pointer)
def _offset(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return builder.gep(args[0], [args[1]])


@_primitive(primitives.gather, lambda pointer, start, stride, count: types.UniTuple(types.float64, len(count)))
def _gather(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    pointer, start, stride, _ = args
    count = len(signature.return_type)
    places = [builder.add(start, builder.mul(stride, ir.Constant(_INTEGER, k))) for k in range(count)]
    values = [builder.load(builder.gep(pointer, [place])) for place in places]
    return context.make_tuple(builder, signature.return_type, values)


@_primitive(primitives.scatter, lambda pointer, start, stride, values: types.void)
def _scatter(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    pointer, start, stride, packed = args
    for k in range(len(signature.args[3])):
        place = builder.add(start, builder.mul(stride, ir.Constant(_INTEGER, k)))
        builder.store(builder.extract_value(packed, k), builder.gep(pointer, [place]))
    return context.get_dummy_value()


@_primitive(primitives.larger, lambda value, other: types.float64)
def _larger(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    exceeds = builder.fcmp_ordered(">", args[1], args[0], flags=_ANY_ORDER)
    return builder.select(exceeds, args[1], args[0], flags=_ANY_ORDER)


@_primitive(primitives.accumulate, lambda total, value: types.float64)
def _accumulate(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return builder.fadd(args[0], args[1], flags=("reassoc", "contract", "nsz"))


@intrinsic
def _call(_typing: Any, addresses: Any, which: Any, arguments: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        addresses, which, packed = args
        values = cgutils.unpack_tuple(builder, packed, len(signature.args[2]))
        kernel_type = ir.FunctionType(ir.VoidType(), [value.type for value in values])
        address = builder.load(builder.gep(addresses, [which]))
        builder.call(builder.inttoptr(address, kernel_type.as_pointer()), values)
        return context.get_dummy_value()

    return types.void(addresses, which, arguments), generate


# numba hands a variable number of arguments only to an overload.
overload(primitives.call, jit_options=LEAN)(
    lambda functions, which, *arguments: lambda functions, which, *arguments: _call(functions, which, arguments)
)


def _executable(context: Any, library: Any, description: Any, environment: Any) -> Any:
    """Machine code as ever for what Python may call (an ``@njit`` function that a law uses), none for anything else."""
    library._ensure_finalized()
    if library.codegen._engine.is_symbol_defined(description.llvm_cpython_wrapper_name):
        return _make_executable(context, library, description, environment)
    return _dynfunc.make_function(description.lookup_module(), description.qualname, "", 0, environment, (library,))


def _pointer(library: Any, name: str) -> int:
    """No machine code for a kernel's entry; `build` makes it."""
    library._ensure_finalized()
    return 0 if name.startswith("cfunc.") else _make_pointer(library, name)


_make_executable, _make_pointer = CPUContext.get_executable, JITCodeLibrary.get_pointer_to_function

# What numba does to each function by itself and `build` does once, for a kernel with all that it calls. numba would
# vectorise loops with checks for overlap that `build` makes needless, and make machine code that nobody runs. Nor need
# scipy be there for the linear algebra that no kernel has; numba imports it to find out.
_LEFT_OUT = (
    (linalg, "ensure_blas", lambda: None),
    (CPUCodeLibrary, "_optimize_functions", lambda *_arguments: None),
    (CPUCodeLibrary, "_optimize_final_module", lambda *_arguments: None),
    (JITCodeLibrary, "_finalize_specific", lambda *_arguments: None),
    (JITCodeLibrary, "get_pointer_to_function", _pointer),
    (CPUContext, "get_executable", _executable),
)


@contextmanager
def only_lowered() -> Iterator[None]:
    """Keep numba from going beyond LLVM's language; compiling in other threads waits meanwhile."""
    with global_compiler_lock, ExitStack() as stack:
        for owner, name, replacement in _LEFT_OUT:
            stack.enter_context(patch.object(owner, name, replacement))
        yield


def record_type(component: Component, members: dict[str, Any]) -> types.Type:
    """A numba type with the component's numeric members as attributes and its methods as methods."""
    name = f"{type(component).__module__}.{type(component).__qualname__}"
    record = type("Record", (types.Type,), {"__init__": lambda self: types.Type.__init__(self, name)})
    kinds = [(key, _member_type(value)) for key, value in members.items()]

    class Model(models.StructModel):
        def __init__(self, manager: Any, kind: Any) -> None:
            super().__init__(manager, kind, kinds)

    register_model(record)(Model)
    for key in members:
        make_attribute_wrapper(record, key, key)
    instance = record()
    for key, method in methods(type(component)).items():
        make_compilable(method)
        overload_method(record, key, jit_options=LEAN)(_as_overload(method))
    return instance


def _member_type(value: Any) -> types.Type:
    if isinstance(value, np.ndarray):
        return POINTER
    if isinstance(value, tuple):
        return record_type(*value)
    return types.float64


def _as_overload(method: FunctionType) -> Callable:
    def choose(*_args: Any, **_keywords: Any) -> FunctionType:
        return method

    # numba asks an overload for the same argument names as its implementation.
    choose.__signature__ = inspect.signature(method)  # type: ignore[attr-defined]
    return choose


def methods(component: type[Component]) -> dict[str, FunctionType]:
    """The plain methods that a component's compiled functions may call on themselves."""
    found: dict[str, FunctionType] = {}
    for base in reversed(component.__mro__):
        if issubclass(base, Component) and base is not Component:
            for key, item in vars(base).items():
                if isinstance(item, FunctionType) and not key.startswith("__"):
                    found[key] = item
                elif isinstance(item, derived):
                    found.pop(key, None)
    return found


def make_compilable(function: FunctionType) -> None:
    """Let compiled code call the plain functions that ``function`` calls by name, and those that they call."""
    for name in function.__code__.co_names:
        callee = function.__globals__.get(name)
        if isinstance(callee, FunctionType) and not getattr(callee, "_hydro1d_jitable", False):
            callee._hydro1d_jitable = True  # type: ignore[attr-defined]
            if callee.__module__ != primitives.__name__:
                register_jitable(**LEAN)(callee)
            make_compilable(callee)


def unpacker(record: types.Type, members: dict[str, Any]) -> Callable:
    """An intrinsic that builds the record from a pointer to its parameters, laid out as `pack` lays them out."""

    @intrinsic
    def unpack(_typing: Any, parameters: Any) -> Any:
        def generate(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
            value, _ = _build(context, builder, record, members, args[0], 0)
            return value

        return record(parameters), generate

    return unpack


def _build(context: Any, builder: Any, record: Any, members: dict, base: Any, slot: int) -> tuple[Any, int]:
    struct = cgutils.create_struct_proxy(record)(context, builder)
    for key, value in members.items():
        place = builder.gep(base, [ir.Constant(_INTEGER, slot)])
        if isinstance(value, tuple):
            kind = context.data_model_manager[record].get_member_fe_type(key)
            built, slot = _build(context, builder, kind, value[1], base, slot)
            setattr(struct, key, built)
            continue
        loaded = builder.load(place)
        if isinstance(value, np.ndarray):
            loaded = builder.gep(base, [builder.fptosi(loaded, _INTEGER)])
        setattr(struct, key, loaded)
        slot += 1
    return struct._getvalue(), slot
