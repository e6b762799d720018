"""Coverage-guided fuzzing of decks: any bytes are a deck or one explained error.

    pip install -e '.[fuzz]'
    python tools/fuzz_atheris.py -atheris_runs=100000 -max_len=4096

atheris watches which branches of the reader an input takes and keeps the inputs that find new ones. Whatever is raised besides
hydro1d's own errors stops it, and the input that did it is kept in a file.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import atheris

with atheris.instrument_imports(
    include=["hydro1d.deck", "hydro1d.components.units", "hydro1d.components.tables", "hydro1d.components.parameters"]
):
    from hydro1d.deck import load_deck
    from hydro1d.errors import Hydro1dError

CASES = Path(__file__).parents[1] / "cases"
WORK = Path(tempfile.mkdtemp(prefix="fuzz-"))  # where no file of the user's lies


def one_input(raw: bytes) -> None:
    """Take the bytes as a deck's file, or as a text with overrides behind a NUL."""
    text, _, overrides = raw.partition(b"\0")
    path = WORK / "deck.toml"
    path.write_bytes(text)
    try:
        load_deck(path, overrides.decode("utf-8", "replace").split("\n")[:5] if overrides else (), folder=WORK)
    except Hydro1dError as error:
        assert str(error)


def main() -> None:
    """Start from the decks that come with hydro1d."""
    seeds = WORK / "seeds"
    seeds.mkdir()
    for deck in CASES.glob("*.toml"):
        (seeds / deck.name).write_bytes(deck.read_bytes())
    atheris.Setup([*sys.argv, str(seeds)], one_input)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
