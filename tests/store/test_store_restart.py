"""Runs of the solver: every checkpoint leads to the very data of the uninterrupted run."""

import random
import subprocess
import sys
import time
import zlib

import h5py
import numpy as np
import pytest

import hydro1d
from hydro1d.errors import FileProblem
from hydro1d.store import writer

DECK = """
title = "restart"
[material.foam]
law = "epph"
density = "51.6 kg/m^3"
modulus = "22 MPa"
plateau_stress = "0.8 MPa"
densification_strain = 0.689
shock_slope = "0.00105 s/m"
[[layer]]
material = "foam"
thickness = "0.5 m"
zones = 30
[[layer]]
material = "foam"
thickness = "0.5 m"
zones = 40
[left]
type = "striker"
mass = 20.0
velocity = "60 m/s"
[right]
type = "wall"
[time]
end = "8 ms"
[output]
profiles = 40
history = 3
probes = ["0.25 m", "0.5 m"]
[checkpoint]
cycles = 20
"""


def arrays(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(
            lambda name, item: found.__setitem__(name, item[()]) if isinstance(item, h5py.Dataset) else None
        )
        found["status"], found["cycles"] = file.attrs["status"], file.attrs["cycles"]
    return found


def same(path, other):
    one, two = arrays(path), arrays(other)
    assert one.keys() == two.keys()
    for name, value in one.items():
        if isinstance(value, np.ndarray) and value.dtype.kind != "O":
            assert value.shape == two[name].shape and value.tobytes() == two[name].tobytes(), name
        elif name != "deck/toml" and name != "deck/resolved":
            assert np.array_equal(value, two[name]), name


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """An uninterrupted run with all of its checkpoints, from its first to its last."""
    folder = tmp_path_factory.mktemp("whole")
    kept, writer.KEPT_CHECKPOINTS = writer.KEPT_CHECKPOINTS, 10**6
    try:
        hydro1d.run(DECK, folder / "a.h5")
    finally:
        writer.KEPT_CHECKPOINTS = kept
    order = sorted(folder.glob("a.checkpoint-*.h5"), key=writer._cycle)
    assert len(order) > 25
    return folder / "a.h5", order


def test_checkpoints_change_nothing(whole, tmp_path):
    hydro1d.run(DECK.replace("[checkpoint]\ncycles = 20", ""), tmp_path / "b.h5")
    same(whole[0], tmp_path / "b.h5")


def restart(checkpoints, whole, folder):
    for checkpoint in checkpoints:
        hydro1d.run(DECK.split("[checkpoint]")[0], folder / "b.h5", restart=checkpoint)
        same(whole, folder / "b.h5")


def test_restart(whole, tmp_path):
    path, checkpoints = whole
    restart(checkpoints[:: len(checkpoints) // 5], path, tmp_path)


LONG = (
    DECK.replace("zones = 30", "zones = 300")
    .replace("zones = 40", "zones = 400")
    .replace("history = 3", "history = 20")
)


@pytest.mark.slow
def test_restart_from_each_of_two_hundred_checkpoints(tmp_path, monkeypatch):
    monkeypatch.setattr(writer, "KEPT_CHECKPOINTS", 10**6)
    deck = LONG.replace("profiles = 40", "profiles = 10").replace("cycles = 20", "cycles = 64")
    hydro1d.run(deck, tmp_path / "a.h5")
    hydro1d.run(deck.split("[checkpoint]")[0], tmp_path / "whole.h5")
    checkpoints = sorted(tmp_path.glob("a.checkpoint-*.h5"), key=writer._cycle)
    print(len(checkpoints), "checkpoints")
    assert len(checkpoints) >= 200
    same(tmp_path / "a.h5", tmp_path / "whole.h5")
    for checkpoint in checkpoints:
        hydro1d.run(deck.split("[checkpoint]")[0], tmp_path / "b.h5", restart=checkpoint)
        same(tmp_path / "whole.h5", tmp_path / "b.h5")


@pytest.mark.parametrize("when", ["every profile", "every cycle"])
def test_checkpoints_at_the_times_of_profiles(tmp_path, monkeypatch, when):
    monkeypatch.setattr(writer, "KEPT_CHECKPOINTS", 10**6)
    plan = f"time = {0.008 / 39!r}" if when == "every profile" else "cycles = 1"
    deck = DECK.replace("cycles = 20", plan).replace("8 ms", "0.2 ms" if when == "every cycle" else "8 ms")
    hydro1d.run(deck, tmp_path / "a.h5")
    checkpoints = sorted(tmp_path.glob("a.checkpoint-*.h5"), key=writer._cycle)
    for checkpoint in checkpoints[:: max(len(checkpoints) // 10, 1)]:
        hydro1d.run(deck.split("[checkpoint]")[0], tmp_path / "b.h5", restart=checkpoint)
        same(tmp_path / "a.h5", tmp_path / "b.h5")


def test_chain(whole, tmp_path, monkeypatch):
    """A run that is stopped at each of its checkpoints and restarted from there."""

    class Stop(Exception):
        pass

    original, path = writer.Hdf5Sink.checkpoint, None

    def stop(self, state):
        original(self, state)
        if state.cycle >= 20 * (count + 1):
            raise Stop

    monkeypatch.setattr(writer.Hdf5Sink, "checkpoint", stop)
    for count in range(20):
        with pytest.raises(Stop):
            hydro1d.run(DECK, tmp_path / "b.h5", restart=path)
        path = max(tmp_path.glob("b.checkpoint-*.h5"), key=writer._cycle)
    monkeypatch.setattr(writer.Hdf5Sink, "checkpoint", original)
    hydro1d.run(DECK, tmp_path / "b.h5", restart=path)
    same(whole[0], tmp_path / "b.h5")


def kill(folder, whole, times, seed):
    """Kill runs at random instants; what is there is complete, and a restart ends with the data of the whole run."""
    chance, restarted = random.Random(seed), 0
    code = f"import hydro1d; hydro1d.run({DECK!r}, {str(folder / 'k.h5')!r})"
    for _ in range(times):
        process = subprocess.Popen([sys.executable, "-c", code])
        time.sleep(chance.uniform(0.5, 4.0))
        process.kill()
        process.wait()
        for left in folder.glob("k*.h5"):
            hydro1d.open_run(left)["stress"]
        if (folder / "k.h5").exists():
            same(whole, folder / "k.h5")
        for checkpoint in folder.glob("k.checkpoint-*.h5"):
            hydro1d.run(DECK.split("[checkpoint]")[0], folder / "again.h5", restart=checkpoint)
            same(whole, folder / "again.h5")
            restarted += 1
        for left in folder.glob("*.h5"):
            left.unlink()
    return restarted


@pytest.mark.nightly
def test_kill(whole, tmp_path):
    kill(tmp_path, whole[0], 3, seed=1)


@pytest.mark.slow
def test_kill_often(whole, tmp_path):
    assert kill(tmp_path, whole[0], 100, seed=2) > 50


def test_longer_end_and_more_output(whole, tmp_path):
    deck = DECK.replace('end = "8 ms"', 'end = "9 ms"').replace('"0.5 m"]', '"0.5 m", "0.75 m"]')
    run = hydro1d.run(deck, tmp_path / "b.h5", restart=whole[1][20])
    assert run.time[-1] == pytest.approx(9e-3) and run.probes["stress"].shape[1] == 3


def test_other_physics(whole, tmp_path):
    with pytest.raises(FileProblem, match=r"left\.velocity: 60\.0 in the checkpoint, 61\.0 in the deck"):
        hydro1d.run(DECK.replace("60 m/s", "61 m/s"), tmp_path / "b.h5", restart=whole[1][3])
    assert not list(tmp_path.iterdir())
    hydro1d.run(DECK.replace("60 m/s", "61 m/s"), tmp_path / "b.h5", restart=whole[1][3], force=True)


SPLIT = DECK.replace("zones = 30", "zones = 20").replace(
    "[[layer]]", '[[layer]]\nmaterial = "foam"\nthickness = "0.25 m"\nzones = 10\n[[layer]]', 1
)


@pytest.mark.parametrize(
    ("deck", "words"),
    [
        (SPLIT, r"holds numbers \(2,\) as layer_state, this deck needs \(3,\)"),
        (DECK.replace("zones = 30", "zones = 31"), r"as velocity, this deck needs \(74,\)"),
    ],
)
def test_not_even_force_makes_a_state_fit_other_layers(whole, tmp_path, deck, words):
    """Compiled code takes the shapes of the state's arrays for granted."""
    with pytest.raises(FileProblem, match="layer"):
        hydro1d.run(deck, tmp_path / "b.h5", restart=whole[1][3])
    with pytest.raises(FileProblem, match=words):
        hydro1d.run(deck, tmp_path / "b.h5", restart=whole[1][3], force=True)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("change", ["missing", "longer"])
def test_a_state_that_is_not_whole(whole, tmp_path, change):
    path = tmp_path / "c.h5"
    path.write_bytes(whole[1][3].read_bytes())
    with h5py.File(path, "r+") as file:
        values = file["state/force"][()]
        del file["state/force"]
        if change == "longer":
            values = np.append(values, 0.0)
            file["state/force"] = values
            file["state/force"].attrs["crc32"] = np.uint32(zlib.crc32(values.tobytes()))
    with pytest.raises(FileProblem, match=r"holds (none|numbers \(71,\)) as force, this deck needs \(70,\)"):
        hydro1d.run(DECK, tmp_path / "b.h5", restart=path)


@pytest.mark.parametrize("place", ["left_front", "right_front", "limiting_layer", "cycle"])
@pytest.mark.parametrize("value", [-1, 2**53 + 1, 2**63 - 1, -(2**63)])
def test_a_state_that_points_outside_its_arrays(whole, tmp_path, place, value):
    """A checkpoint with right checksums and shapes must not have compiled code read elsewhere."""
    path = tmp_path / "c.h5"
    path.write_bytes(whole[1][3].read_bytes())
    with h5py.File(path, "r+") as file:
        clock = file["state/clock"][()]
        clock[place] = value
        file["state/clock"][...] = clock
        file["state/clock"].attrs["crc32"] = np.uint32(zlib.crc32(clock.tobytes()))
    with pytest.raises(FileProblem, match="its state makes no sense"):
        hydro1d.run(DECK, tmp_path / "b.h5", restart=path)
