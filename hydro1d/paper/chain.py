"""A chain of equal masses, on its own: against it the solver's chain, whose mass at the loaded end "
"is half as heavy."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from hydro1d.paper import foam


class Trajectories(NamedTuple):
    """Times (s), positions (times, masses) in m, largest strain of each spring, largest force on the support (Pa)."""

    time: np.ndarray
    position: np.ndarray
    largest_strain: np.ndarray
    support: float
    energy_error: float


def spring(strain: np.ndarray, beta: float, gamma: float) -> np.ndarray:
    """Stress of Eq. 38, elastic in tension, Pa."""
    over = np.maximum(strain - foam.LOCKING, 0.0)
    start = (1.0 - gamma) * 0.5 * math.pi
    angle = start + gamma * 0.5 * math.pi * over / (1.0 - foam.LOCKING)
    rise = np.where(over < 1.0 - foam.LOCKING, np.tan(angle), 1e30) - math.tan(
        start
    )  # a trial step beyond ε = 1 is undone
    return np.minimum(foam.MODULUS * strain, foam.PLATEAU) + foam.PLATEAU * beta * rise


def potential(strain: np.ndarray, beta: float, gamma: float) -> np.ndarray:
    """Energy stored in the springs at that strain, J/m³: the integral of `spring`, in closed form."""
    turn = foam.PLATEAU / foam.MODULUS
    low = np.where(strain < turn, 0.5 * foam.MODULUS * strain**2, foam.PLATEAU * (strain - 0.5 * turn))
    over = np.maximum(strain - foam.LOCKING, 0.0)
    start, rate = (1.0 - gamma) * 0.5 * math.pi, gamma * 0.5 * math.pi / (1.0 - foam.LOCKING)
    logarithm = -np.log(np.cos(start + rate * over) / math.cos(start)) / rate
    return low + foam.PLATEAU * beta * (logarithm - math.tan(start) * over)


def equal_masses(count: int, pressure: float, duration: float, end: float, beta: float, gamma: float) -> Trajectories:
    """``count`` equal masses and springs between load and rigid support, by a Runge-Kutta method of order 8."""
    size, mass = foam.LENGTH / count, foam.DENSITY * foam.LENGTH / count

    def rates(t: float, state: np.ndarray, load: float) -> np.ndarray:
        moved, velocity = state[:count], state[count : 2 * count]
        strain = -np.diff(np.append(moved, 0.0)) / size
        stress = spring(strain, beta, gamma)
        force = np.concatenate([[load], stress[:-1]]) - stress
        return np.concatenate([velocity, force / mass, [load * velocity[0]]])

    start, times, states = np.zeros(2 * count + 1), [np.zeros(1)], [np.zeros((2 * count + 1, 1))]
    for begin, stop, load in ((0.0, duration, pressure), (duration, end, 0.0)):
        found = solve_ivp(rates, (begin, stop), start, "DOP853", args=(load,), rtol=1e-11, atol=1e-13)
        if not found.success:
            raise RuntimeError(found.message)
        start = found.y[:, -1]
        times.append(found.t[1:])
        states.append(found.y[:, 1:])
    time, state = np.concatenate(times), np.concatenate(states, axis=1)
    moved = np.vstack([state[:count], np.zeros(len(time))])
    strain = -np.diff(moved, axis=0) / size
    energy = 0.5 * mass * np.sum(state[count : 2 * count] ** 2, axis=0) + size * potential(strain, beta, gamma).sum(
        axis=0
    )
    worst = float(np.max(np.abs(energy - state[-1])) / np.max(state[-1]))
    position = (np.arange(count + 1)[:, None] * size + moved).T
    return Trajectories(time, position, strain.max(axis=1), float(spring(strain[-1], beta, gamma).max()), worst)
