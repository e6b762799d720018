"""The state of a run: one object, whole, from which a run goes on bit for bit."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from hydro1d.jit.memory import placed

# The node pass goes through displacements and velocities in whole cache lines from node 1 on.
_FIRST = {"velocity": 2, "displacement": 1, "increment": 0, "force": 0, "state": 0, "viscosity": 0, "energy": 0}


@dataclass(frozen=True)
class State:
    """All that changes with time, by the names of `scheme.records.Grid`. The arrays stay where they are, their numbers change.

    clock (1,) and layer_state (layers,): records. velocity (zones + 3,) at half a step before the next kick, with a ghost at
    each end; displacement (zones + 1,); energy (zones,) specific, when it was last folded, and increment (zones,) since then;
    force (zones,) σ + q; viscosity (zones,) q; state (variables, zones), the largest strain first; boundary_state (4, ·) of
    the boundaries, then the same half a kick on.
    """

    clock: np.recarray
    layer_state: np.recarray
    velocity: np.ndarray
    displacement: np.ndarray
    energy: np.ndarray
    increment: np.ndarray
    force: np.ndarray
    viscosity: np.ndarray
    state: np.ndarray
    boundary_state: np.ndarray

    def __post_init__(self) -> None:
        for place, (name, first) in enumerate(_FIRST.items()):
            object.__setattr__(self, name, placed(getattr(self, name), place, first))

    def arrays(self) -> dict[str, np.ndarray]:
        """Every array by name, as a checkpoint stores them."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @classmethod
    def from_arrays(cls, arrays: dict[str, np.ndarray]) -> State:
        """The state that `arrays` described."""
        copies: dict[str, Any] = {field.name: np.array(arrays[field.name]) for field in fields(cls)}
        return cls(**{name: array.view(np.recarray) if array.dtype.names else array for name, array in copies.items()})

    def copy(self) -> State:
        """An independent copy."""
        return State.from_arrays(self.arrays())

    def assign(self, other: State) -> None:
        """Take over the other's values, in place."""
        for name, array in other.arrays().items():
            getattr(self, name)[...] = array

    @property
    def time(self) -> float:
        """Time of the stresses, s."""
        return float(self.clock[0].time)

    @property
    def cycle(self) -> int:
        """Number of steps taken."""
        return int(self.clock[0].cycle)
