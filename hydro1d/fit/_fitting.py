"""Least squares."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydro1d.errors import DeckError, Hydro1dError
from hydro1d.fit._curve import MeasuredCurve, checked, read_curve
from hydro1d.fit._efficiency import Efficiency, energy_efficiency
from hydro1d.fit._models import MODELS, Model, Parameter

_MOST_POINTS = 1500
_CONFIDENCE = 0.95
_PENALTY = 1e3


@dataclass(frozen=True)
class Fit:
    """Parameters of a law from a measured curve.

    values and intervals (95 % confidence, low and high) by the deck's names, SI; residuals = law − measured, Pa, at the
    measured strains; rms, Pa; relative_rms, of what was minimised; efficiency: plateau and densification without a law.
    """

    law: str
    curve: MeasuredCurve
    values: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    units: dict[str, str]
    residuals: np.ndarray
    rms: float
    relative_rms: float
    efficiency: Efficiency
    density: float | None

    def stress(self, strain: np.ndarray) -> np.ndarray:
        """The fitted loading curve, Pa."""
        return _stress(MODELS[self.law], np.asarray(strain, dtype=float), self.density, list(self.values.values()))

    def table(self) -> str:
        """The parameters with their intervals as text."""
        lines = [f"{'parameter':<22}{'value':>14}   95 % confidence"]
        for name, value in self.values.items():
            low, high = self.intervals[name]
            unit = "" if self.units[name] == "1" else f" {self.units[name]}"
            lines.append(f"{name:<22}{value:>14.6g}   {low:.6g} … {high:.6g}{unit}")
        return "\n".join(lines)

    def deck_fragment(self, material: str = "foam", density: float | None = None) -> str:
        """A [material] table for a deck; without a density that line is left for the user to fill in."""
        known = self.density if density is None else density
        given = f'density = "{known:.6g} kg/m^3"' if known is not None else '# density = "... kg/m^3"   # required'
        lines = [f"[material.{material}]", f'law = "{self.law}"', given]
        for name, value in self.values.items():
            lines.append(f"{name} = {_in_deck(value, self.units[name])}")
        return "\n".join(lines)


def _in_deck(value: float, unit: str) -> str:
    if unit == "1":
        return f"{value:.6g}"
    return f'"{value / 1e6:.6g} MPa"' if unit == "Pa" else f'"{value:.6g} {unit}"'


def fittable() -> list[str]:
    """Names of the laws that can be fitted."""
    return list(MODELS)


def fit_curve(
    curve: MeasuredCurve | str | os.PathLike[str],
    law: str = "epph-tangent",
    density: float | None = None,
    largest_strain: float = 1.0,
) -> Fit:
    """Fit a law to a measured quasi-static curve (or the CSV file of one) by least squares.

    What is minimised is the difference of the stresses over √(plateau² + stress²): absolute on the plateau, relative in
    densification, where the stress is many times higher. density (kg/m^3) is needed by `epph`, whose hardening has it.
    Raises DeckError for an unknown law, a missing density or a curve that cannot be fitted, FileProblem for the file.
    """
    if law not in MODELS:
        raise DeckError(f"no fit for the law {law[:60]!r}; there are {', '.join(MODELS)}")
    model = MODELS[law]
    if model.needs_density and density is None:
        raise DeckError(f"{law} needs the density: its hardening (Eq. 39) depends on it")
    if isinstance(curve, str | os.PathLike):
        curve = read_curve(Path(curve), largest_strain)
    else:
        curve = checked(curve.strain, curve.stress, largest_strain)
    found = energy_efficiency(curve)
    parameters = model.parameters(curve, found, density or 1.0)
    answer = _solve(model, _thinned(curve), parameters, density, found.plateau_stress)
    return _result(law, curve, parameters, answer, density, found)


def _thinned(curve: MeasuredCurve) -> MeasuredCurve:
    every = -(-len(curve.strain) // _MOST_POINTS)
    return MeasuredCurve(curve.strain[::every], curve.stress[::every])


def _stress(model: Model, strain: np.ndarray, density: float | None, values: list[float]) -> np.ndarray:
    return np.asarray(model.curve(density or 1.0, *values).stress(strain), dtype=float)


def _solve(
    model: Model, curve: MeasuredCurve, parameters: list[Parameter], density: float | None, plateau: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Best parameters, residuals, Jacobian. Several starts: a corner in the curve leaves local minima."""
    from scipy.optimize import least_squares

    low, high = (np.array([getattr(parameter, side) for parameter in parameters]) for side in ("low", "high"))
    start = np.array([parameter.start for parameter in parameters])
    weight = 1.0 / np.hypot(plateau, curve.stress)

    def difference(values: np.ndarray) -> np.ndarray:
        try:
            return np.clip(
                (_stress(model, curve.strain, density, list(values)) - curve.stress) * weight, -_PENALTY, _PENALTY
            )
        except ValueError:  # parameters that make no curve
            return np.full(len(curve.strain), _PENALTY)

    best = None
    for factor in (1.0, 0.85, 0.7):
        first = start.copy()
        for k, parameter in enumerate(parameters):
            if parameter.name == "densification_strain":
                first[k] *= factor
        first = np.clip(first, low * (1 + 1e-9) + 1e-15, high * (1 - 1e-9))
        answer = least_squares(
            difference, first, bounds=(low, high), x_scale=np.abs(start), jac="3-point", max_nfev=400
        )
        if best is None or answer.cost < best.cost:
            best = answer
    if best is None or not np.isfinite(best.cost) or best.cost >= 0.1 * _PENALTY**2:
        raise Hydro1dError("no parameters of this law come near the curve")
    return best.x, best.fun, best.jac


def _result(
    law: str,
    curve: MeasuredCurve,
    parameters: list[Parameter],
    answer: tuple[np.ndarray, np.ndarray, np.ndarray],
    density: float | None,
    found: Efficiency,
) -> Fit:
    values, differences, jacobian = answer
    half = _half_widths(differences, jacobian)
    residuals = _stress(MODELS[law], curve.strain, density, list(values)) - curve.stress
    names = [parameter.name for parameter in parameters]
    return Fit(
        law,
        curve,
        dict(zip(names, map(float, values), strict=True)),
        {name: (float(v - h), float(v + h)) for name, v, h in zip(names, values, half, strict=True)},
        {parameter.name: parameter.unit for parameter in parameters},
        residuals,
        float(np.sqrt(np.mean(residuals**2))),
        float(np.sqrt(np.mean(differences**2))),
        found,
        density,
    )


def _half_widths(differences: np.ndarray, jacobian: np.ndarray) -> np.ndarray:
    """Half of each 95 % interval, from the linearised covariance; infinite where the curve says nothing."""
    from scipy.stats import t as student

    freedom = max(len(differences) - jacobian.shape[1], 1)
    size = np.linalg.norm(jacobian, axis=0)
    size[size == 0.0] = 1.0
    variance = float(differences @ differences) / freedom
    _, singular, right = np.linalg.svd(jacobian / size, full_matrices=False)
    inverse = np.divide(1.0, singular, out=np.full(len(singular), np.inf), where=singular > 1e-12 * singular[0])
    with np.errstate(invalid="ignore"):
        spread = np.sqrt(np.nansum((right.T * inverse) ** 2, axis=1) * variance) / size
    return np.asarray(student.ppf(0.5 + 0.5 * _CONFIDENCE, freedom) * spread)
