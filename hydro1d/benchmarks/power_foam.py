"""A law as a user writes it, for the benchmark."""

from hydro1d.components.parameters import at_least, positive
from hydro1d.laws.base import Foam


class PowerFoam(Foam):
    """σ = E ε up to yield, then σP + K (ε − σP/E)^n."""

    modulus: float = positive("Pa", "elastic modulus E")
    plateau_stress: float = positive("Pa", "stress σP at yield")
    hardening: float = positive("Pa", "hardening K")
    exponent: float = at_least(1.0, description="exponent n")

    def loading(self, strain: float) -> tuple[float, float]:
        """Stress and tangent on first loading."""
        over = strain - self.plateau_stress / self.modulus
        if over <= 0.0:
            return self.modulus * strain, self.modulus
        power = over ** (self.exponent - 1.0)
        return self.plateau_stress + self.hardening * over * power, self.exponent * self.hardening * power
