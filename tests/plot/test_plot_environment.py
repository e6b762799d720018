"""Figures whatever the environment asks of matplotlib: backends that are not there, LaTeX that is not installed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from coarse import DECK

TEMPLATES = Path(__file__).parents[2] / "hydro1d" / "templates"

# An installation without IPython: its backend, which matplotlib finds by this entry point, is not there.
WITHOUT_IPYTHON = """
import importlib.metadata as metadata

found = metadata.entry_points

def entry_points(**wanted):
    return metadata.EntryPoints() if wanted.get("group") == "matplotlib.backend" else found(**wanted)

metadata.entry_points = entry_points
"""

FIGURES = """
import os, sys
from pathlib import Path

import numpy as np

from hydro1d.cli import main

result, deck, curve, figure = sys.argv[1:]
assert main(["plot", result, "-o", f"plot.{figure}", "--dpi", "40"]) == 0
assert main(["plot", result, "animate", "--frames", "2", "--dpi", "40"]) == 0
assert main(["report", result, "-o", "report.html"]) == 0
assert main(["laws", "fit", curve, "--law", "epph-tangent", "-o", f"fit.{figure}"]) == 0
assert main(["laws", "plot", deck, "-o", f"law.{figure}"]) == 0

from hydro1d.studies.harrigan2010.workshop import QUICK, Workshop, columns, new_figure

drawing, axes = new_figure()
axes.plot([0, 1], [0, 1], label="σ, 1 %")
axes.legend()
Workshop(Path("."), QUICK).picture("fig01", drawing, columns(a=[0.0, 1.0]))

from hydro1d.verify.figures import svg
from hydro1d.verify.rows import Line, Panel

line = Line(np.array([1.0, 2.0]), np.array([1.0, 2.0]), "exact", "exact")
assert "<svg" in svg((Panel("title", "x", "y", (line,)),), "a")
assert os.environ.get("MPLBACKEND", "") == os.environ["EXPECTED"]
"""


@pytest.mark.parametrize(
    ("variables", "rc", "figure"),
    [
        ({"MPLBACKEND": "module://matplotlib_inline.backend_inline"}, "", "png"),
        ({"MPLBACKEND": "nonsense"}, "backend: nonsense\n", "svg"),
        ({}, "text.usetex: True\nsavefig.bbox: tight\n", "pdf"),
    ],
    ids=["inline without IPython", "unknown backend", "LaTeX"],
)
def test_figures_are_drawn_whatever_is_asked_of_matplotlib(result, tmp_path, variables, rc, figure):
    (tmp_path / "sitecustomize.py").write_text(WITHOUT_IPYTHON)
    (tmp_path / "matplotlibrc").write_text(rc)
    (tmp_path / "deck.toml").write_text(DECK)
    root = str(Path(__file__).parents[2])
    environment = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"} | {
        "PYTHONPATH": os.pathsep.join([str(tmp_path), root, os.environ.get("PYTHONPATH", "")]),
        "MATPLOTLIBRC": str(tmp_path / "matplotlibrc"),
        "PATH": str(tmp_path),  # no LaTeX
        "EXPECTED": variables.get("MPLBACKEND", ""),
    }
    done = subprocess.run(
        [sys.executable, "-c", FIGURES, str(result), "deck.toml", str(TEMPLATES / "curve.csv"), figure],
        cwd=tmp_path,
        env=environment | variables,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    made = [f"plot.{figure}", f"fit.{figure}", f"law.{figure}", "coarse-animate.gif", "report.html", "fig01.png"]
    assert all((tmp_path / name).stat().st_size > 1000 for name in made)
