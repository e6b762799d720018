"""A foam law of your own. Edit it, run the deck again: it is compiled anew."""

from hydro1d import Foam, at_least, positive


class OwnFoam(Foam):
    """Crushable foam, stress = plateau + hardening (strain - yield strain)^exponent beyond yield."""

    modulus: float = positive("Pa", "elastic modulus")
    plateau_stress: float = positive("Pa", "stress at yield")
    hardening: float = positive("Pa", "size of the hardening")
    exponent: float = at_least(1.0, description="its exponent")

    def loading(self, strain: float) -> tuple[float, float]:
        """Stress and tangent of the first loading; unloading and history come with Foam."""
        over = strain - self.plateau_stress / self.modulus
        if over <= 0.0:
            return self.modulus * strain, self.modulus
        stress = self.plateau_stress + self.hardening * over**self.exponent
        return stress, self.exponent * self.hardening * over ** (self.exponent - 1.0)
