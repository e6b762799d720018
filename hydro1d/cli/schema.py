"""``hydro1d schema``: the JSON schema of a deck, for editors."""

import argparse
from pathlib import Path

from hydro1d.cli import _common


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d schema``."""
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, help="write it to a file")


def run(args: argparse.Namespace) -> None:
    """Print or write the schema."""
    import json

    from hydro1d.deck import deck_schema

    text = json.dumps(deck_schema(), indent=2, ensure_ascii=False) + "\n"
    if args.output is None:
        print(text, end="")
        return
    _common.refuse_result(args.output).write_text(text, encoding="utf-8")
