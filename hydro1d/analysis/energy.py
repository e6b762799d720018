"""Elastic energy: the part of the internal energy that unloading recovers."""

import itertools

import numpy as np

from hydro1d.deck import Deck
from hydro1d.laws.base import Foam, Law
from hydro1d.store import Run

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(16)


def elastic_energy(run: Run, deck: Deck, profile: int = -1) -> float:
    """Recoverable energy per area (J/m²) at one of the stored profiles; NaN where a law does not tell.

    Steep unloading gives back σ²/(2 H); a reversible foam gives back the whole area under its curve.
    """
    strain, stress = run["strain"][profile], run["stress"][profile]
    largest, edges = run["largest_strain"][profile], run["node_coordinate"]
    sizes = np.diff(edges)
    total, first = 0.0, 0
    for layer in deck.layers:
        part = slice(first, first + layer.zones)
        first += layer.zones
        total += float(np.sum(sizes[part] * _density(layer.law, strain[part], stress[part], largest[part])))
    return total


def _density(law: Law, strain: np.ndarray, stress: np.ndarray, largest: np.ndarray) -> np.ndarray:
    if not isinstance(law, Foam):
        modulus = getattr(law, "modulus", None)
        return 0.5 * stress**2 / modulus if modulus else np.full(stress.shape, np.nan)
    if law.is_reversible:
        return np.array([loading_energy(law, float(e)) for e in strain])
    stiffness = [law.at(e, top).stiffness for e, top in zip(strain, largest, strict=True)]
    return 0.5 * stress**2 / np.array(stiffness)


def loading_energy(law: Foam, strain: float) -> float:
    """Area under the loading curve from 0 to ``strain`` (J/m³), piecewise between yield and densification."""
    if strain <= law.yield_strain:
        return 0.5 * law.modulus * strain**2 if strain > 0.0 or law.tension else 0.0
    corners = sorted({law.yield_strain, min(max(law.densification, law.yield_strain), strain), strain})
    total = 0.5 * law.modulus * law.yield_strain**2
    for low, high in itertools.pairwise(corners):
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        total += half * sum(w * law.loading(middle + half * p)[0] for p, w in zip(_POINTS, _WEIGHTS, strict=True))
    return total
