"""The passes of one column, compiled or plain, bound to its arrays: the clean face of all that is compiled."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from types import FunctionType
from typing import Any

import numpy as np

from hydro1d.boundaries.base import Boundary
from hydro1d.components.parameters import Component
from hydro1d.errors import Hydro1dError
from hydro1d.jit import build, reach, records
from hydro1d.jit.memory import placed
from hydro1d.jit.primitives import at
from hydro1d.jit.refusals import NotCompilable, explanation
from hydro1d.laws.base import LARGEST_STRAIN
from hydro1d.scheme import ends, foam_pass, history, node_pass, profiles, step, zone_pass
from hydro1d.scheme.records import CALL, COLLAPSED, COUNTS, RECORDS, SINGLE, Grid
from hydro1d.solver.column import Column, LayerBlock
from hydro1d.solver.state import State

_BYTES = ("parameters",)
_ADDRESSES = ("passes",)
RAISED = COLLAPSED + 1  # the status of a call in which a law or a boundary raised an exception
FIELDS: dict[str, Any] = {
    name: RECORDS.get(name)
    or (int if name in COUNTS else "u1" if name in _BYTES else "i8" if name in _ADDRESSES else "f8")
    for name in Grid._fields
}
SHARED = build.Shared("Grid", FIELDS)


class PassRaised(Hydro1dError):
    """A law or a boundary raised an exception; compiled code does not tell which."""

    exit_code = 3

    def __init__(self) -> None:
        super().__init__("a law or a boundary raised an exception before the first step")


class Program:
    """Runs the passes of a column on a state.

    Compiling happens here, on construction, so that the time of the loop is the loop's.
    """

    def __init__(self, column: Column, row_capacity: int = 4096) -> None:
        """Compile or load what the column needs; the tables of rows hold ``row_capacity`` rows."""
        self.column, self.row_capacity = column, row_capacity
        self.columns = history.COLUMNS + 2 * column.boundary_width
        self.call = np.zeros(1, dtype=CALL).view(np.recarray)
        self.call.is_fresh = True
        self.profile_length = profiles.length(column.zones, column.variables)
        self._profiles = np.empty((0, self.profile_length))
        self._known: tuple[State, Any] | None = None
        self._components: list[Sequence[Component]] = [block.laws for block in column.layers]
        self._components += [(end,) for _, _, end in column.ends]
        self._members = [records.members(components) for components in self._components]
        blocks = [records.pack(members) for members in self._members]
        starts = np.cumsum([0, *(len(block) for block in blocks)])
        self.own = self._arrays(np.concatenate(blocks), starts)
        self._march: Callable[[Any], int | None] = self._bound()

    def _arrays(self, parameters: np.ndarray, starts: np.ndarray) -> dict[str, Any]:
        """What a column needs beside its state, by the names of `Grid`."""
        column, zones = self.column, self.column.zones
        layers = column.layer_records()
        layers.parameters = starts[: len(column.layers)]
        end_records = np.zeros(2, dtype=RECORDS["ends"]).view(np.recarray)
        end_records.parameters = starts[len(column.layers) : -1]
        for side, (impedance, stress, sign) in enumerate(column.end_properties()):
            end_records[side].impedance, end_records[side].initial_stress = impedance, stress
            end_records[side].side = sign
        rows = self.row_capacity + 1
        remembered = {name: placed(np.zeros(zones), 7 + k) for k, name in enumerate(_REMEMBERED)}
        sizes = np.diff(column.node_coordinate) if not column.is_uniform else np.empty(0)
        masses = column.zone_mass if not column.is_uniform else np.empty(0)
        return {
            **remembered,
            "call": self.call,
            "layers": layers,
            "answer": np.zeros(1, dtype=RECORDS["answer"]).view(np.recarray),
            "ends": end_records,
            "probes": column.probe_records(),
            "velocity_before": placed(np.zeros(zones + 3), 5, 2),
            "node_mass": column.node_mass,
            "inverse_mass": placed(1.0 / column.node_mass, 6, 1),
            "coordinate": column.node_coordinate,
            "size": sizes,
            "inverse_size": 1.0 / sizes,
            "inverse_zone_mass": 1.0 / masses,
            "seen_energy": np.zeros(zones),
            "seen_stress": np.zeros(zones),
            "parameters": parameters,
            "rows": np.zeros((rows, self.columns)),
            "probe_rows": np.zeros((rows, len(column.probes), history.PROBE_COLUMNS)),
            "layer_count": len(column.layers),
            "zones": zones,
            "variables": column.variables,
            "boundary_width": column.boundary_width,
            "probe_count": len(column.probes),
        }

    def _bound(self) -> Callable[[Any], int | None]:
        """The time loop; its table of passes, by number: the zones of each layer, both ends, the nodes."""
        layers = zip(self.column.layers, self._members, strict=False)
        makers = [_zones(block, members) for block, members in layers]
        pairs = zip(self.column.ends, self._members[len(makers) :], strict=True)
        makers += [_end(end, members) for (_, _, end), members in pairs]
        if build.interpreted():
            self._passes: list[Callable] = [
                maker.plain(parts) for maker, parts in zip(makers, self._components, strict=True)
            ]
            self._passes.append(node_pass.kick_nodes)
            return step.march
        addresses = [maker.address() for maker in makers]
        nodes = build.Request("nodes", lambda _copies: node_pass.kick_nodes, lambda: reach.digest(node_pass.kick_nodes))
        addresses.append(build.address(nodes, SHARED))
        self._table = np.array([0, *addresses], dtype=np.int64)
        return build.function(march_address())

    def advance(self, state: State, *, stop: float, steps: int, row_at_stop: bool) -> int:
        """Step until ``stop`` (s), ``steps`` steps or full rows; returns a status of `scheme.records`."""
        return self.advance_past(state, [(stop, False)], steps=steps, row_at_stop=row_at_stop)

    def advance_past(
        self, state: State, stops: Sequence[tuple[float, bool]], *, steps: int, row_at_stop: bool, enough: int = 1
    ) -> int:
        """The same past several stops, each a time (s) and whether to take a profile there; ``enough`` end the call."""
        order, count = self.call[0], sum(profile for _, profile in stops)
        self._profiles = np.empty((count, self.profile_length))
        order.steps, order.history_every, order.row_at_stop = steps, self.column.history_every, row_at_stop
        order.row_capacity, order.stops, order.enough_stops = self.row_capacity, len(stops), enough
        try:
            self._run(state, stops=np.array(stops, dtype=float).reshape(-1), profiles=self._profiles.reshape(-1))
        except PassRaised:
            state.clock[0].cycle += 1  # the cycle that breaks down counts, as it does where a step answers so
            order.status, order.rows, order.profiles, order.is_fresh = RAISED, 0, 0, True
        return int(order.status)

    def profiles(self) -> np.ndarray:
        """Profiles that the last `advance_past` took, each as `scheme.profiles` has it."""
        return self._profiles[: int(self.call[0].profiles)]

    def recorded(self) -> tuple[np.ndarray, np.ndarray]:
        """Rows of history and probes that the last `advance` recorded, as the history shows them."""
        count = int(self.call[0].rows)
        rows = self.own["rows"][:count]
        parts = [rows[:, : history.COLUMNS]]
        coordinates = (self.column.node_coordinate[0], self.column.node_coordinate[-1])
        for side, (_, sign, boundary) in enumerate(self.column.ends):
            start = history.COLUMNS + side * self.column.boundary_width
            kept = rows[:, start : start + len(boundary.state_variables)]
            parts.append(boundary.report(kept, coordinates[side], sign) if boundary.state_variables else kept)
        return np.concatenate(parts, axis=1), self.own["probe_rows"][:count].copy()

    def sweep_layer(self, state: State, layer: int) -> Any:
        """Call a layer's zone pass on the state as it stands, in one block; returns its `ANSWER`."""
        block = self.column.layers[layer]
        part = slice(block.first, block.first + block.zones + 3)
        self.own["velocity_before"][: block.zones + 3] = state.velocity[part]
        self.call[0].step = self.call[0].kick = 0.0
        self.call[0].is_fresh = True
        self._run(state, which=(layer, layer, block.first, block.first + block.zones, 0))
        return self.own["answer"][0]

    def _run(self, state: State, which: tuple[int, ...] | None = None, **arrays: np.ndarray) -> None:
        """The time loop, or one pass by number, on the grid of a state."""
        if build.interpreted():
            values = {**self.own, **state.arrays(), "stops": None, "profiles": None, **arrays}
            grid = _plain_grid(values, self._passes)
            try:
                self._march(grid) if which is None else grid.passes[which[0]](*which[1:])
            except Exception as error:
                raise PassRaised from error
            finally:
                _write_back(grid, values)
            return
        if self._known is None or self._known[0] is not state:
            values = {**self.own, **state.arrays(), "stops": self._table, "profiles": self._table}
            values["passes"] = self._table[1:]
            self._known = state, build.table([values[name] for name in Grid._fields], FIELDS)
            self._table[0] = self._known[1].ctypes.data
        table = self._known[1]
        for name, array in arrays.items():
            table[Grid._fields.index(name)] = array.ctypes.data
        if which is None:
            raised = self._march(table.ctypes.data)
        else:
            raised = build.call_pass(int(self._table[1 + which[0]]), table, which[1:])
        if raised:
            raise PassRaised


