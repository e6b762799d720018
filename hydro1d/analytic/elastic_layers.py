"""Elastic waves in two bonded layers: a pressure at the left end, an interface, a wall, free or silent right end.

d'Alembert: stress = f(t - X/c) + g(t + X/c), velocity = (f - g)/Z, with Z = sqrt(E rho0) and c = sqrt(E/rho0). At an
interface a wave of stress f gives R f back and T f on, R = (Z2 - Z1)/(Z2 + Z1), T = 1 + R; a wall has R = 1, a free end
R = -1 (K. F. Graff, Wave Motion in Elastic Solids, 1975, section 2.2). Every wave is a sum of the applied pressure at
earlier times t - a T1 - b T2, T1 and T2 the transit times; the factors follow from the reflections, order by order.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, Flags, coordinates, finite, positive, require, times
from hydro1d.analytic.jumps import Fields, Jump, State, rest_state

_END_REFLECTION = {"wall": 1.0, "free": -1.0, "transmitting": 0.0}


@dataclass(frozen=True)
class ElasticLayer:
    """density kg/m^3, modulus Pa, thickness m."""

    density: float
    modulus: float
    thickness: float

    def __post_init__(self) -> None:
        positive(self, "density", "modulus", "thickness")

    @property
    def impedance(self) -> float:
        """Z, kg/(m^2 s)."""
        return math.sqrt(self.modulus * self.density)

    @property
    def wave_speed(self) -> float:
        """c, Lagrangian, m/s."""
        return math.sqrt(self.modulus / self.density)

    @property
    def transit_time(self) -> float:
        """Thickness over wave speed, s."""
        return self.thickness / self.wave_speed

    def state(self, right_going: float, left_going: float) -> State:
        """State where waves of these stresses (Pa) meet."""
        fields = self.fields(np.asarray(right_going), np.asarray(left_going))
        return State(*(float(value) for value in fields))

    def fields(self, right_going: Array, left_going: Array) -> Fields:
        """Fields where waves of these stresses (Pa) meet."""
        stress = right_going + left_going
        strain = stress / self.modulus
        velocity = (right_going - left_going) / self.impedance
        return Fields(velocity, stress, strain, self.density / (1.0 - strain), 0.5 * stress * strain / self.density)


def reflection(ahead: ElasticLayer, beyond: ElasticLayer) -> float:
    """Stress reflected at the interface over incident stress, wave coming from `ahead`."""
    return (beyond.impedance - ahead.impedance) / (beyond.impedance + ahead.impedance)


def transmission(ahead: ElasticLayer, beyond: ElasticLayer) -> float:
    """Stress transmitted through the interface over incident stress."""
    return 2.0 * beyond.impedance / (beyond.impedance + ahead.impedance)


@dataclass(frozen=True)
class ElasticLayers:
    """Two bonded elastic layers, a pressure history on the left end, `right_end` wall, free or transmitting.

    pressure(t) takes an array of times >= 0 (s) and returns Pa, a jump at t = 0 allowed (a `Pulse.pressure` fits).
    Called with (coordinate, t), which broadcast; exact for all times, through all echoes. The layers stay bonded,
    tension included; small strain is not assumed.
    """

    first: ElasticLayer
    second: ElasticLayer
    pressure: Callable[[Array], Array]
    right_end: Literal["wall", "free", "transmitting"] = "wall"

    def __post_init__(self) -> None:
        allowed = ", ".join(_END_REFLECTION)
        require(self.right_end in _END_REFLECTION, "right_end", self.right_end, f"one of {allowed}")

    @property
    def arrival_time(self) -> float:
        """When the head arrives at the interface, s."""
        return self.first.transit_time

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s); on the interface, those of the second layer (strain jumps there)."""
        coordinate = coordinates(coordinate, self.first.thickness + self.second.thickness)
        coordinate, t = np.broadcast_arrays(coordinate, times(finite("t", t)))
        inside: Flags = coordinate < self.first.thickness
        near, far = coordinate / self.first.wave_speed, (coordinate - self.first.thickness) / self.second.wave_speed
        down_1, up_1, down_2, up_2 = self._echoes(float(np.max(t, initial=0.0)))
        left = self.first.fields(
            self._sum(down_1, t - near),
            self._sum(up_1, t - (self.first.transit_time - near)),
        )
        right = self.second.fields(
            self._sum(down_2, t - far),
            self._sum(up_2, t - (self.second.transit_time - far)),
        )
        return Fields(*(np.where(inside, a, b) for a, b in zip(left, right, strict=True)))

    def jumps(self, t: float) -> list[Jump]:
        """The head of the pulse at time t (s), which a pressure with a jump at t = 0 makes a front.

        The incident one; after the interface the reflected and the transmitted one, until either meets an end
        (ValueError after that).
        """
        last = self.first.transit_time + min(self.first.transit_time, self.second.transit_time)
        times(t, last, "then a front meets an end")
        height = float(self.pressure(np.asarray(0.0)))
        first, second = self.first, self.second
        if t < self.arrival_time:
            rest, behind = rest_state(first.density), first.state(height, 0.0)
            return [Jump(rest, behind, first.density, first.wave_speed, first.wave_speed * t)]
        since = t - self.arrival_time
        at = first.thickness - first.wave_speed * since
        arriving = float(self.pressure(np.asarray(2.0 * since)))
        back, on = reflection(first, second) * height, transmission(first, second) * height
        there = first.thickness + second.wave_speed * since
        return [
            Jump(first.state(arriving, 0.0), first.state(arriving, back), first.density, -first.wave_speed, at),
            Jump(rest_state(second.density), second.state(on, 0.0), second.density, second.wave_speed, there),
        ]

    def _sum(self, factors: Array, t: Array) -> Array:
        """A wave where it starts, from its factors on the pressure at t - a T1 - b T2."""
        wave = np.zeros_like(t)
        for (a, b), factor in np.ndenumerate(factors):
            since = t - a * self.first.transit_time - b * self.second.transit_time
            if factor != 0.0 and np.any(since >= 0.0):
                wave = wave + factor * np.where(since >= 0.0, self.pressure(np.maximum(since, 0.0)), 0.0)
        return wave

    def _echoes(self, last: float) -> tuple[Array, Array, Array, Array]:
        """Factors (a, b) of the four waves where they start, as far as time `last` needs.

        Right-going and left-going in the first layer, then in the second. At the left end the pressure is given, so
        what arrives there returns with its sign changed.
        """
        first, second = self.first, self.second
        shape = (int(last / first.transit_time) + 2, int(last / second.transit_time) + 2)
        down_1, up_1, down_2, up_2 = (np.zeros(shape) for _ in range(4))
        there, back = transmission(first, second), transmission(second, first)
        mirror, end = reflection(first, second), _END_REFLECTION[self.right_end]
        for a, b in np.ndindex(shape):
            from_left, from_right = (down_1[a - 1, b], up_1[a - 1, b]) if a > 0 else (0.0, 0.0)
            returning, arriving = (up_2[a, b - 1], down_2[a, b - 1]) if b > 0 else (0.0, 0.0)
            down_1[a, b] = (1.0 if a == b == 0 else 0.0) - from_right
            up_1[a, b] = mirror * from_left + back * returning
            down_2[a, b] = there * from_left - mirror * returning
            up_2[a, b] = end * arriving
        return down_1, up_1, down_2, up_2
