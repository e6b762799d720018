"""An output is declared once: what is added in the middle of `scheme.outputs` is found under its name, wherever a run is kept.

A copy of the package declares four outputs more and runs a deck in a process of its own; the untouched package runs the same.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import hydro1d

SOURCE = Path(hydro1d.__file__).parent
# In which tuple, before what, which output: its name, unit, meaning, function.
ADDED = (
    ("HISTORY", "kinetic_energy", "mean_stress", "Pa", "mean of both end stresses",
     "lambda g, now: 0.5 * (g.force[0] + g.force[g.zones - 1])"),
    ("PROBE", "velocity", "closeness", "1", "strain at the probe less one", "lambda g, seen: seen.strain - 1.0"),
    ("NODE", "velocity", "nodal_momentum", "kg m-1 s-1", "momentum of the node",
     "lambda g, node: g.node_mass[node.number] * node.velocity"),
    ("ZONE", "density", "compression", "1", "density over initial density", "lambda g, zone: 1.0 / (1.0 - zone.strain)"),
)  # fmt: skip
NAMES = {"HISTORY": "history/mean_stress", "PROBE": "probes/closeness", "NODE": "nodal_momentum", "ZONE": "compression"}
DECK = """
[material.foam]
law = "epph"
density = 51.6
modulus = 22e6
plateau_stress = 0.8e6
densification_strain = 0.689
shock_slope = 0.00105
[material.gas]
law = "ideal-gas"
density = 1.2
gamma = 1.4
pressure = 1e5
[[layer]]
material = "foam"
thickness = 0.3
zones = 30
[[layer]]
material = "gas"
thickness = 0.1
zones = 10
[left]
type = "striker"
mass = 5.0
velocity = 80.0
[right]
type = "wall"
[time]
end = 1.5e-3
[output]
profiles = 4
history = 7
probes = [0.05, 0.21]
"""
RUNS = """
import sys
import numpy as np
import hydro1d
deck, folder = sys.argv[1:]
run = hydro1d.run(deck)
paths = [*run.keys(), *(f"history/{name}" for name in run.history), *(f"probes/{name}" for name in run.probes)]
np.savez(f"{folder}/memory.npz", **{path: run[path] for path in paths if run[path].dtype != object})
hydro1d.run(deck, f"{folder}/run.h5")
"""


def declare(text: str, place: str, before: str, *output: str) -> str:
    """The source of `scheme.outputs` with one output more."""
    start = text.index(f"{place} = (")
    at = min(text.find(form, start) % len(text) for form in (f'Output("{before}"', f'Output(\n        "{before}"'))
    *words, take = output
    return f"{text[:at]}Output({', '.join(map(repr, words))}, {take}),\n    {text[at:]}"


def run_both_ways(package: Path, folder: Path) -> dict[str, dict[str, np.ndarray]]:
    """Every quantity by its path, kept in memory and as read from the file."""
    folder.mkdir()
    deck = folder / "deck.toml"
    deck.write_text(DECK)
    environment = os.environ | {"PYTHONPATH": str(package), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, "-P", "-c", RUNS, str(deck), str(folder)]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    with np.load(folder / "memory.npz") as memory:
        kept = dict(memory)
    run = hydro1d.open_run(folder / "run.h5")
    return {"memory": kept, "file": {path: np.array(run[path]) for path in kept}}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("outputs")


@pytest.fixture(scope="module")
def plain(folder: Path) -> dict:
    return run_both_ways(SOURCE.parent, folder / "plain")


@pytest.fixture(scope="module")
def richer(folder: Path) -> dict:
    copy = folder / "package" / "hydro1d"
    shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    text = (copy / "scheme" / "outputs.py").read_text(encoding="utf-8")
    for output in ADDED:
        text = declare(text, *output)
    (copy / "scheme" / "outputs.py").write_text(text, encoding="utf-8")
    return run_both_ways(copy.parent, folder / "richer")


@pytest.mark.parametrize("kept", ["memory", "file"])
def test_an_output_is_found_by_its_name_with_its_values(kept: str, richer: dict) -> None:
    run = richer[kept]
    mass = np.concatenate([[0.0], run["zone_mass"], [0.0]])
    expected = {
        "HISTORY": 0.5 * (run["history/left_stress"] + run["history/right_stress"]),
        "PROBE": run["probes/strain"] - 1.0,
        "NODE": 0.5 * (mass[:-1] + mass[1:]) * run["velocity"],
        "ZONE": run["density"] / run["density"][0],
    }
    for place, path in NAMES.items():
        assert run[path].shape == expected[place].shape
        assert np.ptp(run[path]) > 0.0, f"{path} says nothing"
        np.testing.assert_allclose(run[path], expected[place], rtol=1e-13, atol=1e-300, err_msg=path)


@pytest.mark.parametrize("kept", ["memory", "file"])
def test_every_other_output_stays_what_it_was(kept: str, plain: dict, richer: dict) -> None:
    before, after = plain[kept], richer[kept]
    assert set(after) - set(before) == set(NAMES.values())
    assert set(before) <= set(after)
    for path, values in before.items():
        if values.dtype.kind != "f":
            np.testing.assert_array_equal(after[path], values, err_msg=path)
            continue
        # Sums over zones may round otherwise in another machine code.
        scale = 1.0 if path == "history/energy_error" else np.nanmax(np.abs(values), initial=0.0)
        np.testing.assert_allclose(after[path], values, rtol=0.0, atol=1e-13 * scale, err_msg=path)


def test_the_file_says_what_an_output_is(folder: Path, richer: dict) -> None:
    run = hydro1d.open_run(folder / "richer" / "run.h5")
    for place, _, _, units, meaning, _ in ADDED:
        described = run.describe(NAMES[place])
        assert (described.units, described.long_name) == (units, meaning)


def test_memory_and_file_hold_the_same(plain: dict, richer: dict) -> None:
    for both in (plain, richer):
        for path, values in both["memory"].items():
            np.testing.assert_array_equal(both["file"][path], values, err_msg=path)
