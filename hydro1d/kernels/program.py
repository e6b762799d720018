"""The kernels of one column, bound to its arrays: the clean face of all that is compiled."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hydro1d.boundaries.base import Boundary
from hydro1d.components.parameters import Component
from hydro1d.kernels import build, layout, march, profiles, records
from hydro1d.kernels import ends as end_places
from hydro1d.kernels import zones as zone_places
from hydro1d.kernels.memory import placed
from hydro1d.kernels.refusals import NotCompilable, explanation
from hydro1d.laws.base import Foam, Law
from hydro1d.solver.column import Column
from hydro1d.solver.state import State


class Program:
    """Runs the kernels of a column on a state.

    Compiling happens here, on construction, so that the time of the loop is the loop's.
    """

    def __init__(self, column: Column, row_capacity: int = 4096) -> None:
        """Compile or load what the column needs; the tables of rows hold ``row_capacity`` rows."""
        self.column = column
        zones = column.zones
        components = [*(slab.law for slab in column.slabs), column.left, column.right]
        self._components = components
        parameters = [records.pack(component) for component in components]
        starts = np.cumsum([0, *(len(vector) for vector in parameters)])
        self.layers = np.zeros((len(components), layout.LAYER), dtype=np.int64)
        self.layers[:, layout.PARAMETERS] = starts[:-1]
        for row, slab in zip(self.layers, column.slabs, strict=False):
            row[layout.FIRST_ZONE], row[layout.ZONES] = slab.first, slab.zones
        self.parameters = np.concatenate(parameters)
        self.out = np.zeros(layout.OUT)
        self.spare = placed(np.zeros(zones + 3), 5, 2)
        self.inverse_mass = placed(1.0 / column.node_mass, 6, 1)
        self.curve, self.tangents, self.stiffnesses, self.speeds = (placed(np.zeros(zones), 7 + k) for k in range(4))
        self.end_numbers = np.zeros((2, layout.END))
        self.columns = len(column.history_variables) - _remembered(column) + 2 * end_places.MEMORY
        self.row_capacity = row_capacity
        self.rows = np.zeros((row_capacity + 1, self.columns))
        self.probe_table, self.probe_weights = _locate_probes(column)
        self.probe_rows = np.zeros((row_capacity + 1, len(column.probes), 4))
        self.profile_length = profiles.length(zones, 1 + max(len(slab.law.history) for slab in column.slabs))
        self._profiles = np.empty((0, self.profile_length))
        self._known: tuple[State, layout.Arrays] | None = None
        self._bind()

    def _bind(self) -> None:
        slabs = self.column.slabs
        kernels = [zone_function(slab.law) for slab in slabs] + [
            end_function(end) for end in (self.column.left, self.column.right)
        ]
        if build.interpreted():
            self._zone_functions: list[Callable] = [kernel for kernel, _ in kernels[: len(slabs)]]
            self.addresses: Any = [kernel for kernel, _ in kernels]
            self._march: Callable = march.march
            return
        self.addresses = np.array([where for _, where in kernels], dtype=np.int64)
        self._zone_functions = [build.function(int(where), zone_places.SIGNATURE) for _, where in kernels[: len(slabs)]]
        self._march = build.function(march_address(), layout.SIGNATURE)

    def advance(self, state: State, *, stop: float, steps: int, row_at_stop: bool) -> int:
        """Step until ``stop`` (s), ``steps`` steps or full rows; returns a status of `kernels.march`."""
        return self.advance_past(state, [(stop, False)], steps=steps, row_at_stop=row_at_stop)

    def advance_past(
        self, state: State, stops: Sequence[tuple[float, bool]], *, steps: int, row_at_stop: bool, enough: int = 1
    ) -> int:
        """The same past several stops, each a time (s) and whether to take a profile there; ``enough`` end the call."""
        ledger, count = state.ledger, sum(profile for _, profile in stops)
        times = np.array(stops, dtype=float)
        self._profiles = np.empty((count, self.profile_length))
        ledger[layout.STEPS], ledger[layout.CADENCE] = steps, self.column.history_every
        ledger[layout.ROW_AT_STOP], ledger[layout.ROWS] = row_at_stop, self.row_capacity
        ledger[layout.STOPS], ledger[layout.ENOUGH] = len(stops), enough
        self._march(*self._arrays(state)._replace(stops=_place(times), profiles=_place(self._profiles)))
        return int(ledger[layout.STATUS])

    def profiles(self, state: State) -> np.ndarray:
        """Profiles that the last `advance_past` took, each as `kernels.profiles` has it."""
        return self._profiles[: int(state.ledger[layout.PROFILES])]

    def recorded(self, state: State) -> tuple[np.ndarray, np.ndarray]:
        """Rows of history and probes that the last `advance` recorded, as the history shows them."""
        count = int(state.ledger[layout.ROWS])
        rows = self.rows[:count]
        first = self.columns - 2 * end_places.MEMORY
        parts = [rows[:, :first]]
        coordinates = (self.column.node_coordinate[0], self.column.node_coordinate[-1])
        for k, (_, sign, boundary) in enumerate(self.column.ends):
            start = first + k * end_places.MEMORY
            memory = rows[:, start : start + len(boundary.memory)]
            parts.append(boundary.report(memory, coordinates[k], sign) if boundary.memory else memory)
        return np.concatenate(parts, axis=1), self.probe_rows[:count].copy()

    def sweep_layer(self, state: State, layer: int) -> np.ndarray:
        """Call a layer's zone kernel on the state as it stands; what it finds is valid until the next call."""
        a, first, zones = self._arrays(state), self.column.slabs[layer].first, self.column.slabs[layer].zones
        state.numbers[layer, zone_places.AFRESH] = 1.0
        parameters = _onward(a.parameters, int(self.layers[layer, layout.PARAMETERS]))
        numbers = _onward(a.numbers, layer * layout.NUMBERS)
        arrays = (
            a.velocity, a.velocity, a.displacement, a.energy, a.gained, a.force, a.viscosity, a.state, a.curve, a.tangents,
            a.stiffnesses, a.speeds,
        )  # fmt: skip
        here = (_onward(place, first) for place in arrays)
        self._zone_functions[layer](parameters, numbers, *here, zones, self.column.zones, a.out)
        return self.out

    def _arrays(self, state: State) -> layout.Arrays:
        """Where everything is, found once for a state: for a short call this would take longer than its steps do."""
        if self._known is not None and self._known[0] is state:
            return self._known[1]
        column, nowhere = self.column, np.empty(0)
        own = (
            state.ledger, self.layers, self.addresses, self.parameters, state.numbers, self.end_numbers, state.memory,
            self.out, state.velocity, self.spare, state.displacement, state.energy, state.gained, state.force,
            state.viscosity, state.material, self.curve, self.tangents, self.stiffnesses, self.speeds, column.node_mass,
            self.inverse_mass, column.node_coordinate, self.rows, self.probe_table, self.probe_weights, self.probe_rows,
            nowhere, nowhere,
        )  # fmt: skip
        counts = (len(column.slabs), column.zones, self.columns, len(state.material))
        self._known = state, layout.Arrays._make([*map(_place, own), *counts])
        return self._known[1]


