"""Names, dimensions and units of everything in a file."""

from dataclasses import dataclass, field
from typing import Any, NamedTuple, Self

import numpy as np

from hydro1d.variables import NODE, PROBE, ZONE, Variable

SCHEMA_VERSION = 1

GROUPS = ("history", "probes")


class Field(NamedTuple):
    """One dataset: its path in the file, its dimensions, unit and description."""

    path: str
    dimensions: tuple[str, ...]
    units: str
    long_name: str


@dataclass(frozen=True)
class Layout:
    """Constants of a run, and the variables that are recorded.

    Shapes: node_coordinate (zones + 1,) in m; zone_coordinate (zones,) in m; zone_mass (zones,) in kg/m^2; zone_layer
    (zones,), counted from 0; layer_name (layers,); probe_coordinate (probes,) in m. `zone_history` are the history
    variables of the laws, `history` the columns of the history, `time` first. `profiles` is the number of profiles
    asked for, if known; it only shapes the chunks.
    """

    node_coordinate: np.ndarray
    zone_coordinate: np.ndarray
    zone_mass: np.ndarray
    zone_layer: np.ndarray
    layer_name: tuple[str, ...]
    zone_history: tuple[Variable, ...] = ()
    history: tuple[Variable, ...] = ()
    probe_coordinate: np.ndarray = field(default_factory=lambda: np.empty(0))
    profiles: int | None = None

    @classmethod
    def of(cls, column: Any) -> Self:
        """Layout of a `Column`."""
        return cls(
            node_coordinate=column.node_coordinate,
            zone_coordinate=column.zone_coordinate,
            zone_mass=column.zone_mass,
            zone_layer=column.zone_layer,
            layer_name=tuple(column.layer_name),
            zone_history=tuple(column.zone_history),
            history=tuple(column.history_variables),
            probe_coordinate=np.asarray(column.probes, dtype=np.float64),
            profiles=len(column.profile_times) or None,
        )

    @property
    def zones(self) -> int:
        """Number of zones."""
        return len(self.zone_coordinate)

    def static(self) -> dict[str, np.ndarray]:
        """Arrays by path that do not depend on time."""
        integers = {"zone": self.zones, "node": self.zones + 1, "layer": len(self.layer_name)}
        arrays: dict[str, np.ndarray] = {name: np.arange(size, dtype=np.int32) for name, size in integers.items()}
        for name in ("node_coordinate", "zone_coordinate", "zone_mass"):
            arrays[name] = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
        arrays["zone_layer"] = np.ascontiguousarray(self.zone_layer, dtype=np.int32)
        if len(self.probe_coordinate):
            arrays["probes/probe"] = np.ascontiguousarray(self.probe_coordinate, dtype=np.float64)
        return arrays


STATIC = {
    "zone": Field("zone", ("zone",), "1", "number of the zone, from the left"),
    "node": Field("node", ("node",), "1", "number of the node, from the left"),
    "layer": Field("layer", ("layer",), "1", "number of the layer, from the left"),
    "node_coordinate": Field("node_coordinate", ("node",), "m", "Lagrangian coordinate of the node"),
    "zone_coordinate": Field("zone_coordinate", ("zone",), "m", "Lagrangian coordinate of the zone's centre"),
    "zone_mass": Field("zone_mass", ("zone",), "kg m-2", "mass of the zone per area"),
    "zone_layer": Field("zone_layer", ("zone",), "1", "number of the layer that the zone belongs to"),
    "layer_name": Field("layer_name", ("layer",), "1", "material of the layer"),
    "probes/probe": Field("probes/probe", ("probe",), "m", "Lagrangian coordinate of the probe"),
}
MAXIMA = {
    "largest_strain": Field("maximum_strain", ("zone",), "1", "largest strain of the zone, every cycle counted"),
}
_TIME = Field("time", ("time",), "s", "time")


def _over(group: str, dimensions: tuple[str, ...], variables: tuple[Variable, ...]) -> list[Field]:
    prefix = f"{group}/" if group else ""
    return [Field(prefix + name, dimensions, units, text) for name, units, text in variables]


def profile_fields(layout: Layout) -> tuple[list[Field], list[Field], list[Field]]:
    """Fields recorded at each output time: the time itself, those over nodes, those over zones."""
    zone = (*ZONE, *(variable for variable in layout.zone_history if variable not in ZONE))
    return [_TIME], _over("", ("time", "node"), NODE), _over("", ("time", "zone"), zone)


def history_fields(layout: Layout) -> list[Field]:
    """Columns of the history in the solver's order; the first, time, is the coordinate of the group."""
    rest = _over("history", ("history_time",), layout.history[1:])
    return [Field("history/history_time", ("history_time",), "s", "time"), *rest]


def probe_fields(layout: Layout) -> tuple[list[Field], list[Field]]:
    """The time coordinate of the probes and what is recorded at them; empty without probes."""
    if not len(layout.probe_coordinate):
        return [], []
    return (
        [Field("probes/history_time", ("history_time",), "s", "time")],
        _over("probes", ("history_time", "probe"), PROBE),
    )
