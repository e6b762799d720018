"""Plateau stress and densification strain by the energy-efficiency method, without any law.

The efficiency η(ε) = ∫₀^ε σ dε / σ(ε) is the work up to a strain over the stress that it took (Miltz & Gruenbaum, Polym. Eng.
Sci. 21 (1981) 1010-1014; Avalle, Belingardi & Montanini, Int. J. Impact Eng. 25 (2001) 455-472). Where it is largest the foam
begins to densify, and the mean stress from yield to there is the plateau (Li, Magkiriadis & Harrigan, J. Cellular Plastics 42
(2006) 371-392, doi:10.1177/0021955X06063519).
"""

from typing import NamedTuple

import numpy as np

from hydro1d.fit._curve import MeasuredCurve

_FALLEN = 0.95  # of its maximum: noise alone does not bring η lower
_TOE = 0.02  # strains in which the specimen settles, and η is a quotient of small numbers
_BEND = 0.02  # of the last stress: a knee that is lower is none
WINDOW = (
    0.01  # strain on either side over which a stress is averaged: less than any plateau, more than a machine's noise
)


class Efficiency(NamedTuple):
    """efficiency η(ε) = ∫σ dε/σ over `strain`; densification_strain where it is largest; plateau_stress, Pa.

    yield_strain: the knee of the curve, from where the plateau is averaged.
    complete: False where η has not fallen clearly at the last point, so that the curve ends before the foam densifies.
    """

    strain: np.ndarray
    efficiency: np.ndarray
    yield_strain: float
    densification_strain: float
    plateau_stress: float
    complete: bool


def energy_efficiency(curve: MeasuredCurve) -> Efficiency:
    """The method on a measured curve: εD maximises η, σP is the mean stress from the yield strain to εD."""
    strain = np.concatenate([[0.0], curve.strain]) if curve.strain[0] > 0.0 else curve.strain
    stress = np.concatenate([[0.0], curve.stress]) if curve.strain[0] > 0.0 else curve.stress
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(strain))])
    smooth = averaged(strain, stress)
    efficiency = np.divide(energy, smooth, out=np.zeros_like(energy), where=smooth > 0.001 * stress.max())
    efficiency[strain < _TOE] = 0.0
    best = int(np.argmax(efficiency))
    end = float(strain[best])
    yielded = _knee(strain[: best + 1], smooth[: best + 1])
    plateau = float((energy[best] - energy[yielded]) / (end - strain[yielded]))
    complete = bool(efficiency[-1] < _FALLEN * efficiency[best])
    return Efficiency(strain, efficiency, float(strain[yielded]), end, plateau, complete)


def _knee(strain: np.ndarray, stress: np.ndarray) -> int:
    """The point that stands highest above the chord from the first to the last one; the first, for a curve without a knee.

    It is not sought by a level of stress: where the plateau rises, the curve passes its mean halfway, and the mean of the
    rest is higher still.
    """
    chord = stress[0] + (stress[-1] - stress[0]) / (strain[-1] - strain[0]) * (strain - strain[0])
    knee = int(np.argmax(stress - chord))
    return knee if stress[knee] - chord[knee] > _BEND * stress[-1] else 0


def averaged(strain: np.ndarray, stress: np.ndarray) -> np.ndarray:
    """Mean stress around each point, over as much before as behind it; of a curve of few points, the points themselves."""
    reach = np.minimum(WINDOW, np.minimum(strain - strain[0], strain[-1] - strain)) * (1.0 + 1e-9)
    first = np.searchsorted(strain, strain - reach, side="left")
    behind = np.searchsorted(strain, strain + reach, side="right")
    total = np.concatenate([[0.0], np.cumsum(stress)])
    return (total[behind] - total[first]) / (behind - first)
