"""The state behind a compaction front at default settings, for every foam law: the bounds that users may rely on.

Measured figures lie one to three orders below most of these bounds (docs/viscosity.md); the bounds are what a design office can
live with. Exact: `analytic.pressure_step` and `analytic.piston`, independent of the solver's laws.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from columns import layer, run, step

from hydro1d import analytic
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.laws.eph import EPH
from hydro1d.scheme.viscosity import Viscosity

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
import viscosity_study as study

CASES = study.cases()
STIFF = ("rppl", "eppr", "trilinear-130")


def check(name, row):
    assert "failed" not in row, row
    median = 5e-3 if name in STIFF else 1e-3
    assert abs(row["median_strain"]) < median
    assert abs(row["median_stress"]) < median
    assert abs(row["first"]) < 5e-3
    assert abs(row["rest"]) < 5e-3
    assert abs(row["front"]) < 1.0


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("p", [1.5, 4.5, 10.0])
def test_pressure_step(name, p):
    if name == "epph":
        p = min(p, 6.0)  # its curve ends at ε = 1, 6.9 plateau stresses
    law, curve = CASES[name]
    row = study.run(law, analytic.pressure_step(curve, p * study.PLATEAU), step(p * study.PLATEAU), Viscosity())
    check(name, row)
    locking = {"trilinear-18": 18.0, "trilinear-50": 50.0}.get(name, 0.0 if name not in STIFF else 1e9)
    if locking < 25.0 * p:
        assert row["peak"] < 0.015


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("velocity", [60.0, 250.0])
def test_piston(name, velocity):
    law, curve = CASES[name]
    row = study.run(law, analytic.piston(curve, velocity), Piston(velocity=velocity), Viscosity())
    check(name, row)


@pytest.mark.parametrize("zones", [250, 500])
def test_the_error_of_the_state_falls_with_the_zone_size(zones):
    # The median is exact to round-off of the iteration; the worst zone behind the front is what refinement improves or keeps.
    law, curve = CASES["epph"]
    exact = analytic.pressure_step(curve, 3.6e6)
    row = study.run(law, exact, step(3.6e6), Viscosity(), zones)
    assert abs(row["median_strain"]) < 1e-4 and abs(row["first"]) < 1e-3 and abs(row["front"]) < 0.5


@pytest.mark.parametrize("hardening", [2e6, 8e6])
def test_eph_has_a_linear_plastic_wave(hardening):
    law = EPH(density=51.6, modulus=22e6, yield_stress=0.8e6, hardening_modulus=hardening)
    elastic, plastic = np.sqrt(22e6 / 51.6), np.sqrt(hardening / 51.6)
    end = min(0.33 / plastic, 0.9 / elastic)
    _, kept = run([layer(law, 1.0, 1000)], step(1.2e6), Transmitting(), end=end, profile_times=[end])
    strain, stress = kept.frames[-1].fields["strain"], kept.frames[-1].fields["stress"]
    ahead, behind = 0.8e6 / 22e6, 0.8e6 / 22e6 + 0.4e6 / hardening
    arrived, precursor = plastic * end * 1000, elastic * end * 1000
    assert np.median(strain[: int(0.6 * arrived)]) == pytest.approx(behind, rel=2e-3)
    assert np.median(stress[: int(0.6 * arrived)]) == pytest.approx(1.2e6, rel=2e-3)
    before = slice(0, int(arrived + 0.6 * (precursor - arrived)))
    centre = ((strain[before] - ahead) / (behind - ahead)).sum()
    assert centre == pytest.approx(arrived, abs=3.0)  # a linear wave widens as √t, and its centre lags by that little


def test_the_precursor():
    law, _ = CASES["epph"]
    _, kept = run([layer(law, 1.0, 1000)], step(3.6e6), Transmitting(), end=1.4e-3, profile_times=[1.4e-3])
    fields = kept.frames[-1].fields
    ahead = slice(450, 850)  # between the compaction front and the precursor's foot
    assert np.median(fields["stress"][ahead]) == pytest.approx(0.8e6, rel=1e-5)
    assert np.abs(fields["velocity"][ahead] / (0.8e6 / np.sqrt(22e6 * 51.6)) - 1).max() < 1e-4
