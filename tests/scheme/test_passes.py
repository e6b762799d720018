"""The compiled passes: the same numbers as their Python, from run to run, however a column is cut."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hydro1d.benchmarks import cases, reference
from hydro1d.benchmarks.baseline import Baseline
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.jit.memory import placed
from hydro1d.laws._cotangent import cotangent
from hydro1d.loads.rectangular import Rectangular
from hydro1d.solver.column import build_column
from hydro1d.solver.driver import frame, initial_state
from hydro1d.solver.program import Program
from hydro1d.solver.state import State

ROOT = Path(__file__).parents[2]
STEPS = """
import json, sys
from hydro1d.benchmarks import cases
from hydro1d.solver.program import Program
from hydro1d.solver.driver import frame, initial_state
answers = {}
for name in cases.NAMES:
    program = Program(cases.column(name, 24, history=5, probes=[0.3]))
    state = initial_state(program.column, program)
    program.advance(state, stop=1.0, steps=150, row_at_stop=False)
    rows, probes = program.recorded()
    answers[name] = [state.velocity.tolist(), state.force.tolist(), (state.energy + state.increment).tolist(), rows[-1].tolist(),
                     probes[-1].tolist()]
    program.advance_past(state, [(state.time, True)], steps=0, row_at_stop=False)
    answers[name] += [values.tolist() for values in frame(program.column, program.profiles()[0]).fields.values()]
print(json.dumps(answers))
"""


def started(column) -> tuple[Program, State]:
    program = Program(column)
    return program, initial_state(column, program)


@pytest.fixture(scope="module")
def interpreted() -> dict:
    environment = dict(os.environ, PYTHONPATH=str(ROOT), NUMBA_DISABLE_JIT="1")
    done = subprocess.run([sys.executable, "-c", STEPS], env=environment, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


@pytest.mark.parametrize("name", cases.NAMES)
def test_compiled_and_interpreted_agree(name: str, interpreted: dict) -> None:
    program, state = started(cases.column(name, 24, history=5, probes=[0.3]))
    program.advance(state, stop=1.0, steps=150, row_at_stop=False)
    rows, probes = program.recorded()
    found = [state.velocity, state.force, state.energy + state.increment, rows[-1], probes[-1]]
    program.advance_past(state, [(state.time, True)], steps=0, row_at_stop=False)
    found += frame(program.column, program.profiles()[0]).fields.values()
    for k, (ours, theirs) in enumerate(zip(found, interpreted[name], strict=True)):
        expected = np.array(theirs)
        if k == 3:
            assert max(abs(ours[12]), abs(expected[12])) < 1e-13  # the energy error is round-off itself
            ours, expected = np.delete(ours, 12), np.delete(expected, 12)
        np.testing.assert_allclose(ours, expected, rtol=1e-10, atol=1e-12 * np.nanmax(np.abs(expected)))


@pytest.mark.parametrize("name", ["epph", "epph-tangent", "user law", "ideal-gas"])
def test_bits_do_not_depend_on_how_often_one_looks(name: str) -> None:
    program, state = started(cases.column(name, 150))
    again, other = started(cases.column(name, 150))
    program.advance(state, stop=1.0, steps=900, row_at_stop=False)
    for steps in (1, 2, 97, 300, 500):
        again.advance(other, stop=1.0, steps=steps, row_at_stop=False)
    for key, array in state.arrays().items():
        np.testing.assert_array_equal(array, getattr(other, key), err_msg=key)


def test_bits_do_not_depend_on_layers() -> None:
    law = cases.laws("epph")[0]
    pulse = Rectangular(peak=3.6e6, duration=1.53e-3)
    answers = []
    for parts in ([300], [100, 200], [7, 93, 130, 70]):
        layers = [
            SimpleNamespace(material="foam", law=law, thickness=zones / 256.0, zones=zones, velocity=0.0)
            for zones in parts
        ]
        program, state = started(build_column(layers, Pressure(pulse=pulse), Wall(), end=1.0))
        program.advance(state, stop=1.0, steps=2000, row_at_stop=False)
        answers.append(state)
    for other in answers[1:]:
        np.testing.assert_array_equal(answers[0].velocity, other.velocity)
        np.testing.assert_array_equal(answers[0].force, other.force)


def test_a_state_begins_its_arrays_where_vectors_do() -> None:
    for first in (0, 1, 2):
        copy = placed(np.arange(100.0), 3, first)
        assert copy[first:].ctypes.data % 64 == 0
        np.testing.assert_array_equal(copy, np.arange(100.0))


def test_cotangent() -> None:
    angles = np.concatenate([np.geomspace(1e-9, 1.0, 500), np.linspace(1.0, 1.5707, 500)])
    for angle in angles:
        cot, square = cotangent(angle)
        assert abs(cot * math.sin(angle) - math.cos(angle)) < 6e-16
        assert square * math.sin(angle) ** 2 == pytest.approx(1.0, abs=2e-15)


@pytest.mark.parametrize("name", cases.NAMES)
def test_c_reference_agrees(name: str) -> None:
    try:
        library = reference.build()
    except reference.NoReference as reason:
        pytest.skip(str(reason))
    program, states = cases.stations(name, 200, 2)
    other = reference.Reference(library, program)
    for state in states:
        one, two = state.copy(), state.copy()
        program.advance(one, stop=1.0, steps=20, row_at_stop=False)
        other.advance(two, 20)
        assert reference.difference(one, two) < 1e-10


def test_plain_numpy_agrees() -> None:
    program, states = cases.stations("epph", 200, 1)
    one, two = states[0].copy(), states[0].copy()
    program.advance(one, stop=1.0, steps=20, row_at_stop=False)
    Baseline(program).advance(two, 20)
    assert reference.difference(one, two) < 1e-10


def test_without_compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("CC", raising=False)
    with pytest.raises(reference.NoReference, match="compiler"):
        reference.build()


def test_refined_state_goes_on() -> None:
    program, states = cases.stations("epph", 4000, 1)
    assert program.advance(states[0], stop=1.0, steps=50, row_at_stop=False) == 1
    assert np.isfinite(states[0].force).all()
