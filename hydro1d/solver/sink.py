"""Sinks: where a run hands over its profiles, history rows, checkpoints and maxima."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from hydro1d.solver.state import State


@dataclass(frozen=True)
class Frame:
    """Profiles at one time (s): arrays over nodes (zones + 1,) and over zones (zones,) by name, SI."""

    time: float
    cycle: int
    fields: dict[str, np.ndarray]


class Sink:
    """Base of all sinks. Every event does nothing here, so that a sink writes only those that it takes."""

    def profile(self, frame: Frame) -> None:
        """Take the profiles at one time; the arrays are views of what one call of the time loop recorded."""

    def history(self, rows: np.ndarray, probes: np.ndarray) -> None:
        """Take rows of history (rows, columns) and of probes (rows, probes, 4)."""

    def flush(self) -> None:
        """All records up to some time have been handed over: what there is can be read as it stands."""

    def checkpoint(self, state: State) -> object:
        """Take a state to restart from; everything up to its time has been handed over."""
        return None

    def maxima(self, zone_maxima: dict[str, np.ndarray]) -> None:
        """Take what was largest in each zone (zones,) over the run."""
