"""E-P-H: elastic, linear plastic hardening."""

from __future__ import annotations

from pydantic import model_validator

from hydro1d.components.parameters import derived, positive
from hydro1d.laws.base import Foam


class EPH(Foam):
    """σ = E ε up to yield, then σY + H (ε − εY). Two linear waves and no shock: the plastic wave runs at √(H/ρ0)."""

    modulus: float = positive("Pa", "elastic modulus E")
    yield_stress: float = positive("Pa", "yield stress σY")
    hardening_modulus: float = positive("Pa", "plastic tangent H, below the modulus")

    @model_validator(mode="after")
    def _hardens_less_than_elastic(self) -> EPH:
        if not self.hardening_modulus < self.modulus:
            raise ValueError(f"hardening_modulus must be below the modulus, {self.modulus:g} Pa")
        return self

    def loading(self, strain: float) -> tuple[float, float]:
        """Two straight lines."""
        plastic = strain > self.yield_strain
        stress = self.yield_stress + self.hardening_modulus * (strain - self.yield_strain)
        return (stress if plastic else self.modulus * strain), (self.hardening_modulus if plastic else self.modulus)

    @derived
    def yield_strain(self) -> float:
        """σY/E."""
        return self.yield_stress / self.modulus
