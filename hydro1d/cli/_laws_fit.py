"""``hydro1d laws fit``: parameters of a law from a measured quasi-static curve."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from hydro1d.cli import _common
from hydro1d.errors import DeckError, FileProblem, file_problems

if TYPE_CHECKING:
    from hydro1d.fit import Efficiency, Tabulated

HELP = "fit a law to a measured quasi-static curve (CSV: strain, stress)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d laws fit``."""
    parser.add_argument("curve", metavar="CURVE.csv", type=Path, help="two columns, header and units optional")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--law", default="epph-tangent", help="the law to fit, default epph-tangent")
    table = 'fit no law: write the curve itself, smoothed and without falls, for law = "table"'
    what.add_argument("--table", metavar="FILE.csv", type=Path, help=table)
    parser.add_argument(
        "--strain-unit", metavar="UNIT", default="", help='of the first column, "%%"; default: as in the header, else 1'
    )
    second = "of the second column, MPa; default: as in the header, else Pa"
    parser.add_argument("--stress-unit", metavar="UNIT", default="", help=second)
    parser.add_argument("--density", metavar="DENSITY", help='of the foam, "51.6 kg/m^3"; epph needs it')
    parser.add_argument("--max-strain", metavar="STRAIN", type=float, default=1.0, help="leave out what lies beyond")
    parser.add_argument("--material", metavar="NAME", default="foam", help="name in the deck fragment, default foam")
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, help="figure; default: CURVE-LAW.png, here")


def run(args: argparse.Namespace) -> None:
    """Fit, or tabulate; print parameters, quality and a deck fragment; draw."""
    from hydro1d import fit, plot

    units = {"strain_unit": _unit(args, "strain", "1"), "stress_unit": _unit(args, "stress", "Pa")}
    density = _density(args.density)
    found: fit.Fit | fit.Tabulated
    if args.table is not None:
        found = fit.tabulate(args.curve, args.max_strain, **units)
        lines = _written(found, args.curve, args.table)
        fragment = found.deck_fragment(args.material, str(args.table), density)
    else:
        found = fit.fit_curve(args.curve, args.law, density, args.max_strain, **units)
        lines = [found.table(), "", *(f"note: {text}" for text in found.warnings())]
        lines.append(f"rms of the residuals: {found.rms / 1e6:.4g} MPa ({100 * found.relative_rms:.3g} % as weighted)")
        fragment = found.deck_fragment(args.material)
    figure, _ = fit.draw(found)
    target = plot.save(figure, args.output or Path(f"{args.curve.stem}-{found.law}.png"))
    print("\n".join([*lines, *_efficiency(found.efficiency), f"figure: {target}", "", fragment]))


def _written(found: Tabulated, source: Path, target: Path) -> list[str]:
    """Write the table; what to say of it. Raises FileProblem where it would destroy the measured curve or a result."""
    if target.exists() and target.samefile(source):
        raise FileProblem(f"cannot write {target}: it is the measured curve; choose another name")
    with file_problems("write", target):
        _common.refuse_result(target).write_text(found.csv())
    return [
        *(f"note: {text}" for text in found.notes),
        f"table: {target}, {len(found.points)} points behind an elastic line of {found.modulus / 1e6:.5g} MPa; "
        f"rms from the measured curve {found.rms / 1e6:.4g} MPa",
    ]


def _efficiency(found: Efficiency) -> list[str]:
    lines = [
        f"by energy efficiency: plateau {found.plateau_stress / 1e6:.4g} MPa, "
        f"densification strain {found.densification_strain:.4g}"
    ]
    if not found.complete:
        lines.append("  the efficiency has not fallen at the last point: the curve ends before the foam densifies")
    return lines


def _unit(args: argparse.Namespace, column: str, wanted: str) -> str:
    """The unit given for a column, if it is one of the right kind."""
    from hydro1d.components.units import convert

    text = str(getattr(args, f"{column}_unit"))
    try:
        if text:
            convert(f"1 {text}", wanted)
    except ValueError as error:
        raise DeckError(f"--{column}-unit: {error}") from error
    return text


def _density(text: str | None) -> float | None:
    value = None if text is None else _common.quantity(text, "kg/m^3", "--density")
    if value is not None and value <= 0.0:
        raise DeckError("--density must be above zero")
    return value
