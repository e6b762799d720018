"""The materials of the cases: each law of the solver with the exact curve that it stands for."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hydro1d import analytic
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


def epph() -> Material:
    """Eq. 39; its curve ends at p = 6.9."""
    return Material(
        "epph", EPPH(**FOAM, shock_slope=SLOPE), analytic.EPPH(**FOAM, shock_slope=SLOPE), (1.5, 3.0, 4.5, 6.0)
    )


def epph_tangent() -> Material:
    """Eq. 38."""
    return Material(
        "epph-tangent",
        EPPHTangent(**FOAM, beta=BETA, gamma=GAMMA),
        analytic.TangentEPPH(**FOAM, beta=BETA, gamma=GAMMA),
    )


def table() -> Material:
    """Forty points of Eq. 38."""
    smooth = epph_tangent().curve
    strains = np.concatenate([[PLATEAU / MODULUS], np.linspace(DENSIFICATION, 0.985, 40)])
    points = tuple((float(e), float(smooth.stress(e))) for e in strains)
    law = Table(density=DENSITY, modulus=MODULUS, curve=((0.0, 0.0), *points))
    curve = analytic.Table(DENSITY, MODULUS, *(tuple(column) for column in zip(*points, strict=True)))
    return Material("table", law, curve, zones=240)


def rph() -> Material:
    """Hardening from the first, elastic below."""
    law = RPH(density=DENSITY, modulus=MODULUS, plateau_stress=PLATEAU, hardening=0.1e6)
    return Material("rph", law, analytic.RPH(DENSITY, MODULUS, PLATEAU, 0.1e6), zones=600)


def eph() -> Material:
    """Two straight lines: no shock."""
    hardening = 4e6
    law = EPH(density=DENSITY, modulus=MODULUS, yield_stress=PLATEAU, hardening_modulus=hardening)
    curve = analytic.EPH(DENSITY, MODULUS, PLATEAU, hardening)
    return Material("eph", law, curve, (1.5, 2.0, 3.0, 4.0), shock=False, zones=240)


def trilinear(ratio: float) -> Material:
    """Locks with ``ratio`` plateau stresses per strain, early enough to take ten plateau stresses."""
    foam = FOAM | {"densification_strain": min(DENSIFICATION, 0.95 - 9.0 / ratio)}
    law = Trilinear(**foam, locking_modulus=ratio * PLATEAU)
    curve = analytic.Trilinear(**foam, locking_modulus=ratio * PLATEAU)
    return Material(f"trilinear-{ratio:g}", law, curve, stiff=ratio > 100.0, zones=240 if ratio < 20.0 else 120)


def rppl(
    stiffness: float = STIFFNESS, density: float = DENSITY, plateau: float = PLATEAU, locking: float = DENSIFICATION
) -> Material:
    """R-P-P-L at a finite stiffness."""
    parameters = {"plateau_stress": plateau, "densification_strain": locking, "stiffness": stiffness}
    law = RPPL(density=density, **parameters)
    return Material(
        "rppl", law, analytic.stiff_rppl(density, plateau, locking, stiffness * plateau), stiff=True, zones=240
    )


def eppr() -> Material:
    """Elastic and plastic as the others, then nearly rigid."""
    law = EPPR(**FOAM, stiffness=STIFFNESS)
    return Material("eppr", law, analytic.stiff_eppr(**FOAM, stiffness=STIFFNESS * PLATEAU), stiff=True, zones=240)


def with_a_shock() -> list[Material]:
    """Every foam law in which a compaction shock runs."""
    return [epph(), epph_tangent(), table(), rph(), trilinear(18.0), trilinear(50.0), trilinear(130.0), rppl(), eppr()]
