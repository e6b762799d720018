"""Exact solutions to measure the solver against; imports neither solver nor laws. SI units, compression positive."""

from hydro1d.analytic.clad_column import CladColumn
from hydro1d.analytic.compaction_column import ColumnHistory
from hydro1d.analytic.compaction_loads import CompactionPulse, CompactionStriker
from hydro1d.analytic.curves.base import Curve
from hydro1d.analytic.curves.hardening import EPH, RPH, Elastic
from hydro1d.analytic.curves.measured import Table, UserCurve
from hydro1d.analytic.curves.plateau import EPPH, TangentEPPH, Trilinear, stiff_eppr, stiff_rppl
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

# All classes and functions that are imported above.
__all__ = sorted(name for name, item in globals().items() if hasattr(item, "__module__") and name[0] != "_")
