"""Foam that opened: zones that bear no tension, were loaded, and came apart afterwards (spall)."""

from typing import NamedTuple

import numpy as np

from hydro1d.deck import Deck
from hydro1d.laws.base import Law
from hydro1d.store import Run

MIN_OPENING = 1e-3  # strain; a zone that opened by less only oscillates
MAX_VALUES = 20_000_000  # values of one profile quantity; the summary of a longer run leaves openings out


class Openings(NamedTuple):
    """What opened in a run, as far as its profiles tell.

    zones of total opened at some time, still of them at the last profile; first: time of the first profile that shows
    it, s; low, high: Lagrangian coordinates between which they lie, m; stretched: zones that became longer than they
    were at the start; widest: the largest length over the initial one.
    """

    zones: int
    total: int
    still: int
    first: float
    low: float
    high: float
    stretched: int
    widest: float

    @property
    def outcome(self) -> str:
        """Whether the opened zones are closed at the last profile, in words."""
        return "all closed again at the end" if self.still == 0 else f"{self.still} still open at the end"


def find_openings(run: Run, deck: Deck | None = None) -> Openings | None:
    """Zones at zero stress after they were loaded, opened by a strain of MIN_OPENING at least; None if there are none.

    deck: gives the laws and with them the strain at which a zone closes; without, every zone at zero stress counts.
    """
    stress, strain, largest = run["stress"], run["strain"], run["largest_strain"]
    is_open = (stress <= 0.0) & (largest > 0.0) & _bears_no_tension(run)
    if deck is not None and is_open.any():
        is_open &= _closing_strain(run, deck, strain, is_open) - strain >= MIN_OPENING
    zones = np.flatnonzero(is_open.any(axis=0))
    if not len(zones):
        return None
    nodes = run["node_coordinate"]
    least = np.where(is_open, strain, 1.0).min(axis=0)[zones]
    return Openings(
        len(zones),
        strain.shape[1],
        int(is_open[-1].sum()),
        float(run.time[int(np.argmax(is_open.any(axis=1)))]),
        float(nodes[zones[0]]),
        float(nodes[zones[-1] + 1]),
        int((least < 0.0).sum()),
        float(1.0 - least.min()),
    )


def _bears_no_tension(run: Run) -> np.ndarray:
    """Whether each zone's law is a foam without tension, (zone,)."""
    materials = run.deck.get("material", {})
    loose = [materials.get(layer.name, {}).get("tension") is False for layer in run.layers]
    return np.array(loose)[run["zone_layer"]]


def _closing_strain(run: Run, deck: Deck, strain: np.ndarray, is_open: np.ndarray) -> np.ndarray:
    """Strain at which each zone's stress vanishes on unloading, from its largest strain while it was open, (zone,)."""
    largest = np.where(is_open, run["largest_strain"], 0.0).max(axis=0)
    found = np.full(strain.shape[1], -np.inf)
    for layer, part in zip(deck.layers, run.layers, strict=True):
        for zone in part.zones.start + np.flatnonzero(is_open[:, part.zones].any(axis=0)):
            found[zone] = _closed(layer.law, float(largest[zone]))
    return found


def _closed(law: Law, largest: float) -> float:
    if getattr(law, "is_reversible", False):
        return 0.0
    response = law.at(largest, largest)
    return largest - float(response.stress) / float(response.stiffness)
