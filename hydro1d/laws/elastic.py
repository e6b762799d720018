"""Linear elastic: σ = E ε."""

from __future__ import annotations

from hydro1d.components.parameters import positive
from hydro1d.laws.base import Law


class Elastic(Law):
    """Linear elastic material, σ = E ε, in tension as in compression."""

    modulus: float = positive("Pa", "elastic modulus E")

    def point(
        self, strain: float, largest: float, rate: float, energy: float, history: tuple[float, ...]
    ) -> tuple[float, float, float, bool, tuple[float, ...]]:
        """Stress E ε."""
        return self.modulus * strain, self.modulus, self.modulus, True, history
