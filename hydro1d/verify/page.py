"""The report as one HTML page that asks nothing of the network."""

from __future__ import annotations

import html
import math
import platform
import re
from collections.abc import Sequence

from hydro1d.verify import text
from hydro1d.verify.rows import Row
from hydro1d.verify.suite import Report

STYLE = """
:root { color-scheme: light; }
body { font: 15px/1.45 system-ui, sans-serif; color: #1b1b1b; background: #fff; max-width: 74rem; margin: 2rem auto;
  padding: 0 1rem; }
h1 { font-size: 1.7rem; }
h2 { font-size: 1.2rem; margin: 2.6rem 0 .4rem; border-top: 1px solid #ddd; padding-top: 1rem; }
p.about { max-width: 58rem; color: #333; }
table { border-collapse: collapse; font-size: 13px; width: 100%; font-variant-numeric: tabular-nums; }
th { text-align: left; border-bottom: 2px solid #999; padding: .25rem .5rem; }
td { border-bottom: 1px solid #e5e5e5; padding: .18rem .5rem; vertical-align: top; }
td.n, th.n { text-align: right; white-space: nowrap; }
.pass { color: #1d6b34; } .fail { color: #fff; background: #b3261e; font-weight: 600; } .shown { color: #666; }
tr.failed td { background: #fdeceb; }
details { margin: .6rem 0; } summary { cursor: pointer; color: #1769aa; }
figure { margin: .8rem 0; } figure svg { max-width: 100%; height: auto; }
.verdict { font-size: 1.1rem; padding: .5rem .8rem; border-radius: .3rem; display: inline-block; }
.verdict.pass { background: #e6f4ea; } a { color: #1769aa; } .reason { color: #666; font-size: 12px; }
@media print { details > * { display: block; } }
"""


def html_page(reports: Sequence[Report], rows: Sequence[Row], *, full: bool, seconds: float) -> str:
    """The whole page: verdict, a line a case, then each case with its figures and rows."""
    from hydro1d import __version__

    alone = [row for row in rows if all(row is not own for report in reports for own in report.rows)]
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8"><title>hydro1d: verification</title>',
        '<link rel="icon" href="data:,">',
        f"<style>{STYLE}</style></head><body>",
        "<h1>hydro1d: verification</h1>",
        f"<p>The solver against exact solutions. hydro1d {html.escape(__version__)}, {'full' if full else 'default'} "
        f"suite, "
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
        cells = (
            ("", "", "")
            if row is None
            else (html.escape(row.quantity), text.short(row.error), text.limit(row.tolerance))
        )
        lines.append(
            f'<tr><td><a href="#{anchor(report)}">{html.escape(report.case.title)}</a></td><td '
            f'class="n">{judged}</td>{verdict}'
            f'<td>{cells[0]}</td><td class="n">{cells[1]}</td><td class="n">{cells[2]}</td><td '
            f'class="n">{report.seconds:.1f} s</td></tr>'
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
    """A name for links."""
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
    verdict = text.verdict(row)
    order = "" if row.order is None else f"{row.order:.2f}"
    if row.least_order is not None:
        order += f" (≥ {row.least_order:g})"
    numbers = (
        text.number(row.exact),
        text.number(row.measured),
        text.short(row.error),
        order,
        text.limit(row.tolerance),
    )
    cells = "".join(f'<td class="n">{cell}</td>' for cell in numbers)
    failed = "" if row.passed else ' class="failed"'
    return (
        f'<tr{failed}><td>{html.escape(row.quantity)}</td>{cells}<td class="{verdict.lower()}">{verdict}</td>'
        f'<td class="reason">{html.escape(row.reason)}</td></tr>'
    )
