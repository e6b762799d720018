"""``hydro1d run``: run a deck and write its result."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from hydro1d.cli import _common
from hydro1d.errors import Interrupted

if TYPE_CHECKING:
    from collections.abc import Callable

    from hydro1d.analysis.openings import Openings
    from hydro1d.analysis.transmission import Transmission
    from hydro1d.deck import Deck
    from hydro1d.store import Run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d run``."""
    _common.add_deck(parser)
    parser.add_argument(
        "-o", "--output", metavar="FILE", type=Path, help="result; default: the deck's name with .h5, here"
    )
    parser.add_argument("--restart", metavar="FILE", type=Path, help="go on from a checkpoint")
    parser.add_argument(
        "--force", action="store_true", help="restart although deck or law differ from the checkpoint's"
    )
    parser.add_argument("-q", "--quiet", action="store_true", help="no progress, no summary")
    parser.add_argument(
        "--log-json", metavar="FILE", type=Path,
        help="write start, progress and result as JSON, one object a line; - is standard output",
    )  # fmt: skip


def run(args: argparse.Namespace) -> None:
    """Check deck and target, calculate, say what came out."""
    from hydro1d.deck import load_deck

    deck = load_deck(args.deck, args.overrides)
    output = args.output or Path(args.deck.stem + ".h5")
    from hydro1d.store import check_target

    check_target(output)
    _common.refuse_other_kind(output, table=False)
    told = not args.quiet and str(args.log_json) != "-"
    for note in deck.notes if told else ():
        print(f"note: {note}", flush=True)  # before the calculation, which may be long and for nothing
    with _common.notes_of_the_compiler(quiet=not told):
        result = (_calculate if args.log_json is None else _logged)(args, deck, output)
    if told:
        from hydro1d.analysis.openings import MAX_VALUES, find_openings

        few = len(result.time) * len(result["zone"]) <= MAX_VALUES  # else reading them back would take long
        print("\n".join(summary(deck, result, output, find_openings(result, deck) if few else None)))


def _calculate(args: argparse.Namespace, deck: Deck, output: Path, told: Callable[[float], None] | None = None) -> Run:
    """Run the deck; `told` hears of progress as well as the terminal does."""
    from hydro1d.api import run as calculate

    with _common.progress_bar(args.quiet) as shown:

        def both(share: float) -> None:
            for listener in (shown, told):
                if listener is not None:
                    listener(share)

        progress = both if told is not None else shown
        try:
            return calculate(deck, output, restart=args.restart, force=args.force, progress=progress)
        except Interrupted as error:
            onward = f"\n  to go on: {_onward(args, error.checkpoint)}" if error.checkpoint is not None else ""
            raise Interrupted(error.text + onward) from None


def _onward(args: argparse.Namespace, checkpoint: Path) -> str:
    """The command that goes on from a checkpoint: this one, with all that it was given."""
    import shlex

    words = ["hydro1d", "run", str(args.deck)]
    words += [word for text in args.overrides for word in ("--set", text)]
    for option, value in (("-o", args.output), ("--log-json", args.log_json), ("--restart", checkpoint)):
        words += [option, str(value)] if value is not None else []
    return shlex.join([*words, "--quiet"] if args.quiet else words)


def _logged(args: argparse.Namespace, deck: Deck, output: Path) -> Run:
    """Run the deck and keep a log for other programs."""
    from hydro1d.cli._log import JsonLog
    from hydro1d.jit.build import announcing

    log = JsonLog(args.log_json)
    try:
        log.start(deck, output)
        with announcing(log.compiling):
            result = _calculate(args, deck, output, log.progress)
        log.done(result, output)
        return result
    except (Exception, KeyboardInterrupt) as error:
        log.error(error)
        raise
    finally:
        log.close()


def summary(deck: Deck, result: Run, output: Path, opened: Openings | None = None) -> list[str]:
    """Lines that answer first what a user runs the code for: is the load enhanced, is the column crushed."""
    from hydro1d.analysis.transmission import transmission_of

    history, transmission = result.history, transmission_of(result, deck)
    end = _common.figure(float(history["time"][-1]), "s")
    lines = [f"{result.title}"] if result.title else []
    lines.append(_loads(transmission, history["peak_left_stress"][-1], history["peak_right_stress"][-1]))
    uncrushed = float(history["uncrushed_fraction"][-1])
    if uncrushed == uncrushed:
        lines.append("column: fully crushed" if uncrushed <= 0.0 else f"column: {100 * uncrushed:.4g} % is not crushed")
    if transmission.pending:
        pending = " and ".join(transmission.pending)
        lines.append(f"not over at t = {end}: {pending}; a later time.end may change the answers")
    if opened is not None:
        lines.append(_openings(opened))
    cycles, wall = int(result.attributes["cycles"]), float(result.attributes["wall_seconds"])
    error = abs(history["energy_error"]).max()
    lines.append(
        f"{_common.count(cycles, 'cycle')} to t = {end} in {_common.figure(wall, 's')}; energy error {error:.1e}"
    )
    return [*lines, f"result: {output}"]


def _openings(opened: Openings) -> str:
    """What came apart, as far as the stored profiles show."""
    low, high = _common.figure(opened.low, "m"), _common.figure(opened.high, "m")
    first = _common.figure(opened.first, "s")
    text = f"opened: {opened.zones} of {opened.total} zones, first seen at {first}, X from {low} to {high}; {opened.outcome}"
    if opened.stretched:
        text += f"; {opened.stretched} stretched beyond the initial length, to {opened.widest:.3g} times it at most"
    return text


def _loads(transmission: Transmission, left: float, right: float) -> str:
    """Peak support stress over the peak of the applied pressure, where there is a pressure on one end."""
    from hydro1d.analysis.transmission import NOT_REACHED

    ends, applied, transmitted, _ = transmission
    if transmitted == 0.0 and applied > 0.0:
        return f"support stress: {NOT_REACHED} (applied peak {_common.figure(applied, 'Pa')})"
    if applied == 0.0:
        late = f"; no wave has reached the {ends.support} end yet" if transmitted == 0.0 else ""
        peaks = {"left": left, "right": right, **({ends.support: 0.0} if late else {})}
        shown = ", ".join(f"{side} {_common.figure(peak, 'Pa')}" for side, peak in peaks.items())
        return f"peak stress on the ends: {shown}{late}"
    return (
        f"support stress: {transmission.word}, {transmission.ratio:.4g} times the applied peak "
        f"({_common.figure(transmitted, 'Pa')} over {_common.figure(applied, 'Pa')})"
    )
