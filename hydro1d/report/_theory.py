"""The closed-form answer to a deck, where there is one: one layer, loaded on the left from rest."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from hydro1d import analytic
from hydro1d.analysis.fronts import front_path
from hydro1d.analysis.theory import curve_of
from hydro1d.analytic.compaction_column import CompactionColumn
from hydro1d.plot._units import Scale, scale_for
from hydro1d.store import Run

_DOI = "doi:10.1016/j.ijimpeng.2009.03.011"


class Row(NamedTuple):
    """A quantity by theory and as calculated, SI; the scale is how to show it; the time (s) is when."""

    quantity: str
    exact: float
    measured: float
    scale: Scale
    time: float

    @property
    def difference(self) -> str:
        """How far apart, relative where that makes sense."""
        if self.exact == 0.0:
            return self.scale.show(self.measured - self.exact, 2)
        return f"{100 * (self.measured / self.exact - 1.0):+.2g} %"


@dataclass(frozen=True)
class Theory:
    """A closed-form solution: name, where it stands, what it takes for granted, fields and fronts, the comparison.

    exact_until, until: up to when (s) it solves the same equations as the code, and up to when it says anything.
    """

    name: str
    source: str
    assumes: str
    exact_until: float
    until: float
    fields: Callable[[Any, Any], analytic.Fields]
    jumps: Callable[[float], list[analytic.Jump]]
    rows: tuple[Row, ...]


def find_theory(run: Run) -> Theory | None:
    """The theory that fits the run's deck, or None."""
    found = theory_or_reason(run)
    return found if isinstance(found, Theory) else None


def theory_or_reason(run: Run) -> Theory | str:
    """The theory that fits the run's deck, or in a sentence why there is none."""
    deck = run.deck
    layers = deck.get("layer", [])
    if len(layers) != 1:
        return f"The closed forms are for a single layer; this column has {len(layers)}."
    if layers[0].get("velocity"):
        return "The closed forms are for a layer at rest; this one moves at the start."
    if len(run.time) < 2 or "front_position" not in run.history:
        return "There are too few profiles to compare with."
    law = deck.get("material", {}).get(layers[0]["material"], {})
    try:
        curve = curve_of(law)
        if curve is None:
            return f'There is no closed form for the law "{str(law.get("law"))[:80]}".'
        found = _solve(run, curve, float(layers[0]["thickness"]))
    except (ValueError, KeyError) as error:  # loads that the closed forms do not cover
        return f"The closed forms do not cover this load on this curve: {error}."
    return found if found is not None else _LOADS


_LOADS = (
    "The closed forms are for a layer loaded on the left from rest: by a constant or a rectangular pressure, by a piston "
    "of constant velocity, or, against a wall, by a striker."
)
_UNLOADING = (
    "theory takes the crushed foam as a rigid block, slowed as one body by the stress ahead of its front: the stress in "
    "it is a straight line, its velocity one number, its strain what the front left. Here crushed foam unloads on a steep "
    "elastic line. Waves run through the block, it springs back and rings about the motion of the theory, and the front "
    "hears of a change at its other end only when a wave has caught up with it. Fronts and times therefore differ by some "
    'per cent, and single stresses by more; unloading_modulus = "rigid" in the deck comes closer to the theory'
)


def _solve(run: Run, curve: analytic.Curve, length: float) -> Theory | None:
    left, right = run.deck["left"], run.deck["right"]
    kind, fixed = left.get("type"), right.get("type") == "wall"
    if kind == "pressure" and left.get("pulse") == "constant":
        step = analytic.pressure_step(curve, float(left["peak"]), length)
        return _step("Pressure step", step, run)
    if kind == "pressure" and left.get("pulse") == "rectangular":
        peak, duration = float(left["peak"]), float(left["duration"])
        if fixed:
            try:
                pulse = analytic.CompactionPulse(curve, length, peak, duration)
                return _column("Rectangular pulse, two compaction fronts", pulse, run, duration)
            except ValueError:
                pass  # no precursor ahead of one compaction shock: what holds during the pulse is left
        return _step("Rectangular pulse, while it lasts", analytic.pressure_step(curve, peak, length), run, duration)
    if kind == "piston" and float(left.get("velocity") or 0.0) > 0.0:
        return _step("Piston of constant velocity", analytic.piston(curve, float(left["velocity"]), length), run)
    if kind == "striker" and fixed:
        mass, velocity = float(left["mass"]), float(left["velocity"])
        return _column("Striker, two compaction fronts", analytic.CompactionStriker(curve, length, mass, velocity), run)
    return None


def _step(name: str, solution: analytic.StepLoading, run: Run, pulse_end: float = np.inf) -> Theory:
    until = min(pulse_end, solution.end_time, float(run.time[-1]))
    index = _last_before(run, until)
    time = float(run.time[index])
    front = solution.jumps()[-1]
    behind = solution.states[-1]
    rows = _behind_front(run, index, front.front_speed * time, behind)
    ended = "when the pressure ends" if until == pulse_end else "when a wave reaches the far end, or with the run"
    assumes = f"A steady front, from the jump conditions on this law's curve: exact until {_clock(until)}, {ended}."
    if len(solution.states) > 2 or behind.strain > solution.curve.yield_strain:
        rows += _fronts(run, [time], lambda t: front.front_speed * t, "front_position", "front")
    source = f"Eqs. 31–37, 40, 41 of {_DOI}"
    return Theory(name, source, assumes, until, until, solution, solution.jumps, tuple(rows))


