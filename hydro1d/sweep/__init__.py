"""Many runs: tables over parameters, and the value of a deck's key at which an outcome flips."""

from hydro1d.analysis.outcome import Outcome, parse_outcome
from hydro1d.analysis.quantity import Quantity, parse_quantity, quantity_names
from hydro1d.sweep.critical import Critical, critical, trace
from hydro1d.sweep.flip import Flip, NoFlip, find_flip
from hydro1d.sweep.job import Job, evaluate
from hydro1d.sweep.load import load_sweep
from hydro1d.sweep.plan import Parameter, Sweep
from hydro1d.sweep.run import run_sweep
from hydro1d.sweep.table import Column, Table, read_table

# All classes and functions that are imported above.
__all__ = sorted(name for name, item in globals().items() if hasattr(item, "__module__") and name[0] != "_")