_REMEMBERED = ("curve", "tangents", "stiffnesses", "speeds")


# Records with plain attributes: reading one of numpy's costs as much as ten operations on it.
_MEMBERS = {name: dtype.names or () for name, dtype in RECORDS.items()}
_PLAIN = {name: type(name, (), {"__slots__": members}) for name, members in _MEMBERS.items()}


def _plain_grid(values: dict[str, Any], passes: list[Callable]) -> Grid:
    """The grid as plain Python works on it: arrays flat, as a pointer sees them; copies of the records."""
    seen: dict[str, Any] = {}
    for name, value in values.items():
        if name in RECORDS:
            copies = [_plain(name, record) for record in value]
            seen[name] = copies[0] if name in SINGLE else copies
        else:
            seen[name] = value.reshape(-1) if isinstance(value, np.ndarray) else value
    bound: list[Callable] = []
    grid = Grid(**seen, passes=bound)
    bound += [functools.partial(run, grid) for run in passes]
    return grid


def _plain(name: str, record: np.record) -> Any:
    """A copy of a record. Its floats stay numpy's, of which a quotient by zero is infinite, as it is when compiled."""
    copy = _PLAIN[name]()
    for member in _MEMBERS[name]:
        setattr(copy, member, record[member])
    return copy


def _write_back(grid: Grid, values: dict[str, Any]) -> None:
    """Put what plain Python has made of its copies of the records into these."""
    for name, members in _MEMBERS.items():
        copies = getattr(grid, name)
        for k, copy in enumerate([copies] if name in SINGLE else copies):
            values[name][k] = tuple(getattr(copy, member) for member in members)


