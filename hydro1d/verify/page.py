"""The report as one HTML page that asks nothing of the network."""

import html
import math
import platform
import re
from collections.abc import Sequence
from importlib import resources

from hydro1d.verify import text
from hydro1d.verify.rows import Row
from hydro1d.verify.suite import Report


def html_page(reports: Sequence[Report], rows: Sequence[Row], *, full: bool, seconds: float) -> str:
    """The whole page: verdict, a line a case, then each case with its figures and rows."""
    from hydro1d import __version__

    style = resources.files(__package__).joinpath("page.css").read_text(encoding="utf-8")
    alone = [row for row in rows if all(row is not own for report in reports for own in report.rows)]
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8"><title>hydro1d: verification</title>',
        '<link rel="icon" href="data:,">',
        f"<style>\n{style}</style></head><body>",
        "<h1>hydro1d: verification</h1>",
        f"<p>The solver against exact solutions. hydro1d {html.escape(__version__)}, {'full' if full else 'default'} suite, "
        f"Python {platform.python_version()}, {html.escape(platform.machine())}.</p>",
        _verdict(rows, len(reports), seconds),
        _rows_table(alone) if alone else "",
        _overview(reports),
        *(_case(report) for report in reports),
        "</body></html>\n",
    ]
    return "\n".join(part for part in parts if part)


def _verdict(rows: Sequence[Row], cases: int, seconds: float) -> str:
    kind = "pass" if rows and all(row.passed for row in rows) else "fail"
    return f'<p class="verdict {kind}">{html.escape(text.summary(rows, cases, seconds))}</p>'


def _overview(reports: Sequence[Report]) -> str:
    lines = []
    for report in reports:
        row = hardest(report.rows)
        judged = sum(math.isfinite(r.tolerance) for r in report.rows)
        failed = sum(not r.passed for r in report.rows)
        verdict = f'<td class="fail">{failed} FAILED</td>' if failed else '<td class="pass">pass</td>'
        cells = ("", "", "")
        if row is not None:
            _, _, error, _, tolerance, _ = text.cells(row)
            cells = (html.escape(row.quantity), error, tolerance)
        lines.append(
            f'<tr><td><a href="#{anchor(report)}">{html.escape(report.case.title)}</a></td>'
            f'<td class="n">{judged}</td>{verdict}<td>{cells[0]}</td><td class="n">{cells[1]}</td>'
            f'<td class="n">{cells[2]}</td><td class="n">{report.seconds:.1f} s</td></tr>'
        )
    head = _head("case", "rows>", "", "nearest to its tolerance", "error>", "tolerance>", "took>")
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table>"


def _head(*names: str) -> str:
    """Cells of a head; a name that ends in > stands over numbers."""
    return "".join(f'<th class="n">{name[:-1]}</th>' if name.endswith(">") else f"<th>{name}</th>" for name in names)


def hardest(rows: Sequence[Row]) -> Row | None:
    """The judged row whose error is the largest share of its tolerance."""
    judged = [row for row in rows if math.isfinite(row.tolerance) and math.isfinite(row.error) and row.tolerance > 0.0]
    return max(judged, key=lambda row: row.error / row.tolerance, default=None)


def anchor(report: Report) -> str:
    """The id under which the page links to a case."""
    return re.sub(r"[^a-z0-9]+", "-", report.case.name.lower())


def _case(report: Report) -> str:
    from hydro1d.verify.figures import svg

    figure = f"<figure>{svg(report.panels, anchor(report))}</figure>" if report.panels else ""
    opened = " open" if not report.passed or len(report.rows) < 16 else ""
    return (
        f'<h2 id="{anchor(report)}">{html.escape(report.case.title)}</h2>\n'
        f'<p class="about">{html.escape(report.case.about)}</p>\n{figure}\n'
        f"<details{opened}><summary>{len(report.rows)} rows</summary>{_rows_table(report.rows)}</details>"
    )


def _rows_table(rows: Sequence[Row]) -> str:
    head = _head("quantity", "exact>", "measured>", "error>", "order>", "tolerance>", "", "why this tolerance")
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(_row(row) for row in rows)}</tbody></table>"


def _row(row: Row) -> str:
    *numbers, verdict = text.cells(row)
    if row.least_order is not None:
        numbers[3] += f" (≥ {row.least_order:g})"
    cells = "".join(f'<td class="n">{cell}</td>' for cell in numbers)
    failed = "" if row.passed else ' class="failed"'
    return (
        f'<tr{failed}><td>{html.escape(row.quantity)}</td>{cells}<td class="{verdict.lower()}">{verdict}</td>'
        f'<td class="reason">{html.escape(row.reason)}</td></tr>'
    )
