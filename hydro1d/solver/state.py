"""The state of a run: one object, whole, from which a run goes on bit for bit."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from hydro1d.kernels import layout
from hydro1d.kernels.memory import placed


@dataclass(frozen=True)
class State:
    """All that changes with time. The arrays stay where they are, their numbers change.

    ledger: clock, sums and maxima, see `kernels.layout`. velocity (zones + 3,) at half a step before the next kick, with a
    ghost at each end; displacement (zones + 1,); energy (zones,) specific, at the last settling, and
    gained (zones,) since then; force (zones,) σ + q; viscosity (zones,) q;
    material (1 + history variables, zones), the largest strain first; memory (2, ·) of the boundaries; numbers (layers, ·),
    whose running maxima count.
    """

    ledger: np.ndarray
    velocity: np.ndarray
    displacement: np.ndarray
    energy: np.ndarray
    gained: np.ndarray
    force: np.ndarray
    viscosity: np.ndarray
    material: np.ndarray
    memory: np.ndarray
    numbers: np.ndarray

    def __post_init__(self) -> None:
        # The node pass goes through displacements and velocities in whole cache lines from node 1 on.
        starts = {"velocity": 2, "displacement": 1, "gained": 0, "force": 0, "material": 0, "viscosity": 0, "energy": 0}
        for place, (name, first) in enumerate(starts.items()):
            object.__setattr__(self, name, placed(getattr(self, name), place, first))

    def arrays(self) -> dict[str, np.ndarray]:
        """Every array by name, as a checkpoint stores them."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @classmethod
    def from_arrays(cls, arrays: dict[str, np.ndarray]) -> State:
        """The state that `arrays` described."""
        return cls(**{field.name: np.array(arrays[field.name], dtype=float) for field in fields(cls)})

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
        return float(self.ledger[layout.TIME])

    @property
    def cycle(self) -> int:
        """Number of steps taken."""
        return int(self.ledger[layout.CYCLE])
