"""Transmission: the peak stress on the support over the peak of the applied pressure, and whether the run decides it."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from hydro1d.analysis.fronts import FRONTS
from hydro1d.boundaries.base import Boundary
from hydro1d.components.plugins import builtin_names, find
from hydro1d.deck import Deck
from hydro1d.loads.base import Pulse
from hydro1d.store import Run

MIN_PRESSURE = 0.01  # share of the peak pressure; a pulse below it has ended
LAST_SHARE = 0.02  # share of the time calculated; a quantity that changes in this last part is still changing
MIN_RISE = 1e-3  # rise of the peak on the support in the last part, over the peak
PRECURSOR = 1e-9  # stress over the applied (or the largest) stress; a peak below it is only the wave's precursor
MAX_PRECURSOR = 1e-2  # stress over the applied (or the largest) stress; a peak below it that still rises is a precursor
MIN_ADVANCE = 1e-3  # advance of a front in the last part, over the column's length; a front below it stands
NOT_REACHED = "the wave has not reached the support; attenuated or enhanced is not decided yet"


class Ends(NamedTuple):
    """Which end is loaded, which is the support, and whether one alone is loaded by a pressure."""

    loaded: str
    support: str
    by_pressure: bool


class Transmission(NamedTuple):
    """Peak stresses in Pa on the two ends of a run's column.

    applied: peak of the applied pressure, 0 unless exactly one end is loaded by a pressure; transmitted: peak stress on the
    support, 0 before a wave has arrived there; pending: processes that the end of the run cuts off, in words.
    """

    ends: Ends
    applied: float
    transmitted: float
    pending: tuple[str, ...]

    @property
    def ratio(self) -> float:
        """transmitted / applied; NaN where either is 0."""
        return self.transmitted / self.applied if self.applied > 0.0 and self.transmitted > 0.0 else float("nan")

    @property
    def word(self) -> str:
        """enhanced, attenuated, or attenuated so far. A peak only grows: enhanced is decided as soon as it is seen."""
        if self.ratio > 1.0:
            return "enhanced"
        return "attenuated so far" if self.pending else "attenuated"


def transmission_of(run: Run, deck: Deck | None = None) -> Transmission:
    """Transmission of a run that holds a history. deck: needed only for a user's own pulses."""
    ends = ends_of(deck) if deck is not None else ends_of_data(run.deck)
    applied = float(run.attributes.get("peak_applied_pressure") or 0.0) if ends.by_pressure else 0.0
    transmitted = transmitted_stress(run, ends.support, applied)
    return Transmission(ends, applied, transmitted, tuple(_pending(run, deck, ends, transmitted > 0.0)))


def transmitted_stress(run: Run, side: str, applied: float) -> float:
    """Peak stress (Pa) on an end; 0 while it is only the numerical precursor of a wave that has not arrived.

    The precursor runs a few zones ahead of its wave and grows until the wave arrives. It is compared with the ``applied``
    pressure (Pa) if there is one, since the largest stress between masses without viscosity is thousands of times that.
    """
    peak, largest = (float(run.history[name][-1]) for name in (f"peak_{side}_stress", "peak_stress"))
    scale = min(largest, applied) if applied > 0.0 else largest
    is_precursor = peak <= PRECURSOR * scale or (peak < MAX_PRECURSOR * scale and _rises(run, side))
    return 0.0 if is_precursor else peak


def _rises(run: Run, side: str) -> bool:
    peak = run.history[f"peak_{side}_stress"]
    return bool(peak[-1] > (1.0 + MIN_RISE) * peak[_lately(run)])


def _lately(run: Run) -> int:
    """The row of the history with which the last stretch of the run begins."""
    time = run.history["time"]
    return max(int(np.searchsorted(time, (1.0 - LAST_SHARE) * time[-1], side="right")) - 1, 0)


def ends_of(deck: Deck) -> Ends:
    """Loaded end and support of a deck; the right end is the support where both or none is loaded."""
    return _ends(
        {side: end.peak() > 0.0 for side, end in _boundaries(deck).items()},
        {side: hasattr(end, "velocity") for side, end in _boundaries(deck).items()},
    )


def ends_of_data(data: Mapping[str, Any]) -> Ends:
    """Ends by a resolved deck as plain data, for results whose deck names user code that must not be run."""
    ends = {side: data.get(side, {}) for side in ("left", "right")}
    return _ends(
        {side: bool(end.get("pulse")) for side, end in ends.items()},
        {side: _is_mover(end.get("type")) for side, end in ends.items()},
    )


def _is_mover(boundary: Any) -> bool:
    """Whether one of hydro1d's own boundaries is given a velocity."""
    return boundary in builtin_names("boundary") and "velocity" in find("boundary", boundary).model_fields


def _ends(pushed: Mapping[str, bool], moved: Mapping[str, bool]) -> Ends:
    sides = [side for side in pushed if pushed[side]] or [side for side in moved if moved[side]]
    loaded = sides[0] if len(sides) == 1 else "left"
    return Ends(loaded, "right" if loaded == "left" else "left", sum(pushed.values()) == 1)


def pulse_of(run: Run, side: str) -> Pulse | None:
    """Pulse on an end of a result's column, built from the stored deck; None without one or for a user's own pulse."""
    data = run.deck.get(side, {})
    if data.get("pulse") not in builtin_names("pulse"):
        return None
    kind = find("pulse", data["pulse"])
    try:
        found = kind(**{key: value for key, value in data.items() if key in kind.model_fields})
    except ValueError:  # a file by a version whose pulse had other keys
        return None
    return found if isinstance(found, Pulse) else None


def _boundaries(deck: Deck) -> dict[str, Boundary]:
    return {"left": deck.left, "right": deck.right}


def _pending(run: Run, deck: Deck | None, ends: Ends, arrived: bool) -> list[str]:
    """Processes that still go on at the end of the run, in words."""
    end = float(run.history["time"][-1])
    found = []
    pulse = getattr(_boundaries(deck)[ends.loaded], "pulse", None) if deck is not None else pulse_of(run, ends.loaded)
    if pulse is not None and abs(pulse.pressure(end)) > MIN_PRESSURE * pulse.peak_pressure():
        found.append("the pressure still acts")
    if arrived and _rises(run, ends.support):
        found.append("the peak on the support still rises")
    if _is_crushing(run):
        found.append("the column is still being crushed")
    return found


def _is_crushing(run: Run) -> bool:
    """Whether a compaction front has moved on lately."""
    history, nodes, lately = run.history, run["node_coordinate"], _lately(run)
    moved = [sign * (history[name][-1] - history[name][lately]) for name, sign in FRONTS.items() if name in history]
    return any(distance > MIN_ADVANCE * (nodes[-1] - nodes[0]) for distance in moved)
