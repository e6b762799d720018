"""E-P-P-H by a linear ε–[v] Hugoniot, Eq. 39 of doi:10.1016/j.ijimpeng.2009.03.011."""

from __future__ import annotations

from typing import ClassVar

from hydro1d.components.parameters import positive
from hydro1d.laws.base import PlateauFoam


class EPPH(PlateauFoam):
    """Elastic, perfectly plastic, hardening: behind a compaction shock into material at yield ε = εD + s [v] (Eq. 39).

    With Eq. 37 this fixes the curve σ = σP + ρ0 ((ε − εD)/s)²/(ε − εY) for ε ≥ εD. It is finite at ε = 1, where a zone has
    no thickness left: strong loads need `epph-tangent`.
    """

    advice: ClassVar[str] = "; the curve of epph ends there, that of epph-tangent hardens without bound"
    modulus: float = positive("Pa", "elastic modulus E")
    shock_slope: float = positive("s/m", "slope s of the strain behind the front against the velocity jump")

    def hardening(self, over: float) -> tuple[float, float]:
        """ρ0 (over/s)²/(ε − εY) and its derivative."""
        inverse = 1.0 / (over + self.densification_strain - self.yield_strain)
        extra = self.density * (over / self.shock_slope) ** 2 * inverse
        return extra, (2.0 * self.density / self.shock_slope**2 * over - extra) * inverse
