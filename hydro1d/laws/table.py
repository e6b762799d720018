"""A measured curve, linear between its points."""

from __future__ import annotations

import numpy as np
from pydantic import model_validator

from hydro1d.laws.base import Foam
from hydro1d.parameters import derived, pairs, positive


class Table(Foam):
    """σ(ε) through the points of a measured quasi-static curve, after an elastic line of slope E.

    The curve starts where the elastic line meets it; beyond its last point it goes on with its last slope.
    """

    modulus: float = positive("Pa", "elastic modulus E")
    curve: tuple[tuple[float, float], ...] = pairs("1", "Pa", "strain and stress, strain rising, stress not falling")

    @model_validator(mode="after")
    def _check_curve(self) -> Table:
        points = np.array(self.curve, dtype=float)
        if len(points) < 2:
            raise ValueError("curve needs two points at least")
        if not np.isfinite(points).all():
            raise ValueError("curve holds NaN or infinity")
        if not ((np.diff(points[:, 0]) > 0).all() and 0.0 <= points[0, 0] and points[-1, 0] < 1.0):
            raise ValueError("curve must have strains rising from 0 or above to below 1")
        if not ((np.diff(points[:, 1]) >= 0).all() and points[0, 1] >= 0.0 and points[-1, 1] > 0.0):
            raise ValueError("curve must have stresses that do not fall, from 0 or above")
        if self.modulus * points[-1, 0] <= points[-1, 1]:
            raise ValueError("curve never falls below the elastic line; the modulus is too small for it")
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
        excess = self.modulus * points[:, 0] - points[:, 1]
        first = int(np.argmax((excess > 0.0) & (points[:, 0] > 0.0)))
        while first < len(points) and excess[first] <= 0.0:
            first += 1
        if first == 0:
            meet = points[0, 1] / self.modulus
            start = [[0.0, 0.0], [meet, points[0, 1]]] if meet > 0.0 else [[0.0, 0.0]]
        else:
            (e0, s0), (e1, s1) = points[first - 1], points[first]
            slope = (s1 - s0) / (e1 - e0)
            meet = (s0 - slope * e0) / (self.modulus - slope)
            start = [[0.0, 0.0], [meet, self.modulus * meet]] if meet > 0.0 else [[0.0, 0.0]]
        rest = points[points[:, 0] > start[-1][0] * (1.0 + 1e-12)]
        return np.vstack([start, rest])

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
