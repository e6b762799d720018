"""The public way to run a deck: ``run(deck) -> Run``, in memory or into a file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydro1d.deck import Deck, load_deck
from hydro1d.errors import BreakdownError, FileProblem, Interrupted
from hydro1d.interrupt import interruptible
from hydro1d.jit.build import fingerprint
from hydro1d.laws.check import check_law
from hydro1d.solver.column import Column, build_column
from hydro1d.solver.driver import CheckpointPlan, Outcome, initial_state, solve
from hydro1d.solver.program import Program
from hydro1d.solver.state import State

if TYPE_CHECKING:
    from hydro1d.store import Run


class Share(float):
    """The share of the simulated time that is done, with that time (s) and the cycles."""

    time: float
    cycles: int

    def __new__(cls, share: float, time: float, cycles: int) -> Share:
        """share: between 0 and 1; time in s."""
        number = super().__new__(cls, share)
        number.time, number.cycles = float(time), int(cycles)
        return number


def column_of(deck: Deck) -> Column:
    """Column of zones, ends and output times of a deck."""
    return build_column(
        deck.layers,
        deck.left,
        deck.right,
        end=deck.time.end,
        cfl=deck.time.cfl,
        viscosity=deck.viscosity,
        profile_times=deck.output.profiles if isinstance(deck.output.profiles, tuple) else (),
        history=deck.output.history,
        probes=deck.output.probes,
    )


def run(
    deck: Deck | str | Path,
    output: str | Path | None = None,
    *,
    restart: str | Path | None = None,
    force: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Run:
    """Run a deck (a `Deck`, a file, or TOML text) and return its `Run`.

    With ``output`` the result is an HDF5 file, written whole or not at all; without, it stays in memory. ``restart`` names a
    checkpoint to go on from; ``progress`` is told the share of the simulated time that is done.

    Raises DeckError (bad deck), FileProblem (a file), BreakdownError (the calculation; a diagnostic file lies beside the
    output), Interrupted (Ctrl-C or SIGTERM; a checkpoint lies beside the output).
    """
    deck = deck if isinstance(deck, Deck) else load_deck(deck)
    for layer in deck.layers:
        check_law(layer.law)
    column = column_of(deck)
    plan = _plan(deck)
    if output is None:
        return _in_memory(deck, column, progress)
    from hydro1d.store import Hdf5Sink, Layout

    state, checkpoint, program = None, None, None
    if restart is not None:
        program = Program(column)
        checkpoint, state = _read_restart(deck, column, program, Path(restart), force)
    arguments = (Path(output), Layout.of(column), deck.text, deck.resolved(), _attributes(deck))
    sink = Hdf5Sink.resume(checkpoint, *arguments) if checkpoint is not None else Hdf5Sink(*arguments)
    with sink, interruptible() as asked:
        outcome = solve(
            column,
            sink,
            state,
            checkpoints=plan,
            progress=_share(column, progress),
            program=program,
            asked_to_stop=asked,
        )
        saved = None
        if outcome.status == "interrupted" and outcome.state is not None:
            saved = sink.checkpoint(outcome.state)
        written = sink.finish(outcome.status, outcome.cycles, outcome.wall_seconds, **_closing(column, outcome))
    _raise_unless_complete(outcome, written, saved)
    from hydro1d.store import open_run

    return open_run(written, kept=sink.kept)


def _in_memory(deck: Deck, column: Column, progress: Callable[[float], None] | None) -> Run:
    from hydro1d.store import Layout, MemorySink

    sink = MemorySink(Layout.of(column), deck.text, deck.resolved(), _attributes(deck))
    outcome = solve(column, sink, progress=_share(column, progress))
    _raise_unless_complete(outcome, None)
    return sink.finish(outcome.status, outcome.cycles, outcome.wall_seconds, **_closing(column, outcome))


def _plan(deck: Deck) -> CheckpointPlan:
    checkpoint = deck.checkpoint
    return CheckpointPlan(checkpoint.cycles, checkpoint.time, checkpoint.wall) if checkpoint else CheckpointPlan()


def _attributes(deck: Deck) -> dict[str, Any]:
    """Root attributes: the peak of the applied pressure, and the hashes of the code of laws and boundaries."""
    laws, ends = _code_hashes(deck)
    hashes = {f"law_hash_{name}": value for name, value in laws.items()}
    hashes |= {f"boundary_hash_{side}": value for side, value in ends.items()}
    return {**hashes, "peak_applied_pressure": max(deck.left.peak(), deck.right.peak())}


def _code_hashes(deck: Deck) -> tuple[dict[str, str], dict[str, str]]:
    """Hashes of all that the code of laws, by material, and of boundaries, by side, can reach."""
    laws = {layer.material: fingerprint(layer.law) for layer in deck.layers}
    return laws, {"left": fingerprint(deck.left), "right": fingerprint(deck.right)}


def _closing(column: Column, outcome: Outcome) -> dict[str, Any]:
    """Root attributes known at the end."""
    if outcome.state is None:
        return {}
    layer = int(outcome.state.clock[0].limiting_layer)
    return {"limiting_layer": column.layer_name[layer], "message": outcome.message}


def _read_restart(deck: Deck, column: Column, program: Program, path: Path, force: bool) -> tuple[Any, State]:
    from hydro1d.store import read_checkpoint, verify_checkpoint

    checkpoint = read_checkpoint(path)
    if "clock" not in checkpoint.arrays:
        raise FileProblem(
            f"cannot carry on from {path}: it was written by a version before 0.2; run the deck from its start"
        )
    laws, ends = _code_hashes(deck)
    verify_checkpoint(checkpoint, deck.resolved(), laws, force, ends)
    return checkpoint, _state_of(column, program, checkpoint.arrays, path)


def _state_of(column: Column, program: Program, arrays: Mapping[str, Any], path: Path) -> State:
    """The checkpoint's state. Compiled code trusts its shapes, so that not even a forced restart may have others."""
    for name, needed in initial_state(column, program).arrays().items():
        shape = arrays[name].shape if name in arrays else None
        if shape != needed.shape or arrays[name].dtype != needed.dtype:
            found = "none" if shape is None else f"numbers {shape}"
            raise FileProblem(
                f"cannot carry on from {path}: its state holds {found} as {name}, this deck needs {needed.shape}; "
                "layers, zones and the variables of laws must be the checkpoint's"
            )
    state = State.from_arrays(dict(arrays))
    _check_places(column, state, path)
    return state


def _check_places(column: Column, state: State, path: Path) -> None:
    """What compiled code takes for places in its arrays must be places in them."""
    clock = state.clock[0]
    bounds = {"left_front": column.zones, "right_front": column.zones, "cycle": 2**53}
    bounds["limiting_layer"] = len(column.layers) - 1
    if not all(0 <= clock[name] <= bound for name, bound in bounds.items()):
        raise FileProblem(f"cannot carry on from {path}: its state makes no sense")


def _share(column: Column, progress: Callable[[float], None] | None) -> Callable[[State], None] | None:
    if progress is None:
        return None
    return lambda state: progress(Share(min(state.time / column.end_time, 1.0), state.time, state.cycle))


def _raise_unless_complete(outcome: Outcome, written: Path | None, saved: Path | None = None) -> None:
    where = f"\n  what there is: {written}" if written is not None else ""
    if outcome.status == "failed":
        zone = -1 if outcome.zone is None else outcome.zone
        raise BreakdownError(outcome.message + where, zone, outcome.time, outcome.cycles)
    if outcome.status == "interrupted":
        raise Interrupted(f"interrupted at t = {outcome.time:.6g} s, cycle {outcome.cycles}{where}", saved)
