"""From a measured quasi-static curve to the parameters of a law.

>>> from hydro1d import fit
>>> found = fit.fit_curve("rohacell.csv", "epph-tangent")
>>> print(found.table()); print(found.deck_fragment("foam", density=51.6))
"""

from hydro1d.fit._curve import Measured, MeasuredCurve, read_curve, read_measured
from hydro1d.fit._efficiency import Efficiency, energy_efficiency
from hydro1d.fit._fitting import Fit, fit_curve, fittable
from hydro1d.fit._plot import draw
from hydro1d.fit._table import Tabulated, tabulate

# All classes and functions that are imported above.
__all__ = sorted(name for name, item in globals().items() if hasattr(item, "__module__") and name[0] != "_")
