"""Checkpoints: a restart continues as if nothing had happened, or is refused with the reason."""

import copy
import os

import h5py
import made_up
import numpy as np
import pytest
from test_store_round_trip import same

from hydro1d.errors import FileProblem
from hydro1d.store import Hdf5Sink, open_run, read_checkpoint, verify_checkpoint


def new(path, layout=None, **options):
    return Hdf5Sink(
        path, layout or made_up.layout(), made_up.DECK_TEXT, made_up.RESOLVED, made_up.ATTRIBUTES, **options
    )


def state(cycle):
    return made_up.State(cycle, np.random.default_rng(cycle).standard_normal(51))


@pytest.fixture
def checkpoint(tmp_path):
    with new(tmp_path / "a.h5") as sink:
        made_up.record(sink, 0, 10)
        sink.checkpoint(state(350))
    return tmp_path / "a.checkpoint-350.h5"


def resume(path, read, layout=None, **options):
    layout = layout or made_up.layout()
    return Hdf5Sink.resume(read, path, layout, made_up.DECK_TEXT, made_up.RESOLVED, made_up.ATTRIBUTES, **options)


def test_state_is_exact(checkpoint):
    read = read_checkpoint(checkpoint)
    for name, array in state(350).arrays().items():
        array = np.asarray(array)
        assert read.arrays[name].dtype == array.dtype and read.arrays[name].shape == array.shape, name
        assert read.arrays[name].tobytes() == array.tobytes(), name
    assert (read.cycle, read.time) == (350, 350e-6)
    assert read.deck_text == made_up.DECK_TEXT and read.resolved == made_up.RESOLVED
    assert read.law_hashes == {"foam": "abc123"} and read.schema_version == 1


@pytest.mark.parametrize("options", [{}, {"buffer_bytes": 20_000}, {"buffer_bytes": 1, "flush_seconds": 0.0}])
@pytest.mark.parametrize("at", [0, 1, 10, 39])
def test_restart_ends_with_the_same_data(tmp_path, at, options):
    with new(tmp_path / "a.h5", **options) as sink:
        made_up.record(sink, 0, at)
        sink.checkpoint(state(at))
        made_up.record(sink, at, 40)
        whole = sink.finish("complete", 1, 0.0)
    with resume(tmp_path / "b.h5", read_checkpoint(tmp_path / f"a.checkpoint-{at}.h5"), **options) as sink:
        made_up.record(sink, at, 40)
        again = sink.finish("complete", 1, 0.0)
    same(open_run(again), made_up.expected(40))
    with h5py.File(whole) as one, h5py.File(again) as other:
        assert all(one[name].attrs["crc32"] == other[name].attrs["crc32"] for name in ("stress", "history/momentum"))


def test_chain_of_restarts(tmp_path):
    sink = new(tmp_path / "a.h5")
    for number in range(20):
        with sink:
            made_up.record(sink, 2 * number, 2 * number + 2)
            sink.checkpoint(state(number))
        sink = resume(tmp_path / "a.h5", read_checkpoint(tmp_path / f"a.checkpoint-{number}.h5"))
    same(open_run(sink.finish("complete", 1, 0.0)), made_up.expected(40))


def test_the_last_two_are_kept(tmp_path):
    def kept():
        return sorted(path.name for path in tmp_path.glob("*checkpoint*"))

    (tmp_path / "a.checkpoint-notes.txt").write_text("mine")
    with new(tmp_path / "a.h5") as sink:
        for cycle in (5, 50, 500):
            sink.checkpoint(state(cycle))
        sink.checkpoint(state(500))
    assert kept() == ["a.checkpoint-50.h5", "a.checkpoint-500.h5", "a.checkpoint-notes.txt"]
    with resume(tmp_path / "a.h5", read_checkpoint(tmp_path / "a.checkpoint-500.h5")) as sink:
        sink.checkpoint(state(600))
    assert kept() == ["a.checkpoint-500.h5", "a.checkpoint-600.h5", "a.checkpoint-notes.txt"]


def test_a_checkpoint_needs_no_other_file(checkpoint, tmp_path):
    other = tmp_path / "elsewhere"
    other.mkdir()
    os.rename(checkpoint, other / "c.h5")
    with resume(other / "b.h5", read_checkpoint(other / "c.h5")) as sink:
        same(open_run(sink.finish("complete", 1, 0.0)), made_up.expected(10))


