"""Small columns for the tests of the solver."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.laws.epph import EPPH
from hydro1d.loads.constant import Constant
from hydro1d.loads.rectangular import Rectangular
from hydro1d.solver.column import build_column
from hydro1d.solver.driver import solve
from hydro1d.solver.sink import Sink

ROHACELL = {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689}
FOAM = EPPH(**ROHACELL, shock_slope=0.00105)
PULSE = Pressure(pulse=Rectangular(peak=3.6e6, duration=1.53e-3))


class Kept(Sink):
    """Keeps everything that the solver hands over."""

    def __init__(self):
        self.frames, self.rows, self.probes, self.states = [], [], [], []

    def profile(self, frame):
        self.frames.append(frame)

    def history(self, rows, probes):
        self.rows.append(rows)
        self.probes.append(probes)

    def checkpoint(self, state):
        self.states.append(state.copy())

    def maxima(self, zone_maxima):
        self.zone_maxima = zone_maxima

    def column(self, name):
        names = [variable.name for variable in self.variables]
        return np.concatenate(self.rows)[:, names.index(name)]


def layer(law=FOAM, thickness=1.0, zones=100, velocity=0.0, material="foam"):
    return SimpleNamespace(material=material, law=law, thickness=thickness, zones=zones, velocity=velocity)


def run(layers, left=PULSE, right=None, end=8e-3, state=None, **options):
    """Solve and return (outcome, what was kept)."""
    solving = {key: options.pop(key) for key in ("checkpoints", "asked_to_stop", "program") if key in options}
    column = build_column(layers, left, right or Wall(), end=end, **options)
    kept = Kept()
    kept.variables = column.history_variables
    outcome = solve(column, kept, state, **solving)
    return outcome, kept


def step(pressure):
    return Pressure(pulse=Constant(peak=pressure))