def _column(name: str, solution: CompactionColumn, run: Run, pulse: float = 0.0) -> Theory:
    until = min(solution.end_time, float(run.time[-1]))
    rows: list[Row] = []
    if 0.0 < pulse < until:
        index = _last_before(run, pulse)
        where = float(solution.history(run.time[index]).front)
        state = solution(np.array([0.5 * where]), float(run.time[index]))
        rows += _behind_front(run, index, where, analytic.State(*(float(value[0]) for value in state)))
    moments = [share * until for share in (0.25, 0.5, 0.75, 0.95)]
    rows += _fronts(run, moments, lambda t: float(solution.history(t).front), "front_position", "front")
    late = [t for t in moments if t > solution.wave_arrival]
    rows += _fronts(
        run, late[-1:], lambda t: float(solution.history(t).distal_front), "distal_front_position", "far front"
    )
    rows += [_block_velocity(run, solution, t) for t in moments[1:3]]
    if late:
        felt = float(np.interp(late[-1], run.history["time"], run.history["right_stress"]))
        exact = float(solution.history(late[-1]).right_stress)
        rows.append(Row(f"support stress at {_clock(late[-1])}", exact, felt, scale_for("Pa", felt), late[-1]))
    rows += _crushed(run, solution)
    met = np.isclose(until, solution.meeting_time)
    ended = "the two fronts meet" if met else "the crushed block comes to rest, or with the run"
    begun = "While the pulse lasts it is exact. Afterwards the" if pulse > 0.0 else "The"
    assumes = f"{begun} {_UNLOADING}. It ends at {_clock(until)}, when {ended}."
    source = f"Eqs. 39–47 of {_DOI}, on this law's curve"
    return Theory(name, source, assumes, min(pulse, until), until, solution, solution.jumps, tuple(rows))


def _behind_front(run: Run, index: int, front: float, state: analytic.State) -> list[Row]:
    """Medians over the middle of the material behind the front at one output time."""
    where = run["zone_coordinate"]
    inside = (where > 0.15 * front) & (where < 0.8 * front)
    if inside.sum() < 3:
        return []
    time, rows = float(run.time[index]), []
    measured = {"strain": run["strain"][index], "stress": run["stress"][index], "velocity": _zone_velocity(run, index)}
    for (name, values), unit in zip(measured.items(), ("1", "Pa", "m s-1"), strict=True):
        exact = float(getattr(state, name))
        median = float(np.median(values[inside]))
        rows.append(Row(f"{name} behind the front at {_clock(time)}", exact, median, scale_for(unit, exact), time))
    return rows


def _zone_velocity(run: Run, index: int) -> np.ndarray:
    """Velocity in the middle of the zones at one output time, m/s."""
    nodes = run["velocity"][index]
    return 0.5 * (nodes[:-1] + nodes[1:])


def _fronts(run: Run, times: list[float], exact: Callable[[float], float], name: str, words: str) -> list[Row]:
    path, clock = front_path(run, name), run.history["time"]
    known = np.isfinite(path)
    rows = []
    for time in times:
        if known.any() and clock[known][0] <= time <= clock[known][-1]:
            measured = float(np.interp(time, clock[known], path[known]))
            rows.append(Row(f"{words} at {_clock(time)}", exact(time), measured, scale_for("m", measured), time))
    return rows


def _block_velocity(run: Run, solution: CompactionColumn, time: float) -> Row:
    """Mean velocity of the crushed block: a real foam unloads elastically and rings about the theory's rigid block."""
    index = _last_before(run, time)
    front = float(solution.history(run.time[index]).front)
    inside = run["zone_coordinate"] < front
    mass = run["zone_mass"][inside]
    mean = float(np.sum(mass * _zone_velocity(run, index)[inside]) / np.sum(mass)) if inside.any() else np.nan
    exact = float(solution.history(run.time[index]).velocity)
    label = f"mean velocity of the crushed block at {_clock(float(run.time[index]))}"
    return Row(label, exact, mean, scale_for("m s-1", exact), float(run.time[index]))


def _crushed(run: Run, solution: CompactionColumn) -> list[Row]:
    left = run.history["uncrushed_fraction"]
    if np.isfinite(solution.meeting_time) and (left <= 0.0).any():
        at, measured = solution.meeting_time, float(run.history["time"][int(np.argmax(left <= 0.0))])
        return [Row("fully crushed at", at, measured, scale_for("s", measured), at)]
    return []


def _last_before(run: Run, time: float) -> int:
    """The last profile at or before a time, not the initial one."""
    return max(int(np.searchsorted(run.time, time * (1 + 1e-12), side="right")) - 1, 1)


def _clock(time: float) -> str:
    return scale_for("s", time).show(time, 3)
