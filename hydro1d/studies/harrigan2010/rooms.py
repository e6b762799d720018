"""Chains of masses by an integrator of their own, fast enough to ask thousands of pulses.

A spring is known by its room, 1 − ε: undamped masses drive it down to 1e-10, which a strain near 1 could hardly tell. Leapfrog,
with steps that follow the stiffest spring and the shortest time to a collision. No code is shared with the solver, whose
chain has half a mass at the loaded end; here that is a choice.
"""

import functools
import math
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future
from typing import Any, NamedTuple

import numpy as np

from hydro1d.jit import build, reach
from hydro1d.scheme.records import record
from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.boundary import Ending, at_rest
from hydro1d.sweep import find_flip

FULL = 1.0 - foam.LOCKING  # room at which hardening begins
SLENDER = 1.0 - foam.PLATEAU / foam.MODULUS  # room at yield
MODULUS, PLATEAU, DENSITY, LENGTH = foam.MODULUS, foam.PLATEAU, foam.DENSITY, foam.LENGTH
FASTEST = 1.2  # most by which a step exceeds the one before

LOAD = record("beta rate start min_stress lock pressure duration end cfl", flags="plastic until_settled")


class Masses(NamedTuple):
    """What `march` works on: springs and load by `LOAD`; over springs room, least room, stress, and 1 where it is a rigid link;
    over masses mass and, one more, velocity; what comes out, a `Story`."""

    told: Any
    mass: Any
    room: Any
    least: Any
    velocity: Any
    stress: Any
    rigid: Any
    out: Any
    masses: int


SHARED = build.Shared("Masses", {name: "f8" for name in Masses._fields} | {"told": LOAD, "masses": int})


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
    steps: float


def follow(chain: Chain, pressure: float, duration: float, end: float, until_settled: bool = False) -> Story:
    """The chain under a rectangular pulse (Pa, s) up to ``end`` (s), or until it has been crushed and enhanced."""
    mass = np.full(chain.masses, DENSITY * LENGTH / chain.masses)
    mass[0] *= chain.end_mass
    rate, start = chain.gamma * 0.5 * math.pi / FULL, math.tan((1.0 - chain.gamma) * 0.5 * math.pi)
    told = np.zeros(1, dtype=LOAD).view(np.recarray)
    told.beta, told.rate, told.start, told.plastic = chain.beta, rate, start, chain.plastic
    told.min_stress, told.lock, told.cfl = -math.inf if chain.pulls else 0.0, chain.lock, chain.cfl
    told.pressure, told.duration, told.end, told.until_settled = pressure, duration, end, until_settled
    room, least = np.ones(chain.masses), np.ones(chain.masses)
    velocity, stress, rigid = np.zeros((3, chain.masses + 1))
    out = np.full(len(Story._fields), math.nan)
    _marching()(Masses(told, mass, room, least, velocity, stress, rigid, out, chain.masses))
    return Story(*out.tolist())


class Band(NamedTuple):
    """Durations over Eq. 30: the shortest to which the answer is yes, and the one from which on it is always yes."""

    first: Any
    last: Any


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


QUESTIONS = {"fully_crushed": "crushed", "enhanced": "enhanced"}  # criteria of the solver's runs, fields of `Story`


def ask(
    pool: Executor, chain: Chain, pressures: Sequence[float], bracket: tuple[float, float], scan: int = 12
) -> dict[str, list[Future[Band]]]:
    """Submit `critical` at every pressure (Pa) for both criteria; the answers come by criterion."""
    return {
        criterion: [pool.submit(critical, chain, question, p, bracket, scan=scan) for p in pressures]
        for criterion, question in QUESTIONS.items()
    }


