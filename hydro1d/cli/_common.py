"""What several subcommands share."""

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from hydro1d.errors import DeckError, FileProblem


def one_of(words: Iterable[str]) -> Callable[[str], str]:
    """The `type` of an argument with `choices`: a word that is none of them is answered with the nearest one."""
    known = list(words)

    def checked(text: str) -> str:
        if text not in known:
            from hydro1d.deck.messages import suggestion

            listed = ", ".join(known)
            raise argparse.ArgumentTypeError(f"{text[:80]!r} is not one of {listed}{suggestion(text, known)}")
        return text

    return checked


def refuse_result(target: Path) -> Path:
    """The path, if no result lies there: text must not be written over what may have taken hours to calculate.

    Raises FileProblem.
    """
    from hydro1d.store.files import begins_as_hdf5

    try:
        lost = begins_as_hdf5(target)
    except OSError:
        return target  # nothing there, or nothing that could be lost
    if lost:
        raise FileProblem(f"cannot write {target}: a result (HDF5) is there and would be lost; choose another name")
    return target


def refuse_other_kind(target: Path, table: bool) -> None:
    """A run does not replace the table of a sweep, nor a sweep the result of a run. Raises FileProblem.

    `target` has been through `check_target`: what is there is hydro1d's.
    """
    from hydro1d.store.seal import has_seal

    if not target.is_file():
        return
    found = "" if has_seal(target) else _content(target)  # a result is sealed, a table is not
    if (found == "table") != table:
        what = "the table of a sweep" if found == "table" else "the result of a run"
        raise FileProblem(f"cannot write {target}: {what} is there; choose another name with -o")


def _content(path: Path) -> str:
    import h5py

    with h5py.File(path, "r", locking=False) as file:  # that it can be read was seen when the target was checked
        return str(file.attrs.get("content", ""))


def add_deck(parser: argparse.ArgumentParser) -> None:
    """The deck and what overrides its values."""
    parser.add_argument("deck", metavar="DECK", type=Path, help="the deck, a TOML file")
    parser.add_argument(
        "--set", metavar="PATH=VALUE", action="append", default=[], dest="overrides",
        help="put a value in place of the deck's, for example layer[0].zones=2000; can be repeated",
    )  # fmt: skip


def positive(text: str) -> int:
    """The `type` of an argument that is an integer from 1 on."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"must be 1 at least, an integer, not {text[:80]!r}")
    return int(text)


def add_threads(parser: argparse.ArgumentParser, what: str = "runs") -> None:
    """How much is done at a time."""
    parser.add_argument(
        "--threads", metavar="N", type=positive, help=f"{what} at a time; default: the processors there are"
    )


def quantity(text: str, unit: str, option: str) -> float:
    """A number, or a text with a unit, in the SI unit. Raises DeckError, naming the option."""
    from hydro1d.components.units import convert, plain

    try:
        return convert(plain(text), unit)
    except ValueError as error:
        raise DeckError(f"{option}: {error}") from error


def figure(value: float, unit: str = "", digits: int = 4) -> str:
    """Return a value as people read it: ``figure(3.6e6, "Pa")`` is "3.6 MPa". Only a single unit takes a prefix."""
    if not unit.isalpha() or unit == "kg" or value != value or value in (float("inf"), -float("inf")):
        return f"{value:.{digits}g} {unit}".strip()
    for exponent, prefix in ((9, "G"), (6, "M"), (3, "k"), (0, ""), (-3, "m"), (-6, "u"), (-9, "n")):
        if abs(value) >= 0.9999999 * 10.0**exponent:
            return f"{value / 10.0**exponent:.{digits}g} {prefix}{unit}"
    return f"{value:.{digits}g} {unit}"


def count(number: int, noun: str) -> str:
    """Return "1 layer", "2 layers"."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


@contextmanager
def notes_of_the_compiler(quiet: bool) -> Iterator[None]:
    """Print what a user should know about machine code that cannot be kept."""
    from hydro1d.jit.build import noting

    with noting(lambda text: None if quiet else print(f"note: {text}", flush=True)):
        yield


@contextmanager
def progress_bar(quiet: bool) -> Iterator[Callable[[float], None] | None]:
    """A bar on standard error for a share that grows from 0 to 1; None where nobody watches."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from tqdm import tqdm

    from hydro1d.jit.build import announcing

    layout = "{percentage:3.0f}% {bar} {desc}{elapsed}, {remaining} left"
    with tqdm(total=1.0, bar_format=layout, leave=False, file=sys.stderr) as bar:
        compiled: list[str] = []

        def compiling(kernel: str) -> None:
            compiled.append(kernel)
            bar.set_description_str("compiling, once (some seconds) … ")

        def show(share: float) -> None:
            if compiled:  # that time says nothing about what is left
                compiled.clear()
                bar.reset()
            time, cycles = getattr(share, "time", None), getattr(share, "cycles", 0)
            if time is not None:
                bar.set_description_str(f"t = {figure(time, 's')}, {cycles} cycles, ", refresh=False)
            bar.update(min(max(share, 0.0), 1.0) - bar.n)

        with announcing(compiling):
            yield show
