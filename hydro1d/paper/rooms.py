"""Chains of masses by an integrator of their own, fast enough to ask thousands of pulses.

A spring is known by its room, 1 − ε: undamped masses drive it down to 1e-10, which a strain near 1 could hardly tell. Leapfrog,
with steps that follow the stiffest spring and the shortest time to a collision. No code is shared with the solver, whose
chain has half a mass at the loaded end; here that is a choice.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numba import njit

from hydro1d.paper import foam
from hydro1d.paper.boundary import Ending, at_rest
from hydro1d.sweep import find_flip


def _compiled(function: Callable) -> Any:
    return njit(function, error_model="numpy", nogil=True)


FULL = 1.0 - foam.LOCKING  # room at which hardening begins
SLENDER = 1.0 - foam.PLATEAU / foam.MODULUS  # room at yield
MODULUS, PLATEAU, DENSITY, LENGTH = foam.MODULUS, foam.PLATEAU, foam.DENSITY, foam.LENGTH
FASTEST = 1.2  # most by which a step exceeds the one before


class Chain(NamedTuple):
    """A chain of masses between a pressure pulse and a wall.

    end_mass: of the others', at the loaded end; plastic: springs unload on a steep line as the solver's foam does; pulls:
    springs bear tension; lock: room at which a plastic spring is taken for a rigid link, 0: never; cfl: of the stable step.
    """

    masses: int = 10
    end_mass: float = 1.0
    plastic: bool = False
    pulls: bool = True
    lock: float = 0.0
    beta: float = foam.BETA
    gamma: float = foam.GAMMA
    cfl: float = 0.01


class Story(NamedTuple):
    """When every spring has been past εD, the support has felt more than P, all springs are past εD at once (s; NaN: never).

    support: largest stress on the support, Pa; least_room: of any spring; steps: their number.
    """

    crushed: float
    enhanced: float
    together: float
    support: float
    least_room: float
    steps: int


def follow(chain: Chain, pressure: float, duration: float, end: float, until_settled: bool = False) -> Story:
    """The chain under a rectangular pulse (Pa, s) up to ``end`` (s), or until it has been crushed and enhanced."""
    mass = np.full(chain.masses, foam.DENSITY * foam.LENGTH / chain.masses)
    mass[0] *= chain.end_mass
    rate, start = chain.gamma * 0.5 * math.pi / FULL, math.tan((1.0 - chain.gamma) * 0.5 * math.pi)
    spring = (chain.beta, rate, start, float(chain.plastic), -math.inf if chain.pulls else 0.0, chain.lock)
    return Story(*march(mass, spring, pressure, duration, end, chain.cfl, until_settled))


class Band(NamedTuple):
    """Durations over Eq. 30: the shortest to which the answer is yes, and the one from which on it is always yes."""

    first: float
    last: float


def critical(
    chain: Chain, question: str, pressure: float, bracket: tuple[float, float], *, end: Ending = at_rest, scan: int = 12
) -> Band:
    """Where `Story` comes to answer the question, as far as ``scan`` pulses between two durations over Eq. 30 show; else NaN."""
    unit, which = foam.eq30(pressure), Story._fields.index(question)

    def decide(share: float) -> bool:
        duration = share * unit
        story = follow(chain, pressure, duration, end(pressure, duration), question != "together")
        return not math.isnan(story[which])

    shares = np.geomspace(*bracket, scan)
    said = np.array([decide(share) for share in shares])
    changes = np.flatnonzero(~said[:-1] & said[1:])
    if not len(changes) or not said[-1]:
        return Band(math.nan, math.nan)
    first, last = (find_flip(decide, shares[k], shares[k + 1], scan=2).value for k in (changes[0], changes[-1]))
    return Band(first, last)


def answers(chain: Chain, pressure: float, shares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Whether the chain is crushed, and whether it is enhanced, at these durations over Eq. 30."""
    durations = [float(share) * foam.eq30(pressure) for share in shares]
    stories = [follow(chain, pressure, duration, at_rest(pressure, duration), True) for duration in durations]
    crushed, enhanced = (~np.isnan([getattr(s, name) for s in stories]) for name in ("crushed", "enhanced"))
    return crushed, enhanced


