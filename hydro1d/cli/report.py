"""``hydro1d report``: one page with everything about a run."""

import argparse
from pathlib import Path

from hydro1d.errors import DeckError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d report``."""
    parser.add_argument("result", metavar="RUN.h5", type=Path, help="a result")
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, help="default: RUN.html, here")
    parser.add_argument("--deck", metavar="DECK", type=Path, help="where to take laws of your own from")


def run(args: argparse.Namespace) -> None:
    """Write the page and say where it is."""
    from hydro1d.store import open_run

    target = args.output or Path(args.result.stem + ".html")
    if target.suffix.lower() not in (".html", ".htm"):
        raise DeckError(f"{target}: a report's name ends in .html")
    result = open_run(args.result)
    from hydro1d.report import write_report

    print(write_report(result, target, args.deck))
