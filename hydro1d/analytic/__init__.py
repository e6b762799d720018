"""Exact solutions to measure the solver against; imports neither solver nor laws. SI units, compression positive."""

from hydro1d.analytic.clad_column import CladColumn
from hydro1d.analytic.compaction_column import ColumnHistory
from hydro1d.analytic.compaction_loads import CompactionPulse, CompactionStriker
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
from hydro1d.analytic.elastic_layers import ElasticLayer, ElasticLayers, reflection, transmission
from hydro1d.analytic.hugoniot import Hugoniot, compaction_hugoniot
from hydro1d.analytic.isentropic import SimpleWave
from hydro1d.analytic.jumps import Fields, Jump, Residuals, State
from hydro1d.analytic.noh import Noh
from hydro1d.analytic.pulses import (
    ExponentialPulse,
    FriedlanderPulse,
    Pulse,
    RectangularPulse,
    TablePulse,
    TriangularPulse,
)
from hydro1d.analytic.riemann import Gas, RiemannProblem
from hydro1d.analytic.rigid import FrontHistory
from hydro1d.analytic.rph import RPHFoam, RPHPiston, RPHStriker
from hydro1d.analytic.rppl import RPPL, RPPLStriker
from hydro1d.analytic.rppl_energy_balance import EnergyBalanceStriker
from hydro1d.analytic.rppl_pulse import RPPLPulse
from hydro1d.analytic.step_loading import StepLoading, piston, pressure_step
from hydro1d.analytic.taylor_plate import PlateHistory, TaylorPlate
from hydro1d.analytic.viscous_profile import ViscousProfile

__all__ = [
    "EPH",
    "EPPH",
    "RPH",
    "RPPL",
    "CladColumn",
    "ColumnHistory",
    "CompactionPulse",
    "CompactionStriker",
    "Curve",
    "Elastic",
    "ElasticLayer",
    "ElasticLayers",
    "EnergyBalanceStriker",
    "ExponentialPulse",
    "Fields",
    "FriedlanderPulse",
    "FrontHistory",
    "Gas",
    "Hugoniot",
    "Jump",
    "Noh",
    "PlateHistory",
    "Pulse",
    "RPHFoam",
    "RPHPiston",
    "RPHStriker",
    "RPPLPulse",
    "RPPLStriker",
    "RectangularPulse",
    "Residuals",
    "RiemannProblem",
    "SimpleWave",
    "State",
    "StepLoading",
    "Table",
    "TablePulse",
    "TangentEPPH",
    "TaylorPlate",
    "TriangularPulse",
    "Trilinear",
    "UserCurve",
    "ViscousProfile",
    "compaction_hugoniot",
    "piston",
    "pressure_step",
    "reflection",
    "stiff_eppr",
    "stiff_rppl",
    "transmission",
]
