"""What a case of the suite is, and what it fills: rows of the verification table and curves of its figures."""

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, Literal, Self

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.verify.convergence import extrapolate, order


@dataclass(frozen=True)
class Row:
    """One comparison.

    error is `|measured − exact|/|exact|`, or absolute where exact is 0 or a scale is named in `quantity`; order is what
    successive resolutions show (None: not asked for, or exact already); tolerance bounds the error (infinite: reported
    only) and least_order the order. reason says where the tolerance comes from.
    """

    case: str
    quantity: str
    exact: float
    measured: float
    error: float
    order: float | None
    tolerance: float
    passed: bool
    least_order: float | None = None
    reason: str = ""

    def plain(self) -> dict[str, Any]:
        """The row as JSON holds it: null for what is not a finite number."""
        return {
            key: None if isinstance(value, float) and not math.isfinite(value) else value
            for key, value in asdict(self).items()
        }


@dataclass(frozen=True)
class Line:
    """One curve of a panel: the exact solution, a run, or points."""

    x: np.ndarray
    y: np.ndarray
    label: str
    style: Literal["exact", "run", "points"] = "run"


@dataclass(frozen=True)
class Panel:
    """One set of axes."""

    title: str
    x_label: str
    y_label: str
    lines: tuple[Line, ...]
    log: bool = False


@dataclass
class Table:
    """Collects the rows and panels of one case."""

    case: str
    rows: list[Row] = field(default_factory=list)
    panels: list[Panel] = field(default_factory=list)

    def compare(
        self,
        quantity: str,
        exact: float,
        measured: float,
        tolerance: float,
        reason: str,
        *,
        scale: float | None = None,
        order: float | None = None,
        least_order: float | None = None,
    ) -> None:
        """Add `|measured − exact|` over ``scale`` (`|exact|` unless given, 1 for an exact zero) against a tolerance."""
        exact, measured = float(exact), float(measured)
        error = abs(measured - exact) / (abs(scale) if scale else abs(exact) or 1.0)
        passed = error <= tolerance and math.isfinite(error)  # a NaN never passes
        if least_order is not None:
            passed = passed and order is not None and order >= least_order
        self.rows.append(
            Row(self.case, quantity, exact, measured, error, order, float(tolerance), bool(passed), least_order, reason)
        )

    def bound(
        self,
        quantity: str,
        value: float,
        tolerance: float,
        reason: str,
        *,
        order: float | None = None,
        least_order: float | None = None,
    ) -> None:
        """Add a quantity that is zero in the exact solution: a residual or a norm of the error."""
        self.compare(quantity, 0.0, value, tolerance, reason, order=order, least_order=least_order)

    def converges(
        self,
        quantity: str,
        zones: ArrayLike,
        errors: Sequence[float] | np.ndarray,
        tolerance: float,
        reason: str,
        *,
        least_order: float | None = None,
    ) -> None:
        """Add the last of the errors at growing numbers of zones, with the order that they show."""
        self.bound(quantity, errors[-1], tolerance, reason, order=order(zones, errors), least_order=least_order)

    def rigid_limit(
        self,
        quantity: str,
        exact: float,
        stiffnesses: ArrayLike,
        values: np.ndarray,
        stiffest: tuple[str, float, str],
        limit: tuple[float, str],
        *,
        scale: float | None = None,
    ) -> None:
        """Add two rows of a quantity that reaches its exact value as stiffness^(−½): at the stiffest, and extrapolated.

        stiffest: what the row calls it, tolerance and reason; limit: tolerance and reason of the extrapolated value.
        """
        name, *raw = stiffest
        self.compare(f"{quantity}, {name}", exact, values[-1], *raw, scale=scale)  # type: ignore[arg-type]
        self.compare(f"{quantity}, limit", exact, extrapolate(stiffnesses, values, 0.5), *limit, scale=scale)

    def report(self, quantity: str, exact: float, measured: float, reason: str, *, scale: float | None = None) -> None:
        """Add a row that is shown and not judged, unless it is not a number."""
        self.compare(quantity, exact, measured, math.inf, reason, scale=scale)

    def panel(self, title: str, x_label: str, y_label: str, lines: Sequence[Line], *, log: bool = False) -> None:
        """Add a set of axes to the case's figure."""
        self.panels.append(Panel(title, x_label, y_label, tuple(lines), log))

    def beside(
        self,
        title: str,
        x_label: str,
        y_label: str,
        exact: tuple[ArrayLike, ArrayLike],
        run: tuple[ArrayLike, ArrayLike],
        label: str,
        theory: str = "exact",
    ) -> None:
        """Add a set of axes with one run, x and y, over the exact solution."""
        self.panel(title, x_label, y_label, [line(*exact, theory, "exact"), line(*run, label)])

    def convergence(self, zones: ArrayLike, errors: Mapping[str, ArrayLike], y_label: str) -> None:
        """Add the error against the number of zones, on logarithmic axes."""
        lines = [line(zones, values, label) for label, values in errors.items()]
        self.panel("convergence", "zones", y_label, lines, log=True)


def line(x: ArrayLike, y: ArrayLike, label: str, style: Literal["exact", "run", "points"] = "run") -> Line:
    """A `Line` from two array-likes."""
    return Line(np.asarray(x, dtype=float), np.asarray(y, dtype=float), label, style)


def failure(case: str, quantity: str, reason: str) -> Row:
    """A row that fails, for a case that did not run to its end."""
    return Row(case, quantity, math.nan, math.nan, math.nan, None, 0.0, False, None, reason)


@dataclass(frozen=True)
class Effort:
    """How fine the runs are: the default suite takes a minute, the full one adds finer resolutions."""

    full: bool = False

    def zones(self, coarsest: int, levels: int = 3) -> tuple[int, ...]:
        """Numbers of zones, each twice the one before; the full suite adds one more doubling."""
        return tuple(coarsest * 2**k for k in range(levels + self.full))


@dataclass(frozen=True)
class Case:
    """One entry of the suite.

    `study(table, effort)` runs the solver and fills the table with exactly `rows` rows; about: what is run and
    compared, one paragraph, for the report.
    """

    name: str
    title: str
    about: str
    rows: int
    study: Callable[[Table, Effort], None]

    @classmethod
    def of(cls, name: str, title: str, rows: int, study: Callable[[Table, Effort], None]) -> Self:
        """A case about which the docstring of its study says what there is to say."""
        told = inspect.getdoc(getattr(study, "func", study)) or ""
        return cls(name, title, " ".join(told.split()), rows, study)
