"""``hydro1d plot``: figures of one run or several."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydro1d.cli import _common
from hydro1d.errors import DeckError

if TYPE_CHECKING:
    from hydro1d.store import Run

KINDS = {
    "overview": "one page: x-t diagram, stress on the ends, profiles, Hugoniot plane",
    "profiles": "quantities along the column at chosen times",
    "xt": "x-t diagram, coloured by a quantity, with fronts and interfaces",
    "history": "ends, energies, fronts and probes in time",
    "hugoniot": "paths of zones in the plane of strain and stress, curve, Rayleigh line",
    "compare": "several runs in the same axes",
    "animate": "a film of the profiles (GIF; MP4 with ffmpeg)",
}
TAKES = {
    "quantity": ("profiles", "xt", "history", "compare", "animate"),
    "time": ("profiles", "compare"),
    "frame": ("profiles", "xt", "animate"),
    "zone": ("hugoniot",),
    "deck": ("overview", "hugoniot"),
    "frames": ("animate",),
    "fps": ("animate",),
}
FORMATS = ("png", "svg", "pdf", "gif", "mp4")
FRAMES = ("lagrangian", "laboratory")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d plot``."""
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    kinds = "\n".join(f"  {name:<10}{text}" for name, text in KINDS.items())
    parser.epilog = f"kinds:\n{kinds}\n\nWithout a kind: overview; compare if several runs are given."
    parser.add_argument("words", metavar="RUN.h5 | KIND", nargs="+", help="results, and the kind of figure")
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, help="default: RUN-KIND.png, here")
    parser.add_argument(
        "--format", choices=FORMATS, type=_common.one_of(FORMATS),
        help="with default names: png, svg or pdf for figures, gif or mp4 for films",
    )  # fmt: skip
    parser.add_argument(
        "-q", "--quantity", metavar="NAME", action="append", default=[],
        help="what to draw (stress, strain, velocity, right_stress, probes/strain …); repeat or separate by commas",
    )  # fmt: skip
    parser.add_argument(
        "-t", "--time", metavar="TIME", action="append", default=[],
        help='times of profiles, "1.5 ms"; repeat or separate by commas',
    )  # fmt: skip
    parser.add_argument(
        "--frame", choices=FRAMES, type=_common.one_of(FRAMES), help="where things are; default lagrangian"
    )
    parser.add_argument("--zone", metavar="N", type=int, action="append", help="zone whose path to draw; repeat")
    parser.add_argument("--deck", metavar="DECK", type=Path, help="where to take laws of your own from")
    parser.add_argument("--dpi", type=_common.positive, default=150, help="dots per inch, default 150")
    parser.add_argument("--frames", type=_common.positive, help="most frames of a film, default 100")
    parser.add_argument("--fps", type=_common.positive, help="frames a second, default 15")


def run(args: argparse.Namespace) -> None:
    """Draw one figure and say where it is."""
    from hydro1d.store import open_run

    kinds = [word for word in args.words if word in KINDS]
    files = [word for word in args.words if word not in KINDS]
    if len(kinds) > 1 or not files:
        raise DeckError("name one kind of figure at most" if files else "name a result, RUN.h5")
    for word in files:
        _hint_at_kind(word)
    runs = [open_run(name) for name in files]
    kind = kinds[0] if kinds else "compare" if len(runs) > 1 else "overview"
    if len(runs) > 1 and kind != "compare":
        raise DeckError(f"{kind} draws one run; compare draws several")
    _refuse_idle_options(kind, args)
    print(_DRAW.get(kind, _figure)(kind, args, runs))


def _hint_at_kind(word: str) -> None:
    from hydro1d.deck.messages import suggestion

    if "." not in word and "/" not in word and not Path(word).exists():
        hint = suggestion(word, list(KINDS))
        raise DeckError(f"{word[:80]!r} is neither a file nor a kind of figure{hint}; kinds: {', '.join(KINDS)}")


def _refuse_idle_options(kind: str, args: argparse.Namespace) -> None:
    """An option that this kind of figure would ignore is a misunderstanding."""
    for option, kinds in TAKES.items():
        if getattr(args, option) and kind not in kinds:
            raise DeckError(f"{kind} takes no --{option}; it is for {', '.join(kinds)}")


def _figure(kind: str, args: argparse.Namespace, runs: list[Run]) -> Path:
    from hydro1d import plot

    options = _options(kind, args)
    figure, _ = getattr(plot, kind)(runs if kind == "compare" else runs[0], **options)
    return plot.save(figure, _target(kind, args, runs, args.format or "png"), args.dpi)


def _animate(kind: str, args: argparse.Namespace, runs: list[Run]) -> Path:
    from hydro1d import plot

    given = {"frames": args.frames, "fps": args.fps, "frame": args.frame, "quantities": _list(args.quantity)}
    options = {name: value for name, value in given.items() if value}
    return plot.animate(runs[0], _target(kind, args, runs, args.format or "gif"), dpi=min(args.dpi, 90), **options)


_DRAW: dict[str, Callable[[str, argparse.Namespace, list[Run]], Path]] = {"animate": _animate}


def _options(kind: str, args: argparse.Namespace) -> dict[str, Any]:
    """Arguments of the function that draws."""
    options: dict[str, Any] = {}
    names = _list(args.quantity)
    times = [_common.quantity(text, "s", "--time") for text in _list(args.time)]
    if names and kind == "xt":
        options["quantity"] = _one(names, "--quantity", kind)
    elif names:
        options["quantities"] = names
    if times and kind == "compare":
        options["time"] = _one(times, "--time", kind)
    elif times:
        options["times"] = times
    given = {"frame": args.frame, "deck": args.deck, "zones": args.zone}
    return options | {name: value for name, value in given.items() if value is not None}


def _target(kind: str, args: argparse.Namespace, runs: list[Run], ending: str) -> Path:
    if args.output is not None:
        return Path(args.output)
    stem = "-".join(item.path.stem for item in runs[:3] if item.path is not None)
    return Path(f"{stem}-{kind}.{ending}")


def _one(values: list[Any], option: str, kind: str) -> Any:
    if len(values) > 1:
        raise DeckError(f"{kind} takes one {option}, not {len(values)}")
    return values[0]


def _list(texts: list[str]) -> list[str]:
    return [part.strip() for text in texts for part in text.split(",") if part.strip()]
