"""What several subcommands share."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


def path(text: str) -> Path:
    """A file's name as a Path, imported only when one is given."""
    from pathlib import Path

    return Path(text)


def add_deck(parser: argparse.ArgumentParser) -> None:
    """The deck and what overrides its values."""
    parser.add_argument("deck", metavar="DECK", type=path, help="the deck, a TOML file")
    parser.add_argument(
        "--set", metavar="PATH=VALUE", action="append", default=[], dest="overrides",
        help="put a value in place of the deck's, for example layer[0].zones=2000; can be repeated",
    )  # fmt: skip


def figure(value: float, unit: str = "") -> str:
    """Return a value as people read it: ``figure(3.6e6, "Pa")`` is "3.6 MPa"."""
    if value != value or value in (float("inf"), -float("inf")):
        return f"{value} {unit}".strip()
    for exponent, prefix in ((9, "G"), (6, "M"), (3, "k"), (0, ""), (-3, "m"), (-6, "u"), (-9, "n")):
        if abs(value) >= 0.9999999 * 10.0**exponent:
            return f"{value / 10.0**exponent:.4g} {prefix}{unit}".strip()
    return f"{value:.4g} {unit}".strip()


def count(number: int, noun: str) -> str:
    """Return "1 layer", "2 layers"."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


@contextmanager
def progress_bar(quiet: bool) -> Iterator[Callable[[float], None] | None]:
    """A bar on standard error for a share that grows from 0 to 1; None where nobody watches."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from tqdm import tqdm

    layout = "{percentage:3.0f}% {bar} {desc}{elapsed}, {remaining} left"
    with tqdm(total=1.0, bar_format=layout, leave=False, file=sys.stderr) as bar:

        def show(share: float) -> None:
            time, cycles = getattr(share, "time", None), getattr(share, "cycles", 0)
            if time is not None:
                bar.set_description_str(f"t = {figure(time, 's')}, {cycles} cycles, ", refresh=False)
            bar.update(min(max(share, 0.0), 1.0) - bar.n)

        yield show