def test_more_probes(checkpoint, tmp_path):
    layout = made_up.layout(probes=3)  # 0.25, 0.5, 0.75; the checkpoint has the outer two
    with resume(tmp_path / "b.h5", read_checkpoint(checkpoint), layout) as sink:
        made_up.record(sink, 10, 12, probes=3)
        run = open_run(sink.finish("complete", 1, 0.0))
    before = made_up.expected(10)["probes/stress"]
    assert np.array_equal(run.probes["stress"][:350, [0, 2]], before)
    assert np.isnan(run.probes["stress"][:350, 1]).all() and not np.isnan(run.probes["stress"][350:]).any()


def changed(path, value):
    deck = copy.deepcopy(made_up.RESOLVED)
    *parents, last = path.split(".")
    where = deck
    for parent in parents:
        where = where.setdefault(parent, {})
    where[last] = value
    return deck


@pytest.mark.parametrize(
    "path, value",
    [
        ("time.end", 0.016),
        ("title", "x"),
        ("output.profiles", [0.0]),
        ("output.probes", [1.0]),
        ("checkpoint.cycles", 5),
    ],
)
def test_what_may_change(checkpoint, path, value):
    verify_checkpoint(read_checkpoint(checkpoint), changed(path, value), {"foam": "abc123"})


@pytest.mark.parametrize(
    "path, value", [("material.foam.modulus", 23e6), ("time.cfl", 0.4), ("left.type", "wall"), ("material.foam", None)]
)
def test_what_may_not(checkpoint, path, value):
    with pytest.raises(FileProblem, match=f"{path}: .* in the checkpoint, .* in the deck"):
        verify_checkpoint(read_checkpoint(checkpoint), changed(path, value))
    verify_checkpoint(read_checkpoint(checkpoint), changed(path, value), force=True)


def test_lists_are_compared(checkpoint):
    read = read_checkpoint(checkpoint)
    for old, new_, message in [([1, 2], [1, 3], r"layer\[1\]: 2"), ([1], [1, 2], "layer: 1 entries .*, 2 entries")]:
        read.resolved["layer"] = old
        with pytest.raises(FileProblem, match=message):
            verify_checkpoint(read, changed("layer", new_))


def test_other_law_source(checkpoint):
    with pytest.raises(FileProblem, match="law of material foam: its source has changed"):
        verify_checkpoint(read_checkpoint(checkpoint), made_up.RESOLVED, {"foam": "def"})
    verify_checkpoint(read_checkpoint(checkpoint), made_up.RESOLVED, {"foam": "def"}, force=True)


def test_end_before_the_checkpoint(checkpoint):
    for force in (False, True):
        with pytest.raises(FileProblem, match="after the deck's end"):
            verify_checkpoint(read_checkpoint(checkpoint), changed("time.end", 1e-6), force=force)


@pytest.mark.parametrize("version", [0, 2])
def test_schema_version(checkpoint, version):
    with h5py.File(checkpoint, "r+") as file:
        file.attrs["schema_version"] = version
    read = read_checkpoint(checkpoint)
    with pytest.raises(FileProblem, match=f"schema version: {version} in the checkpoint, 1 here"):
        verify_checkpoint(read, made_up.RESOLVED)
    verify_checkpoint(read, made_up.RESOLVED, force=True)


def test_a_result_is_no_checkpoint(tmp_path):
    with new(tmp_path / "a.h5") as sink:
        path = sink.finish("complete", 1, 0.0)
    with pytest.raises(FileProblem, match="not a checkpoint"):
        read_checkpoint(path)


def test_other_zones_or_quantities(checkpoint, tmp_path):
    with pytest.raises(FileProblem, match="another number of zones"):
        resume(tmp_path / "b.h5", read_checkpoint(checkpoint), made_up.layout(60))
    layout = made_up.layout()
    object.__setattr__(layout, "zone_history", (made_up.Variable("damage", "1", "damage"),))
    with pytest.raises(FileProblem, match="it holds no damage"):
        resume(tmp_path / "b.h5", read_checkpoint(checkpoint), layout)
    assert not list(tmp_path.glob(".*"))


def test_state_that_cannot_be_stored(tmp_path):
    class Bad:
        cycle, time = 1, 0.0

        def arrays(self):
            return {"name": np.array("text")}

    with new(tmp_path / "a.h5") as sink, pytest.raises(FileProblem, match="cannot be stored exactly"):
        sink.checkpoint(Bad())
    assert not list(tmp_path.iterdir())
