"""A component as numbers: what compiled code sees of it, in a fixed order."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydro1d.components.parameters import Component, derived


def members(component: Component) -> dict[str, Any]:
    """Numeric fields and derived constants by name: float, array of floats, or (component, members) for a nested one."""
    names = list(type(component).model_fields)
    for base in reversed(type(component).__mro__):
        names += [name for name, item in vars(base).items() if isinstance(item, derived) and name not in names]
    found: dict[str, Any] = {}
    for name in names:
        value = getattr(component, name)
        if isinstance(value, Component):
            found[name] = (value, members(value))
        elif isinstance(value, bool | int | float):
            found[name] = float(value)
        elif isinstance(value, np.ndarray) and value.ndim == 1:
            found[name] = value
    return found


def pack(component: Component) -> np.ndarray:
    """The members as one vector: a slot each (an array's holds where it begins), then the arrays."""
    scalars, arrays = _flatten(members(component))
    start, slots = len(scalars), list(scalars)
    for slot, array in arrays:
        slots[slot] = float(start)
        start += len(array)
    return np.concatenate([np.array(slots, dtype=float), *(np.asarray(array, dtype=float) for _, array in arrays)])


def _flatten(found: dict[str, Any], first: int = 0) -> tuple[list[float], list[tuple[int, np.ndarray]]]:
    scalars: list[float] = []
    arrays: list[tuple[int, np.ndarray]] = []
    for value in found.values():
        if isinstance(value, tuple):
            inner, inner_arrays = _flatten(value[1], first + len(scalars))
            scalars += inner
            arrays += inner_arrays
        elif isinstance(value, np.ndarray):
            arrays.append((first + len(scalars), value))
            scalars.append(0.0)
        else:
            scalars.append(value)
    return scalars, arrays
