"""Plateau stress and densification strain by the energy-efficiency method, without any law.

Source: Li, Magkiriadis & Harrigan, J. Cellular Plastics 42 (2006) 371-392, doi:10.1177/0021955X06063519.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hydro1d.fit._curve import MeasuredCurve

_FALLEN = 0.95  # of its maximum: noise alone does not bring η lower


class Efficiency(NamedTuple):
    """efficiency η(ε) = ∫σ dε/σ over `strain`; densification_strain where it is largest; plateau_stress, Pa.

    complete: False where η has not fallen clearly at the last point, so that the curve ends before the foam densifies.
    """

    strain: np.ndarray
    efficiency: np.ndarray
    yield_strain: float
    densification_strain: float
    plateau_stress: float
    complete: bool


def energy_efficiency(curve: MeasuredCurve) -> Efficiency:
    """The method on a measured curve: εD maximises η, σP is the mean stress from yield to εD."""
    strain = np.concatenate([[0.0], curve.strain]) if curve.strain[0] > 0.0 else curve.strain
    stress = np.concatenate([[0.0], curve.stress]) if curve.strain[0] > 0.0 else curve.stress
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(strain))])
    efficiency = np.divide(energy, stress, out=np.zeros_like(energy), where=stress > 0.02 * stress.max() / 20.0)
    efficiency[strain < 0.02] = 0.0  # a noisy toe must not win
    best = int(np.argmax(efficiency))
    end = float(strain[best])
    # The mean from yield on depends on the yield strain, which is where the mean is first reached: settled in rounds.
    start = 0.0
    plateau = float(energy[best] / end)
    for _ in range(20):
        start = _first_reached(strain, stress, plateau)
        if not start < end:
            break
        plateau = float((energy[best] - np.interp(start, strain, energy)) / (end - start))
    return Efficiency(strain, efficiency, start, end, plateau, bool(efficiency[-1] < _FALLEN * efficiency[best]))


def _first_reached(strain: np.ndarray, stress: np.ndarray, level: float) -> float:
    """Strain at which the stress first reaches a level."""
    above = np.flatnonzero(stress >= level)
    if not len(above) or above[0] == 0:
        return 0.0
    k = int(above[0])
    share = (level - stress[k - 1]) / (stress[k] - stress[k - 1])
    return float(strain[k - 1] + share * (strain[k] - strain[k - 1]))