def answers(chain: Chain, pressure: float, shares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Whether the chain is crushed, and whether it is enhanced, at these durations over Eq. 30."""
    durations = [float(share) * foam.eq30(pressure) for share in shares]
    stories = [follow(chain, pressure, duration, at_rest(pressure, duration), True) for duration in durations]
    crushed, enhanced = (~np.isnan([getattr(s, name) for s in stories]) for name in ("crushed", "enhanced"))
    return crushed, enhanced


@functools.cache
def _marching() -> Callable[[Masses], object]:
    """`march` for arrays, compiled, or as it stands for a debugger."""
    if build.interpreted():
        return lambda m: march(m._replace(told=m.told[0]))
    request = build.Request("chain of rooms", lambda _copies: march, lambda: reach.digest(march), is_leaf=False)
    run = build.function(build.address(request, SHARED))

    def marched(m: Masses) -> None:
        table = build.table(m, SHARED.fields)  # must outlive the call, during which other threads ask for memory
        run(table.ctypes.data)

    return marched


def stress_and_stiffness(room: float, told: Any) -> tuple[float, float]:
    """Eq. 38 at this room, elastic in tension, Pa."""
    if room > SLENDER:
        return MODULUS * (1.0 - room), MODULUS
    if room > FULL:
        return PLATEAU, 0.0
    rise = 1.0 / math.tan(told.rate * room)
    scale = PLATEAU * told.beta
    return PLATEAU + scale * (rise - told.start), scale * told.rate * (1.0 + rise * rise)


def press(m: Masses) -> float:
    """Stress of every spring that is no rigid link; returns the largest stiffness, Pa."""
    told, room, least, largest = m.told, m.room, m.least, MODULUS
    for i in range(m.masses):
        least[i] = min(least[i], room[i])
        if m.rigid[i] > 0.0:
            continue
        if told.plastic and room[i] > least[i]:
            top, stiffness = stress_and_stiffness(least[i], told)
            stiffness = max(stiffness, MODULUS)
            m.stress[i] = top - stiffness * (room[i] - least[i])
        else:
            m.stress[i], stiffness = stress_and_stiffness(room[i], told)
        m.stress[i] = max(m.stress[i], told.min_stress)
        largest = max(largest, stiffness)
        m.rigid[i] = 1.0 if told.plastic and room[i] < told.lock else 0.0
    return largest


def push(m: Masses, load: float, kick: float) -> None:
    """Kick masses; those that are linked move as one, and with the wall not at all."""
    first, count = 0, m.masses
    while first < count:
        last, heavy, momentum = first, m.mass[first], m.mass[first] * m.velocity[first]
        while last < count and m.rigid[last] > 0.0:
            last += 1
            if last < count:
                heavy += m.mass[last]
                momentum += m.mass[last] * m.velocity[last]
        after = 0.0
        if last < count:
            before = load if first == 0 else m.stress[first - 1]
            after = (momentum + (before - m.stress[last]) * kick) / heavy
        for i in range(first, min(last + 1, count)):
            m.velocity[i] = after
        first = last + 1


def soonest(room: Any, velocity: Any, size: float, count: int) -> float:
    """Shortest time (s) in which a spring that closes would have no room left."""
    least = math.inf
    for i in range(count):
        closing = velocity[i] - velocity[i + 1]
        if closing > 0.0:
            least = min(least, room[i] * size / closing)
    return least


def march(m: Masses) -> None:
    """The time loop of `follow`; `out` is a `Story`, its first three places NaN."""
    told, room, out, count = m.told, m.room, m.out, m.masses
    size, time, last, support, steps = LENGTH / count, 0.0, 0.0, 0.0, 0
    while time < told.end:
        stiffness = press(m)
        support = max(support, m.stress[count - 1])
        widest = widest_ever = 0.0
        for i in range(count):
            widest, widest_ever = max(widest, room[i]), max(widest_ever, m.least[i])
        out[0] = time if out[0] != out[0] and widest_ever < FULL else out[0]
        out[1] = time if out[1] != out[1] and m.stress[count - 1] > told.pressure else out[1]
        out[2] = time if out[2] != out[2] and widest < FULL else out[2]
        if told.until_settled and out[0] == out[0] and out[1] == out[1]:
            break
        step = told.cfl * min(size * math.sqrt(DENSITY / stiffness), soonest(room, m.velocity, size, count))
        step = min(step, FASTEST * last) if last > 0.0 else step
        if time < told.duration < time + step:
            step = told.duration - time
        push(m, told.pressure if time < told.duration else 0.0, 0.5 * (last + step))
        for i in range(count):
            room[i] -= step / size * (m.velocity[i] - m.velocity[i + 1])
        time, last, steps = time + step, step, steps + 1
    narrowest = 1.0
    for i in range(count):
        narrowest = min(narrowest, m.least[i])
    out[3], out[4], out[5] = support, narrowest, steps
