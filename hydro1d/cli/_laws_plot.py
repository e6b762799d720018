"""``hydro1d laws plot``: a law's curve before anything is run."""

import argparse
from pathlib import Path

from hydro1d.cli import _common

HELP = "draw the curve of a deck's law: loading, unloading, tangent, Hugoniot, absorbed energy"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d laws plot``."""
    _common.add_deck(parser)
    parser.add_argument("--material", metavar="NAME", help="which material; default: that of the first layer")
    parser.add_argument("--strain", metavar="STRAIN", type=float, help="largest strain to draw")
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, help="default: DECK-MATERIAL.png, here")
    parser.add_argument("--dpi", type=_common.positive, default=150, help="dots per inch, default 150")


def run(args: argparse.Namespace) -> None:
    """Draw, and say where the figure is."""
    from hydro1d.deck import load_deck

    deck = load_deck(args.deck, args.overrides)
    from hydro1d import plot
    from hydro1d.plot._materials import law_of_deck

    name, law = law_of_deck(deck, args.material)
    figure, _ = plot.law(law, name, args.strain)
    safe = "".join(part if part.isalnum() or part in "-_." else "_" for part in name)
    print(plot.save(figure, args.output or Path(f"{args.deck.stem}-{safe}.png"), args.dpi))
