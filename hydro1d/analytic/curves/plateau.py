"""What foams with a flat plateau share: an elastic line, the plateau, and something steeper from densification on."""

from abc import abstractmethod

import numpy as np

from hydro1d.analytic._checks import Array, between, positive
from hydro1d.analytic.curves.base import Curve


class PlateauCurve(Curve):
    """Elastic line, flat plateau up to densification, then what `_rise` says."""

    plateau_stress: float
    densification_strain: float

    def _check_plateau(self) -> None:
        positive(self, "density", "modulus", "plateau_stress")
        between(self, "densification_strain", self.plateau_stress / self.modulus, 1.0)

    @property
    def corners(self) -> tuple[float, ...]:
        """Strains between which the curve is concave-up."""
        return (self.plateau_stress / self.modulus, self.densification_strain)

    @abstractmethod
    def _rise(self, strain: Array) -> Array:
        """Stress above the plateau, Pa, at strains of at least the densification strain."""

    @abstractmethod
    def _slope(self, strain: Array) -> Array:
        """Derivative of `_rise`, Pa."""

    def _stress(self, strain: Array) -> Array:
        crushed = np.maximum(strain, self.densification_strain)
        rise = np.where(strain > self.densification_strain, self._rise(crushed), 0.0)
        return np.minimum(self.modulus * strain, self.plateau_stress) + rise

    def _tangent(self, strain: Array) -> Array:
        crushed = np.maximum(strain, self.densification_strain)
        beyond = np.where(strain < self.densification_strain, 0.0, self._slope(crushed))
        return np.where(strain < self.plateau_stress / self.modulus, self.modulus, beyond)
