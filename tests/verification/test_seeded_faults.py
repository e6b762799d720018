"""The suite must fail when the code is wrong: errors seeded into a copy of the package turn it red.

Each fault is a textual edit that asserts that it found its target. The copy runs as a process of its own, with a cache of
its own that holds the machine code of the sound passes already: those that an edit changes must not be met there, or the suite
stays green and the test fails.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

import hydro1d

SOURCE = Path(hydro1d.__file__).parent


@dataclass(frozen=True)
class Fault:
    """Edits (file, pattern, replacement), each of which must find its target, and cases that must see them."""

    name: str
    edits: tuple[tuple[str, str, str], ...]
    cases: tuple[str, ...]


VISCOSITY = r"(if self\.kind == \"none\" else )\(self\.linear, self\.smooth_linear, self\.quadratic\)"
PASSES = ("scheme/zone_pass.py", "scheme/foam_pass.py")
FAULTS = (
    Fault(
        "viscosity ten times too weak",
        (("scheme/viscosity.py", VISCOSITY, r"\1(0.1 * self.linear, 0.1 * self.smooth_linear, 0.1 * self.quadratic)"),),
        ("pressure-step epph", "riemann sod"),
    ),
    Fault(
        "viscosity ten times too strong",
        (
            (
                "scheme/viscosity.py",
                VISCOSITY,
                r"\1(10.0 * self.linear, 10.0 * self.smooth_linear, 10.0 * self.quadratic)",
            ),
        ),
        ("pressure-step epph", "riemann sod"),
    ),
    Fault(
        "energy work with the wrong velocity",
        tuple((name, r"\(jump_before \+ jump\)", "(jump + jump)") for name in PASSES),
        ("riemann sod", "symmetry"),
    ),
    Fault(
        "work of the viscosity half a step apart",
        tuple(
            (name, r"viscosity\[i\] \* \(jump_before \+ jump\)", r"viscosity[i] * (2.0 * jump_before)")
            for name in PASSES
        ),
        ("front-energy trilinear-50",),
    ),
    Fault(
        "clock shifted by one step",
        (
            (
                "scheme/ends.py",
                r"(end\.time, end\.step_before, end\.step_after = g\.clock\.time)(, g\.clock\.last_step, step\b)",
                r"\1 + step\2",
            ),
        ),
        ("smooth", "elastic-bar"),
    ),
    Fault(
        "unloading along the loading curve",
        (("laws/base.py", r"(unloading: Literal\[\"elastic\", \"reversible\"\] = )\"elastic\"", r'\1"reversible"'),),
        ("rph-striker", "epph-pulse"),
    ),
    Fault(
        "wrong mass of a boundary node",
        (("solver/column.py", r"(node_mass\[1:\] \+= 0\.5 \* zone_mass\n)", r"\1    node_mass[0] *= 2.0\n"),),
        ("smooth", "symmetry"),
    ),
    Fault(
        "plateau stress 1 % off",
        (
            (
                "laws/base.py",
                r"(min\(self\.modulus \* strain, )self\.plateau_stress\)",
                r"\g<1>1.01 * self.plateau_stress)",
            ),
        ),
        ("pressure-step epph", "piston epph"),
    ),
    Fault(
        "time step above its bound",
        (("scheme/step.py", r"(clock\.next_step = )(clock\.cfl \* stable)", r"\g<1>1.5 * \2"),),
        ("elastic-bar", "smooth", "symmetry"),
    ),
)
SOUND = "no fault"
GREEN = tuple(dict.fromkeys(fault.cases[0] for fault in FAULTS))
QUICK = (
    "pressure-step epph",
    "piston epph",
    "riemann sod",
    "front-energy trilinear-50",
    "smooth",
    "elastic-bar",
    "symmetry",
    "rph-striker",
    "epph-pulse",
)


def _copy(folder: Path, fault: Fault | None) -> Path:
    """A copy of the package with the fault in it."""
    shutil.copytree(SOURCE, folder / "hydro1d", ignore=shutil.ignore_patterns("__pycache__"))
    for name, pattern, replacement in fault.edits if fault else ():
        path = folder / "hydro1d" / name
        text, found = re.subn(pattern, replacement, path.read_text(encoding="utf-8"))
        assert found >= 1, f"{fault.name}: no place in {name} matches {pattern!r}"
        path.write_text(text, encoding="utf-8")
    return folder


def _verify(folder: Path, cases: tuple[str, ...]) -> tuple[int, list[dict]]:
    """Exit code and rows of ``hydro1d verify`` run from the copy."""
    rows = folder / "rows.json"
    only = [part for case in cases for part in ("--only", case)]
    environment = os.environ | {
        "PYTHONPATH": str(folder),
        "HYDRO1D_CACHE_DIR": str(folder / "cache"),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [sys.executable, "-P", "-m", "hydro1d.cli", "verify", "--quiet", "--json", str(rows), *only]
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=600, check=False
    )
    assert rows.exists(), done.stderr
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, json.loads(rows.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, int, list[dict]]:
    """Folder, exit code and rows of the suite's run on a copy without a fault."""
    folder = _copy(tmp_path_factory.mktemp("sound"), None)
    return folder, *_verify(folder, GREEN)


@pytest.mark.nightly
@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_the_suite_turns_red(fault: Fault, sound: tuple[Path, int, list[dict]], tmp_path: Path) -> None:
    shutil.copytree(sound[0] / "cache", tmp_path / "cache")
    code, rows = _verify(_copy(tmp_path, fault), fault.cases[:1])
    assert code == 1, f"{fault.name} was not seen in {len(rows)} rows"
    assert any(not row["passed"] for row in rows)


@pytest.mark.nightly
def test_it_is_green_without_a_fault(sound: tuple[Path, int, list[dict]]) -> None:
    _, code, rows = sound
    assert code == 0, [row for row in rows if not row["passed"]]
    assert {row["case"] for row in rows} == set(GREEN)


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_every_case_named_for_a_fault_sees_it(fault: Fault, tmp_path: Path) -> None:
    """Each of the cases by itself, and among all of the quick ones."""
    folder = _copy(tmp_path, fault)
    code, rows = _verify(folder, QUICK)
    assert code == 1
    red = {row["case"] for row in rows if not row["passed"]}
    assert red >= set(fault.cases), f"{fault.name}: seen by {sorted(red)} only"
