"""What a warm start may load. What may import what is in pyproject.toml, for `lint-imports`."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "hydro1d"


def test_a_warm_run_loads_neither_compiler_nor_plots(tmp_path):
    code = (
        "import sys, hydro1d\n"
        f"hydro1d.run({str(PACKAGE.parent / 'cases' / 'sod.toml')!r}, {str(tmp_path / 'sod.h5')!r})\n"
        "print([name for name in ('numba', 'scipy', 'pint', 'matplotlib', 'xarray') if name in sys.modules])"
    )
    for _ in range(2):  # the first may have to compile
        answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert answer.strip() == "[]"


def test_the_public_names_are_shown_before_they_are_loaded():
    code = "import hydro1d; print(set(hydro1d.__all__) <= set(dir(hydro1d)), 'numpy' in __import__('sys').modules)"
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert answer.split() == ["True", "False"]


def test_matplotlib_is_imported_by_the_plots_first():
    """hydro1d.plot imports it whatever MPLBACKEND says; a module elsewhere that came first would fail there."""
    wrong = []
    for path in PACKAGE.rglob("*.py"):
        for node in [] if path.parent.name == "plot" else ast.parse(path.read_text()).body:
            names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            wrong += [path.name for name in names if name.split(".")[0] == "matplotlib"]
    assert not wrong
