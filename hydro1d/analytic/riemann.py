"""Exact solution of the Riemann problem for two ideal gases, in Lagrangian and in laboratory coordinates.

Source: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., chapter 4,
doi:10.1007/b79761; here with a gamma a side. In Lagrangian coordinates a fan is a power law: its characteristics run at
rho c/rho0.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from hydro1d.analytic._checks import Array, finite, positive, require, times
from hydro1d.analytic.jumps import Fields, Jump, State


@dataclass(frozen=True)
class Gas:
    """An ideal gas: density kg/m^3, velocity m/s, pressure Pa, gamma > 1."""

    density: float
    velocity: float
    pressure: float
    gamma: float = 1.4

    def __post_init__(self) -> None:
        positive(self, "density", "pressure")
        require(math.isfinite(self.velocity), "velocity", self.velocity, "finite")
        require(math.isfinite(self.gamma) and self.gamma > 1.0, "gamma", self.gamma, "finite and greater than 1")

    @property
    def sound_speed(self) -> float:
        """Sound speed, m/s."""
        return math.sqrt(self.gamma * self.pressure / self.density)

    @property
    def internal_energy(self) -> float:
        """Internal energy, J/kg."""
        return self.pressure / ((self.gamma - 1.0) * self.density)

    @property
    def escape_speed(self) -> float:
        """Velocity gained on expansion into vacuum, m/s."""
        return 2.0 * self.sound_speed / (self.gamma - 1.0)

    @property
    def state(self) -> State:
        """The gas as a material state; its strain is counted from here."""
        return State(self.velocity, self.pressure, 0.0, self.density, self.internal_energy)

    def velocity_change(self, pressure: float) -> float:
        """Speed gained through a shock or fan to `pressure` (Pa), m/s; positive when compressed (Toro 4.6, 4.7)."""
        if pressure > self.pressure:
            a, b = 2.0 / ((self.gamma + 1.0) * self.density), (self.gamma - 1.0) / (self.gamma + 1.0) * self.pressure
            return (pressure - self.pressure) * math.sqrt(a / (pressure + b))
        exponent = (self.gamma - 1.0) / (2.0 * self.gamma)
        return self.escape_speed * math.expm1(exponent * math.log(pressure / self.pressure))

    def density_at(self, pressure: float) -> float:
        """Density behind a shock or fan to `pressure` (Pa), kg/m^3 (Toro 4.50, 4.53)."""
        ratio = pressure / self.pressure
        if ratio > 1.0:
            mu = (self.gamma - 1.0) / (self.gamma + 1.0)
            return self.density * (ratio + mu) / (mu * ratio + 1.0)
        return self.density * ratio ** (1.0 / self.gamma)


@dataclass(frozen=True)
class _Wave:
    """The wave into one side: a shock or a fan. sign is -1 on the left, 1 on the right; speeds are magnitudes."""

    gas: Gas
    sign: int
    star_pressure: float
    star_velocity: float

    @property
    def is_shock(self) -> bool:
        return self.star_pressure > self.gas.pressure

    @property
    def star(self) -> State:
        density = self.gas.density_at(self.star_pressure)
        energy = self.star_pressure / ((self.gas.gamma - 1.0) * density)
        return State(self.star_velocity, self.star_pressure, 1.0 - self.gas.density / density, density, energy)

    @property
    def head(self) -> float:
        """Lagrangian speed of the shock or of the head of the fan."""
        gas, ratio = self.gas, self.star_pressure / self.gas.pressure
        if not self.is_shock:
            return gas.sound_speed
        return gas.sound_speed * math.sqrt(((gas.gamma + 1.0) * ratio + gas.gamma - 1.0) / (2.0 * gas.gamma))

    @property
    def tail(self) -> float:
        """Lagrangian speed of the shock or of the tail of the fan."""
        if self.is_shock:
            return self.head
        return math.sqrt(self.gas.gamma * self.star_pressure * self.star.density) / self.gas.density

    def fields(self, speed: Array) -> Fields:
        """Fields at a Lagrangian similarity speed |coordinate - interface|/t."""
        gas = self.gas
        inside, behind = (speed < self.head) & (speed >= self.tail), speed < self.tail
        relative = np.where(inside, speed / gas.sound_speed, 1.0)
        sound = relative ** ((gas.gamma - 1.0) / (gas.gamma + 1.0))  # c over the sound speed ahead
        density = gas.density * sound ** (2.0 / (gas.gamma - 1.0))
        pressure = gas.pressure * sound ** (2.0 * gas.gamma / (gas.gamma - 1.0))
        fan = (
            gas.velocity - self.sign * gas.escape_speed * (1.0 - sound),
            pressure,
            1.0 - gas.density / density,
            density,
            pressure / ((gas.gamma - 1.0) * density),
        )
        zones = zip(self.star, fan, gas.state, strict=True)
        return Fields(*(np.where(behind, b, np.where(inside, f, a)) for b, f, a in zones))

    def displacement_speed(self, speed: Array) -> Array:
        """(position - interface)/t of the material at a Lagrangian similarity speed; exact, by mass conservation."""
        fields = self.fields(speed)
        at_star = self.star_velocity + self.sign * speed * self.gas.density / self.star.density
        # In a fan dx/dt = v and the similarity x = t f(X/t) give f = v + (X/t) rho0/rho for every X/t.
        in_fan = fields.velocity + self.sign * speed * self.gas.density / fields.density
        return np.where(speed < self.tail, at_star, in_fan)


@dataclass(frozen=True)
class RiemannProblem:
    """Two ideal gases that meet at `interface` (m) at t = 0; without ends.

    Called with (coordinate, t), the Lagrangian coordinate (position at t = 0, m) and the time (s), which broadcast;
    `laboratory(x, t)` takes positions at time t. Strain counts from the initial state of each side. Raises ValueError
    where a vacuum opens.
    """

    left: Gas
    right: Gas
    interface: float = 0.0

    def __post_init__(self) -> None:
        apart, most = self.right.velocity - self.left.velocity, self.left.escape_speed + self.right.escape_speed
        require(apart < most, "right.velocity - left.velocity", apart, f"less than {most:.9g} m/s, or a vacuum opens")

    @cached_property
    def star_pressure(self) -> float:
        """Pressure between the waves, Pa."""

        def excess(log_pressure: float) -> float:
            pressure = math.exp(log_pressure)
            apart = self.right.velocity - self.left.velocity
            return self.left.velocity_change(pressure) + self.right.velocity_change(pressure) + apart

        low = high = math.log(max(self.left.pressure, self.right.pressure))
        while excess(low) > 0.0:
            low -= 2.0
        while excess(high) < 0.0:
            high += 2.0
        if low == high:
            return math.exp(low)
        return math.exp(float(brentq(excess, low, high, xtol=1e-15, rtol=1e-15)))

    @cached_property
    def star_velocity(self) -> float:
        """Velocity between the waves, m/s."""
        change = self.right.velocity_change(self.star_pressure) - self.left.velocity_change(self.star_pressure)
        return 0.5 * (self.left.velocity + self.right.velocity + change)

    @property
    def star_states(self) -> tuple[State, State]:
        """States left and right of the contact."""
        left, right = self._waves
        return left.star, right.star

    @property
    def inner_speeds(self) -> tuple[float, float]:
        """Lagrangian speed of the inner edge of the left and of the right wave: shock, or tail of a fan, m/s."""
        left, right = self._waves
        return left.tail, right.tail

    @property
    def _waves(self) -> tuple[_Wave, _Wave]:
        star = self.star_pressure, self.star_velocity
        return _Wave(self.left, -1, *star), _Wave(self.right, 1, *star)

    def jumps(self, t: float = 0.0) -> list[Jump]:
        """The shocks (not the contact), from the left; fans have none."""
        return [
            Jump(
                wave.gas.state,
                wave.star,
                wave.gas.density,
                wave.sign * wave.head,
                self.interface + wave.sign * wave.head * t,
            )
            for wave in self._waves
            if wave.is_shock
        ]

    def __call__(self, coordinate: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at the Lagrangian coordinate (m) and t (s)."""
        offset = finite("coordinate", coordinate) - self.interface
        return self._fields_at(_speed(offset, times(t)))

    def position(self, coordinate: ArrayLike, t: ArrayLike) -> Array:
        """Where the material of a Lagrangian coordinate (m) is at time t (s), m."""
        offset, t = np.broadcast_arrays(finite("coordinate", coordinate) - self.interface, times(t))
        speed = _speed(offset, t)
        left, right = self._waves
        moved = np.where(offset < 0.0, left.displacement_speed(np.abs(speed)), right.displacement_speed(np.abs(speed)))
        return self.interface + np.where(t > 0.0, moved * t, offset)

    def laboratory(self, x: ArrayLike, t: ArrayLike) -> Fields:
        """Fields at positions x (m) at time t (s)."""
        offset = finite("x", x) - self.interface
        speed, (left, right) = _speed(offset, times(t)), self._waves
        to_the_left = speed < self.star_velocity
        return self._fields_at(np.where(to_the_left, -_material_speed(left, speed), _material_speed(right, speed)))

    def _fields_at(self, speed: Array) -> Fields:
        left, right = (wave.fields(np.abs(speed)) for wave in self._waves)
        return Fields(*(np.where(speed < 0.0, a, b) for a, b in zip(left, right, strict=True)))


