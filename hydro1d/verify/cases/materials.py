"""The materials of the cases: each law of the solver with the exact curve that it stands for."""

from typing import Any, NamedTuple

import numpy as np

from hydro1d import analytic
from hydro1d.analysis.theory import curve_of
from hydro1d.laws.base import Law
from hydro1d.laws.eph import EPH
from hydro1d.laws.epph import EPPH
from hydro1d.laws.epph_tangent import EPPHTangent
from hydro1d.laws.eppr import EPPR
from hydro1d.laws.rph import RPH
from hydro1d.laws.rppl import RPPL
from hydro1d.laws.table import Table
from hydro1d.laws.trilinear import Trilinear

# Rohacell-51 WF, Table 1 of the paper.
DENSITY, MODULUS, PLATEAU, DENSIFICATION = 51.6, 22e6, 0.8e6, 0.689
SLOPE, BETA, GAMMA = 0.00105, 1.22, 0.603
STIFFNESS = 1000.0  # of rppl and eppr, in plateau stresses: the laws' default
FOAM = {"density": DENSITY, "modulus": MODULUS, "plateau_stress": PLATEAU, "densification_strain": DENSIFICATION}


class Material(NamedTuple):
    """A law and its curve.

    stiff: locking so steep that a strain error comes back as a large stress error. shock: whether a compaction shock
    runs in it, or a linear plastic wave.
    """

    name: str
    law: Law
    curve: analytic.Curve
    pressures: tuple[float, ...] = (1.5, 3.0, 6.0, 10.0)
    stiff: bool = False
    shock: bool = True
    zones: int = 120  # coarsest resolution of its steps: finer where a weak or nearly linear front is many zones wide


def _material(word: str, law: Law, **more: Any) -> Material:
    """A law of the deck with the curve that the theory has for it."""
    curve = curve_of({"law": word, **law.model_dump()})
    assert curve is not None
    return Material(**{"name": word, "law": law, "curve": curve, **more})


def epph() -> Material:
    """E-P-P-H by Eq. 39, a curve that ends at 6.9 plateau stresses."""
    return _material("epph", EPPH(**FOAM, shock_slope=SLOPE), pressures=(1.5, 3.0, 4.5, 6.0))


def epph_tangent() -> Material:
    """E-P-P-H by Eq. 38."""
    return _material("epph-tangent", EPPHTangent(**FOAM, beta=BETA, gamma=GAMMA))


def table() -> Material:
    """A table of forty points on Eq. 38."""
    smooth = epph_tangent().curve
    strains = np.concatenate([[PLATEAU / MODULUS], np.linspace(DENSIFICATION, 0.985, 40)])
    points = tuple((float(e), float(smooth.stress(e))) for e in strains)
    law = Table(density=DENSITY, modulus=MODULUS, curve=((0.0, 0.0), *points))
    curve = analytic.Table(DENSITY, MODULUS, *(tuple(column) for column in zip(*points, strict=True)))
    return Material("table", law, curve, zones=240)


def rph() -> Material:
    """A foam that hardens from yield on and is elastic below."""
    law = RPH(density=DENSITY, modulus=MODULUS, plateau_stress=PLATEAU, hardening=0.1e6)
    return _material("rph", law, zones=600)


def eph() -> Material:
    """Two straight lines, in which no shock runs."""
    law = EPH(density=DENSITY, modulus=MODULUS, yield_stress=PLATEAU, hardening_modulus=4e6)
    return _material("eph", law, pressures=(1.5, 2.0, 3.0, 4.0), shock=False, zones=240)


def trilinear(ratio: float) -> Material:
    """Locks with ``ratio`` plateau stresses per strain, early enough to take ten plateau stresses."""
    foam = FOAM | {"densification_strain": min(DENSIFICATION, 0.95 - 9.0 / ratio)}
    law, zones = Trilinear(**foam, locking_modulus=ratio * PLATEAU), 240 if ratio < 20.0 else 120
    return _material("trilinear", law, name=f"trilinear-{ratio:g}", stiff=ratio > 100.0, zones=zones)


def rppl(
    stiffness: float = STIFFNESS, density: float = DENSITY, plateau: float = PLATEAU, locking: float = DENSIFICATION
) -> Material:
    """R-P-P-L at a finite stiffness."""
    parameters = {"plateau_stress": plateau, "densification_strain": locking, "stiffness": stiffness}
    return _material("rppl", RPPL(density=density, **parameters), stiff=True, zones=240)


def eppr() -> Material:
    """Elastic and plastic as the others, then nearly rigid."""
    return _material("eppr", EPPR(**FOAM, stiffness=STIFFNESS), stiff=True, zones=240)


def with_a_shock() -> list[Material]:
    """Every foam law in which a compaction shock runs."""
    return [epph(), epph_tangent(), table(), rph(), trilinear(18.0), trilinear(50.0), trilinear(130.0), rppl(), eppr()]
