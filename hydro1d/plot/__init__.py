"""Figures of runs and laws. Every function returns (Figure, Axes); units are MPa, ms, mm, m/s.

>>> from hydro1d import plot
>>> figure, axes = plot.xt("pulse_epph.h5", "strain")
>>> plot.save(figure, "xt.png")

Nothing here touches pyplot, so no window opens and nothing is global. A run is a `hydro1d.Run` or the name of its file.
"""

from hydro1d.plot import _matplotlib  # first: it imports matplotlib whatever MPLBACKEND says
from hydro1d.plot._animate import animate
from hydro1d.plot._base import Picture, save
from hydro1d.plot._compare import compare
from hydro1d.plot._histories import history
from hydro1d.plot._hugoniot import hugoniot
from hydro1d.plot._laws import law
from hydro1d.plot._overview import overview
from hydro1d.plot._profiles import profiles
from hydro1d.plot._xt import xt

__all__ = ["Picture", "animate", "compare", "history", "hugoniot", "law", "overview", "profiles", "save", "xt"]