def _speed(offset: Array, t: Array) -> Array:
    """offset/t, infinite on its side of the interface at t = 0."""
    offset, t = np.broadcast_arrays(offset, t)
    # The interface itself belongs to the right side, at t = 0 too.
    side = np.where(offset < 0.0, -np.inf, np.inf)
    return np.where(t > 0.0, offset / np.where(t > 0.0, t, 1.0), side)


def _material_speed(wave: _Wave, speed: Array) -> Array:
    """Lagrangian similarity speed of the material on the wave's side that is at (x - interface)/t = speed."""
    gas, sign = wave.gas, wave.sign
    outward = sign * (speed - gas.velocity)
    ahead = outward  # nothing has moved against the gas yet
    star = sign * (speed - wave.star_velocity) * wave.star.density / gas.density
    if wave.is_shock:
        return np.where(star < wave.head, np.maximum(star, 0.0), ahead)
    ratio = (gas.gamma - 1.0) / (gas.gamma + 1.0)
    # Toro 4.56, 4.63: c in the fan from the laboratory speed, then rho c/rho0.
    sound = np.maximum(ratio * outward / gas.sound_speed + 1.0 - ratio, 0.0)
    fan = gas.sound_speed * np.minimum(sound, 1.0) ** (1.0 / ratio)
    inside = np.where(star < wave.tail, np.maximum(star, 0.0), fan)
    return np.where(outward >= gas.sound_speed, ahead, inside)
