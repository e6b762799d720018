"""A short deck, the answer of a run, and the command as a process of its own."""

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from hydro1d import cli

DECK = """\
title = "A short run"
[material.foam]
law = "epph"
density = "51.6 kg/m^3"
modulus = "22 MPa"
plateau_stress = "0.8 MPa"
densification_strain = 0.689
shock_slope = "0.00105 s/m"
[[layer]]
material = "foam"
thickness = "1 m"
zones = 20
[left]
type = "pressure"
pulse = "rectangular"
peak = "3.6 MPa"
duration = "1.53 ms"
[right]
type = "wall"
[time]
end = "1 ms"
[output]
profiles = 3
"""
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(cli.__file__).parents[2])}


class Answer(SimpleNamespace):
    """Stands for a `Run`, as far as its summary goes."""

    def __getitem__(self, name):
        return {"node_coordinate": np.array([0.0, 1.0])}[name]


def outcome(left=3.6e6, right=5.4e6, uncrushed=0.25):
    history = {
        "time": np.array([0.0, 1.9e-3, 2e-3]),
        "peak_stress": np.array([0.0, 6e6, 6e6]),
        "peak_left_stress": np.array([0.0, left, left]),
        "peak_right_stress": np.array([0.0, right, right]),
        "uncrushed_fraction": np.array([1.0, uncrushed, uncrushed]),
        "energy_error": np.array([0.0, -3e-15, 0.0]),
    }
    attributes = {"cycles": 123, "wall_seconds": 0.02, "peak_applied_pressure": 3.6e6}
    return Answer(title="A short run", history=history, attributes=attributes)


def command(*arguments, **options):
    return subprocess.run(
        [sys.executable, "-m", "hydro1d.cli", *arguments],
        capture_output=True,
        text=True,
        check=False,
        env=ENVIRONMENT | options,
    )
