"""A measured curve as `law = "table"` takes it: no noise, no fall of the stress, few points."""

import os
from dataclasses import dataclass

import numpy as np
from pydantic import ValidationError

from hydro1d.errors import DeckError
from hydro1d.fit._curve import MeasuredCurve, density_line, measured
from hydro1d.fit._efficiency import WINDOW, Efficiency, averaged, energy_efficiency
from hydro1d.fit._models import elastic_modulus
from hydro1d.laws.table import Table

_NEAR = 0.005  # of √(plateau² + stress²): how far a straight line between two points may miss those between
_NOISE = 3.0  # standard deviations that a straight line may miss: steps within them are not the foam's
_ON_LINE = 0.97  # of the elastic line: a point above is on it
_MIN_ELASTIC = 2  # points before the first corner that make a slope
_UNSETTLED = 0.003  # of strain before the end: a mean over less still has the noise
_MPA = 1e6


@dataclass(frozen=True)
class Tabulated:
    """A loading curve from a measured one.

    points (n, 2): strain and stress, Pa; modulus, Pa, of the elastic line before them; corners, the same with that line, as
    the law has them; residuals = table − measured, Pa, at the measured strains; rms, Pa; efficiency: plateau and
    densification; notes: what was assumed in reading.
    """

    curve: MeasuredCurve
    points: np.ndarray
    modulus: float
    corners: np.ndarray
    residuals: np.ndarray
    rms: float
    efficiency: Efficiency
    notes: tuple[str, ...]
    law: str = "table"

    def stress(self, strain: np.ndarray) -> np.ndarray:
        """The loading curve, Pa."""
        return np.interp(np.asarray(strain, dtype=float), *self.corners.T)

    def csv(self) -> str:
        """The points as a file that a deck's `curve` names."""
        return "\n".join(["strain,stress [MPa]", *(f"{e:.6g},{s / _MPA:.6g}" for e, s in self.points), ""])

    def deck_fragment(self, material: str, file: str, density: float | None) -> str:
        """A [material] table for a deck; without a density that line is left for the user to fill in."""
        lines = [f"[material.{material}]", 'law = "table"', density_line(density)]
        return "\n".join([*lines, f'modulus = "{self.modulus / _MPA:.6g} MPa"', f'curve = "{file}"'])


def tabulate(
    curve: MeasuredCurve | str | os.PathLike[str],
    largest_strain: float = 1.0,
    strain_unit: str = "",
    stress_unit: str = "",
) -> Tabulated:
    """Make a measured curve (or the CSV file of one) one that `law = "table"` takes.

    Stresses are averaged over ±0.01 of strain, then raised and lowered as little as possible until none falls (isotonic
    regression: a peak and the trough behind it become a level between them), and thinned to points between which straight
    lines stay within 0.5 %, or within what is left of the noise. Raises DeckError and FileProblem as `fit_curve` does.
    """
    curve, notes = measured(curve, largest_strain, strain_unit, stress_unit)
    found = energy_efficiency(curve)
    slope = elastic_modulus(curve, found)
    mean = averaged(curve.strain, curve.stress)
    near = max(_NEAR, _NOISE * _scatter(curve, mean, found.plateau_stress))
    strain, stress = _settled(curve.strain, mean)
    first = _end_of_line(strain, stress, slope, found)
    kept = first + _corners(strain[first:], stress[first:], near * np.hypot(found.plateau_stress, stress[first:]))
    points = np.column_stack([strain[kept], stress[kept]])
    modulus = max(slope, _least_modulus(points))
    if np.count_nonzero((curve.strain > 0.0) & (curve.strain < points[0, 0])) < _MIN_ELASTIC:
        guess = "the curve has hardly a point on its elastic line; the modulus is a guess: put in the right one"
        notes = (*notes, guess)
    corners = _law(points, modulus).corners
    residuals = np.interp(curve.strain, *corners.T) - curve.stress
    return Tabulated(curve, points, modulus, corners, residuals, float(np.sqrt(np.mean(residuals**2))), found, notes)


def _scatter(curve: MeasuredCurve, mean: np.ndarray, plateau: float) -> float:
    """Standard deviation of the mean stress, over √(plateau² + stress²): what is left of a machine's noise."""
    together = max(2.0 * WINDOW / float(np.median(np.diff(curve.strain))), 1.0)
    share = (curve.stress - mean) / np.hypot(plateau, mean)
    return float(np.sqrt(np.mean(share**2) / together))


def _least_modulus(points: np.ndarray) -> float:
    """The smallest modulus whose line from the origin comes to the first point, or above it, no flatter than the curve there."""
    (start, low), (end, high) = points[:2]
    return 1.0001 * max(low / start, (high - low) / (end - start))


def _settled(strain: np.ndarray, stress: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The curve without falls, and without its last points if they are too close to the end to have been averaged."""
    from scipy.optimize import isotonic_regression

    kept = (strain <= strain[-1] - _UNSETTLED) | (np.diff(strain, append=2.0) > _UNSETTLED)
    return strain[kept], np.maximum(isotonic_regression(stress[kept]).x, 0.0)


def _end_of_line(strain: np.ndarray, stress: np.ndarray, modulus: float, found: Efficiency) -> int:
    """Index of the last point on the elastic line; the knee, where the curve has a toe and is nowhere on it."""
    before = int(np.searchsorted(strain, found.yield_strain))
    on_line = np.flatnonzero(stress[: before + 1] >= _ON_LINE * modulus * strain[: before + 1])
    last = int(on_line[-1]) if len(on_line) else before
    return min(max(last, int(strain[0] == 0.0)), len(strain) - 2)  # the origin is the line's


def _corners(strain: np.ndarray, stress: np.ndarray, allowed: np.ndarray) -> np.ndarray:
    """Indices of the points that a polygon needs so as not to miss any by more than is allowed (Douglas & Peucker)."""
    kept, open_parts = {0, len(strain) - 1}, [(0, len(strain) - 1)]
    while open_parts:
        first, last = open_parts.pop()
        if last - first < 2:
            continue
        inside = slice(first + 1, last)
        line = np.interp(strain[inside], strain[[first, last]], stress[[first, last]])
        missed = np.abs(stress[inside] - line) / allowed[inside]
        worst = first + 1 + int(np.argmax(missed))
        if missed.max() > 1.0:
            kept.add(worst)
            open_parts += [(first, worst), (worst, last)]
    return np.array(sorted(kept))


def _law(points: np.ndarray, modulus: float) -> Table:
    """The law itself judges its table. Raises DeckError with its reason."""
    try:
        return Table(density=1.0, modulus=modulus, curve=tuple(map(tuple, points.tolist())))
    except ValidationError as error:
        reason = error.errors()[0]["msg"].removeprefix("Value error, ")
        raise DeckError(f"no table can be made of this curve: {reason}") from error
