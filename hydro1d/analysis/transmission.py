"""What a run says of its load: does the support feel more than was applied, and is that decided by the end of the run?"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from hydro1d.analysis.fronts import FRONTS
from hydro1d.components.plugins import builtin_names, find
from hydro1d.loads.base import Pulse
from hydro1d.variables import HERALD

if TYPE_CHECKING:
    from hydro1d.boundaries.base import Boundary
    from hydro1d.deck import Deck
    from hydro1d.store import Run

ACTS = 0.01  # of its peak: a smaller pressure is over
LATELY = 0.02  # of the time calculated, at the end: what changes there is still going on
RISES = 1e-3  # of the peak on the support, lately
FAINT = 1e-2  # of the applied or, without one, the largest stress: a peak on the support that is less and still rises is a herald
RUNS = 1e-3  # of the column's length, lately: a front that runs
NOT_REACHED = "the wave has not reached the support; attenuated or enhanced is not decided yet"


class Ends(NamedTuple):
    """Which end is loaded, which is the support, and whether one alone is loaded by a pressure."""

    loaded: str
    support: str
    by_pressure: bool


class Verdict(NamedTuple):
    """What a run says of its load; pressures in Pa.

    applied: peak of the pressure, 0 unless one end alone is loaded by one; felt: peak on the support, 0 as long as no
    wave has arrived there; pending: what is still going on at the end of the run, in words.
    """

    ends: Ends
    applied: float
    felt: float
    pending: tuple[str, ...]

    @property
    def ratio(self) -> float:
        """Felt over applied; NaN where it has no meaning."""
        return self.felt / self.applied if self.applied > 0.0 and self.felt > 0.0 else float("nan")

    @property
    def word(self) -> str:
        """enhanced, attenuated, or attenuated so far. A peak only grows: enhanced is decided as soon as it is seen."""
        if self.ratio > 1.0:
            return "enhanced"
        return "attenuated so far" if self.pending else "attenuated"


def verdict_of(run: Run, deck: Deck | None = None) -> Verdict:
    """The verdict on a run that holds a history. deck: needed only for pulses of the user's own."""
    ends = ends_of(deck) if deck is not None else ends_of_data(run.deck)
    applied = float(run.attributes.get("peak_applied_pressure") or 0.0) if ends.by_pressure else 0.0
    felt = felt_on(run, ends.support, applied)
    return Verdict(ends, applied, felt, tuple(_pending(run, deck, ends, felt > 0.0)))


def felt_on(run: Run, side: str, applied: float) -> float:
    """Peak stress (Pa) on an end; 0 as long as it is only the numerical herald of a wave that has not arrived.

    A herald runs ahead of its wave by a few zones; it is faint and grows until the wave is there. Faint is measured by the
    ``applied`` pressure, if any: masses without viscosity collide with thousands of times as much.
    """
    felt, most = (float(run.history[name][-1]) for name in (f"peak_{side}_stress", "peak_stress"))
    most = min(most, applied) if applied > 0.0 else most
    is_herald = felt <= HERALD * most or (felt < FAINT * most and _rises(run, side))
    return 0.0 if is_herald else felt


def _rises(run: Run, side: str) -> bool:
    peak = run.history[f"peak_{side}_stress"]
    return bool(peak[-1] > (1.0 + RISES) * peak[_lately(run)])


def _lately(run: Run) -> int:
    """The row of the history with which the last stretch of the run begins."""
    time = run.history["time"]
    return max(int(np.searchsorted(time, (1.0 - LATELY) * time[-1], side="right")) - 1, 0)


def ends_of(deck: Deck) -> Ends:
    """Loaded end and support of a deck; the right end is the support where both or none is loaded."""
    return _ends(
        {side: end.peak() > 0.0 for side, end in _boundaries(deck).items()},
        {side: hasattr(end, "velocity") for side, end in _boundaries(deck).items()},
    )


def ends_of_data(data: Mapping[str, Any]) -> Ends:
    """The same from a deck as plain data, for results whose deck names code of its user that is not to be run."""
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
    """The pulse on an end of a result's column, whatever the laws are; None where there is none of hydro1d's own."""
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
    """What has not come to its end with the run."""
    end = float(run.history["time"][-1])
    found = []
    pulse = getattr(_boundaries(deck)[ends.loaded], "pulse", None) if deck is not None else pulse_of(run, ends.loaded)
    if pulse is not None and abs(pulse.pressure(end)) > ACTS * pulse.peak_pressure():
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
    return any(distance > RUNS * (nodes[-1] - nodes[0]) for distance in moved)
