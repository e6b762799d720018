"""Stress-strain curves on first loading, independent of the solver's laws."""

from hydro1d.analytic.curves.base import Curve
from hydro1d.analytic.curves.hardening import EPH, RPH, Elastic
from hydro1d.analytic.curves.measured import Table, UserCurve
from hydro1d.analytic.curves.plateau import EPPH, TangentEPPH, Trilinear, stiff_eppr, stiff_rppl
