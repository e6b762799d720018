"""A measured curve, linear between its points."""

from __future__ import annotations

import numpy as np
from pydantic import model_validator

from hydro1d.components.parameters import derived, pairs, positive
from hydro1d.laws.base import Foam

_ADVICE = "hydro1d laws fit CURVE.csv --table FILE.csv makes such a curve of a measured one with unloading and noise"


class Table(Foam):
    """σ(ε) through the points of a measured quasi-static curve, after an elastic line of slope E.

    The elastic line ends where it meets the curve, whose first segment is extended for that as far as needed (a point at the
    origin does not count); beyond its last point the curve goes on with its last slope.
    """

    modulus: float = positive("Pa", "elastic modulus E")
    curve: tuple[tuple[float, float], ...] = pairs(
        "1", "Pa", "strain and stress, strain rising, stress not falling", advice=f"; {_ADVICE}"
    )

    @model_validator(mode="after")
    def _check_curve(self) -> Table:
        points = np.array(self.curve, dtype=float)
        if len(points) < 2 or (len(points) == 2 and points[0, 0] == points[0, 1] == 0.0):
            raise ValueError("curve needs two points at least besides the origin")
        first, last = points[0, 0], points[-1, 0]
        if not ((np.diff(points[:, 0]) > 0).all() and first >= 0.0 and last < 1.0):
            raise ValueError(
                f"curve must have strains rising from 0 or above to below 1, not from {first:g} to {last:g} "
                "(percent needs the unit %)"
            )
        falls = np.flatnonzero(np.diff(points[:, 1]) < 0.0)
        if len(falls):
            (strain, high), (_, low) = points[falls[0]], points[falls[0] + 1]
            raise ValueError(
                f"curve must have stresses that do not fall; behind strain {strain:g} they fall from {high:g} to {low:g} Pa, "
                f"the first of {len(falls)} falls; {_ADVICE}"
            )
        if not (points[0, 1] >= 0.0 and points[-1, 1] > 0.0):
            raise ValueError("curve must have stresses from 0 or above to above 0")
        if not (self.modulus * points[:, 0] > points[:, 1]).any():
            raise ValueError(
                f"curve never falls below the elastic line; the modulus, {self.modulus:g} Pa, is too small"
            )
        self.corners  # noqa: B018 (its own check, before anything is computed)
        return self

    def loading(self, strain: float) -> tuple[float, float]:
        """The lower of elastic line and curve, and its slope; the segment by bisection."""
        low, high = 0, int(self.segments)
        while high - low > 1:
            middle = (low + high) // 2
            if strain >= self.strains[middle]:
                low = middle
            else:
                high = middle
        slope = self.slopes[low]
        return self.stresses[low] + slope * (strain - self.strains[low]), slope

    @derived
    def corners(self) -> np.ndarray:
        """Corner points (strain, stress) of elastic line and curve together, shape (points, 2)."""
        points = np.array(self.curve, dtype=float)
        if points[0, 0] == points[0, 1] == 0.0:
            points = points[1:]  # the origin lies on the elastic line already
        below = np.flatnonzero(self.modulus * points[:, 0] >= points[:, 1])[0]  # first on the line or right of it
        segment = max(below - 1, 0)
        (strain, stress), (end, end_stress) = points[segment], points[min(segment + 1, len(points) - 1)]
        slope = (end_stress - stress) / (end - strain) if end > strain else 0.0
        meet = (stress - slope * strain) / (self.modulus - slope) if slope < self.modulus else 0.0
        if slope > self.modulus * (1.0 + 1e-9):
            raise ValueError(f"curve rises by {slope:g} Pa between strains {strain:g} and {end:g}, above the modulus")
        if meet <= 0.0:  # a curve that is straight from the origin, or has a toe
            return np.vstack([[0.0, 0.0], points[below:]])
        rest = points[points[:, 0] > meet * (1.0 + 1e-12)]
        return np.vstack([[0.0, 0.0], [meet, self.modulus * meet], rest])

    @derived
    def strains(self) -> np.ndarray:
        """Strains at the corners."""
        return np.ascontiguousarray(self.corners[:-1, 0])

    @derived
    def stresses(self) -> np.ndarray:
        """Stresses at the corners, Pa."""
        return np.ascontiguousarray(self.corners[:-1, 1])

    @derived
    def slopes(self) -> np.ndarray:
        """Slopes of the segments, Pa."""
        steps = np.diff(self.corners, axis=0)
        return np.ascontiguousarray(steps[:, 1] / steps[:, 0])

    @derived
    def segments(self) -> int:
        """Number of segments."""
        return len(self.corners) - 1

    @derived
    def yield_strain(self) -> float:
        """Strain at the end of the elastic line."""
        return float(self.corners[1, 0])
