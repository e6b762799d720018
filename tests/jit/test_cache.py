"""The cache of object code: a run never fails for it, and never runs what is stale, damaged or another user's."""

from __future__ import annotations

import math
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import questions

from hydro1d.jit import build, cache

ROOT = Path(__file__).parents[2]
LAW = """
from hydro1d import Foam, positive

class Mine(Foam):
    modulus: float = positive("Pa")

    def loading(self, strain):
        over = strain - 0.01
        return self.modulus * (strain if over < 0.0 else 0.01 + {slope} * over), self.modulus * (1.0 if over < 0.0 else {slope})
"""
# Runs a column of the law for a few steps; prints the end velocity and whether numba was needed.
SCRIPT = """
import sys
from types import SimpleNamespace
from pathlib import Path
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.free import Free
from hydro1d.solver.column import build_column
from hydro1d.solver.program import Program
from hydro1d.components.plugins import find
from hydro1d.solver.driver import initial_state

law = find("law", sys.argv[1], Path.cwd())(density=50.0, modulus=1e6)
layer = SimpleNamespace(material="foam", law=law, thickness=1.0, zones=20, velocity=0.0)
column = build_column([layer], Piston(velocity=20.0), Free(), end=1.0)
program = Program(column)
state = initial_state(column, program)
program.advance(state, stop=1e-3, steps=100, row_at_stop=False)
print(repr(float(state.force[0])), "numba" in sys.modules)
"""


def run(folder: Path, cache: Path, law: str = "mine.py:Mine") -> tuple[float, bool]:
    """Force at the piston, and whether something was compiled."""
    environment = dict(os.environ, PYTHONPATH=str(ROOT), HYDRO1D_CACHE_DIR=str(cache))
    environment.pop("NUMBA_DISABLE_JIT", None)
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, law], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    force, compiled = done.stdout.split()
    return float(force), compiled == "True"


@pytest.fixture(scope="module")
def filled(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, float]:
    """A folder with a law, its cache, and the law's answer."""
    folder = tmp_path_factory.mktemp("laws")
    (folder / "mine.py").write_text(LAW.format(slope=0.9))
    force, compiled = run(folder, folder / "cache")
    assert compiled
    return folder, folder / "cache", force


def test_second_run_needs_no_numba(filled: tuple[Path, Path, float]) -> None:
    folder, cache, force = filled
    assert run(folder, cache) == (force, False)


def test_only_the_user_may_read(filled: tuple[Path, Path, float]) -> None:
    _, cache, _ = filled
    assert cache.stat().st_mode & 0o777 == 0o700
    assert all(path.stat().st_mode & 0o077 == 0 for path in cache.iterdir())
    assert all(path.suffix == ".o" for path in cache.iterdir())


def test_an_edited_law_takes_effect_and_laws_of_one_name_do_not_mix(
    filled: tuple[Path, Path, float], tmp_path: Path
) -> None:
    folder, cache, force = filled
    (tmp_path / "mine.py").write_text(LAW.format(slope=0.1))
    softer, compiled = run(tmp_path, cache)
    assert compiled
    assert softer < 0.9 * force
    assert run(folder, cache) == (force, False)
    assert run(tmp_path, cache) == (softer, False)


def copied(cache: Path, to: Path) -> Path:
    """Copy a cache; returns the copy's smallest entry, which is quick to compile."""
    for path in cache.iterdir():
        shutil.copy(path, to / path.name)
    return min(to.iterdir(), key=lambda path: path.stat().st_size)


def damaged(damage: str, whole: bytes) -> bytes:
    flipped = whole[:-1] + bytes([whole[-1] ^ 1])
    return {"empty": b"", "digest": whole[:32], "half": whole[: len(whole) // 2], "bit": flipped}[damage]


@pytest.mark.skipif(build.interpreted(), reason="without a compiler nothing is compiled")
@pytest.mark.parametrize("damage", ["empty", "digest", "half", "bit", "others"])
def test_damaged_entries_and_those_that_others_could_write_are_compiled_again(
    damage: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if damage == "others" and not hasattr(os, "getuid"):
        pytest.skip("POSIX permissions")
    monkeypatch.setenv("HYDRO1D_CACHE_DIR", str(tmp_path))
    compiled: list[str] = []
    with build.announcing(compiled.append):
        for count in (1, 2, 2):  # anew, for the damage, and then from the file
            monkeypatch.setattr(build, "_addresses", {})
            assert questions.answered(math.sqrt) == math.sqrt(questions.X)
            assert len(compiled) == count
            (entry,) = tmp_path.iterdir()
            if count == 1 and damage == "others":
                entry.chmod(0o666)
            elif count == 1:
                entry.write_bytes(damaged(damage, entry.read_bytes()))


def test_a_damaged_entry_costs_another_process_time_alone(filled: tuple[Path, Path, float], tmp_path: Path) -> None:
    folder, cache, force = filled
    entry = copied(cache, tmp_path)
    entry.write_bytes(damaged("bit", entry.read_bytes()))
    assert run(folder, tmp_path) == (force, True)
    assert run(folder, tmp_path) == (force, False)


@pytest.mark.nightly
def test_no_cache_is_no_error(filled: tuple[Path, Path, float], tmp_path: Path) -> None:
    folder, _, force = filled
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    assert run(folder, blocked / "cache") == (force, True)


@pytest.mark.nightly
def test_processes_share_a_cache(filled: tuple[Path, Path, float], tmp_path: Path) -> None:
    folder, cache, force = filled
    copied(cache, tmp_path).unlink()
    with ThreadPoolExecutor(3) as pool:
        answers = list(pool.map(lambda _: run(folder, tmp_path), range(3)))
    assert [answer for answer, _ in answers] == [force] * 3
    assert run(folder, tmp_path) == (force, False)


def test_an_interrupted_write_leaves_nothing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("HYDRO1D_CACHE_DIR", str(tmp_path))

    def full(self: Path, target: Path) -> Path:
        raise OSError("no space left")

    monkeypatch.setattr(Path, "replace", full)
    cache.write("key", b"code")
    assert list(tmp_path.iterdir()) == []
    assert cache.read("key") is None
