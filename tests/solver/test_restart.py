"""A run goes on from a state bit for bit."""

from __future__ import annotations

import numpy as np
import pytest
from columns import FOAM, PULSE, layer, run

from hydro1d.boundaries.striker import Striker
from hydro1d.boundaries.wall import Wall
from hydro1d.solver import driver as solver
from hydro1d.solver.column import build_column
from hydro1d.solver.driver import CheckpointPlan
from hydro1d.solver.program import Program
from hydro1d.solver.state import State


def test_from_any_checkpoint_on_everything_is_the_same():
    options = {"end": 4e-3, "profile_times": np.linspace(0, 4e-3, 9)}
    plan = CheckpointPlan(cycles=50)
    for left in (PULSE, Striker(mass=3.0, velocity=90.0)):
        _, whole = run([layer(FOAM, 1.0, 60)], left, Wall(), checkpoints=plan, **options)
        _, plain = run([layer(FOAM, 1.0, 60)], left, Wall(), **options)
        assert np.array_equal(
            np.concatenate(whole.rows), np.concatenate(plain.rows), equal_nan=True
        )  # a checkpoint changes no step
        assert len(whole.states) > 3
        for state in whole.states:
            saved = State.from_arrays({name: array.copy() for name, array in state.arrays().items()})
            _, rest = run([layer(FOAM, 1.0, 60)], left, Wall(), state=saved, **options)
            rows, all_rows = np.concatenate(rest.rows), np.concatenate(plain.rows)
            assert np.array_equal(rows, all_rows[-len(rows) :], equal_nan=True)
            for name, values in rest.frames[-1].fields.items():
                assert np.array_equal(values, plain.frames[-1].fields[name]), name


def test_a_chain_of_restarts_ends_where_one_run_does():
    options = {"end": 4e-3, "profile_times": np.linspace(0, 4e-3, 9), "checkpoints": CheckpointPlan(cycles=50)}
    _, whole = run([layer(FOAM, 1.0, 60)], PULSE, Wall(), **options)
    state, rows = whole.states[0], []
    for _ in range(20):
        _, part = run([layer(FOAM, 1.0, 60)], PULSE, Wall(), state=state.copy(), **options)
        rows = np.concatenate(part.rows)
        assert np.array_equal(rows, np.concatenate(whole.rows)[-len(rows) :], equal_nan=True)
        if not part.states:
            break
        state = part.states[0]
    for name, values in part.frames[-1].fields.items():
        assert np.array_equal(values, whole.frames[-1].fields[name]), name


def test_a_stretch_that_passes_many_stops_takes_the_same_profiles_as_one_that_ends_at_each(monkeypatch):
    options = {"end": 4e-3, "profile_times": np.linspace(0, 4e-3, 200), "history": 7}
    _, many = run([layer(FOAM, 1.0, 60)], PULSE, Wall(), **options)
    monkeypatch.setattr(solver, "MAX_VALUES", 0)
    _, each = run([layer(FOAM, 1.0, 60)], PULSE, Wall(), **options)
    assert len(many.rows) < len(each.rows) / 5
    assert np.array_equal(np.concatenate(many.rows), np.concatenate(each.rows), equal_nan=True)
    assert [frame.time for frame in many.frames] == options["profile_times"].tolist()
    for one, other in zip(many.frames, each.frames, strict=True):
        assert (one.time, one.cycle) == (other.time, other.cycle)
        for name, values in one.fields.items():
            assert np.array_equal(values, other.fields[name]), name


@pytest.mark.parametrize("capacity", [1, 3, 40])
def test_tables_that_hold_few_rows_give_all_of_them(capacity):
    options = {"end": 1e-3, "history": 2}
    _, plain = run([layer(FOAM, 1.0, 60)], PULSE, Wall(), **options)
    column = build_column([layer(FOAM, 1.0, 60)], PULSE, Wall(), **options)
    _, few = run([layer(FOAM, 1.0, 60)], PULSE, Wall(), program=Program(column, capacity), **options)
    assert max(len(rows) for rows in few.rows) <= capacity + 1
    assert np.array_equal(np.concatenate(few.rows), np.concatenate(plain.rows), equal_nan=True)
