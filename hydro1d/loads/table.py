"""A measured pressure."""

from __future__ import annotations

import numpy as np
from pydantic import model_validator

from hydro1d.components.parameters import derived, pairs
from hydro1d.loads.base import Pulse, check_times, interpolate


class Table(Pulse):
    """Pressure linear between the points of a table, constant before the first and after the last."""

    table: tuple[tuple[float, float], ...] = pairs("s", "Pa", "time and pressure")

    @model_validator(mode="after")
    def _check_table(self) -> Table:
        check_times(self.table)
        return self

    def pressure(self, time: float) -> float:
        """Linear interpolation."""
        return interpolate(self.times, self.pressures, self.points, time)

    def breakpoints(self) -> tuple[float, ...]:
        """The times of the points."""
        return tuple(time for time, _ in self.table if time > 0.0)

    def peak_pressure(self) -> float:
        """Largest pressure of the points, Pa."""
        return max(pressure for _, pressure in self.table)

    @derived
    def times(self) -> np.ndarray:
        """Times of the points, s."""
        return np.array([time for time, _ in self.table])

    @derived
    def pressures(self) -> np.ndarray:
        """Pressures at the points, Pa."""
        return np.array([pressure for _, pressure in self.table])

    @derived
    def points(self) -> int:
        """Number of points."""
        return len(self.table)
