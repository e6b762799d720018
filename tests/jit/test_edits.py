"""Laws, pulses and boundaries of a user's whose code changes: what runs is what stands there; restarts ask for it."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import h5py
import pytest

import hydro1d
from hydro1d.boundaries.base import Boundary
from hydro1d.boundaries.free import Free
from hydro1d.boundaries.pressure import Pressure
from hydro1d.errors import DeckError, FileProblem
from hydro1d.jit import build, reach
from hydro1d.laws.elastic import Elastic
from hydro1d.loads.base import Pulse
from hydro1d.store import open_run

compiles = pytest.mark.skipif(build.interpreted(), reason="without a compiler nothing is compiled")
FOAM = """
import shape
from hydro1d import Foam, positive

class Mine(Foam):
    modulus: float = positive("Pa")

    def loading(self, strain):
        over = max(strain - 0.01, 0.0)
        return self.modulus * min(strain, 0.01) + shape.line(over), self.modulus if over == 0.0 else shape.SLOPE
"""
SHAPE = "SLOPE = 1.0e6\n\ndef line(over):\n    return SLOPE * over\n"
LOAD = """
import shape
from hydro1d import Pulse

class Mine(Pulse):
    def pressure(self, time):
        return 0.2 * shape.SLOPE
"""
DECK = """
[material.foam]
law = "mine.py:Mine"
density = 50
modulus = 2e7
[[layer]]
material = "foam"
thickness = 1
zones = 40
[left]
type = "pressure"
pulse = "constant"
peak = 4e5
[right]
type = "wall"
[time]
end = 3e-3
[checkpoint]
cycles = 32
[output]
profiles = 2
"""
ELASTIC = DECK.replace('pulse = "constant"\npeak = 4e5', 'pulse = "load.py:Mine"').replace("mine.py:Mine", "elastic")


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "mine.py").write_text(FOAM)
    (tmp_path / "shape.py").write_text(SHAPE)
    (tmp_path / "load.py").write_text(LOAD)
    (tmp_path / "deck.toml").write_text(DECK)
    return tmp_path


def hydro1d_command(folder, *words, **more):
    environment = dict(os.environ, PYTHONPATH=str(Path(__file__).parents[2]), **more)
    environment.pop("NUMBA_DISABLE_JIT", None)
    command = [sys.executable, "-m", "hydro1d", *words]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120)


def checkpoint_in(folder):
    """The older of the checkpoints that a run has left."""
    return min(folder.glob("run.checkpoint-*.h5"), key=lambda path: path.stat().st_mtime_ns)


def strain(run):
    return float(run["strain"][-1].max())


def test_an_edited_helper_of_a_law_takes_effect_and_a_restart_asks(folder):
    """In this process and in another; what a forced restart runs is the new law."""
    deck, result = folder / "deck.toml", folder / "run.h5"
    soft = strain(hydro1d.run(deck, result))
    old = dict(open_run(result).attributes)
    checkpoint = str(checkpoint_in(folder))
    (folder / "shape.py").write_text(SHAPE.replace("1.0e6", "3.0e6"))
    stiff = strain(hydro1d.run(deck))
    assert soft > 1.5 * stiff
    new = hydro1d.run(deck).attributes
    assert old["law_hash_foam"] != new["law_hash_foam"] and old["boundary_hash_left"] == new["boundary_hash_left"]
    with pytest.raises(FileProblem, match="law of material foam: its source has changed"):
        hydro1d.run(deck, folder / "on.h5", restart=checkpoint)
    forced = strain(hydro1d.run(deck, folder / "on.h5", restart=checkpoint, force=True))
    assert stiff < forced < soft
    assert hydro1d_command(folder, "run", "deck.toml", "-o", "there.h5").returncode == 0
    assert strain(open_run(folder / "there.h5")) == stiff
    refused = hydro1d_command(folder, "run", "deck.toml", "-o", "on.h5", "--restart", checkpoint)
    assert refused.returncode == 4 and "law of material foam: its source has changed" in refused.stderr
    (folder / "shape.py").write_text(SHAPE)
    assert strain(hydro1d.run(deck, folder / "on.h5", restart=checkpoint)) == soft


def test_an_edited_pulse_is_asked_for_too(folder):
    (folder / "deck.toml").write_text(ELASTIC)
    first = strain(hydro1d.run(folder / "deck.toml", folder / "run.h5"))
    checkpoint = checkpoint_in(folder)
    (folder / "shape.py").write_text(SHAPE.replace("1.0e6", "3.0e6"))
    assert strain(hydro1d.run(folder / "deck.toml")) == pytest.approx(3.0 * first, rel=0.05)
    with pytest.raises(FileProblem, match="left boundary: its source has changed"):
        hydro1d.run(folder / "deck.toml", folder / "run.h5", restart=checkpoint)


def column(left, end=2e-5):
    layers = [hydro1d.Layer(law=Elastic(density=1000.0, modulus=1e9), thickness=1.0, zones=20)]
    return hydro1d.Deck(layers=layers, left=left, right=Free(), end=end, output={"profiles": 2})


def velocity(left):
    return float(hydro1d.run(column(left))["velocity"][-1, 0])


def pulse_of(pressure):
    class Step(Pulse):
        def pressure(self, time):
            return pressure

    return Pressure(pulse=Step())


def piston_of(speed):
    class Steady(Boundary):
        def kick(self, end, state):
            return speed, 0.0, state

    return Steady()


def test_pulses_and_boundaries_made_by_one_function_are_several():
    one, three, again = (velocity(pulse_of(pressure)) for pressure in (1e6, 3e6, 1e6))
    assert one == again and three == pytest.approx(3.0 * one, rel=1e-2)
    assert [velocity(piston_of(speed)) for speed in (1.0, 3.0)] == [1.0, 3.0]
    hashes = [build.fingerprint(pulse_of(pressure)) for pressure in (1e6, 3e6, 1e6)]
    assert hashes[0] == hashes[2] != hashes[1]


def test_a_class_that_a_notebook_defines_anew_is_the_new_one():
    scope = {"Boundary": Boundary, "__name__": "__main__"}
    said = []
    for speed in ("1.0", "2.0", "SPEED", "SPEED"):
        scope["SPEED"] = scope.get("SPEED", 2.0) + 1.0
        exec(f"class Mine(Boundary):\n  def kick(self, end, state):\n    return {speed}, 0.0, state", scope)
        said.append(velocity(scope["Mine"]()))
    assert said == [1.0, 2.0, 5.0, 6.0]


class Calls(Boundary):
    """A method calls another, which only `super` and a constant of a base class tell apart."""

    def speed(self):
        return 1.0

    def kick(self, end, state):
        return self.speed(), 0.0, state


class Overrides(Calls):
    def speed(self):
        return 2.0


def test_a_method_of_a_subclass_counts():
    assert [velocity(kind()) for kind in (Calls, Overrides, Calls)] == [1.0, 2.0, 1.0]
    assert build.fingerprint(Calls()) != build.fingerprint(Overrides())


COUNT = 0


class Counts(Boundary):
    def kick(self, end, state):
        global COUNT
        COUNT += 1
        return 1.0, 0.0, state


class CountsInPython(Boundary):
    def kick(self, end, state):
        return 1.0, 0.0, state

    def peak(self):
        global COUNT
        COUNT += 1
        return 0.0


@compiles
def test_a_component_that_writes_a_global_is_refused_before_anything_is_computed(tmp_path):
    with pytest.raises(
        reach.KeepsState, match=r"test_edits\.py, line \d+: Counts\.kick writes the global COUNT"
    ) as told:
        hydro1d.run(column(Counts()), tmp_path / "out.h5")
    assert told.value.exit_code == DeckError.exit_code == 2
    assert not list(tmp_path.iterdir())


def test_in_python_alone_a_component_may_write_a_global():
    run = hydro1d.run(column(CountsInPython()))
    assert run.attributes["boundary_hash_left"] == "unknown: the global COUNT, which CountsInPython.peak writes"
    assert COUNT > 0


SQRT = (
    "import ctypes\nsqrt = ctypes.CDLL(None).sqrt\nsqrt.restype, sqrt.argtypes = ctypes.c_double, [ctypes.c_double]\n"
)


@compiles
@pytest.mark.skipif(sys.platform != "linux", reason="the library's name")
def test_what_cannot_be_known_is_said_stored_and_not_gone_on_from(folder):
    (folder / "load.py").write_text(SQRT + LOAD.replace("0.2 *", "0.2 * sqrt(1.0) *"))
    (folder / "deck.toml").write_text(ELASTIC)
    for _ in range(2):
        done = hydro1d_command(folder, "run", "deck.toml", "-o", "run.h5")
        assert done.returncode == 0 and done.stderr == ""
        (note,) = [line for line in done.stdout.splitlines() if "sqrt" in line]
        assert (
            note.startswith("note: Pressure is compiled anew in every run") and "called sqrt in Mine.pressure" in note
        )
    with h5py.File(folder / "run.h5") as file:
        assert file.attrs["boundary_hash_left"] == "unknown: an object of type _FuncPtr called sqrt in Mine.pressure"
    checkpoint = checkpoint_in(folder)
    with pytest.raises(
        FileProblem, match="left boundary: whether its code has changed cannot be known, since it depends on an"
    ):
        hydro1d.run(folder / "deck.toml", folder / "on.h5", restart=checkpoint)
    forced = hydro1d.run(folder / "deck.toml", folder / "on.h5", restart=checkpoint, force=True)
    assert forced.attributes["status"] == "complete"


@pytest.mark.skipif(sys.platform != "linux", reason="the library's name")
def test_a_law_whose_code_cannot_be_followed_has_a_hash_that_says_so(folder):
    (folder / "mine.py").write_text(SQRT + FOAM.replace("shape.line(over)", "shape.line(over) * sqrt(1.0)"))
    law = hydro1d.load_deck(folder / "deck.toml").layers[0].law
    assert build.fingerprint(law) == "unknown: an object of type _FuncPtr called sqrt in Mine.loading"


def test_a_law_of_version_0_1_is_noted(tmp_path):
    (tmp_path / "mine.py").write_text(
        "from hydro1d import Law, positive\nclass Mine(Law):\n    modulus: float = positive('Pa')\n"
        "    def point(self, strain, largest, rate, energy, history):\n"
        "        return self.modulus * strain, self.modulus, self.modulus, True, history\n"
    )
    (tmp_path / "deck.toml").write_text(DECK)
    (note,) = hydro1d.load_deck(tmp_path / "deck.toml").notes
    assert "\n" not in note and "Mine" in note and "respond" in note and "docs/own-law.md" in note


def test_no_note_on_other_laws(folder):
    assert hydro1d.load_deck(folder / "deck.toml").notes == ()


RAISES = """
from hydro1d import Law, positive

