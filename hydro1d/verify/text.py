"""The rows of the suite as a table in plain text."""

import math
from collections.abc import Sequence

from hydro1d.verify.rows import Row
from hydro1d.verify.suite import Report

WIDTHS = (32, 38, 14, 14, 9, 6, 9, 6)
HEADER = ("case", "quantity", "exact", "measured", "error", "order", "tolerance", "")


def header() -> str:
    """Names of the columns."""
    return _row(HEADER)


def lines(report: Report) -> list[str]:
    """The rows of one case."""
    return [row_text(row) for row in report.rows]


def row_text(row: Row) -> str:
    """One row; a failure says its reason below."""
    text = _row(
        (
            row.case,
            row.quantity,
            number(row.exact),
            number(row.measured),
            short(row.error),
            order(row),
            limit(row.tolerance),
            verdict(row),
        )
    )
    return text if row.passed else f"{text}\n    {row.reason}"


def summary(rows: Sequence[Row], cases: int, seconds: float) -> str:
    """The last line of the output: numbers of cases, rows and failures, and the time taken (s)."""
    failed = sum(not row.passed for row in rows)
    verdict = "all passed" if not failed else f"{failed} FAILED"
    return f"{cases} cases, {len(rows)} rows, {verdict}, {seconds:.1f} s"


def verdict(row: Row) -> str:
    """The last column: pass, FAIL, or shown for a row without a tolerance."""
    return "FAIL" if not row.passed else "pass" if math.isfinite(row.tolerance) else "shown"


def number(value: float) -> str:
    """A value with seven digits, a dash for what is not finite."""
    return f"{value:.7g}" if math.isfinite(value) else "–"


def short(value: float) -> str:
    """An error with two digits, a dash for what is not finite."""
    return f"{value:.1e}" if math.isfinite(value) else "–"


def limit(value: float) -> str:
    """A tolerance, a dash where there is none."""
    return f"{value:.2g}" if math.isfinite(value) else "–"


def order(row: Row) -> str:
    """The observed order, two digits; nothing where none was asked for."""
    return "" if row.order is None else f"{row.order:.2f}"


def _row(cells: Sequence[str]) -> str:
    left = [f"{cell:<{width}}" for cell, width in zip(cells[:2], WIDTHS, strict=False)]
    right = [f"{cell:>{width}}" for cell, width in zip(cells[2:], WIDTHS[2:], strict=False)]
    return "  ".join([*left, *right]).rstrip()
