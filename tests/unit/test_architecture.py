"""What a warm start may load. What may import what is in pyproject.toml, for `lint-imports`."""

from __future__ import annotations

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
