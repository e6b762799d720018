"""A column: layers cut into zones, masses, and the state at t = 0, as arrays."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hydro1d.boundaries.base import Boundary
from hydro1d.laws.base import Law
from hydro1d.scheme.records import LAYER, PROBE
from hydro1d.scheme.viscosity import Viscosity
from hydro1d.variables import HISTORY, Variable

SIDES = (("left", 1.0), ("right", -1.0))


@dataclass(frozen=True)
class LayerBlock:
    """One layer of a column: its zones [first, first + zones) and their law, one for all or one a zone.

    size: of every zone, m, where all are equal, else their mean; unequal: size of each (zones,), or None.
    """

    name: str
    laws: tuple[Law, ...]
    first: int
    zones: int
    size: float
    velocity: float
    unequal: np.ndarray | None = None

    @property
    def law(self) -> Law:
        """The law of its first zone."""
        return self.laws[0]

    @property
    def is_uniform(self) -> bool:
        """Whether all zones have one size and one mass."""
        return self.unequal is None and len({law.density for law in self.laws}) == 1

    @property
    def sizes(self) -> np.ndarray:
        """Size of each zone (zones,), m."""
        return np.full(self.zones, self.size) if self.unequal is None else self.unequal

    @property
    def densities(self) -> np.ndarray:
        """Initial density of each zone (zones,), kg/m³."""
        return np.full(self.zones, [law.density for law in self.laws])

    @property
    def part(self) -> slice:
        """Its zones within an array over zones."""
        return slice(self.first, self.first + self.zones)


@dataclass(frozen=True)
class Column:
    """Everything about a run that does not change with time.

    node_coordinate (zones + 1,) m; zone_coordinate (zones,) m, centres; zone_mass (zones,) and node_mass (zones + 1,)
    kg/m²; probes (m) are Lagrangian coordinates; profile_times (s) rise from 0 or above.
    """

    layers: tuple[LayerBlock, ...]
    left: Boundary
    right: Boundary
    viscosity: Viscosity
    end_time: float
    cfl: float
    profile_times: np.ndarray
    history_every: int
    probes: np.ndarray
    node_coordinate: np.ndarray
    zone_mass: np.ndarray
    node_mass: np.ndarray

    @property
    def zones(self) -> int:
        """Number of zones."""
        return len(self.zone_mass)

    @property
    def zone_coordinate(self) -> np.ndarray:
        """Lagrangian centres of the zones, m."""
        return 0.5 * (self.node_coordinate[:-1] + self.node_coordinate[1:])

    @property
    def zone_layer(self) -> np.ndarray:
        """Number of the layer of each zone."""
        return np.repeat(np.arange(len(self.layers)), [block.zones for block in self.layers])

    @property
    def layer_name(self) -> list[str]:
        """Material of each layer."""
        return [block.name for block in self.layers]

    @property
    def ends(self) -> tuple[tuple[str, float, Boundary], ...]:
        """Side, sign and boundary of both ends."""
        return tuple((side, sign, getattr(self, side)) for side, sign in SIDES)

    @property
    def history_variables(self) -> tuple[Variable, ...]:
        """Columns of the history: the common ones, then what the boundaries remember."""
        own = [
            Variable(f"{side}_{name}", units, f"{name.replace('_', ' ')} at the {side} end")
            for side, _, boundary in self.ends
            for name, units in boundary.state_variables.items()
        ]
        return (*HISTORY, *own)

    @property
    def zone_history(self) -> tuple[Variable, ...]:
        """History variables that profiles hold beside the common quantities."""
        names = dict.fromkeys(name for block in self.layers for name in block.law.own_variables())
        largest = Variable("largest_strain", "1", "largest strain so far")
        return (largest, *(Variable(name, "1", f"history variable {name} of the law") for name in names))

    @property
    def breakpoints(self) -> list[float]:
        """Times (s) of breakpoints of the loads."""
        return sorted({time for _, _, boundary in self.ends for time in boundary.breakpoints() if time > 0.0})

    @property
    def variables(self) -> int:
        """Rows that the zones' state variables take: the largest strain, and the most others that a law has."""
        return 1 + max(len(block.law.own_variables()) for block in self.layers)

    @property
    def boundary_width(self) -> int:
        """The most state variables that one of the boundaries has."""
        return max(len(boundary.state_variables) for _, _, boundary in self.ends)

    @property
    def is_uniform(self) -> bool:
        """Whether every layer is."""
        return all(block.is_uniform for block in self.layers)

    def layer_records(self) -> np.recarray:
        """The layers as the scheme sees them (layers,)."""
        records = np.zeros(len(self.layers), dtype=LAYER).view(np.recarray)
        for record, block in zip(records, self.layers, strict=True):
            size, density = float(block.sizes[0]), float(block.densities[0])
            record.first, record.end, record.is_uniform = block.first, block.first + block.zones, block.is_uniform
            record.zone_size, record.min_size, record.inverse_size = size, block.sizes.min(), 1.0 / size
            record.density, record.zone_mass, record.inverse_zone_mass = (
                density,
                size * density,
                1.0 / size * (1.0 / density),
            )
            record.crushed_strain = block.law.crushed_strain
            record.yield_strain = getattr(block.law, "yield_strain", 0.0)
            record.linear, record.limited_linear, record.quadratic = self.viscosity.coefficients()
        return records

    def probe_records(self) -> np.recarray:
        """Where the probes lie (probes,)."""
        zone = np.clip(np.searchsorted(self.node_coordinate, self.probes, side="right") - 1, 0, self.zones - 1)
        records = np.zeros(len(self.probes), dtype=PROBE).view(np.recarray)
        records.zone, records.layer = zone, self.zone_layer[zone]
        records.share = (self.probes - self.node_coordinate[zone]) / np.diff(self.node_coordinate)[zone]
        return records

    def end_properties(self) -> list[tuple[float, float, float]]:
        """Impedance ρ0 c (kg/(m² s)) and initial stress (Pa) of the zone at each end, and the end's sign."""
        found = []
        for law, sign in ((self.layers[0].laws[0], 1.0), (self.layers[-1].laws[-1], -1.0)):
            response = law.at(0.0, energy=law.initial_energy)
            found.append((math.sqrt(law.density * response.stiffness), response.stress, sign))
        return found


