"""A component as a record: what compiled code sees of it, under the names that it has in Python."""

from __future__ import annotations

from collections.abc import Sequence
from types import FunctionType
from typing import Any

import numpy as np

from hydro1d.components.parameters import Component, derived

ROW = "row"  # the kind of a number that differs from place to place


def members(components: Sequence[Component]) -> dict[str, Any]:
    """Numeric fields and derived constants by name, of one component or of one of the same kind for each place.

    A member is a bool, int, float, an array of floats, (component, members) for a nested one, or (`ROW`, array) for a number
    that is not the same everywhere.
    """
    first = components[0]
    names = list(type(first).model_fields)
    for base in reversed(type(first).__mro__):
        names += [name for name, item in vars(base).items() if isinstance(item, derived) and name not in names]
    found: dict[str, Any] = {}
    for name in names:
        values = [getattr(component, name) for component in components]
        value = values[0]
        if isinstance(value, Component):
            found[name] = (value, members(values))
        elif isinstance(value, bool | int | float | np.generic):
            differs = any(other != value and not (other != other and value != value) for other in values)
            found[name] = (ROW, np.array(values, dtype=float)) if differs else _plain(value)
        elif isinstance(value, np.ndarray) and value.ndim == 1:
            found[name] = value
    return found


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


def kinds(component: type[Component], found: dict[str, Any]) -> list[type[Component]]:
    """The classes of a component with these members, and of those that it holds."""
    inner = [value for value in found.values() if isinstance(value, tuple) and value[0] is not ROW]
    return [component, *(kind for part, own in inner for kind in kinds(type(part), own))]


def _plain(value: Any) -> bool | int | float:
    return value.item() if isinstance(value, np.generic) else value


def varies(found: dict[str, Any]) -> bool:
    """Whether any member differs from place to place."""
    pairs = [value for value in found.values() if isinstance(value, tuple)]
    return any(pair[0] is ROW or varies(pair[1]) for pair in pairs)


def layout(found: dict[str, Any]) -> np.dtype:
    """The record's dtype; for an array, the place where it begins in bytes from the record."""
    return np.dtype([(name, _kind(value)) for name, value in found.items()], align=True)


def _kind(value: Any) -> Any:
    if isinstance(value, tuple):
        return "i8" if value[0] is ROW else layout(value[1])
    return {bool: "?", int: "i8", float: "f8"}.get(type(value), "i8")


def pack(found: dict[str, Any]) -> np.ndarray:
    """The members as bytes: the record, then the arrays."""
    block = np.zeros(1, dtype=layout(found))
    start = -(-block.nbytes // 8) * 8
    arrays: list[np.ndarray] = []
    _fill(block[0], found, arrays, [start])
    record = np.zeros(start, dtype=np.uint8)
    record[: block.nbytes] = block.view(np.uint8)
    return np.concatenate([record, *(array.view(np.uint8) for array in arrays)])


def _fill(record: Any, found: dict[str, Any], arrays: list[np.ndarray], end: list[int]) -> None:
    for name, value in found.items():
        if isinstance(value, tuple) and value[0] is not ROW:
            _fill(record[name], value[1], arrays, end)
            continue
        array = value[1] if isinstance(value, tuple) else value
        if isinstance(array, np.ndarray):
            arrays.append(np.ascontiguousarray(array, dtype=float))
            record[name], end[0] = end[0], end[0] + arrays[-1].nbytes
        else:
            record[name] = value
