"""The laws of a run or a deck, and what their curves say."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from hydro1d.deck import Deck, load_deck
from hydro1d.deck.messages import suggestion
from hydro1d.errors import DeckError, Hydro1dError
from hydro1d.laws.base import Law
from hydro1d.store import Run


def deck_of(run: Run, deck: Deck | str | Path | None = None) -> Deck | None:
    """The deck that a figure takes its laws from: the one given, else the run's own.

    None where the run's deck names Python files of its user: they are not run for a figure unless the user names the
    deck.
    """
    if deck is not None:
        return deck if isinstance(deck, Deck) else load_deck(deck)
    kinds = [str(law.get("law", "")) for law in run.deck.get("material", {}).values()]
    kinds += [str(run.deck.get(side, {}).get(key, "")) for side in ("left", "right") for key in ("type", "pulse")]
    if any(".py" in kind for kind in kinds):
        return None
    try:
        return load_deck(run.deck)
    except Hydro1dError:  # a law that this installation does not have
        return None


def loads_by_strain(law: Law) -> bool:
    """Whether the law is a curve of the strain: gases and laws that need energy or rate are not."""
    if callable(getattr(law, "loading", None)):
        return True
    energy = law.initial_energy + 1e3
    cases = ((0.0, 0.0), (1e3, 0.0), (0.0, energy))
    answers = [law.at(0.01, 0.01, rate=rate, energy=heat).stress for rate, heat in cases]
    return answers[0] == answers[1] == answers[2]


_MIN_SHARE = 1e-6  # of the energy: a front that dissipates less is no shock
_EVEN = 1.0 + 1e-9  # slopes as equal as their rounding are one line


class Hugoniot(NamedTuple):
    """Compaction shocks of a foam loaded from rest, arrays over the strain behind them; SI.

    strain and stress behind the shock; foot, the strain ahead of it; velocity_jump [v]; front_speed [v]/[ε], Lagrangian;
    shock_energy, along the curve to the foot and then ½(σA + σB)[ε], and curve_energy, the area under the curve, both per
    initial volume from the yield point on.
    """

    strain: np.ndarray
    stress: np.ndarray
    foot: np.ndarray
    velocity_jump: np.ndarray
    front_speed: np.ndarray
    shock_energy: np.ndarray
    curve_energy: np.ndarray


def curve(law: Law, strains: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Loading stress and tangent (Pa) at strains."""
    if callable(getattr(law, "loading", None)):
        answers = np.array([law.loading(float(strain)) for strain in strains])  # type: ignore[attr-defined]
    else:
        responses = [law.at(strain, strain) for strain in strains]
        answers = np.array([(response.stress, response.tangent) for response in responses])
    return answers[:, 0], answers[:, 1]


def strain_grid(law: Law, top: float, points: int = 600) -> np.ndarray:
    """Strains from 0 to `top` with the corners of the curve among them."""
    corners = [getattr(law, name, None) for name in ("yield_strain", "densification")]
    inside = [float(value) for value in corners if value is not None and 0.0 < float(value) < top]
    return np.unique(np.concatenate([np.linspace(0.0, top, points), inside]))


def top_strain(law: Law, ratio: float = 12.0) -> float:
    """A strain to draw the curve to: where the stress is `ratio` times that of the knee, short of 1.

    The knee is where the tangent has fallen to half of that at rest: a rounded one leaves the elastic line, and so yields
    for the law, far below it.
    """
    strain = np.linspace(0.0, 0.995, 4000)
    stress, tangent = curve(law, strain)
    bent = np.flatnonzero(tangent <= 0.5 * tangent[0])
    if not len(bent):
        return 0.5
    above = np.flatnonzero(stress >= ratio * stress[max(bent[0] - 1, 1)])
    return max(float(strain[above[0]]), 0.02) if len(above) else 0.995


def hugoniot_of(law: Law, top: float) -> Hugoniot:
    """The last front of a step from rest to each strain up to `top`, where that is a shock (Eqs. 35, 37)."""
    strain = strain_grid(law, top, 1200)
    stress, _ = curve(law, strain)
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(strain))])
    foot = _feet(strain, stress)
    rise, change = stress - stress[foot], strain - strain[foot]
    crossed = 0.5 * (stress + stress[foot]) * change
    yielded = float(np.interp(min(float(getattr(law, "yield_strain", 0.0)), top), strain, energy))
    keep = crossed - (energy - energy[foot]) > _MIN_SHARE * crossed
    rise, change = rise[keep], change[keep]
    return Hugoniot(
        strain[keep],
        stress[keep],
        strain[foot[keep]],
        np.sqrt(rise * change / law.density),
        np.sqrt(rise / change / law.density),
        crossed[keep] + energy[foot[keep]] - yielded,
        energy[keep] - yielded,
    )


def _feet(strain: np.ndarray, stress: np.ndarray) -> np.ndarray:
    """For each point of a curve, the point ahead of the last front of a step there: the foot of its Rayleigh line.

    The fronts are the edges of the smallest concave majorant of the curve from rest to the point (Liu, J. Math. Anal. Appl.
    53 (1976) 78-88): at a corner the foot is the yield point; on a rounded knee it is where the Rayleigh line touches the
    curve, with a fan of ever slower waves before it; the origin where the shock would overtake the elastic wave.
    """
    hull, feet = [0], np.zeros(len(strain), dtype=int)
    for point in range(1, len(strain)):
        while len(hull) > 1 and _slope(strain, stress, *hull[-2:]) <= _slope(strain, stress, hull[-1], point) * _EVEN:
            hull.pop()
        feet[point] = hull[-1]
        hull.append(point)
    return feet


def _slope(strain: np.ndarray, stress: np.ndarray, first: int, second: int) -> float:
    return float((stress[second] - stress[first]) / (strain[second] - strain[first]))


def law_of_deck(deck: Deck, material: str | None = None) -> tuple[str, Law]:
    """Name and law of one material of a deck, the first without a name. Raises DeckError with the names there are."""
    laws = {layer.material: layer.law for layer in deck.layers}
    if material is None:
        return next(iter(laws.items()))
    if material not in laws:
        hint = suggestion(material, list(laws))
        raise DeckError(f"no layer of material {material[:80]!r}{hint}; there are {', '.join(laws)}")
    return material, laws[material]
