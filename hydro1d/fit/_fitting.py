"""Fitting a law to a measured curve by least squares."""

import itertools
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from hydro1d.analysis.theory import CURVES
from hydro1d.deck.messages import suggestion
from hydro1d.errors import DeckError, Hydro1dError
from hydro1d.fit._confidence import confidence
from hydro1d.fit._curve import MeasuredCurve, density_line, measured
from hydro1d.fit._efficiency import Efficiency, energy_efficiency
from hydro1d.fit._models import MODELS, NEED_DENSITY, Parameter

_MAX_POINTS = 1500
_PENALTY = 1e3
_WRONG_SHAPE = 0.1  # weighted rms: machines and foams scatter by less


@dataclass(frozen=True)
class Fit:
    """Parameters of a law from a measured curve.

    values and intervals (95 % confidence, low and high) by the deck's names, SI; residuals = law − measured, Pa, at the
    measured strains; rms, Pa; relative_rms, of what was minimised; efficiency: plateau and densification without a law.
    undetermined: parameters that the curve does not fix; at_bound: those that went as far as they may. Intervals of
    both are infinite. notes: what was assumed or left out in reading the curve.
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
    undetermined: tuple[str, ...] = ()
    at_bound: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def stress(self, strain: np.ndarray) -> np.ndarray:
        """The fitted loading curve, Pa."""
        return _stress(self.law, np.asarray(strain, dtype=float), self.density, self.values)

    def table(self) -> str:
        """The parameters with their intervals as text."""
        lines = [f"{'parameter':<22}{'value':>14}   95 % confidence"]
        for name, value in self.values.items():
            size, unit = (1e6, " MPa") if self.units[name] == "Pa" else (1.0, f" {self.units[name]}".replace(" 1", ""))
            low, high = (bound / size for bound in self.intervals[name])
            told = f"{low:.5g} … {high:.5g}{unit}" if np.isfinite([low, high]).all() else self.doubt(name)
            lines.append(f"{name:<22}{f'{value / size:.6g}{unit}':>14}   {told}")
        return "\n".join(lines)

    def doubt(self, name: str) -> str:
        """Why a parameter is not to be trusted, in a few words; "" if it is."""
        if name in self.at_bound:
            return "none: at its bound"
        return "none: the curve does not determine it" if name in self.undetermined else ""

    def warnings(self) -> list[str]:
        """What a user must know before using the parameters, in sentences."""
        found = [*self.notes]
        if self.undetermined:
            found.append(
                f"the curve does not determine {_listed(self.undetermined)}: other values fit as well. Measure further "
                "(to higher strain, or more points where it acts) or take a law with fewer parameters"
            )
        if self.at_bound:
            found.append(
                f"{_listed(self.at_bound)} went to the end of what a fit allows: the curve ends before it shows what that "
                "stands for, or does not have the shape of the law. Look at the residuals; another law may fit better"
            )
        if self.relative_rms > _WRONG_SHAPE:
            found.append(
                f"the law misses the curve by {100.0 * self.relative_rms:.2g} % as weighted: the curve does not have its shape. "
                f'Another law may fit better ({", ".join(fittable())}), and --table writes the curve itself for law = "table"'
            )
        return found

    def deck_fragment(self, material: str = "foam", density: float | None = None) -> str:
        """A [material] table for a deck; without a density that line is left for the user to fill in."""
        known = density_line(self.density if density is None else density)
        lines = [f"[material.{material}]", f'law = "{self.law}"', known]
        for name, value in self.values.items():
            doubt = self.doubt(name).removeprefix("none: ")
            lines.append(f"{name} = {_in_deck(value, self.units[name])}" + (f"   # {doubt}" if doubt else ""))
        return "\n".join(lines)


def _listed(names: tuple[str, ...]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


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
    strain_unit: str = "",
    stress_unit: str = "",
) -> Fit:
    """Fit a law to a measured quasi-static curve (or the CSV file of one) by least squares.

    What is minimised is the difference of the stresses over √(plateau² + stress²): absolute on the plateau, relative in
    densification, where the stress is many times higher. density (kg/m^3) is needed by `epph`, whose hardening has it;
    strain_unit and stress_unit are those of a file whose header names none.
    Raises DeckError for an unknown law, a missing density or a curve that cannot be fitted, FileProblem for the file.
    """
    _refuse_unfittable(law, density)
    curve, notes = measured(curve, largest_strain, strain_unit, stress_unit)
    found = energy_efficiency(curve)
    parameters = MODELS[law](curve, found)
    names = [parameter.name for parameter in parameters]
    difference = _difference(law, names, _thinned(curve), density, found.plateau_stress)
    values, jacobian = _solve(difference, parameters)
    trust = confidence(parameters, values, jacobian, difference)
    named = dict(zip(names, map(float, values), strict=True))
    residuals = _stress(law, curve.strain, density, named) - curve.stress
    return Fit(
        law=law,
        curve=curve,
        values=named,
        intervals={
            name: (v - h, v + h) for (name, v), h in zip(named.items(), map(float, trust.half_width), strict=True)
        },
        units={parameter.name: parameter.unit for parameter in parameters},
        residuals=residuals,
        rms=_root_mean_square(residuals),
        relative_rms=_root_mean_square(difference(values)),
        efficiency=found,
        density=density,
        undetermined=tuple(itertools.compress(names, trust.undetermined)),
        at_bound=tuple(itertools.compress(names, trust.at_bound)),
        notes=notes,
    )


def _refuse_unfittable(law: str, density: float | None) -> None:
    if law not in MODELS:
        raise DeckError(
            f"no fit for the law {law[:60]!r}{suggestion(law, fittable())}; there are {', '.join(MODELS)}; "
            'hydro1d laws fit --table writes a curve for law = "table"'
        )
    if law in NEED_DENSITY and density is None:
        raise DeckError(f"{law} needs the density: its hardening (Eq. 39) depends on it")


def _root_mean_square(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _thinned(curve: MeasuredCurve) -> MeasuredCurve:
    every = -(-len(curve.strain) // _MAX_POINTS)
    return MeasuredCurve(curve.strain[::every], curve.stress[::every])


def _stress(law: str, strain: np.ndarray, density: float | None, values: Mapping[str, float]) -> np.ndarray:
    return np.asarray(CURVES[law](density=density or 1.0, **values).stress(strain), dtype=float)


def _difference(
    law: str, names: Sequence[str], curve: MeasuredCurve, density: float | None, plateau: float
) -> Callable[[np.ndarray], np.ndarray]:
    """The function that is minimised: parameters -> law − measured, weighted."""
    weight = 1.0 / np.hypot(plateau, curve.stress)

    def difference(values: np.ndarray) -> np.ndarray:
        try:
            gap = _stress(law, curve.strain, density, dict(zip(names, values, strict=True))) - curve.stress
            return np.clip(gap * weight, -_PENALTY, _PENALTY)
        except ValueError:  # parameters that make no curve
            return np.full(len(curve.strain), _PENALTY)

    return difference


def _solve(
    difference: Callable[[np.ndarray], np.ndarray], parameters: list[Parameter]
) -> tuple[np.ndarray, np.ndarray]:
    """Best parameters and Jacobian. Several starts: a corner in the curve leaves local minima."""
    from scipy.optimize import least_squares

    low, high = (np.array([getattr(parameter, side) for parameter in parameters]) for side in ("low", "high"))
    start = np.array([parameter.start for parameter in parameters])
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
    return best.x, best.jac
