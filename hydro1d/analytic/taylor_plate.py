"""Taylor's free plate: an exponential pulse in a fluid (or elastic medium) meets a plate that is free to move.

M dv/dt + rho c v = 2 p0 exp(-t/theta); the medium cannot pull, so it cavitates at the plate when the pressure there
falls to zero. Source: G. I. Taylor, "The pressure and impulse of submarine explosion waves on plates" (1941),
Scientific Papers III, Cambridge 1963, 287-303; with beta = rho c theta/M the time is theta ln(beta)/(beta - 1).
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, coordinates, not_negative, positive, times
from hydro1d.analytic.elastic_layers import ElasticLayer
from hydro1d.analytic.jumps import Fields, Jump, rest_state


class PlateHistory(NamedTuple):
    """displacement (m), velocity (m/s) of the plate, pressure on it (Pa): arrays of the shape of t."""

    displacement: Array
    velocity: Array
    pressure: Array


@dataclass(frozen=True)
class TaylorPlate:
    """Linear medium of `thickness` (m), loaded by peak exp(-t/decay) at coordinate 0, a free plate at its far end.

    density kg/m^3 and modulus Pa of the medium (sound speed sqrt(modulus/density)); mass of the plate per area,
    kg/m^2; peak Pa, decay s. t = 0 is when the pulse enters the medium; it arrives at `arrival_time`.
    Valid until cavitation or until the reflected wave is back at the loaded end: ValueError after `end_time`.
    """

    density: float
    modulus: float
    mass: float
    peak: float
    decay: float
    thickness: float = 0.0

    def __post_init__(self) -> None:
        positive(self, "density", "modulus", "mass", "peak", "decay")
        not_negative(self, "thickness")

    @property
    def _medium(self) -> ElasticLayer:  # the waves in it know no thickness, which may be zero here
        return ElasticLayer(self.density, self.modulus, self.thickness or 1.0)

    @property
    def sound_speed(self) -> float:
        """Lagrangian sound speed of the medium, m/s."""
        return self._medium.wave_speed

    @property
    def impedance(self) -> float:
        """rho c, kg/(m^2 s)."""
        return self._medium.impedance

    @property
    def beta(self) -> float:
        """rho c theta/M."""
        return self.impedance * self.decay / self.mass

    @property
    def arrival_time(self) -> float:
        """When the pulse arrives at the plate, s."""
        return self.thickness / self.sound_speed

    @property
    def cavitation_time(self) -> float:
        """When the pressure on the plate has fallen to zero, s."""
        excess = self.beta - 1.0
        ratio = math.log1p(excess) / excess if excess != 0.0 else 1.0
        return self.arrival_time + self.decay * ratio

    @property
    def end_time(self) -> float:
        """Cavitation; or, if sooner, the reflected wave is back at the loaded end, s."""
        returned = 2.0 * self.arrival_time if self.thickness > 0.0 else math.inf
        return min(self.cavitation_time, returned)

    @property
    def impulse(self) -> float:
        """Momentum per area of the plate at cavitation, Pa s."""
        return self.mass * float(self._velocity(np.asarray(self.cavitation_time - self.arrival_time)))

    def _velocity(self, since: Array) -> Array:
        """Velocity at a time since arrival; one form for every beta, 1 included."""
        s = np.maximum(since, 0.0) / self.decay
        return 2.0 * self.peak * self.decay / self.mass * np.exp(-s) * s * _relative_growth((1.0 - self.beta) * s)

    def _displacement(self, since: Array) -> Array:
        """From the impulse: Z u = 2 p0 theta (1 - exp(-t/theta)) - M v."""
        s = np.maximum(since, 0.0)
        given = -2.0 * self.peak * self.decay * np.expm1(-s / self.decay)
        return (given - self.mass * self._velocity(s)) / self.impedance

    def _incident(self, since: Array) -> Array:
        return np.where(since >= 0.0, self.peak * np.exp(-np.maximum(since, 0.0) / self.decay), 0.0)

    def _reflected(self, since: Array) -> Array:
        return self._incident(since) - self.impedance * self._velocity(since)

    def history(self, t: ArrayLike) -> PlateHistory:
        """Plate at times t (s)."""
        since = times(t, self.cavitation_time, "then the medium cavitates at the plate") - self.arrival_time
        return PlateHistory(
            self._displacement(since), self._velocity(since), self._incident(since) + self._reflected(since)
        )

    def jumps(self, t: float) -> list[Jump]:
        """The head of the pulse: incident until it arrives, then reflected; peak on either."""
        times(t, self.end_time, "cavitation, or the reflected wave is back")
        path = self.sound_speed * t
        rest = rest_state(self.density)
        if t < self.arrival_time:
            return [Jump(rest, self._medium.state(self.peak, 0.0), self.density, self.sound_speed, path)]
        at = 2.0 * self.thickness - path
        incident = float(self._incident(np.asarray(t - at / self.sound_speed)))
        states = self._medium.state(incident, 0.0), self._medium.state(incident, self.peak)
        return [Jump(*states, self.density, -self.sound_speed, at)]

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields in the medium at coordinate (m) and t (s), which broadcast."""
        t = times(t, self.end_time, "cavitation, or the reflected wave is back")
        place = coordinates(coordinate, self.thickness) / self.sound_speed
        reflected = self._reflected(t - (2.0 * self.arrival_time - place))
        return self._medium.fields(self._incident(t - place), reflected)


def _relative_growth(x: Array) -> Array:
    """(exp(x) - 1)/x, 1 at x = 0."""
    return np.where(x == 0.0, 1.0, np.expm1(x) / np.where(x == 0.0, 1.0, x))
