"""The documentation's page of results, generated: a line a case, and what each case is."""

import math
from collections.abc import Sequence
from importlib import resources
from string import Template

from hydro1d.verify import text
from hydro1d.verify.page import hardest
from hydro1d.verify.rows import Row
from hydro1d.verify.suite import Report


def markdown_page(reports: Sequence[Report], rows: Sequence[Row], *, full: bool, seconds: float) -> str:
    """The page as MyST Markdown."""
    judged, failed = sum(math.isfinite(row.tolerance) for row in rows), sum(not row.passed for row in rows)
    suite, verdict = "full" if full else "default", "all pass" if not failed else f"**{failed} fail**"
    about: dict[str, str] = {}
    for report in reports:
        about.setdefault(report.case.about, report.case.title.split(",")[0])
    template = Template(resources.files(__package__).joinpath("results.md").read_text(encoding="utf-8"))
    return template.substitute(
        summary=f"The {suite} suite: {len(reports)} cases, {len(rows)} rows, {judged} of them judged: {verdict}.",
        table=_hardest_rows(reports),
        cases="\n".join(f"**{title}.** {text}\n" for text, title in about.items()),
        orders=_orders(reports),
    )


def _hardest_rows(reports: Sequence[Report]) -> str:
    """A line a case: the row nearest to its tolerance."""
    table = ["| case | rows | worst row | error | order | tolerance |", "| --- | ---: | --- | ---: | ---: | ---: |"]
    for report in reports:
        row = hardest(report.rows)
        if row is not None:
            cells = (report.case.title, str(len(report.rows)), _escaped(row.quantity), *text.cells(row)[2:5])
            table.append(f"| {' | '.join(cells)} |")
    return "\n".join(table)


def _orders(reports: Sequence[Report]) -> str:
    """Every asserted order; of the many loads of a step, the lowest."""
    lines = ["| case | quantity | order | at least |", "| --- | --- | ---: | ---: |"]
    for report in reports:
        asserted = [row for row in report.rows if row.least_order is not None and row.order is not None]
        if report.case.name.startswith(("pressure-step", "piston")):
            asserted = sorted(asserted, key=lambda row: row.order or 0.0)[:1]
        lines += [
            f"| {report.case.title} | {_escaped(row.quantity)} | {row.order:.2f} | {row.least_order:g} |"
            for row in asserted
        ]
    return "\n".join(lines)


def _escaped(quantity: str) -> str:
    return quantity.replace("|", r"\|")
