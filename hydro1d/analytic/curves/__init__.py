"""Stress-strain curves on first loading, independent of the solver's laws."""

from hydro1d.analytic.curves.base import Curve
from hydro1d.analytic.curves.densifying import EPPH, TangentEPPH
from hydro1d.analytic.curves.hardening import RPH
from hydro1d.analytic.curves.lines import EPH, Elastic
from hydro1d.analytic.curves.locking import Trilinear, stiff_eppr, stiff_rppl
from hydro1d.analytic.curves.measured import Table, UserCurve

__all__ = [
    "EPH",
    "EPPH",
    "RPH",
    "Curve",
    "Elastic",
    "Table",
    "TangentEPPH",
    "Trilinear",
    "UserCurve",
    "stiff_eppr",
    "stiff_rppl",
]
