"""R-PH: rigid, plastic hardening, Zheng et al. 2014, doi:10.1016/j.jmps.2014.07.013."""

from __future__ import annotations

import numpy as np

from hydro1d.components.parameters import derived, positive
from hydro1d.laws.base import Foam


class RPH(Foam):
    """σ = min(E ε, σ0 + C ε/(1 − ε)²) up to yield, the second beyond: no densification strain, hardening from the first.

    The source's foam is rigid up to its plateau stress σ0, the limit E → ∞.
    """

    modulus: float = positive("Pa", "elastic modulus E")
    plateau_stress: float = positive("Pa", "initial crushing stress σ0")
    hardening: float = positive("Pa", "strain hardening parameter C")

    def loading(self, strain: float) -> tuple[float, float]:
        """The elastic line up to where it first meets the hardening curve, that curve beyond."""
        inverse = 1.0 / (1.0 - strain)
        scale = self.hardening * inverse * inverse
        elastic = strain <= self.yield_strain
        stress = self.modulus * strain if elastic else self.plateau_stress + scale * strain
        return stress, (self.modulus if elastic else scale * (1.0 + strain) * inverse)

    @derived
    def yield_strain(self) -> float:
        """First root of E ε = σ0 + C ε/(1 − ε)²; 1 where the line stays below the curve."""
        # E ε (1 − ε)² − σ0 (1 − ε)² − C ε = 0, a cubic in ε
        e, s, c = self.modulus, self.plateau_stress, self.hardening
        roots = np.roots([e, -2.0 * e - s, e + 2.0 * s - c, -s])
        real = sorted(root.real for root in roots if abs(root.imag) < 1e-12 and 0.0 < root.real < 1.0)
        return float(real[0]) if real else 1.0
