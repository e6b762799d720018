"""Timing: interleaved, best of many, so that what else runs on the machine disturbs a ratio least."""

import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hydro1d.benchmarks import cases, reference
from hydro1d.benchmarks.baseline import Baseline
from hydro1d.solver.driver import solve
from hydro1d.solver.program import Program
from hydro1d.solver.sink import Sink
from hydro1d.solver.state import State

AGREEMENT = 1e-10  # of the two answers, or nothing is timed; beyond 10 000 zones the round-off of their strains is more
ZONE_STEPS = 100_000  # of one timed call, a fraction of a millisecond


def best(calls: Sequence[Callable[[], Callable[[], object]]], repetitions: int) -> list[float]:
    """Least seconds of each call, taken in turns; each entry prepares and returns what is timed."""
    least = [float("inf")] * len(calls)
    for _ in range(repetitions):
        for k, prepare in enumerate(calls):
            timed = prepare()
            begun = time.perf_counter()
            timed()
            least[k] = min(least[k], time.perf_counter() - begun)
    return least


def case(name: str, zones: int, library: Any | None, repetitions: int) -> dict[str, Any]:
    """ns per zone-cycle of one case, beside the C reference where there is one."""
    program, states = cases.stations(name, zones, 2 if zones > 100_000 else 4)
    steps = max(ZONE_STEPS // zones, 4)
    other = reference.Reference(library, program) if library is not None else None
    agreement = max(agree(program, other, state, zones) for state in states) if other is not None else None
    seconds = np.zeros(2 if other is not None else 1)
    for state in states:
        calls = [lambda state=state: _ours(program, state.copy(), steps)]
        if other is not None:
            calls.append(lambda state=state: _theirs(other, state.copy(), steps))
        seconds += best(calls, repetitions)
    per = 1e9 / (steps * zones * len(states))
    row: dict[str, Any] = {"case": name, "zones": zones, "ns": seconds[0] * per}
    if other is not None:
        row |= {"reference_ns": seconds[1] * per, "ratio": seconds[0] / seconds[1], "difference": agreement}
    return row


def agree(program: Program, other: reference.Reference, state: State, zones: int) -> float:
    """Relative difference of the two answers after some steps. Raises RuntimeError where it is too large."""
    one, two = state.copy(), state.copy()
    steps = 20 if zones <= 100_000 else 8
    program.advance(one, stop=1.0, steps=steps, row_at_stop=False)
    other.advance(two, steps)
    found = reference.difference(one, two)
    if not found <= AGREEMENT * max(zones / 1e4, 1.0):
        raise RuntimeError(f"hydro1d and the C reference differ by {found:.1e} after {steps} steps")
    return found


def _ours(program: Program, state: State, steps: int) -> Callable[[], object]:
    return lambda: program.advance(state, stop=1.0, steps=steps, row_at_stop=False)


def _theirs(other: reference.Reference, state: State, steps: int) -> Callable[[], object]:
    return lambda: other.advance(state, steps)


def plain_numpy(zones: int, repetitions: int) -> dict[str, Any]:
    """ns per zone-cycle of `epph` in plain numpy."""
    program, states = cases.stations("epph", zones, 1)
    plain, steps = Baseline(program), max(20_000 // zones, 2)
    one, two = states[0].copy(), states[0].copy()
    program.advance(one, stop=1.0, steps=20, row_at_stop=False)
    plain.advance(two, 20)
    seconds = best([lambda: (lambda state: lambda: plain.advance(state, steps))(states[0].copy())], repetitions)[0]
    return {"zones": zones, "ns": seconds * 1e9 / (steps * zones), "difference": reference.difference(one, two)}


def memory_bandwidth(repetitions: int) -> dict[str, float]:
    """Bytes a second through memory by a sum in place of arrays beyond any cache, and ns per zone-cycle that this allows.

    Per zone and cycle a foam moves 14 numbers of 8 bytes at least: velocity, displacement, force, viscosity, energy, largest
    strain and three numbers of its curve come in; the first five go out.
    """
    size = 20_000_000
    a, b = np.zeros(size), np.ones(size)
    seconds = best([lambda: lambda: np.add(a, b, out=a)], repetitions)[0]  # the loop too writes where it has read
    moved = 3 * 8 * size  # two read, one written
    return {"bytes_per_second": moved / seconds, "bound_ns": 14 * 8 * seconds / moved * 1e9}


def threads(zones: int, repetitions: int, count: int = 2) -> dict[str, float]:
    """How many times faster ``count`` threads run as many independent cases than one thread runs them in turn."""
    pairs = [cases.stations("epph", zones, 1) for _ in range(count)]
    steps = 20_000_000 // zones

    def work(k: int) -> None:
        program, states = pairs[k]
        program.advance(states[0].copy(), stop=1.0, steps=steps, row_at_stop=False)

    def in_turn() -> None:
        for k in range(count):
            work(k)

    def at_once() -> None:
        running = [threading.Thread(target=work, args=(k,)) for k in range(count)]
        for thread in running:
            thread.start()
        for thread in running:
            thread.join()

    turn, once = best([lambda: in_turn, lambda: at_once], repetitions)
    return {"threads": count, "speedup": turn / once}


def output_cost(zones: int, repetitions: int) -> dict[str, float]:
    """Time loop of the main case with 200 profiles, history and probes over that without output."""
    end = 8e-3
    profiles = np.linspace(0.0, end, 200).tolist()
    bare = cases.column("epph", zones, end=end)
    variants = {
        "none": bare,
        "history every 10 cycles": cases.column(
            "epph", zones, end=end, history=10, profile_times=profiles, probes=[0.25, 0.5]
        ),
        "history every cycle": cases.column(
            "epph", zones, end=end, history=1, profile_times=profiles, probes=[0.25, 0.5]
        ),
    }
    programs = {name: Program(column) for name, column in variants.items()}
    least = dict.fromkeys(variants, float("inf"))
    for _ in range(repetitions):
        for name, column in variants.items():
            outcome = solve(column, Sink(), program=programs[name])
            least[name] = min(least[name], outcome.wall_seconds)
    return {name: seconds / least["none"] for name, seconds in least.items() if name != "none"}


def linearity(largest: float, repetitions: int) -> list[dict[str, float]]:
    """ns per zone-cycle and bytes per zone from 100 zones up to ``largest``, by tens."""
    rows = []
    zones = 100
    while zones <= largest:
        program, states = cases.stations("epph", zones, 1)
        steps = max(ZONE_STEPS // zones, 3)
        state = states[0]
        seconds = best(
            [lambda: _ours(program, state.copy(), steps)],  # noqa: B023 (called within the turn)
            repetitions if zones < 1e5 else 3,
        )[0]
        held = sum(a.nbytes for a in state.arrays().values()) + sum(
            a.nbytes for a in vars(program).values() if isinstance(a, np.ndarray) and a.size >= zones
        )
        rows.append({"zones": zones, "ns": seconds * 1e9 / (steps * zones), "bytes_per_zone": held / zones})
        zones *= 10
    return rows
