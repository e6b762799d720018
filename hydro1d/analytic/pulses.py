"""Pressure pulses with their first and second integral in time, in closed form.

Units: peak Pa, times s. `pressure(t)` in Pa, `impulse(t)` in Pa s, `impulse_integral(t)` in Pa s^2, shape of t >= 0.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, not_negative, positive, require

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(64)


class Pulse(ABC):
    """A pressure that is zero before t = 0."""

    @abstractmethod
    def _pressure(self, t: Array) -> Array: ...

    @abstractmethod
    def _impulse(self, t: Array) -> Array: ...

    @abstractmethod
    def _impulse_integral(self, t: Array) -> Array: ...

    def pressure(self, t: ArrayLike) -> Array:
        """Pressure, Pa."""
        return self._pressure(np.asarray(t, dtype=float))

    def impulse(self, t: ArrayLike) -> Array:
        """Integral of the pressure from 0 to t, Pa s."""
        return self._impulse(np.asarray(t, dtype=float))

    def impulse_integral(self, t: ArrayLike) -> Array:
        """Integral of the impulse from 0 to t, Pa s^2."""
        return self._impulse_integral(np.asarray(t, dtype=float))


@dataclass(frozen=True)
class RectangularPulse(Pulse):
    """peak (Pa) until `duration` (s), then nothing."""

    peak: float
    duration: float

    def __post_init__(self) -> None:
        positive(self, "peak", "duration")

    def _pressure(self, t: Array) -> Array:
        return np.where(t <= self.duration, self.peak, 0.0)

    def _impulse(self, t: Array) -> Array:
        return self.peak * np.minimum(t, self.duration)

    def _impulse_integral(self, t: Array) -> Array:
        loaded = np.minimum(t, self.duration)
        return self.peak * loaded * (t - 0.5 * loaded)


@dataclass(frozen=True)
class TriangularPulse(Pulse):
    """peak (1 - t/duration), then nothing. peak Pa, duration s."""

    peak: float
    duration: float

    def __post_init__(self) -> None:
        positive(self, "peak", "duration")

    def _pressure(self, t: Array) -> Array:
        return self.peak * np.maximum(1.0 - t / self.duration, 0.0)

    def _impulse(self, t: Array) -> Array:
        loaded = np.minimum(t, self.duration)
        return self.peak * loaded * (1.0 - 0.5 * loaded / self.duration)

    def _impulse_integral(self, t: Array) -> Array:
        loaded = np.minimum(t, self.duration)
        during = self.peak * loaded**2 * (0.5 - loaded / (6.0 * self.duration))
        return during + 0.5 * self.peak * self.duration * (t - loaded)


@dataclass(frozen=True)
class ExponentialPulse(Pulse):
    """peak exp(-t/decay). peak Pa, decay s."""

    peak: float
    decay: float

    def __post_init__(self) -> None:
        positive(self, "peak", "decay")

    def _pressure(self, t: Array) -> Array:
        return self.peak * np.exp(-t / self.decay)

    def _impulse(self, t: Array) -> Array:
        return -self.peak * self.decay * np.expm1(-t / self.decay)

    def _impulse_integral(self, t: Array) -> Array:
        return self.peak * self.decay**2 * _second_exponential(t / self.decay)


def _second_exponential(s: Array) -> Array:
    """s - 1 + exp(-s), by its series where the terms cancel."""
    series = s**2 * (0.5 - s * (1 / 6 - s * (1 / 24 - s * (1 / 120 - s * (1 / 720 - s / 5040)))))
    return np.where(s < 0.02, series, s + np.expm1(-s))


@dataclass(frozen=True)
class FriedlanderPulse(Pulse):
    """peak (1 - t/duration) exp(-decay t/duration), nothing after `duration`. peak Pa, duration s, decay plain."""

    peak: float
    duration: float
    decay: float

    def __post_init__(self) -> None:
        positive(self, "peak", "duration")
        not_negative(self, "decay")

    def _pressure(self, t: Array) -> Array:
        s = np.minimum(t / self.duration, 1.0)
        return self.peak * (1.0 - s) * np.exp(-self.decay * s)

    def _impulse(self, t: Array) -> Array:
        s = np.minimum(t / self.duration, 1.0)
        return self.peak * self.duration * self._moment(s, 0)

    def _impulse_integral(self, t: Array) -> Array:
        s = np.minimum(t / self.duration, 1.0)
        later = np.maximum(t - self.duration, 0.0) * self.impulse(self.duration)
        return self.peak * self.duration**2 * self._moment(s, 1) + later

    def _moment(self, s: Array, power: int) -> Array:
        """Integral over r from 0 to s of (s - r)^power (1 - r) exp(-decay r).

        By Gauss: to the last digits, where the closed forms cancel for short times and weak decays.
        """
        r = 0.5 * s[..., None] * (_NODES + 1.0)
        weight = 0.5 * s[..., None] * _WEIGHTS
        return np.sum(weight * (s[..., None] - r) ** power * (1.0 - r) * np.exp(-self.decay * r), axis=-1)


@dataclass(frozen=True)
class TablePulse(Pulse):
    """Straight lines between points; zero before the first time and after the last. times s (from 0), pressures Pa."""

    times: tuple[float, ...]
    pressures: tuple[float, ...]

    def __post_init__(self) -> None:
        same = len(self.times) == len(self.pressures) >= 2
        require(same, "pressures", self.pressures, "as many as times, at least 2")
        rising = self.times[0] >= 0.0 and bool(np.all(np.diff(self.times) > 0.0))
        require(rising, "times", self.times, "increasing and not negative")

    def _pressure(self, t: Array) -> Array:
        return np.interp(t, self.times, self.pressures, left=0.0, right=0.0)

    def _impulse(self, t: Array) -> Array:
        line, since, slope = self._line(t)
        start = np.asarray(self.pressures)[line]
        impulses, _ = self._at_points()
        return impulses[line] + since * (start + 0.5 * slope * since)

    def _impulse_integral(self, t: Array) -> Array:
        line, since, slope = self._line(t)
        start = np.asarray(self.pressures)[line]
        impulses, seconds = self._at_points()
        during = seconds[line] + since * (impulses[line] + since * (0.5 * start + slope * since / 6.0))
        return during + impulses[-1] * np.maximum(t - self.times[-1], 0.0)

    def _line(self, t: Array) -> tuple[Any, Array, Array]:
        """Index of the line, time since its start, its slope."""
        inside = np.clip(t, self.times[0], self.times[-1])
        line = np.clip(np.searchsorted(self.times, inside, side="right") - 1, 0, len(self.times) - 2)
        slopes = np.diff(self.pressures) / np.diff(self.times)
        return line, inside - np.asarray(self.times)[line], slopes[line]

    def _at_points(self) -> tuple[Array, Array]:
        """Impulse and its integral at the points."""
        p, h = np.asarray(self.pressures), np.diff(self.times)
        impulses = np.concatenate([[0.0], np.cumsum(0.5 * (p[:-1] + p[1:]) * h)])
        steps = h * impulses[:-1] + h**2 * (2.0 * p[:-1] + p[1:]) / 6.0
        return impulses, np.concatenate([[0.0], np.cumsum(steps)])
