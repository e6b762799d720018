"""``hydro1d critical``: the value of a deck's key at which an outcome flips."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydro1d.cli import _common
from hydro1d.errors import DeckError

if TYPE_CHECKING:
    from hydro1d.sweep import Critical

SPACINGS = ("linear", "log")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d critical``."""
    _common.add_deck(parser)
    add = parser.add_argument
    add("--key", metavar="PATH", required=True, help="the deck's key to vary, for example left.duration")
    add("--from", metavar="VALUE", required=True, dest="low", help='lower end of the bracket, for example "0.5 ms"')
    add("--to", metavar="VALUE", required=True, dest="high", help="upper end of the bracket")
    add(
        "--outcome", metavar="NAME", required=True,
        help='enhanced, fully_crushed, separated, or a comparison such as "support_peak > 2 MPa"',
    )  # fmt: skip
    add("--tolerance", metavar="SHARE", type=float, default=1e-3, help="relative width of the last bracket (1e-3)")
    single = "values over the whole bracket that check for a single flip (5)"
    add("--scan", metavar="N", type=int, default=5, help=single)
    spread, spacing = "how these values are spread", _common.one_of(SPACINGS)
    add("--spacing", choices=SPACINGS, type=spacing, default="linear", help=spread)
    add("--along", metavar="PATH", help="a second key: trace the boundary along it")
    add("--values", metavar="LIST", help='its values: "2 MPa, 3 MPa" or FIRST:LAST:COUNT')
    _common.add_threads(parser, "points")
    add("-o", "--output", metavar="FILE.csv", type=Path, help="write every evaluation; with --along the boundary too")
    add("-q", "--quiet", action="store_true", help="no progress")


def run(args: argparse.Namespace) -> None:
    """Search, print, write."""
    from hydro1d.components.units import plain
    from hydro1d.sweep.critical import boundary_table, critical, evaluations_table, trace
    from hydro1d.sweep.table import check_text_target

    if (args.along is None) != (args.values is None):
        raise DeckError("--along and --values go together")
    boundary_file = args.output.with_suffix(".boundary.csv") if args.output else None
    for path in filter(None, (args.output, boundary_file)):
        check_text_target(path)
    arguments = (args.deck, args.key, plain(args.low), plain(args.high), args.outcome)
    options: dict[str, Any] = {name: getattr(args, name) for name in ("overrides", "tolerance", "scan", "spacing")}
    if args.along is None:
        from hydro1d.interrupt import interruptible

        with interruptible() as asked:
            points = [critical(*arguments, **options, asked_to_stop=asked)]
        print("\n".join(_lines(args, points[0])))
    else:
        values = _values(args.values)
        with _common.progress_bar(args.quiet) as progress:
            points = trace(*arguments, args.along, values, **options, threads=args.threads, progress=progress)
        print("\n".join([f"{args.along:>16} {args.key:>16}", *(_row(point) for point in points)]))
        if boundary_file is not None:
            boundary_table(points, args.key, args.outcome, args.along).write_csv(boundary_file)
    if args.output is not None:
        evaluations_table(points, args.key, args.outcome, args.along).write_csv(args.output)


def _lines(args: argparse.Namespace, point: Critical) -> list[str]:
    turn, runs = "ends" if point.before else "begins", _common.count(len(point.evaluations), "run")
    low, high = (_common.figure(value, point.units, 9) for value in (point.low, point.high))
    lines = [
        f"{args.outcome} {turn} at {args.key} = {_common.figure(point.value, point.units, 6)}",
        f"between {low} and {high}, {runs}",
    ]
    if not point.monotonic:
        lines.append("not monotonic: the outcome flips more than once in this bracket; this is the lowest flip")
    return lines


def _row(point: Critical) -> str:
    note = point.message or ("" if point.monotonic else "not monotonic")
    along, value = _common.figure(point.along, point.along_units, 6), _common.figure(point.value, point.units, 6)
    return f"{along:>16} {value:>16}  {note}".rstrip()


def _values(text: str) -> list[Any]:
    """``A, B, C`` or ``FIRST:LAST:COUNT``."""
    from hydro1d.components.units import plain
    from hydro1d.sweep.plan import Parameter

    parts = text.split(":")
    if len(parts) == 3 and parts[2].strip().isdecimal():
        from pydantic import ValidationError

        first, last = (plain(part.strip()) for part in parts[:2])
        try:
            return Parameter(key="x", first=first, last=last, count=int(parts[2])).listed()
        except ValidationError as error:
            raise DeckError(f"--values {text}: {error.errors()[0]['msg'].removeprefix('Value error, ')}") from None
    values = [plain(part.strip()) for part in text.split(",") if part.strip()]
    if not values:
        raise DeckError("--values: there is none")
    return values