class _Maker:
    """How the pass of a component is made: as plain Python, or as machine code."""

    def __init__(
        self, factory: Callable, where: Callable, kind: type[Component], members: dict[str, Any], *arguments: Any
    ):
        """``where`` answers (grid, number, zone) with the place of the component's parameters, and that within its rows."""
        self.factory, self.where, self.kind, self.members, self.arguments = factory, where, kind, members, arguments

    def plain(self, components: Sequence[Component]) -> Callable:
        """The pass as Python on the components themselves."""
        if len(components) == 1:
            return self.factory(lambda g, number, i: components[0], *self.arguments)
        return self.factory(lambda g, number, i: components[self.where(g, number, i)[1]], *self.arguments)

    def address(self) -> int:
        """The address of the pass as machine code. Raises DeckError for code of a user's that cannot be compiled."""
        name, owner = f"{self.factory.__name__} {self.kind.__module__}.{self.kind.__qualname__}", self.kind.__qualname__
        try:
            return build.address(build.Request(name, self._make, self._content, owner=owner), SHARED)
        except NotCompilable as refused:
            raise explanation(self.kind, refused.failures) or refused from refused.__cause__

    def _content(self) -> str:
        """All that the machine code depends on: the members, and the code of the pass with the methods that it may call."""
        methods: dict[str, list[FunctionType]] = {}
        for kind in records.kinds(self.kind, self.members):
            for key, method in records.methods(kind).items():
                methods.setdefault(key, []).append(method)
        return f"{_shape(self.members)} {self.arguments} {reach.digest(self.factory, self.where, methods=methods)}"

    def _make(self, copies: Any) -> Any:
        from hydro1d.jit import lowering

        record = lowering.record_type(self.kind, self.members, copies)
        return self.factory(lowering.reader(record, self.members, self.where), *self.arguments)


def _in_layer(g: Grid, number: int, i: int) -> tuple[int, int]:
    layer = at(g.layers, number)
    return layer.parameters, i - layer.first


def _at_end(g: Grid, number: int, i: int) -> tuple[int, int]:
    return at(g.ends, number).parameters, i


def _zones(block: LayerBlock, members: dict[str, Any]) -> _Maker:
    law = block.laws[0]
    keeps = next(iter(type(law).state_variables), "") == LARGEST_STRAIN
    factory = foam_pass.foam_pass if law.keeps_its_curve else zone_pass.zone_pass
    count = len(type(law).state_variables) * (0.0,)
    kind = zone_pass.Kind(not records.varies(members), block.is_uniform)
    return _Maker(factory, _in_layer, type(law), members, kind, 0 if keeps else 1, count)


def _end(boundary: Boundary, members: dict[str, Any]) -> _Maker:
    return _Maker(ends.end_pass, _at_end, type(boundary), members, len(type(boundary).state_variables) * (0.0,))


def _shape(members: dict[str, Any]) -> str:
    """The kinds, not the values, of a component's members."""
    kinds = []
    for name, value in members.items():
        if isinstance(value, tuple):
            inner = records.ROW if value[0] is records.ROW else _shape(value[1])
        else:
            inner = type(value).__name__
        kinds.append(f"{name}:{inner}")
    return f"({', '.join(kinds)})"


def march_address() -> int:
    """Address of the time loop, which is the same for all columns."""
    request = build.Request("march", lambda _copies: step.march, lambda: reach.digest(step.march), is_leaf=False)
    return build.address(request, SHARED)
