"""analytic/ stands alone: numpy, scipy, the standard library and itself."""

import ast
import sys
from pathlib import Path

import pytest

import hydro1d.analytic

MODULES = sorted(Path(hydro1d.analytic.__file__).parent.glob("*.py"))


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.stem)
def test_imports_nothing_else(module):
    for node in ast.walk(ast.parse(module.read_text())):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0
            names = [node.module]
        for name in names:
            top = name.partition(".")[0]
            own = name == "hydro1d.analytic" or name.startswith("hydro1d.analytic.")
            assert own or top in {"numpy", "scipy"} or top in sys.stdlib_module_names, name


def test_exports_are_there():
    assert all(hasattr(hydro1d.analytic, name) for name in hydro1d.analytic.__all__)
