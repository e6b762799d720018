"""The rows of the suite as a table in plain text."""

import math
from collections.abc import Sequence

from hydro1d.verify.rows import Row

WIDTHS = (32, 38, 14, 14, 9, 6, 9, 6)
HEADER = ("case", "quantity", "exact", "measured", "error", "order", "tolerance", "")


def header() -> str:
    """Names of the columns."""
    return _row(HEADER)


def row_text(row: Row) -> str:
    """One row; a failure says its reason below."""
    text = _row((row.case, row.quantity, *cells(row)))
    return text if row.passed else f"{text}\n    {row.reason}"


def summary(rows: Sequence[Row], cases: int, seconds: float) -> str:
    """The last line of the output: numbers of cases, rows and failures, and the time taken (s)."""
    failed = sum(not row.passed for row in rows)
    verdict = "all passed" if not failed else f"{failed} FAILED"
    return f"{cases} cases, {len(rows)} rows, {verdict}, {seconds:.1f} s"


def cells(row: Row) -> tuple[str, ...]:
    """Exact and measured value, error, order, tolerance and verdict; a dash for what is not finite, no order if none is asked."""
    values = ((row.exact, ".7g"), (row.measured, ".7g"), (row.error, ".1e"), (row.tolerance, ".2g"))
    exact, measured, error, tolerance = (format(value, form) if math.isfinite(value) else "–" for value, form in values)
    verdict = "FAIL" if not row.passed else "pass" if math.isfinite(row.tolerance) else "shown"
    return exact, measured, error, "" if row.order is None else f"{row.order:.2f}", tolerance, verdict


def _row(cells: Sequence[str]) -> str:
    left = [f"{cell:<{width}}" for cell, width in zip(cells[:2], WIDTHS, strict=False)]
    right = [f"{cell:>{width}}" for cell, width in zip(cells[2:], WIDTHS[2:], strict=False)]
    return "  ".join([*left, *right]).rstrip()
