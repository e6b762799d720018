"""Every deck under cases/ runs as it stands and shows what its comment says."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hydro1d

CASES = Path(__file__).parents[2] / "cases"
DECKS = sorted(path for path in CASES.rglob("*.toml") if "[[layer]]" in path.read_text())


@pytest.mark.parametrize("path", DECKS, ids=lambda path: str(path.relative_to(CASES)))
def test_every_deck_runs(path, tmp_path):
    run = hydro1d.run(path, tmp_path / "run.h5")
    assert run.status == "complete"
    assert np.abs(run.history["energy_error"]).max() < 1e-12
    assert path.read_text().lstrip().startswith("#")
    for name in run:
        if name not in ("layer_name",) and run[name].dtype.kind == "f" and name in ("strain", "stress", "velocity"):
            assert np.isfinite(run[name]).all(), name


def test_the_main_case_shows_what_the_theory_says():
    run = hydro1d.run(CASES / "pulse_epph.toml")
    stage_one = np.searchsorted(run.time, 1.4e-3)
    time = run.time[stage_one]
    crushed = slice(0, int(1000 * 248.0 * time) - 25)  # front: [v]/[ε] = 248 m of column per second
    strain, stress = run["strain"][stage_one, crushed], run["stress"][stage_one, crushed]
    velocity = run["velocity"][stage_one, : crushed.stop]
    # Eqs. 37 and 39 at p = 4.5, as `paper` numbers: [v] = 218.81 m/s, ε = 0.9188, σ = P
    assert np.median(strain) == pytest.approx(0.91875, rel=1e-4)
    assert np.median(stress) == pytest.approx(3.6e6, rel=1e-4)
    assert np.median(velocity) - 23.744 == pytest.approx(218.81, rel=1e-4)
    assert np.abs(strain[5:] / 0.918753 - 1).max() < 5e-4
    assert np.abs(strain[:5] / 0.918753 - 1).max() < 2e-3
    early = run.history["time"] < 1.5e-3
    assert run.history["peak_stress"][early].max() < 1.0035 * 3.6e6
    assert run.history["uncrushed_fraction"][-1] == 0.0
    assert 0.5 < run.history["peak_right_stress"][-1] / 3.6e6 < 0.6


def test_sod_is_sod(tmp_path):
    run = hydro1d.run(CASES / "sod.toml")
    # star state of the exact solution: p = 0.30313, u = 0.92745
    middle = np.abs(run["position"][-1] - 0.6).argmin()
    assert run["stress"][-1, middle] == pytest.approx(0.30313, rel=5e-3)
    assert run["velocity"][-1, middle] == pytest.approx(0.92745, rel=5e-3)
