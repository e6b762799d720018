"""Arrival times of waves at the support, estimated from a deck alone, to compare with its end time."""

import math
from typing import NamedTuple

from hydro1d.analysis.transmission import ends_of
from hydro1d.boundaries.base import Boundary
from hydro1d.deck import Deck
from hydro1d.laws.base import Foam, Law

BISECTIONS = 60


class Arrival(NamedTuple):
    """Times (s) from the load to the support: of the first wave, and of a compaction front that never slows down.

    The front is NaN where the load makes none, or where the laws do not tell.
    """

    wave: float
    front: float


def arrival_of(deck: Deck) -> Arrival | None:
    """The estimate for a deck; None where there is no support, or where more moves or acts than a load on the other end.

    The front is taken to keep the speed that the peak of the load gives it. A pulse that decays or ends, the elastic
    layers on its way and the reflections from them make it slower, so that it arrives later or never.
    """
    ends = ends_of(deck)
    load, support = getattr(deck, ends.loaded), getattr(deck, ends.support)
    still = not any(layer.velocity for layer in deck.layers) and not _acts(support)
    if not (_acts(load) and still) or not support.supports:
        return None
    speeds = [elastic_speed(layer.law) for layer in deck.layers]
    if not all(0.0 < speed < math.inf for speed in speeds):
        return None
    wave = sum(layer.thickness / speed for layer, speed in zip(deck.layers, speeds, strict=True))
    inward = _top_velocity(load, 1.0 if ends.loaded == "left" else -1.0)
    foams = [(layer.thickness, layer.law) for layer in deck.layers if isinstance(layer.law, Foam)]
    front = sum(thickness / front_speed(foam, load.peak(), inward) for thickness, foam in foams)
    return Arrival(min(wave, front), front) if front > 0.0 else Arrival(wave, math.nan)  # strong fronts outrun the wave


def _acts(boundary: Boundary) -> bool:
    return boundary.peak() > 0.0 or hasattr(boundary, "velocity")


def _top_velocity(load: Boundary, inward: float) -> float:
    """Largest speed (m/s) into the column that a piston or a striker has; 0 for a pressure."""
    table = getattr(load, "table", None) or ((0.0, getattr(load, "velocity", None) or 0.0),)
    return max(0.0, *(inward * speed for _, speed in table))


def elastic_speed(law: Law) -> float:
    """Lagrangian speed (m/s) of a weak wave in the material at rest."""
    return math.sqrt(law.at(0.0, energy=law.initial_energy).stiffness / law.density)


def front_speed(foam: Foam, pressure: float, velocity: float) -> float:
    """Lagrangian speed (m/s) of the shock from yield to where the stress is `pressure` or the velocity is `velocity`.

    NaN where such a load does not bring the foam to yield. By Eqs. 35 and 37 of doi:10.1016/j.ijimpeng.2009.03.011.
    """
    yielded, low, high = foam.loading(foam.yield_strain)[0], foam.yield_strain, 1.0
    start = yielded / math.sqrt(foam.density * foam.modulus)

    def reaches(strain: float) -> bool:
        stress = foam.loading(strain)[0]
        jump = math.sqrt(max(stress - yielded, 0.0) * (strain - foam.yield_strain) / foam.density)
        return stress >= pressure if pressure > 0.0 else start + jump >= velocity

    if low >= 1.0 or reaches(low):
        return math.nan
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        try:
            low, high = (low, middle) if reaches(middle) else (middle, high)
        except ArithmeticError:  # near full strain the stress overflows
            high = middle
    if high == 1.0:  # no state of this curve bears such a load
        return math.nan
    rise, strain = foam.loading(high)[0] - yielded, high - foam.yield_strain
    return math.sqrt(rise / strain / foam.density) if rise > 0.0 < strain else math.nan
