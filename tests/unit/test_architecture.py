"""What may import what, and what a warm start may load."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "hydro1d"
SOLVE_PATH = [
    "api.py",
    "viscosity.py",
    "solver",
    "components",
    "laws",
    "boundaries",
    "loads",
    "kernels",
    "deck",
    "store",
]


def imported(path: Path) -> set[str]:
    """Every module, or name in one, that a file imports, wherever in the file."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def imports(path: Path) -> set[str]:
    """Those of this project."""
    return {name for name in imported(path) if name.startswith("hydro1d")}


def files(*names: str) -> list[Path]:
    paths = [PACKAGE / name for name in names]
    return [file for path in paths for file in (path.rglob("*.py") if path.is_dir() else [path])]


def test_theory_knows_nothing_of_the_solver():
    wrong = [
        f"{path.name} imports {name}"
        for path in files("analytic")
        for name in imports(path)
        if not name.startswith("hydro1d.analytic")
    ]
    assert not wrong


def test_the_solve_path_knows_nothing_of_the_theory():
    theory = ("hydro1d.analytic", "hydro1d.verify", "hydro1d.plot")
    wrong = [
        f"{path.relative_to(PACKAGE)} imports {name}"
        for path in files(*SOLVE_PATH)
        for name in imports(path)
        if name.startswith(theory)
    ]
    assert not wrong


def test_numba_is_known_to_the_kernels_alone():
    wrong = [
        f"{path.relative_to(PACKAGE)} imports {name}"
        for path in files(".")
        if path.parent.name not in ("kernels", "benchmarks", "cli")
        for name in imported(path)
        if name.split(".")[0] in ("numba", "llvmlite")
    ]
    assert not wrong


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


@pytest.mark.parametrize("path", files("."), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_matplotlib_is_imported_by_the_plots_first(path):
    """hydro1d.plot imports it whatever MPLBACKEND says; a module elsewhere that came first would fail there."""
    if path.parent.name == "plot":
        return
    for node in ast.parse(path.read_text()).body:
        names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
        names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        assert not any(name.split(".")[0] == "matplotlib" for name in names)
