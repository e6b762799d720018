"""A law of one's own: a crushable foam that hardens by a power of the strain beyond yield."""

from hydro1d import Foam, at_least, positive


class PowerFoam(Foam):
    r"""σ = E ε up to yield, then σ = σP + K (ε − σP/E)^n."""

    modulus: float = positive("Pa", "elastic modulus E")
    plateau_stress: float = positive("Pa", "stress σP at yield")
    hardening: float = positive("Pa", "hardening K")
    exponent: float = at_least(1.0, description="exponent n")

    def loading(self, strain):
        """Stress and tangent on first loading."""
        over = strain - self.plateau_stress / self.modulus
        if over <= 0.0:
            return self.modulus * strain, self.modulus
        power = over ** (self.exponent - 1.0)
        return self.plateau_stress + self.hardening * over * power, self.exponent * self.hardening * power