def _place(array: Any) -> Any:
    """Where an array begins or, where kernels run as Python, the array as a pointer sees it: flat."""
    if build.interpreted():
        return array.reshape(-1) if isinstance(array, np.ndarray) else array
    return array.ctypes.data


def _onward(place: Any, values: int) -> Any:
    """The place so many values on."""
    return place[values:] if build.interpreted() else place + 8 * values


def _remembered(column: Column) -> int:
    return sum(len(boundary.memory) for _, _, boundary in column.ends)


def _locate_probes(column: Column) -> tuple[np.ndarray, np.ndarray]:
    """Zone and layer of each probe behind their number, and each probe's place within its zone."""
    zones = np.clip(np.searchsorted(column.node_coordinate, column.probes, side="right") - 1, 0, column.zones - 1)
    sizes = np.diff(column.node_coordinate)[zones]
    weights = (column.probes - column.node_coordinate[zones]) / sizes
    table = np.column_stack([zones, column.zone_layer[zones]]).astype(np.int64)
    return np.concatenate([[len(zones)], table.reshape(-1)]), np.asarray(weights, dtype=float)


def zone_function(law: Law) -> tuple[Callable, int]:
    """The zone kernel of a law: as Python where kernels are interpreted, else its address."""
    factory = zone_places.foam_kernel if _keeps_its_curve(law) else zone_places.zone_kernel
    return _component_kernel(factory.__name__, factory, zone_places.SIGNATURE, law, len(type(law).history))


def _keeps_its_curve(law: Component) -> bool:
    """Whether the law is a foam as `Foam.point` has it, whose loading curve is only asked at the largest strain."""
    return isinstance(law, Foam) and type(law).point is Foam.point and not law.is_reversible and not law.history


def end_function(boundary: Boundary) -> tuple[Callable, int]:
    """The kick of a boundary, likewise."""
    return _component_kernel("end", end_places.end_kernel, end_places.SIGNATURE, boundary, len(type(boundary).memory))


def _component_kernel(
    kind: str, factory: Callable, signature: str, component: Component, remembered: int
) -> tuple[Callable, int]:
    count = remembered * (0.0,)
    if build.interpreted():
        return factory(lambda _parameters: component, count), 0
    members = records.members(component)
    content = f"{_shape(component, members)} {remembered}"

    def make() -> Callable:
        from hydro1d.kernels import lowering

        record = lowering.record_type(component, members)
        return factory(lowering.unpacker(record, members), count)

    name = f"{kind} {type(component).__module__}.{type(component).__qualname__}"
    try:
        return march.march, build.address(name, signature, content, make)
    except NotCompilable as refused:
        raise explanation(type(component), refused.failures) or refused from refused.__cause__


def _shape(component: Component, members: dict[str, Any]) -> str:
    """What the machine code depends on of a component: its code and the kinds, not the values, of its members."""
    kinds = [
        f"{name}:{_shape(*value) if isinstance(value, tuple) else type(value).__name__}"
        for name, value in members.items()
    ]
    return f"{build.fingerprint(type(component))}({', '.join(kinds)})"


def march_address() -> int:
    """Address of the time loop, which is the same for all columns."""
    return build.address("march", layout.SIGNATURE, "", lambda: march.march)
