"""Ideal gas, for the verification of the scheme against exact Riemann solutions."""

from __future__ import annotations

from hydro1d.components.parameters import above, derived, positive
from hydro1d.laws.base import Law, Point, Response


class IdealGas(Law):
    """p = (γ − 1) ρ e; stress is pressure. With ρ = ρ0/(1 − ε) the Lagrangian modulus −dσ/dε is γ p ρ/ρ0."""

    gamma: float = above(1.0, "1", "ratio of specific heats γ")
    pressure: float = positive("Pa", "initial pressure")

    def respond(self, point: Point, old: tuple[float, ...]) -> Response:
        """Pressure and isentropic modulus."""
        inverse = 1.0 / (1.0 - point.strain)
        pressure = (self.gamma - 1.0) * self.density * inverse * point.energy
        modulus = self.gamma * pressure * inverse
        return Response(pressure, pressure, modulus, modulus, 0.0, True, old)

    def strain_to_lockup(self, strain: float, compression: float) -> float:
        """Makes (γ + 1)/4 of the default coefficient 2: half of a strong shock's own q, (γ + 1)/2 ρ Δv² (Kuropatenko 1967).

        A gas does not lock, and keeps no overshoot as a foam does.
        """
        return (1.0 - strain) * 8.0 / (self.gamma + 1.0)

    @derived
    def initial_energy(self) -> float:
        """p/((γ − 1) ρ0), J/kg."""
        return self.pressure / ((self.gamma - 1.0) * self.density)
