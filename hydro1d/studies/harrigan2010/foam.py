"""The foam of the paper's Table 1 and the curves that stand for it."""

import math

import numpy as np
from scipy.optimize import least_squares

from hydro1d import analytic
from hydro1d.analytic.rppl_pulse import critical_duration

DENSITY, MODULUS, PLATEAU, LOCKING, SLOPE = 51.6, 22e6, 0.8e6, 0.689, 0.00105
BETA, GAMMA = 1.22, 0.603
LENGTH, PRESSURE, DURATION = 1.0, 3.6e6, 1.53e-3
RATE = math.sqrt(MODULUS / DENSITY) / LENGTH  # τ = RATE t
RIGID = analytic.RPPL(DENSITY, PLATEAU, LOCKING)
LINEAR = analytic.EPPH(DENSITY, MODULUS, PLATEAU, LOCKING, SLOPE)
TANGENT = analytic.TangentEPPH(DENSITY, MODULUS, PLATEAU, LOCKING, BETA, GAMMA)


def eq30(pressure: float) -> float:
    """Critical duration of the shock theory for R-P-P-L, s."""
    return float(critical_duration(RIGID, pressure, LENGTH))


def eq30_line(lowest: float, highest: float) -> tuple[np.ndarray, np.ndarray]:
    """Eq. 30 drawn smoothly: durations (s) and pressures (Pa)."""
    pressures = np.linspace(lowest, highest, 200)
    return np.array([eq30(float(p)) for p in pressures]), pressures


def fit_tangent(velocities: np.ndarray) -> tuple[float, float, float]:
    """β, γ of Eq. 38 that fit the strains of Eq. 39 at these [v] (m/s), and the rms difference of strain."""
    found = least_squares(lambda x: _difference(velocities, *x), [1.0, 0.5], bounds=([0.05, 0.05], [10.0, 0.99]))
    beta, gamma = found.x
    return float(beta), float(gamma), float(np.sqrt(np.mean(found.fun**2)))


def misfit(velocities: np.ndarray, beta: float, gamma: float) -> float:
    """Root mean square difference of strain between Eq. 38 with this β and γ and Eq. 39."""
    return float(np.sqrt(np.mean(_difference(velocities, beta, gamma) ** 2)))


def _difference(velocities: np.ndarray, beta: float, gamma: float) -> np.ndarray:
    curve = analytic.TangentEPPH(DENSITY, MODULUS, PLATEAU, LOCKING, float(beta), float(gamma))
    return np.asarray(analytic.compaction_hugoniot(curve, velocities).strain) - (LOCKING + SLOPE * velocities)
