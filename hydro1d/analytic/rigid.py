"""What the solutions for rigid foams share: a history, a striker, a front that ends when its block comes to rest."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, length_allowed, positive
from hydro1d.analytic.jumps import Jump


class FrontHistory(NamedTuple):
    """What happens at the loaded end and at the front, arrays of the shape of t.

    displacement u (m) and velocity v (m/s) of the loaded end; front, the Lagrangian coordinate of the front, which is
    the crushed length (m); front_stress behind the front and left_stress on the loaded end (Pa).
    """

    displacement: Array
    velocity: Array
    front: Array
    front_stress: Array
    left_stress: Array


class RigidFoam(Protocol):
    """A foam that is rigid until a front crushes it: density kg/m^3, plateau_stress Pa."""

    @property
    def density(self) -> float:
        """Initial density, kg/m^3."""

    @property
    def plateau_stress(self) -> float:
        """Stress ahead of the front, Pa."""

    def jump(self, velocity: float, coordinate: float) -> Jump:
        """The front at `coordinate` (m), crushed material moving at `velocity` (m/s)."""


class StoppingFront(ABC):
    """One front in a rigid foam, which is gone once the crushed block is at rest."""

    material: RigidFoam

    @property
    @abstractmethod
    def stop_time(self) -> float:
        """When the block comes to rest if the column is long enough, s."""

    @abstractmethod
    def history(self, t: ArrayLike) -> FrontHistory:
        """Displacement, velocity, front and stresses at times t (s)."""

    def jumps(self, t: float) -> list[Jump]:
        """The front at time t (s); none once the block is at rest."""
        history = self.history(t)
        if t >= self.stop_time:
            return []
        return [self.material.jump(float(history.velocity), float(history.front))]


@dataclass(frozen=True)
class RigidStriker:
    """A rigid mass against a column of rigid foam with a fixed back.

    material; mass of the striker per area, kg/m^2 (G/A0); impact_velocity v0, m/s; length of the column, m.
    """

    material: RigidFoam
    mass: float
    impact_velocity: float
    length: float = math.inf

    def __post_init__(self) -> None:
        positive(self, "mass", "impact_velocity")
        length_allowed(self.length)

    def _striker_stress(self, front_stress: Array, front: Array) -> Array:
        """Stress between striker and column, Pa: the striker's share of what decelerates the whole block."""
        return front_stress * self.mass / (self.mass + self.material.density * front)


@dataclass(frozen=True)
class MomentumStriker(RigidStriker, StoppingFront):
    """A striker that only the plateau stress ahead of the front takes momentum from."""

    @property
    def stop_time(self) -> float:
        """When the striker comes to rest in a column long enough, s."""
        return self.mass * self.impact_velocity / self.material.plateau_stress
