"""The kick of an end node by its boundary. One kernel a boundary (and pulse)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hydro1d.boundaries.base import End
from hydro1d.kernels.primitives import gather, scatter

SIGNATURE = "pppp"
MEMORY = 4  # the most that a boundary may remember

# Places in `out`
VELOCITY, FORCE = 0, 1


def end_kernel(unpack: Callable, memory_count: tuple[float, ...]) -> Callable:
    """The kernel of the boundary that ``unpack`` builds from its parameters; it has one memory variable an entry."""

    def kick(parameters: Any, state: Any, memory: Any, out: Any) -> None:
        """New velocity and force (inward) from the ten numbers of an `End`; the memory is advanced in place."""
        boundary = unpack(parameters)
        end = End(state[0], state[1], state[2], state[3], state[4], state[5], state[6], state[7], state[8], state[9])
        velocity, force, remembered = boundary.kick(end, gather(memory, 0, 1, memory_count))
        scatter(memory, 0, 1, remembered)
        out[VELOCITY] = velocity
        out[FORCE] = force

    return kick
