"""R-PH: rigid, plastic hardening, Zheng et al. 2014, doi:10.1016/j.jmps.2014.07.013."""

from __future__ import annotations

from hydro1d.laws.base import Foam
from hydro1d.parameters import positive


class RPH(Foam):
    """σ = min(E ε, σ0 + C ε/(1 − ε)²): no densification strain, hardening from the first crush on.

    The source's foam is rigid up to its plateau stress σ0, the limit E → ∞.
    """

    modulus: float = positive("Pa", "elastic modulus E")
    plateau_stress: float = positive("Pa", "initial crushing stress σ0")
    hardening: float = positive("Pa", "strain hardening parameter C")

    def loading(self, strain: float) -> tuple[float, float]:
        """The lower of the elastic line and the hardening curve, and its slope."""
        inverse = 1.0 / (1.0 - strain)
        scale = self.hardening * inverse * inverse
        crush = self.plateau_stress + scale * strain
        line = self.modulus * strain
        return min(line, crush), (self.modulus if line <= crush else scale * (1.0 + strain) * inverse)
