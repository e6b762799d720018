"""Locking along a straight line, and R-P-P-L and E-P-P-R as its stiff ends."""

from dataclasses import dataclass

import numpy as np

from hydro1d.analytic._checks import Array, positive
from hydro1d.analytic.curves.base import below_one
from hydro1d.analytic.curves.plateau import PlateauCurve


@dataclass(frozen=True)
class Trilinear(PlateauCurve):
    """Elastic line, plateau, locking line: stress = plateau + locking_modulus (strain - eD) beyond densification.

    density kg/m^3, modulus Pa, plateau_stress Pa, densification_strain eD, locking_modulus Pa.
    """

    density: float
    modulus: float
    plateau_stress: float
    densification_strain: float
    locking_modulus: float

    def __post_init__(self) -> None:
        self._check_plateau()
        positive(self, "locking_modulus")

    def _rise(self, strain: Array) -> Array:
        return self.locking_modulus * (strain - self.densification_strain)

    def _slope(self, strain: Array) -> Array:
        return np.full_like(strain, self.locking_modulus)

    def strain_at(self, stress: float) -> float:
        """The strain that carries `stress` (Pa); ValueError where there is none."""
        rise = stress - self.plateau_stress
        if rise <= 0.0:
            return stress / self.modulus
        strain = self.densification_strain + rise / self.locking_modulus
        return below_one(strain, stress)


def stiff_rppl(density: float, plateau_stress: float, densification_strain: float, stiffness: float) -> Trilinear:
    """R-P-P-L at finite stiffness K (Pa): elastic line and locking line both of slope K."""
    return Trilinear(density, stiffness, plateau_stress, densification_strain, stiffness)


def stiff_eppr(
    density: float, modulus: float, plateau_stress: float, densification_strain: float, stiffness: float
) -> Trilinear:
    """E-P-P-R at finite stiffness K (Pa): elastic line of slope modulus, locking line of slope K."""
    return Trilinear(density, modulus, plateau_stress, densification_strain, stiffness)
