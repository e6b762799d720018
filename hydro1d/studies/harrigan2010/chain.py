"""A chain of equal masses by an independent integrator.

The solver's own chain has half a mass at the loaded end. Springs are known by their room, 1 − ε: undamped masses
collide down to a room of 1e-10, which a strain near 1 could not tell.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from hydro1d.studies.harrigan2010 import foam

_FULL = 1.0 - foam.LOCKING  # room at which hardening begins


class Trajectories(NamedTuple):
    """Times (s), positions (times, masses + 1) in m, largest force on the support (Pa), largest error of energy."""

    time: np.ndarray
    position: np.ndarray
    support: float
    energy_error: float


def spring(room: np.ndarray, beta: float, gamma: float) -> np.ndarray:
    """Stress of Eq. 38 at this room, elastic in tension, Pa."""
    rate, start = _angles(gamma)
    inside = np.clip(room, 1e-300, _FULL)  # a trial step beyond ε = 1 is undone
    rise = 1.0 / np.tan(rate * inside) - math.tan(start)
    return np.minimum(foam.MODULUS * (1.0 - room), foam.PLATEAU) + foam.PLATEAU * beta * rise


def potential(room: np.ndarray, beta: float, gamma: float) -> np.ndarray:
    """Energy stored in the springs at this room, J/m³: the integral of `spring`, in closed form."""
    strain, turn = 1.0 - room, foam.PLATEAU / foam.MODULUS
    low = np.where(strain < turn, 0.5 * foam.MODULUS * strain**2, foam.PLATEAU * (strain - 0.5 * turn))
    rate, start = _angles(gamma)
    inside = np.minimum(room, _FULL)
    logarithm = -np.log(np.sin(rate * inside) / math.cos(start)) / rate
    return low + foam.PLATEAU * beta * (logarithm - math.tan(start) * (_FULL - inside))


def _angles(gamma: float) -> tuple[float, float]:
    """Angle of Eq. 38 for a room of 1, and the angle where hardening begins."""
    return gamma * 0.5 * math.pi / _FULL, (1.0 - gamma) * 0.5 * math.pi


def equal_masses(count: int, pressure: float, duration: float, end: float, beta: float, gamma: float) -> Trajectories:
    """``count`` equal masses and springs between load and rigid support, by a Runge-Kutta method of order 8."""
    size, mass = foam.LENGTH / count, foam.DENSITY * foam.LENGTH / count

    def rates(t: float, state: np.ndarray, load: float) -> np.ndarray:
        room, velocity = state[:count], state[count : 2 * count]
        stress = spring(room, beta, gamma)
        force = np.concatenate([[load], stress[:-1]]) - stress
        return np.concatenate([np.diff(velocity, append=0.0) / size, force / mass, [load * velocity[0]]])

    time, state = _integrate(rates, count, ((0.0, duration, pressure), (duration, end, 0.0)))
    room, velocity, work = state[:count], state[count : 2 * count], state[-1]
    energy = 0.5 * mass * np.sum(velocity**2, axis=0) + size * np.sum(potential(room, beta, gamma), axis=0)
    worst = float(np.max(np.abs(energy - work)) / np.max(work))
    support = float(spring(room[-1], beta, gamma).max())
    from_wall = np.cumsum(np.vstack([np.zeros(len(time)), size * room[::-1]]), axis=0)[::-1]
    return Trajectories(time, (foam.LENGTH - from_wall).T, support, worst)


def _integrate(rates: object, count: int, stages: tuple) -> tuple[np.ndarray, np.ndarray]:
    """Times and states (rooms, velocities, work done; times) from rest, stage by stage."""
    state = np.concatenate([np.ones(count), np.zeros(count + 1)])
    floor = np.concatenate([np.full(count, 1e-18), np.full(count, 1e-9), [1e-6]])  # what counts as nothing
    times, states = [np.zeros(1)], [state[:, None]]
    for begin, stop, load in stages:
        found = solve_ivp(rates, (begin, stop), state, "DOP853", args=(load,), rtol=1e-10, atol=floor)
        if not found.success:
            raise RuntimeError(found.message)
        state = found.y[:, -1]
        times.append(found.t[1:])
        states.append(found.y[:, 1:])
    return np.concatenate(times), np.concatenate(states, axis=1)
