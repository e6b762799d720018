"""``hydro1d reproduce``: every figure and number of the paper."""

import argparse
from pathlib import Path

from hydro1d.cli import _common
from hydro1d.errors import DeckError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d reproduce``."""
    parser.add_argument("--out", metavar="DIR", type=Path, default=Path("paper"), help="where to; default: paper")
    parser.add_argument(
        "--quick", action="store_true", help="coarser, fewer points, the same figures: under two minutes"
    )
    parser.add_argument(
        "--only", metavar="FIGURE", action="append", default=[], help="one figure, for example 6; can be repeated"
    )
    _common.add_threads(parser)
    parser.add_argument("--scheduler", metavar="ADDRESS", help="search on the Dask cluster of this scheduler")
    parser.add_argument("-q", "--quiet", action="store_true", help="do not say what is being made")


def run(args: argparse.Namespace) -> None:
    """Make the figures and the page."""
    from hydro1d.cli.sweep import executor_at
    from hydro1d.deck.messages import one_of
    from hydro1d.studies.harrigan2010.reproduce import PARTS, reproduce

    names = [name for name, _ in PARTS]
    unknown = [name for name in args.only if name not in names]
    if unknown:
        raise DeckError(f"--only {unknown[0]}: there is no such part; there are {one_of(names)}")

    def say(text: str) -> None:
        if not args.quiet:
            print(text, flush=True)

    with executor_at(args.scheduler) as executor:
        page = reproduce(
            args.out, quick=args.quick, only=tuple(args.only), threads=args.threads, executor=executor, say=say
        )
    say(f"page: {page}")
