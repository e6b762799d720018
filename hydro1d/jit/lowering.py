"""How numba compiles the primitives, and the types through which compiled code sees records and components."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from types import FunctionType
from typing import Any

import numpy as np
from llvmlite import ir
from numba import from_dtype, types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    infer_getattr,
    intrinsic,
    lower_builtin,
    lower_getattr_generic,
    make_attribute_wrapper,
    models,
    overload,
    overload_method,
    register_model,
    type_callable,
)

from hydro1d.components.parameters import Component
from hydro1d.jit import primitives
from hydro1d.jit.fresh import LEAN, Copies
from hydro1d.jit.records import ROW, layout, methods

POINTER = types.CPointer(types.float64)
ADDRESSES = types.CPointer(types.int64)
BYTES = types.CPointer(types.uint8)
_BYTE, _INTEGER, _DOUBLE = ir.IntType(8), ir.IntType(64), ir.DoubleType()
_ANY_ORDER = ("nnan", "nsz")


def argument_type(kind: Any) -> types.Type:
    """The numba type of an argument: a record's dtype, that of the elements of an array, or `int`."""
    if kind is int:
        return types.int64
    kind = np.dtype(kind)
    if kind.names:
        return from_dtype(kind)
    return {"f": POINTER, "i": ADDRESSES, "u": BYTES}[kind.kind]


def shared_type(name: str, fields: Mapping[str, Any]) -> types.Type:
    """The type of what all passes share: a table of addresses and integers, seen as the attributes ``fields``."""
    kinds = {key: argument_type(kind) for key, kind in fields.items()}
    shared = type(name, (types.Type,), {"__init__": lambda self: types.Type.__init__(self, name)})

    class Table(models.PrimitiveModel):
        def __init__(self, manager: Any, kind: Any) -> None:
            super().__init__(manager, kind, _INTEGER.as_pointer())

    class Attributes(AttributeTemplate):
        key = shared

        def generic_resolve(self, _kind: Any, name: str) -> types.Type | None:
            return kinds.get(name)

    def read(context: Any, builder: Any, _kind: Any, value: Any, name: str) -> Any:
        place = builder.gep(value, [ir.Constant(_INTEGER, list(kinds).index(name))])
        return builder.load(builder.bitcast(place, context.get_value_type(kinds[name]).as_pointer()))

    register_model(shared)(Table)
    infer_getattr(Attributes)
    lower_getattr_generic(shared)(read)
    return shared()


def _primitive(function: Callable, kind: Callable) -> Callable:
    """Register how LLVM does a primitive: ``kind`` of its arguments' types is the type of its value.

    An `overload` would do, and cost one more function to infer, lower and inline for each.
    """

    def register(generate: Callable) -> Callable:
        type_callable(function)(lambda _context: kind)
        return lower_builtin(function, types.VarArg(types.Any))(generate)

    return register


def _onward(builder: Any, pointer: Any, count: Any, kind: Any) -> Any:
    """A pointer to ``kind``, so many bytes on."""
    start = builder.bitcast(pointer, _BYTE.as_pointer())
    return builder.bitcast(builder.gep(start, [count]), kind)


@_primitive(primitives.at, lambda records, k: records)
def _at(_context: Any, builder: Any, signature: Any, args: Any) -> Any:
    size = ir.Constant(_INTEGER, signature.args[0].size)
    return _onward(builder, args[0], builder.mul(args[1], size), args[0].type)


