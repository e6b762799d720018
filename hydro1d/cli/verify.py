"""``hydro1d verify``: the solver against exact solutions."""

import argparse
from pathlib import Path

from hydro1d.cli import _common
from hydro1d.errors import DeckError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d verify``."""
    parser.add_argument("--full", action="store_true", help="finer resolutions too; takes several times as long")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write the rows of the table as JSON")
    parser.add_argument(
        "--html", metavar="FILE", type=Path, help="write one self-contained page: table, profiles, convergence"
    )
    parser.add_argument("--markdown", metavar="FILE", type=Path, help="write the page of the documentation")
    parser.add_argument(
        "--only", metavar="PATTERN", action="append", default=[],
        help="run the cases of this name (* stands for anything); can be repeated",
    )  # fmt: skip
    parser.add_argument("--list", action="store_true", help="name the cases and leave")
    parser.add_argument("-q", "--quiet", action="store_true", help="print failures and the last line only")
    parser.add_argument("--workers", metavar="N", type=_common.positive, help="threads; default: one a core")


def run(args: argparse.Namespace) -> int:
    """Run the suite; 1 if any row fails."""
    from hydro1d.deck.messages import suggestion
    from hydro1d.verify.suite import chosen

    cases = chosen(args.only)
    if not cases:
        hint = suggestion(args.only[0], [case.name for case in chosen([])])
        raise DeckError(f"no case is called {' or '.join(args.only)}{hint}; --list names them")
    for path in filter(None, (args.json, args.html, args.markdown)):
        _common.refuse_result(path)  # before anything is measured
    if args.list:
        print("\n".join(f"{case.name:36}{case.rows:5} rows  {case.title}" for case in cases))
        return 0
    return _measure(args)


def _measure(args: argparse.Namespace) -> int:
    import time

    from hydro1d.verify import text
    from hydro1d.verify.suite import Report, chosen, registered_whole, run_suite

    def show(report: Report) -> None:
        rows = [row for row in report.rows if not (args.quiet and row.passed)]
        if rows:
            print("\n".join(text.row_text(row) for row in rows), flush=True)

    begun = time.perf_counter()
    cases = chosen(args.only)
    if not args.quiet:
        print(text.header())
    reports = run_suite(cases, full=args.full, workers=args.workers, done=show)
    rows = [row for report in reports for row in report.rows]
    incomplete = None if args.only else registered_whole(cases)
    if incomplete is not None:
        rows.append(incomplete)
        print(text.row_text(incomplete))
    seconds = time.perf_counter() - begun
    print(text.summary(rows, len(cases), seconds))
    _write(args, reports, rows, seconds)
    return 0 if rows and all(row.passed for row in rows) else 1


def _write(args: argparse.Namespace, reports: list, rows: list, seconds: float) -> None:
    """The files that were asked for, rows that failed included."""
    import json

    from hydro1d.verify.markdown import markdown_page
    from hydro1d.verify.page import html_page

    if args.json is not None:
        text = json.dumps([row.plain() for row in rows], indent=1, ensure_ascii=False) + "\n"
        _common.refuse_result(args.json).write_text(text, encoding="utf-8")
    for path, make in ((args.html, html_page), (args.markdown, markdown_page)):
        if path is not None:
            page = make(reports, rows, full=args.full, seconds=seconds)
            _common.refuse_result(path).write_text(page, encoding="utf-8")
