"""A column: layers cut into zones, masses, and the state at t = 0, as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hydro1d.boundaries.base import Boundary
from hydro1d.laws.base import Law
from hydro1d.variables import HISTORY, Variable
from hydro1d.viscosity import Viscosity

SIDES = (("left", 1.0), ("right", -1.0))


@dataclass(frozen=True)
class Slab:
    """One layer of a column: its law and its zones [first, first + zones)."""

    name: str
    law: Law
    first: int
    zones: int
    size: float
    velocity: float

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

    slabs: tuple[Slab, ...]
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
        return np.repeat(np.arange(len(self.slabs)), [slab.zones for slab in self.slabs])

    @property
    def layer_name(self) -> list[str]:
        """Material of each layer."""
        return [slab.name for slab in self.slabs]

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
            for name, units in boundary.memory.items()
        ]
        return (*HISTORY, *own)

    @property
    def zone_history(self) -> tuple[Variable, ...]:
        """History variables that profiles hold beside the common quantities."""
        names = dict.fromkeys(name for slab in self.slabs for name in slab.law.history)
        largest = Variable("largest_strain", "1", "largest strain so far")
        return (largest, *(Variable(name, "1", f"history variable {name} of the law") for name in names))

    @property
    def corners(self) -> list[float]:
        """Times of corners of the loads."""
        return sorted({time for _, _, boundary in self.ends for time in boundary.corners() if time > 0.0})


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
    """Cut layers (objects with material, law, thickness, zones, velocity) into equal zones, side by side from x = 0."""
    slabs, first = [], 0
    for layer in layers:
        size = layer.thickness / layer.zones
        slabs.append(Slab(layer.material, layer.law, first, layer.zones, size, layer.velocity))
        first += layer.zones
    sizes = np.concatenate([np.full(slab.zones, slab.size) for slab in slabs])
    zone_mass = np.concatenate([np.full(slab.zones, slab.size * slab.law.density) for slab in slabs])
    starts = np.concatenate([[0.0], np.cumsum([slab.size * slab.zones for slab in slabs])])
    nodes = [start + slab.size * np.arange(slab.zones) for start, slab in zip(starts, slabs, strict=False)]
    node_mass = np.zeros(len(sizes) + 1)
    node_mass[:-1] += 0.5 * zone_mass
    node_mass[1:] += 0.5 * zone_mass
    return Column(
        slabs=tuple(slabs),
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


def initial_velocities(column: Column) -> np.ndarray:
    """Velocities of the nodes (zones + 1,), m/s; a node between two layers starts with their momentum."""
    velocity = np.concatenate([np.full(slab.zones, slab.velocity) for slab in column.slabs])
    if (velocity == velocity[0]).all():
        return np.full(column.zones + 1, velocity[0])
    momentum = 0.5 * column.zone_mass * velocity
    nodes = np.zeros(column.zones + 1)
    nodes[:-1] += momentum
    nodes[1:] += momentum
    nodes /= column.node_mass
    for slab in column.slabs:  # inside a layer the velocity is the deck's, to the last bit
        nodes[slab.first + 1 : slab.first + slab.zones] = slab.velocity
    nodes[0], nodes[-1] = velocity[0], velocity[-1]
    return nodes