@_compiled
def stress_and_stiffness(room: float, spring: tuple) -> tuple[float, float]:
    """Eq. 38 at this room, elastic in tension, Pa."""
    if room > SLENDER:
        return MODULUS * (1.0 - room), MODULUS
    if room > FULL:
        return PLATEAU, 0.0
    beta, rate, start = spring[0], spring[1], spring[2]
    rise = 1.0 / math.tan(rate * room)
    return PLATEAU * (1.0 + beta * (rise - start)), PLATEAU * beta * rate * (1.0 + rise * rise)


@_compiled
def press(room: np.ndarray, least: np.ndarray, rigid: np.ndarray, stress: np.ndarray, spring: tuple) -> float:
    """Stress of every spring that is no rigid link; returns the largest stiffness, Pa."""
    plastic, least_stress, lock = spring[3], spring[4], spring[5]
    largest = MODULUS
    for i in range(len(room)):
        least[i] = min(least[i], room[i])
        if rigid[i]:
            continue
        if plastic > 0.0 and room[i] > least[i]:
            top, stiffness = stress_and_stiffness(least[i], spring)
            stiffness = max(stiffness, MODULUS)
            stress[i] = top - stiffness * (room[i] - least[i])
        else:
            stress[i], stiffness = stress_and_stiffness(room[i], spring)
        stress[i] = max(stress[i], least_stress)
        largest = max(largest, stiffness)
        rigid[i] = plastic > 0.0 and room[i] < lock
    return largest


@_compiled
def push(
    mass: np.ndarray, velocity: np.ndarray, stress: np.ndarray, rigid: np.ndarray, load: float, kick: float
) -> None:
    """Kick masses; those that are linked move as one, and with the wall not at all."""
    count, first = len(mass), 0
    while first < count:
        last, heavy, momentum = first, mass[first], mass[first] * velocity[first]
        while last < count and rigid[last]:
            last += 1
            if last < count:
                heavy += mass[last]
                momentum += mass[last] * velocity[last]
        if last == count:
            velocity[first:] = 0.0
        else:
            before = load if first == 0 else stress[first - 1]
            velocity[first : last + 1] = (momentum + (before - stress[last]) * kick) / heavy
        first = last + 1


@_compiled
def soonest(room: np.ndarray, velocity: np.ndarray, size: float) -> float:
    """Shortest time (s) in which a spring that closes would have no room left."""
    least = math.inf
    for i in range(len(room)):
        closing = velocity[i] - velocity[i + 1]
        if closing > 0.0:
            least = min(least, room[i] * size / closing)
    return least


@_compiled
def march(
    mass: np.ndarray, spring: tuple, pressure: float, duration: float, end: float, cfl: float, until_settled: bool
) -> tuple[float, float, float, float, float, int]:
    """The time loop of `follow`."""
    count, size = len(mass), LENGTH / len(mass)
    room, least, velocity = np.ones(count), np.ones(count), np.zeros(count + 1)
    stress, rigid = np.zeros(count), np.zeros(count, dtype=np.bool_)
    crushed = enhanced = together = math.nan
    time = last = support = 0.0
    steps = 0
    while time < end:
        stiffness = press(room, least, rigid, stress, spring)
        support = max(support, stress[-1])
        crushed = time if crushed != crushed and least.max() < FULL else crushed
        together = time if together != together and room.max() < FULL else together
        enhanced = time if enhanced != enhanced and stress[-1] > pressure else enhanced
        if until_settled and crushed == crushed and enhanced == enhanced:
            break
        step = cfl * min(size * math.sqrt(DENSITY / stiffness), soonest(room, velocity, size))
        step = min(step, FASTEST * last) if last > 0.0 else step
        if time < duration < time + step:
            step = duration - time
        push(mass, velocity, stress, rigid, pressure if time < duration else 0.0, 0.5 * (last + step))
        room -= step / size * (velocity[:-1] - velocity[1:])
        time, last, steps = time + step, step, steps + 1
    return crushed, enhanced, together, support, least.min(), steps
