"""Elastic, plateau, linear locking."""

from __future__ import annotations

from hydro1d.components.parameters import derived, positive
from hydro1d.laws._locking import LinearLocking


class Trilinear(LinearLocking):
    """Three straight lines: E ε, σP, σP + L (ε − εD)."""

    modulus: float = positive("Pa", "elastic modulus E")
    locking_modulus: float = positive("Pa", "slope L of the densified branch")

    @derived
    def locking_slope(self) -> float:
        """The deck's locking modulus, Pa."""
        return self.locking_modulus