class Mine(Law):
    modulus: float = positive("Pa")
    history = {"count": 0.0}

    def point(self, strain, largest, rate, energy, history):
        if strain < -1e-3:
            raise ValueError("no tension")
        return self.modulus * strain, self.modulus, self.modulus, True, (history[0] + 1.0,)
"""


@pytest.mark.parametrize("interpreted", ["0", "1"])
def test_an_exception_in_a_law_ends_the_run_and_is_named(folder, monkeypatch, interpreted):
    monkeypatch.setenv("NUMBA_DISABLE_JIT", interpreted)
    (folder / "mine.py").write_text(RAISES)
    text = DECK.replace('pulse = "constant"', 'pulse = "rectangular"\nduration = 2e-4').replace('"wall"', '"free"')
    (folder / "deck.toml").write_text(text.replace("end = 3e-3", "end = 2e-2"))
    with pytest.raises(hydro1d.BreakdownError) as told:
        hydro1d.run(folder / "deck.toml", folder / "run.h5")
    cause = r"the law of foam, asked at a strain of -0\.001\d*, raised ValueError: no tension \(mine\.py, line 10, in point\)"
    assert re.search(cause, str(told.value)) and told.value.cycle > 10
    left = open_run(folder / "run.failed.h5")
    assert left.attributes["status"] == "failed" and "no tension" in left.attributes["message"]
    assert len(left.history["time"]) >= 1


class Refuses(Boundary):
    def kick(self, end, state):
        if end.time > 1e-5:
            raise ArithmeticError("too late")
        return 1.0, 0.0, state


def test_an_exception_in_a_boundary_ends_the_run_and_is_named():
    with pytest.raises(
        hydro1d.BreakdownError, match=r"the left boundary, raised ArithmeticError: too late \(test_edits\.py"
    ):
        hydro1d.run(column(Refuses(), end=1e-3))


def test_a_sweep_takes_over_no_rows_of_another_law(folder):
    from hydro1d.sweep import load_sweep
    from hydro1d.sweep.run import digest

    (folder / "sweep.toml").write_text(
        'deck = "deck.toml"\nquantities = ["peak_stress"]\n[[parameter]]\nkey = "left.peak"\nvalues = [1e5, 2e5]\n'
    )
    first = digest(load_sweep(folder / "sweep.toml"))
    assert digest(load_sweep(folder / "sweep.toml")) == first
    (folder / "shape.py").write_text(SHAPE.replace("1.0e6", "3.0e6"))
    second = digest(load_sweep(folder / "sweep.toml"))
    assert first != second
    (folder / "mine.py").write_text(FOAM + "    def advise(self):\n        return OPEN\nOPEN = open(__file__)\n")
    assert len({digest(load_sweep(folder / "sweep.toml")) for _ in range(2)}) == 2
