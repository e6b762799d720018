"""Exact solutions to measure the solver against; imports neither solver nor laws. SI units, compression positive."""

from hydro1d.analytic.compaction_column import ColumnHistory, CompactionPulse, CompactionStriker
from hydro1d.analytic.curves import (
    EPH,
    EPPH,
    RPH,
    Curve,
    Elastic,
    Table,
    TangentEPPH,
    Trilinear,
    UserCurve,
    stiff_eppr,
    stiff_rppl,
)
from hydro1d.analytic.hugoniot import Hugoniot, compaction_hugoniot
from hydro1d.analytic.isentropic import SimpleWave
from hydro1d.analytic.jumps import Fields, Jump, Residuals, State
from hydro1d.analytic.noh import Noh
from hydro1d.analytic.riemann import Gas, RiemannProblem
from hydro1d.analytic.rppl import RPPL, FrontHistory, RPPLStriker
from hydro1d.analytic.rppl_energy_balance import EnergyBalanceStriker
from hydro1d.analytic.rppl_pulse import RPPLPulse
from hydro1d.analytic.step_loading import StepLoading, piston, pressure_step

__all__ = [
    "EPH",
    "EPPH",
    "RPH",
    "RPPL",
    "ColumnHistory",
    "CompactionPulse",
    "CompactionStriker",
    "Curve",
    "Elastic",
    "EnergyBalanceStriker",
    "Fields",
    "FrontHistory",
    "Gas",
    "Hugoniot",
    "Jump",
    "Noh",
    "RPPLPulse",
    "RPPLStriker",
    "Residuals",
    "RiemannProblem",
    "SimpleWave",
    "State",
    "StepLoading",
    "Table",
    "TangentEPPH",
    "Trilinear",
    "UserCurve",
    "compaction_hugoniot",
    "piston",
    "pressure_step",
    "stiff_eppr",
    "stiff_rppl",
]
