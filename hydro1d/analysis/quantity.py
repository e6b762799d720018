"""Quantities of a run by name: ``peak_support_stress``, ``max(kinetic_energy)``, ``front_arrival(0.5 m)``.

A name is looked up, an argument is a column of the history or a length; nothing is evaluated.
"""

import math
import re
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from hydro1d.analysis.energy import elastic_energy
from hydro1d.analysis.fronts import front_arrival
from hydro1d.analysis.transmission import ends_of, transmitted_stress
from hydro1d.components.plugins import builtin_names, find
from hydro1d.components.units import UnitError, convert, plain
from hydro1d.deck import Deck
from hydro1d.deck.messages import one_of, suggestion
from hydro1d.store import Run
from hydro1d.variables import HISTORY

_CALL = re.compile(r"\s*([A-Za-z_]\w*)\s*(?:\(\s*([^()]*?)\s*\))?\s*")


class Quantity(NamedTuple):
    """A number taken from a run: how it is written, its SI unit, what it is, and the function that takes it."""

    name: str
    units: str
    long_name: str
    take: Callable[[Run, Deck], float]


def parse_quantity(text: str) -> Quantity:
    """The quantity that ``text`` names. Raises ValueError, in one sentence, for one that there is not."""
    match = _CALL.fullmatch(str(text)[:200])
    if match is None:
        raise ValueError(f"{str(text)[:80]!r} is not the name of a quantity")
    name, argument = match.groups()
    if argument is None:
        if name not in _PLAIN:
            hint = (
                " takes an argument, as in " + _EXAMPLES[name] if name in _EXAMPLES else suggestion(name, list(_PLAIN))
            )
            raise ValueError(f"there is no quantity {name!r}{hint}; there are {one_of(quantity_names(), 40)}")
        units, long_name, take = _PLAIN[name]
        return Quantity(name, units, long_name, take)
    if name in _ARRIVALS:
        return _arrival(name, argument)
    if name not in _REDUCTIONS:
        names = [*_REDUCTIONS, *_ARRIVALS]
        raise ValueError(f"{name!r} takes no argument{suggestion(name, names)}; those that do are {one_of(names)}")
    return _reduction(name, argument)


def quantity_names() -> list[str]:
    """Every quantity as it can be written; ``COLUMN`` and ``POSITION`` stand for what the user puts in."""
    return [*_PLAIN, *(f"{name}(COLUMN)" for name in _REDUCTIONS), *(f"{name}(POSITION)" for name in _ARRIVALS)]


def support_side(deck: Deck) -> str:
    """`left` or `right`: the end away from the load."""
    return ends_of(deck).support


def applied_peak(deck: Deck) -> float:
    """Largest pressure that the deck prescribes, Pa."""
    return max(deck.left.peak(), deck.right.peak())


def _last(column: str) -> Callable[[Run, Deck], float]:
    return lambda run, deck: float(run.history[column][-1])


def _peak_support(run: Run, deck: Deck) -> float:
    return float(run.history[f"peak_{support_side(deck)}_stress"][-1])


def _enhancement(run: Run, deck: Deck) -> float:
    applied = applied_peak(deck)
    transmitted = transmitted_stress(run, support_side(deck), applied)
    return transmitted / applied if applied > 0.0 and transmitted > 0.0 else float("nan")


def _crushed_time(run: Run, deck: Deck) -> float:
    return _first_time(run, run.history["uncrushed_fraction"] <= 0.0)


def _first_time(run: Run, happened: np.ndarray) -> float:
    return float(run.history["time"][np.argmax(happened)]) if happened.any() else float("nan")


def _energy_in(run: Run) -> float:
    """Initial energy and the largest work done so far, J/m²."""
    history = run.history
    return float(
        history["kinetic_energy"][0] + history["internal_energy"][0] + max(history["boundary_work"].max(), 0.0)
    )


def _share(part: Callable[[Run, Deck], float]) -> Callable[[Run, Deck], float]:
    def share(run: Run, deck: Deck) -> float:
        total = _energy_in(run)
        return part(run, deck) / total if total > 0.0 else float("nan")

    return share


def _crushing_energy(run: Run, deck: Deck) -> float:
    history = run.history
    first = float(history["internal_energy"][0])
    return (
        float(history["internal_energy"][-1]) - first - float(history["viscous_work"][-1]) - elastic_energy(run, deck)
    )


def separated(run: Run, deck: Deck) -> float:
    """1 if a striker has parted from the column, or the column from a wall that does not hold it; else 0."""
    history, length = run.history, float(run["node_coordinate"][-1] - run["node_coordinate"][0])
    gap = 0.0
    for side, sign in (("left", 1.0), ("right", -1.0)):
        end = history[f"{side}_position"]
        if f"{side}_striker_position" in history:
            gap = max(gap, float(np.max(sign * (end - history[f"{side}_striker_position"]))))
        elif not getattr(getattr(deck, side), "bonded", True):
            gap = max(gap, float(np.max(sign * (end - end[0]))))
    return float(gap > 1e-9 * length)


def _is_enhanced(run: Run, deck: Deck) -> float:
    ratio = _enhancement(run, deck)
    return float(ratio > 1.0) if ratio == ratio else float("nan")


def _is_fully_crushed(run: Run, deck: Deck) -> float:
    return float(run.history["uncrushed_fraction"][-1] <= 0.0)


