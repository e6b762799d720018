"""E-P-P-H by a tangent hardening curve, Eq. 38 of doi:10.1016/j.ijimpeng.2009.03.011."""

from __future__ import annotations

import math

from hydro1d.components.parameters import derived, fraction, positive
from hydro1d.laws._cotangent import cotangent
from hydro1d.laws.base import PlateauFoam


class EPPHTangent(PlateauFoam):
    """Elastic, perfectly plastic, hardening without bound as ε → 1 (Eq. 38).

    σ = σP {1 + β [tan((1 − γ + γ (ε − εD)/(1 − εD)) π/2) − tan((1 − γ) π/2)]} for ε ≥ εD.
    """

    modulus: float = positive("Pa", "elastic modulus E")
    beta: float = positive("1", "height β of the hardening")
    gamma: float = fraction("sharpness γ of the hardening")

    def hardening(self, over: float) -> tuple[float, float]:
        """Eq. 38 less the plateau, and its derivative σP β (1 + tan²) γ π/2/(1 − εD)."""
        tangent, secant_squared = cotangent(self.end_angle - self.angle_rate * over)  # of the complement
        scale = self.plateau_stress * self.beta
        return scale * (tangent - self.start_tangent), scale * self.angle_rate * secant_squared

    @derived
    def angle_rate(self) -> float:
        """Angle per strain."""
        return self.gamma * 0.5 * math.pi / (1.0 - self.densification_strain)

    @derived
    def end_angle(self) -> float:
        """Angle that is left at densification to π/2, which full strain reaches."""
        return self.gamma * 0.5 * math.pi

    @derived
    def start_tangent(self) -> float:
        """Tangent at densification."""
        return cotangent(self.end_angle)[0]
