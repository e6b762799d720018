"""A numba or llvmlite that cannot compile the kernels is refused before it is imported."""

from __future__ import annotations

import importlib.metadata
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from hydro1d.errors import LibraryProblem
from hydro1d.jit.versions import SUPPORTED, require_supported_compiler

ROOT = Path(__file__).parents[2]


def installed(monkeypatch, **versions):
    """Make the named versions the installed ones; None is not installed."""
    real = importlib.metadata.version

    def version(name):
        if versions.get(name, "") is None:
            raise importlib.metadata.PackageNotFoundError(name)
        return versions.get(name) or real(name)

    monkeypatch.setattr(importlib.metadata, "version", version)


@pytest.mark.parametrize("found", ["0.66.0", "0.66.0rc1", "0.67.0", "0.68.1"])
def test_a_version_within_the_range_is_taken(monkeypatch, found):
    installed(monkeypatch, numba=found)
    require_supported_compiler()


@pytest.mark.parametrize("found", ["0.9.0", "0.61.2", "0.65.1", "0.69.0", "0.69.0.dev0", "1.0.0", "0.100.0"])
def test_a_version_outside_is_refused_by_name(monkeypatch, found):
    installed(monkeypatch, numba=found)
    with pytest.raises(LibraryProblem, match=rf"numba {found} is installed; allowed: .*'numba>=0\.66,<0\.69'"):
        require_supported_compiler()


def test_everything_wrong_is_named_at_once(monkeypatch):
    installed(monkeypatch, numba=None, llvmlite="0.44.0")
    with pytest.raises(LibraryProblem, match=r"numba is not installed, llvmlite 0\.44\.0 is installed"):
        require_supported_compiler()


def test_the_range_is_that_of_the_package():
    stated = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
    for library, (first, end) in SUPPORTED.items():
        assert f"{library}>={first},<{end}" in stated


def test_the_command_line_says_so_once_and_ends_with_4(tmp_path):
    (tmp_path / "numba-0.65.1.dist-info").mkdir()
    (tmp_path / "numba-0.65.1.dist-info" / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: numba\nVersion: 0.65.1\n"
    )
    command = [sys.executable, "-m", "hydro1d", "run", str(ROOT / "cases" / "sod.toml"), "-o", "sod.h5"]
    path = os.pathsep.join([str(tmp_path), str(ROOT)])
    environment = {**os.environ, "PYTHONPATH": path, "HYDRO1D_CACHE_DIR": str(tmp_path / "cache")}
    environment.pop("NUMBA_DISABLE_JIT", None)
    done = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 4
    assert done.stderr.count("\n") == 1 and "numba 0.65.1 is installed" in done.stderr
    assert not (tmp_path / "sod.h5").exists()
