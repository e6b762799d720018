"""The laws whose densified branch is a straight line."""

from __future__ import annotations

from hydro1d.components.parameters import derived
from hydro1d.laws.base import PlateauFoam


class LinearLocking(PlateauFoam):
    """Plateau, then σ = σP + L (ε − εD); a subclass gives `locking_slope`, the slope L."""

    def hardening(self, over: float) -> tuple[float, float]:
        """L over, and L."""
        return self.locking_slope * over, self.locking_slope

    @derived
    def locking_slope(self) -> float:
        """Slope L of the densified branch, Pa."""
        raise NotImplementedError
