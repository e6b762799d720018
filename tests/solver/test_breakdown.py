"""Where a calculation breaks down it says where, when and why."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest
from columns import FOAM, layer, run, step

import hydro1d
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.wall import Wall
from hydro1d.laws.base import Law
from hydro1d.solver.driver import CheckpointPlan


def test_the_curve_that_ends_at_full_strain_ends_the_run():
    outcome, kept = run([layer(FOAM, zones=60)], step(9e6), end=5e-3)
    assert outcome.status == "failed"
    assert outcome.zone is not None and "strain" in outcome.message
    assert outcome.time == kept.frames[-1].time
    assert np.isfinite(kept.column("energy_error")).all()


def test_the_advice_names_the_law_that_can_follow():
    outcome, _ = run([layer(FOAM, zones=60)], step(9e6), end=5e-3)
    assert "epph-tangent" in outcome.message


class Nonsense(Law):
    """A law that returns NaN beyond a strain."""

    def point(self, strain, largest, rate, energy, history):
        return (1e6 * strain if strain < 0.95 else float("nan")), 1e6, 1e6, True, history


def test_nan_is_found_and_located():
    outcome, _ = run([layer(Nonsense(density=100.0), zones=20)], Piston(velocity=300.0), Wall(), end=1.0)
    assert outcome.status == "failed"
    assert 0 <= outcome.zone < 20


def test_the_public_api_raises_and_leaves_a_diagnostic_file(tmp_path):
    text = (
        "[material.foam]\nlaw='epph'\ndensity=51.6\nmodulus=22e6\nplateau_stress=0.8e6\ndensification_strain=0.689\n"
        "shock_slope=0.00105\n[[layer]]\nmaterial='foam'\nthickness=1\nzones=50\n"
        "[left]\ntype='pressure'\npulse='constant'\npeak=9e6\n[right]\ntype='wall'\n[time]\nend=5e-3\n"
    )
    with pytest.raises(hydro1d.BreakdownError) as caught:
        hydro1d.run(text, tmp_path / "run.h5")
    assert caught.value.exit_code == 3 and caught.value.zone is not None
    assert not (tmp_path / "run.h5").exists()
    diagnosis = hydro1d.open_run(tmp_path / "run.failed.h5")
    assert diagnosis.status == "failed" and diagnosis["strain"].shape[1] == 50


class Hasty(Law):
    """A law that cannot follow a strain that grows by more than 1 % in a step."""

    history: ClassVar[dict[str, float]] = {"last": 0.0}

    def point(self, strain, largest, rate, energy, history):
        (last,) = history
        stress = 1e6 * strain if strain - last < 0.01 else float("nan")
        return stress, 1e6, 1e6, True, (strain,)


@pytest.mark.parametrize("profiles", [1, 40])
def test_a_block_that_breaks_down_is_tried_again_wherever_the_run_is_cut(profiles):
    # at 10 m/s every block of the run breaks down at full steps and passes at half of them
    def fields(**options):
        options["profile_times"] = np.linspace(6e-3 / profiles, 6e-3, profiles)
        outcome, kept = run([layer(Hasty(density=100.0), zones=50)], Piston(velocity=10.0), Wall(), end=6e-3, **options)
        assert outcome.status == "complete", outcome.message
        assert outcome.cycles > 100  # 84 were it never tried again
        return kept.frames[-1].fields | {"cycles": outcome.cycles}

    whole = fields(history=100)
    steps = [fields(history=history, checkpoints=plan) for history, plan in
             ((1, None), (7, CheckpointPlan(cycles=3)), (0, CheckpointPlan(cycles=50)),
              (0, CheckpointPlan(time=1e-4)))]  # fmt: skip
    for other in steps:
        for name, values in whole.items():
            assert np.array_equal(values, other[name]), name


class Brittle(Law):
    """A law without an answer beyond 5 % strain."""

    def point(self, strain, largest, rate, energy, history):
        return (1e6 * strain if strain < 0.05 else float("nan")), 1e6, 1e6, True, history


def test_all_that_was_asked_for_up_to_the_breakdown_is_handed_over():
    times = np.linspace(0.0, 1e-3, 400)
    outcome, kept = run(
        [layer(Brittle(density=100.0), 0.1, 10)], Piston(velocity=10.0), end=1e-3, profile_times=times, history=1
    )
    assert outcome.status == "failed"
    *asked, last = [frame.time for frame in kept.frames]
    assert asked == times[times < outcome.time].tolist() and last == outcome.time
    assert np.array_equal(kept.column("time"), np.unique(kept.column("time")))
    assert outcome.cycles - len(kept.column("time")) <= 1  # every cycle but the one that broke down, and t = 0