_PLAIN: dict[str, tuple[str, str, Callable[[Run, Deck], float]]] = {
    "peak_support_stress": ("Pa", "largest stress on the end away from the load, every cycle counted", _peak_support),
    "enhancement": (
        "1",
        "peak support stress over the largest applied pressure; NaN until a wave has arrived",
        _enhancement,
    ),
    "uncrushed_fraction": ("1", "share of the length that is not crushed at the end", _last("uncrushed_fraction")),
    "peak_stress": ("Pa", "largest stress anywhere, every cycle counted", _last("peak_stress")),
    "crushed_time": ("s", "when the column is fully crushed; NaN if it never is", _crushed_time),
    "enhanced": (
        "1",
        "1 if the peak support stress exceeds the applied pressure; NaN until a wave has arrived",
        _is_enhanced,
    ),
    "fully_crushed": ("1", "1 if every zone is crushed at the end", _is_fully_crushed),
    "separated": ("1", "1 if striker and column, or column and wall, have parted", separated),
    "boundary_work": ("J m-2", "work done on the column by both ends", _last("boundary_work")),
    "kinetic_energy": ("J m-2", "kinetic energy at the end", _last("kinetic_energy")),
    "internal_energy": ("J m-2", "internal energy at the end", _last("internal_energy")),
    "front_dissipation": (
        "J m-2",
        "energy dissipated in fronts, beyond the stress-strain curve",
        _last("viscous_work"),
    ),
    "elastic_energy": ("J m-2", "recoverable energy at the end", elastic_energy),
    "crushing_energy": ("J m-2", "energy absorbed along the stress-strain curve, not recoverable", _crushing_energy),
    "kinetic_share": ("1", "kinetic energy over all energy put in", _share(_last("kinetic_energy"))),
    "front_share": ("1", "dissipation in fronts over all energy put in", _share(_last("viscous_work"))),
    "elastic_share": ("1", "recoverable energy over all energy put in", _share(elastic_energy)),
    "crushing_share": ("1", "crushing energy over all energy put in", _share(_crushing_energy)),
    "energy_error": (
        "1",
        "largest energy imbalance",
        lambda run, deck: float(np.abs(run.history["energy_error"]).max()),
    ),
}
_PLAIN["support_peak"] = _PLAIN["peak_support_stress"]

_REDUCTIONS: dict[str, tuple[str, Callable[[np.ndarray, np.ndarray], float]]] = {
    "max": ("largest", lambda time, values: float(np.nanmax(values)) if _any(values) else float("nan")),
    "min": ("smallest", lambda time, values: float(np.nanmin(values)) if _any(values) else float("nan")),
    "first": ("first", lambda time, values: float(values[0])),
    "last": ("last", lambda time, values: float(values[-1])),
    "mean": ("mean in time of", lambda time, values: float(np.trapezoid(values, time) / (time[-1] - time[0]))),
    "integral": ("time integral of", lambda time, values: float(np.trapezoid(values, time))),
    "time_of_max": ("time of the largest", lambda t, v: float(t[np.nanargmax(v)]) if _any(v) else float("nan")),
    "time_of_min": ("time of the smallest", lambda t, v: float(t[np.nanargmin(v)]) if _any(v) else float("nan")),
}
_PROXIMAL, _DISTAL = "front_position", "distal_front_position"
_ARRIVALS = {
    "front_arrival": ((_PROXIMAL,), "arrival of the front from the left at"),
    "distal_front_arrival": ((_DISTAL,), "arrival of the front from the right at"),
    "crushed_time": ((_PROXIMAL, _DISTAL), "arrival of the first of the two fronts at"),
}
_EXAMPLES = {
    **{name: f"{name}(right_stress)" for name in _REDUCTIONS},
    **{name: f"{name}(0.5 m)" for name in _ARRIVALS},
}


def _any(values: np.ndarray) -> bool:
    return bool(np.isfinite(values).any())


def _reduction(name: str, column: str) -> Quantity:
    units = {variable.name: variable.units for variable in HISTORY} | _boundary_columns()
    if column not in units:
        known = [*units]
        raise ValueError(
            f"{column[:80]!r} is no column of the history{suggestion(column, known)}; there are {one_of(known, 40)}"
        )
    label, reduce = _REDUCTIONS[name]
    unit = "s" if name.startswith("time_of") else units[column] + (" s" if name == "integral" else "")

    def take(run: Run, deck: Deck) -> float:
        if column not in run.history:
            return float("nan")  # a striker's column where there is no striker
        return reduce(np.asarray(run.history["time"]), np.asarray(run.history[column]))

    return Quantity(f"{name}({column})", unit, f"{label} {column.replace('_', ' ')}", take)


def _boundary_columns() -> dict[str, str]:
    """Columns that hydro1d's own boundaries add to the history, with their SI units."""
    kept = [getattr(find("boundary", name), "memory", {}) for name in builtin_names("boundary")]
    return {f"{side}_{name}": units for side in ("left", "right") for own in kept for name, units in own.items()}


def _arrival(name: str, argument: str) -> Quantity:
    try:
        position = convert(plain(argument), "m")
    except UnitError as error:
        raise ValueError(f"{name} takes a Lagrangian position such as 0.5 m: {error}") from None
    columns, what = _ARRIVALS[name]

    def take(run: Run, deck: Deck) -> float:
        times = [front_arrival(run, column, position) for column in columns]
        return min((time for time in times if not math.isnan(time)), default=float("nan"))

    return Quantity(f"{name}({argument})", "s", f"{what} {position:g} m", take)
