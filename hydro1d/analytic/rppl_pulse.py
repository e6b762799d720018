"""A rectangular pressure pulse on a column of R-P-P-L with a fixed back: steady front, then a decaying one.

Source: Eqs. 23-30 of Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011. Stage 2, after the
pulse, is Scheme 1 with the block crushed in stage 1 as the striker.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from hydro1d.analytic._checks import Array, coordinates, length_allowed, positive, require, times
from hydro1d.analytic.jumps import Fields
from hydro1d.analytic.rigid import FrontHistory, StoppingFront
from hydro1d.analytic.rppl import RPPL, RPPLStriker


@dataclass(frozen=True)
class RPPLPulse(StoppingFront):
    """Rectangular pressure pulse on a column of R-P-P-L (Eqs. 25-30).

    material; pressure P, Pa, above the plateau stress; duration T, s; length of the column, m.
    The stress after the column has come to rest is undetermined in rigid bodies and returned as NaN.
    Raises ValueError for times after full locking.
    """

    material: RPPL
    pressure: float
    duration: float
    length: float = math.inf

    def __post_init__(self) -> None:
        positive(self, "pressure", "duration")
        plateau = self.material.plateau_stress
        require(self.pressure > plateau, "pressure", self.pressure, f"greater than the plateau stress {plateau} Pa")
        length_allowed(self.length)

    @property
    def pulse_velocity(self) -> float:
        """vI, velocity of the crushed block during the pulse, m/s (Eq. 25)."""
        material = self.material
        rise = self.pressure - material.plateau_stress
        return math.sqrt(material.densification_strain * rise / material.density)

    @property
    def pulse_length(self) -> float:
        """lI, length of column crushed during the pulse, m (Eqs. 26, 27)."""
        return self.duration * self.pulse_velocity / self.material.densification_strain

    @property
    def critical_length(self) -> float:
        """lCR2, length of column that the pulse just fully crushes, m (Eq. 29)."""
        return self.pulse_length + self.after_pulse.critical_length

    @property
    def stop_time(self) -> float:
        """When the block comes to rest if the column does not lock fully before, s: T P/plateau."""
        return self.duration * self.pressure / self.material.plateau_stress

    @cached_property
    def after_pulse(self) -> RPPLStriker:
        """Stage 2 (Eq. 28): the crushed block is a striker; its time and coordinate start where stage 1 ends."""
        remaining = max(self.length - self.pulse_length, math.ulp(0.0))
        return RPPLStriker(self.material, self.material.density * self.pulse_length, self.pulse_velocity, remaining)

    @property
    def locking_time(self) -> float:
        """When the front reaches the back, s; infinite if it never does."""
        if self.length <= self.pulse_length:
            return self.length * self.material.densification_strain / self.pulse_velocity
        return self.duration + self.after_pulse.locking_time

    def history(self, t: ArrayLike) -> FrontHistory:
        """Displacement, velocity, front and stresses at times t (s)."""
        t = times(t, self.locking_time, "then the column is fully locked")
        loaded = t <= self.duration
        # Stage 2 has its own last moment, which differs from t - T by round-off.
        since = np.minimum(t - self.duration, min(self.after_pulse.stop_time, self.after_pulse.locking_time))
        later = self.after_pulse.history(np.where(loaded, 0.0, since))
        displacement = self.pulse_velocity * np.minimum(t, self.duration) + later.displacement
        at_rest = t > self.stop_time
        return FrontHistory(
            displacement,
            np.where(loaded, self.pulse_velocity, later.velocity),
            displacement / self.material.densification_strain,
            np.where(at_rest, np.nan, np.where(loaded, self.pressure, later.front_stress)),
            np.where(at_rest, np.nan, np.where(loaded, self.pressure, 0.0)),
        )

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at coordinate (m) and t (s), which broadcast; on the front, the state ahead."""
        coordinate = coordinates(coordinate, self.length)
        history = self.history(t)
        crushed = coordinate < history.front
        loaded = np.asarray(t) <= self.duration
        share = coordinate / np.where(history.front > 0.0, history.front, 1.0)
        block_stress = np.where(loaded, self.pressure, history.front_stress * share)
        beyond = np.maximum(coordinate - self.pulse_length, 0.0)
        crossing = self.after_pulse.stress_at(beyond * self.material.densification_strain)
        fields = self.material.fields(crushed, history.velocity, block_stress, crossing)
        return fields._replace(stress=np.where(np.asarray(t) > self.stop_time, np.nan, fields.stress))


def critical_duration(material: RPPL, pressure: ArrayLike, length: ArrayLike) -> Array:
    """TCR, duration at which a pulse (Pa) just fully crushes a column of `length` (m), s (Eq. 30).

    The boundary between attenuation and enhancement of Fig. 6. Raises ValueError for a pressure below the plateau.
    """
    pressure = np.asarray(pressure, dtype=float)
    plateau = material.plateau_stress
    require(bool(np.all(pressure > plateau)), "pressure", pressure, f"greater than the plateau stress {plateau} Pa")
    resistance = plateau * material.density * material.densification_strain
    return np.asarray(length, dtype=float) * np.sqrt(resistance / (pressure * (pressure - plateau)))
