"""What a boundary is.

A boundary moves the end node of a column. It is written once, in the frame of the end it stands on: velocity and
displacement count positive *into* the column, stresses compressive, so the same file serves the left and the right end.
Its `kick` is compiled like a law's point function.
"""

from __future__ import annotations

from typing import ClassVar, NamedTuple

import numpy as np

from hydro1d.components.parameters import Component


class End(NamedTuple):
    """State of an end node at the time of the stresses, in the frame of the end.

    `step_before` and `step_after` (s) are the steps on either side of `time`; the kick takes half of each. `impedance`
    (ρ0 c) and `initial_stress` are those of the zone at the end before anything moved. `side` is 1 on the left and −1 on
    the right end: a velocity that counts positive to the right, times `side`, is inward.
    """

    time: float
    step_before: float
    step_after: float
    velocity: float
    displacement: float
    mass: float
    stress: float
    impedance: float
    initial_stress: float
    side: float


class Boundary(Component):
    """Base of all boundaries. `state_variables` names what a boundary keeps, with units, for the history.

    `supports` is whether what stands on the end bears a load that arrives there, as a wall does.
    """

    state_variables: ClassVar[dict[str, str]] = {}
    memory: ClassVar[dict[str, str]] = {}  # what version 0.1 called it
    supports: ClassVar[bool] = True

    def kick(self, end: End, state: tuple[float, ...]) -> tuple[float, float, tuple[float, ...]]:
        """Advance the end node over one step.

        Returns the new velocity (m/s, inward), the force per area that the boundary exerts on the node (Pa, inward), and
        the new state.
        """
        raise NotImplementedError

    def start(self, velocity: float, mass: float, side: float) -> tuple[float, tuple[float, ...]]:
        """Velocity (inward) of the end node just after t = 0, and the initial state.

        Raises ValueError, in one sentence, where the load makes no sense on this side.
        """
        return velocity, ()

    def report(self, kept: np.ndarray, coordinate: float, side: float) -> np.ndarray:
        """What is kept (rows, variables) as the history shows it: in the laboratory, for an end that began at ``coordinate``."""
        return kept

    def breakpoints(self) -> tuple[float, ...]:
        """Times (s) at which the load has a breakpoint or a jump: a step lands on each."""
        return ()

    def peak(self) -> float:
        """Largest pressure applied (Pa); 0 where no pressure is prescribed."""
        return 0.0


def free_velocity(end: End, force: float) -> float:
    """Velocity of an end node of its own mass after a kick by ``force``."""
    return end.velocity + 0.5 * (end.step_before + end.step_after) * (force - end.stress) / end.mass


def reaction(end: End, velocity: float) -> float:
    """Force that takes the end node to ``velocity``."""
    step = 0.5 * (end.step_before + end.step_after)
    return end.stress + (end.mass * (velocity - end.velocity) / step if step > 0.0 else 0.0)
