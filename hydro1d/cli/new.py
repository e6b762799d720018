"""``hydro1d new``: a commented deck to start from."""

import argparse
from pathlib import Path

from hydro1d.errors import DeckError, FileProblem, file_problems

CASES = {
    "pulse": "a pressure pulse on a foam layer against a wall",
    "blast": "a blast on a steel plate over two foams",
    "striker": "a rigid mass strikes a foam column",
    "piston": "a piston drives a steady compaction front",
    "curve": "a foam with a measured curve, in a CSV file",
    "own-law": "a foam with a law of your own, in a Python file",
    "gas": "a shock tube with two ideal gases",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d new``."""
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = "cases:\n" + _listing()
    parser.add_argument("case", metavar="CASE", nargs="?", help="which case; without, they are listed")
    parser.add_argument("-o", "--output", metavar="FILE.toml", help="default: CASE.toml, here")


def run(args: argparse.Namespace) -> None:
    """Write the deck and what it needs beside it; never over a file that is there."""
    if args.case is None:
        print(_listing() + "\n\nhydro1d new CASE writes CASE.toml.")
        return
    if args.case not in CASES:
        from hydro1d.deck.messages import suggestion

        hint = suggestion(args.case, list(CASES))
        raise DeckError(f"there is no case {args.case[:80]!r}{hint}; there are {', '.join(CASES)}")
    deck = Path(args.output or f"{args.case}.toml")
    if deck.suffix != ".toml":
        raise DeckError(f"{deck}: a deck's name ends in .toml")
    texts = {deck.with_suffix(suffix): text for suffix, text in templates(args.case).items()}
    there = [str(path) for path in texts if path.exists()]
    if there:
        raise FileProblem(f"{', '.join(there)} is there already; choose another name with -o")
    for path, text in texts.items():
        with file_problems("write", path):
            path.write_text(text.replace("{name}", deck.stem), encoding="utf-8")
    print("\n".join(map(str, texts)))
    print(f"next: hydro1d run {deck}")


def templates(case: str) -> dict[str, str]:
    """Texts of a case by the endings of their files, the deck's first."""
    from importlib import resources

    folder = resources.files("hydro1d") / "templates"
    texts = {}
    for suffix in (".toml", ".csv", ".py"):
        path = folder / f"{case}{suffix}"
        if path.is_file():
            texts[suffix] = path.read_text(encoding="utf-8")
    return texts


def _listing() -> str:
    return "\n".join(f"  {name:<10}{text}" for name, text in CASES.items())