@_primitive(primitives.gather, lambda array, start, stride, count: types.UniTuple(types.float64, len(count)))
def _gather(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    array, start, stride, _ = args
    count = len(signature.return_type)
    places = [builder.add(start, builder.mul(stride, ir.Constant(_INTEGER, k))) for k in range(count)]
    values = [builder.load(builder.gep(array, [place])) for place in places]
    return context.make_tuple(builder, signature.return_type, values)


@_primitive(primitives.scatter, lambda array, start, stride, values: types.void)
def _scatter(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    array, start, stride, packed = args
    for k, kind in enumerate(signature.args[3]):
        place = builder.add(start, builder.mul(stride, ir.Constant(_INTEGER, k)))
        value = context.cast(builder, builder.extract_value(packed, k), kind, types.float64)
        builder.store(value, builder.gep(array, [place]))
    return context.get_dummy_value()


@_primitive(primitives.larger, lambda value, other: types.float64)
def _larger(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    exceeds = builder.fcmp_ordered(">", args[1], args[0], flags=_ANY_ORDER)
    return builder.select(exceeds, args[1], args[0], flags=_ANY_ORDER)


@_primitive(primitives.accumulate, lambda total, value: types.float64)
def _accumulate(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return builder.fadd(args[0], args[1], flags=("reassoc", "contract", "nsz"))


@intrinsic
def _call(_typing: Any, passes: Any, which: Any, integers: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        passes, which, packed = args
        values = cgutils.unpack_tuple(builder, packed, len(signature.args[2]))
        # The place before the first pass holds the address of the arguments that all of them share.
        table = builder.load(builder.gep(passes, [ir.Constant(_INTEGER, -1)]))
        address = builder.load(builder.gep(passes, [which]))
        kind = ir.FunctionType(ir.IntType(32), [_INTEGER] * (1 + len(values)))
        raised = builder.call(builder.inttoptr(address, kind.as_pointer()), [table, *values])
        with cgutils.if_unlikely(builder, cgutils.is_not_null(builder, raised)):
            context.call_conv.return_user_exc(builder, RuntimeError)  # goes up through all callers
        return context.get_dummy_value()

    return types.void(passes, which, integers), generate


# numba hands a variable number of arguments only to an overload.
overload(primitives.call, jit_options=LEAN)(
    lambda passes, which, *integers: lambda passes, which, *integers: _call(passes, which, integers)
)


def record_type(component: type[Component], members: dict[str, Any], copies: Copies) -> types.Type:
    """A numba type with the component's numeric members as attributes and its methods as methods."""
    name = f"{component.__module__}.{component.__qualname__}"
    record = type("Record", (types.Type,), {"__init__": lambda self: types.Type.__init__(self, name)})
    kinds = [(key, _member_type(value, copies)) for key, value in members.items()]

    class Model(models.StructModel):
        def __init__(self, manager: Any, kind: Any) -> None:
            super().__init__(manager, kind, kinds)

    register_model(record)(Model)
    for key in members:
        make_attribute_wrapper(record, key, key)
    instance = record()
    for key, method in methods(component).items():
        overload_method(record, key, jit_options=LEAN)(_as_overload(copies.plain(method)))
    return instance


def _member_type(value: Any, copies: Copies) -> types.Type:
    if isinstance(value, np.ndarray):
        return POINTER
    if isinstance(value, tuple) and value[0] is not ROW:
        return record_type(type(value[0]), value[1], copies)
    return {bool: types.boolean, int: types.int64}.get(type(value), types.float64)


def _as_overload(method: FunctionType) -> Callable:
    def choose(*_args: Any, **_keywords: Any) -> FunctionType:
        return method

    # numba asks an overload for the same argument names as its implementation.
    choose.__signature__ = inspect.signature(method)  # type: ignore[attr-defined]
    return choose


def reader(record: types.Type, members: dict[str, Any], where: Callable) -> Callable:
    """A function (shared, number, place) that reads the record at the start and the row that ``where`` answers with."""
    unpack = unpacker(record, members)

    def read(shared: Any, number: int, place: int) -> Any:
        start, row = where(shared, number, place)
        return unpack(shared.parameters, start, row)

    return read


def unpacker(record: types.Type, members: dict[str, Any]) -> Callable:
    """An intrinsic (parameters, start, place) that builds the record from the block that begins at byte ``start``.

    A member that differs from place to place is that of ``place``.
    """

    @intrinsic
    def unpack(_typing: Any, parameters: Any, start: Any, place: Any) -> Any:
        def generate(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
            block = builder.gep(args[0], [args[1]])
            return _build(context, builder, record, (members, layout(members)), (block, block, args[2]))

        return record(parameters, start, place), generate

    return unpack


def _build(context: Any, builder: Any, record: Any, told: tuple[dict, np.dtype], where: tuple) -> Any:
    """The record at ``where``: the block it is part of, its own place in that, and the place of members in rows."""
    struct = cgutils.create_struct_proxy(record)(context, builder)
    (members, kinds), (block, own, place) = told, where
    for key, value in members.items():
        fields = kinds.fields
        assert fields is not None
        kind, offset = fields[key][:2]
        here = ir.Constant(_INTEGER, offset)
        if isinstance(value, tuple) and value[0] is not ROW:
            inner = context.data_model_manager[record].get_member_fe_type(key)
            built = _build(context, builder, inner, (value[1], kind), (block, builder.gep(own, [here]), place))
        elif isinstance(value, bool):
            built = builder.icmp_unsigned("!=", builder.load(builder.gep(own, [here])), ir.Constant(_BYTE, 0))
        elif isinstance(value, float):
            built = builder.load(_onward(builder, own, here, _DOUBLE.as_pointer()))
        else:
            built = builder.load(_onward(builder, own, here, _INTEGER.as_pointer()))
            if not isinstance(value, int):  # the place of an array, or of the numbers of all places
                built = _onward(builder, block, built, _DOUBLE.as_pointer())
            if isinstance(value, tuple):
                built = builder.load(builder.gep(built, [place]))
        setattr(struct, key, built)
    return struct._getvalue()