def build_column(
    layers: Sequence,
    left: Boundary,
    right: Boundary,
    *,
    end: float,
    cfl: float = 0.8,
    viscosity: Viscosity | None = None,
    profile_times: Sequence[float] = (),
    history: int = 1,
    probes: Sequence[float] = (),
) -> Column:
    """Cut layers (objects with material, law, thickness, zones, velocity) into zones, side by side from x = 0.

    Zones are equal unless a layer has ``sizes`` (zones,), and of one law unless it has ``laws``, one a zone.
    """
    blocks, first = [], 0
    for layer in layers:
        laws = tuple(getattr(layer, "laws", None) or (layer.law,))
        size, unequal = layer.thickness / layer.zones, getattr(layer, "sizes", None)
        blocks.append(LayerBlock(layer.material, laws, first, layer.zones, size, layer.velocity, unequal))
        first += layer.zones
    sizes = np.concatenate([block.sizes for block in blocks])
    zone_mass = sizes * np.concatenate([block.densities for block in blocks])
    starts = np.concatenate([[0.0], np.cumsum([_thickness(block) for block in blocks])])
    nodes = [start + _left_sides(block) for start, block in zip(starts, blocks, strict=False)]
    node_mass = np.zeros(len(sizes) + 1)
    node_mass[:-1] += 0.5 * zone_mass
    node_mass[1:] += 0.5 * zone_mass
    return Column(
        layers=tuple(blocks),
        left=left,
        right=right,
        viscosity=viscosity or Viscosity(),
        end_time=float(end),
        cfl=float(cfl),
        profile_times=np.array(sorted(profile_times), dtype=float),
        history_every=int(history),
        probes=np.array(probes, dtype=float),
        node_coordinate=np.concatenate([*nodes, starts[-1:]]),
        zone_mass=zone_mass,
        node_mass=node_mass,
    )


def _thickness(block: LayerBlock) -> float:
    return block.size * block.zones if block.unequal is None else float(block.unequal.sum())


def _left_sides(block: LayerBlock) -> np.ndarray:
    """Lagrangian coordinates (zones,) of the left sides of its zones within the layer, m."""
    if block.unequal is None:
        return block.size * np.arange(block.zones)
    return np.concatenate([[0.0], np.cumsum(block.unequal)[:-1]])


def initial_velocities(column: Column) -> np.ndarray:
    """Velocities of the nodes (zones + 1,), m/s; a node between two layers starts with their momentum."""
    velocity = np.concatenate([np.full(block.zones, block.velocity) for block in column.layers])
    if (velocity == velocity[0]).all():
        return np.full(column.zones + 1, velocity[0])
    momentum = 0.5 * column.zone_mass * velocity
    nodes = np.zeros(column.zones + 1)
    nodes[:-1] += momentum
    nodes[1:] += momentum
    nodes /= column.node_mass
    for block in column.layers:  # inside a layer the velocity is the deck's, to the last bit
        nodes[block.first + 1 : block.first + block.zones] = block.velocity
    nodes[0], nodes[-1] = velocity[0], velocity[-1]
    return nodes
