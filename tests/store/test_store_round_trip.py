"""What is written is read back bit for bit, whichever way it took to the file."""

import h5py
import made_up
import numpy as np
import pytest

from hydro1d.errors import FileProblem
from hydro1d.store import Hdf5Sink, MemorySink, open_run


def write(path, profiles=40, zones=50, probes=2, layout=None, **options):
    layout = layout or made_up.layout(zones, probes, profiles)
    with Hdf5Sink(path, layout, made_up.DECK_TEXT, made_up.RESOLVED, made_up.ATTRIBUTES, **options) as sink:
        made_up.record(sink, 0, profiles, zones, probes)
        sink.maxima(made_up.maxima(zones))
        return sink.finish("complete", 35 * profiles, 0.25, peak_load=None, nodes=zones + 1)


def same(run, arrays):
    for path, array in arrays.items():
        assert run[path].shape == array.shape, path
        assert run[path].tobytes() == np.ascontiguousarray(array).tobytes(), path


ROUTES = {
    "at once": {},
    "one thread": {"threads": 1},
    "through a working file": {"buffer_bytes": 20_000},
    "with partial files": {"flush_seconds": 0.0},
    "both": {"flush_seconds": 0.0, "buffer_bytes": 20_000},
}


@pytest.mark.parametrize("route", ROUTES)
def test_exact(tmp_path, route):
    run = open_run(write(tmp_path / "a.h5", **ROUTES[route]))
    same(run, made_up.expected(40))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.h5"]


@pytest.mark.parametrize("profiles", [0, 1, 2, 3])
def test_few_profiles(tmp_path, profiles):
    run = open_run(write(tmp_path / "a.h5", profiles))
    assert run.time.shape == (profiles,)
    assert run["stress"].shape == (profiles, 50)
    if profiles:
        same(run, made_up.expected(profiles))
    repr(run)


@pytest.mark.parametrize("zones", [1, 10, 1000, 70_000])
def test_sizes(tmp_path, zones):
    same(open_run(write(tmp_path / "a.h5", 5, zones, buffer_bytes=1)), made_up.expected(5, zones))


def test_no_probes(tmp_path):
    run = open_run(write(tmp_path / "a.h5", 5, probes=0))
    assert len(run.probes) == 0
    arrays = made_up.expected(5, probes=0)
    same(run, {path: array for path, array in arrays.items() if not path.startswith("probes")})


def test_incompressible_and_constant(tmp_path):
    rng = np.random.default_rng(5)
    values = {
        "noise": rng.integers(0, 2**63, (130, 1000)).view(np.float64),
        "zeros": np.zeros((130, 1000)),
        "special": rng.choice([np.nan, -np.nan, np.inf, -np.inf, -0.0, 5e-324], (130, 1000)),
    }
    for name, array in values.items():
        with Hdf5Sink(tmp_path / f"{name}.h5", made_up.layout(1000, 0), "", {}) as sink:
            for number in range(130):
                frame = made_up.frame(number, 1000)
                frame.fields["stress"] = array[number]
                sink.profile(frame)
            path = sink.finish("complete", 1, 0.0)
        assert open_run(path)["stress"].tobytes() == array.tobytes(), name
        with h5py.File(path) as file:
            assert file["stress"][()].tobytes() == array.tobytes(), name


def test_in_memory_the_same(tmp_path):
    from_file = open_run(write(tmp_path / "a.h5"))
    sink = MemorySink(made_up.layout(), made_up.DECK_TEXT, made_up.RESOLVED, made_up.ATTRIBUTES)
    made_up.record(sink, 0, 40)
    sink.maxima(made_up.maxima())
    run = sink.finish("complete", 1400, 0.25)
    same(run, made_up.expected(40))
    assert run.keys() == from_file.keys()
    for name in run:
        assert run.describe(name) == from_file.describe(name)
        assert np.array_equal(run[name], from_file[name], equal_nan=name == "viscosity")
    assert run.layers == from_file.layers
    assert run.deck == from_file.deck and run.deck_text == from_file.deck_text
    assert (run.status, run.title) == ("complete", made_up.RESOLVED["title"])
    assert run.to_xarray().identical(run.to_xarray())


def test_records_are_copied(tmp_path):
    with Hdf5Sink(tmp_path / "a.h5", made_up.layout(), "", {}) as sink:
        frame, (block, probes) = made_up.frame(3), made_up.rows(3)
        sink.profile(frame)
        sink.history(block, probes)
        frame.fields["stress"][:] = -1.0
        block[:], probes[:] = -1.0, -1.0
        run = open_run(sink.finish("complete", 1, 0.0))
    assert (
        (run["stress"] != -1.0).all() and (run.history["time"] != -1.0).all() and (run.probes["stress"] != -1.0).all()
    )


def test_chunks_suit_profiles_and_time_series(tmp_path):
    with h5py.File(write(tmp_path / "a.h5", 201, 1000)) as file:
        assert file["stress"].chunks == (51, 1000)
        assert file["stress"].compression == "gzip" and file["stress"].shuffle
        assert file["history/right_stress"].chunks == (7035,)


@pytest.mark.parametrize("buffer_bytes", [32 << 20, 2 << 20, 100_000])
def test_what_is_still_in_memory_is_what_the_file_holds(tmp_path, buffer_bytes):
    sink = Hdf5Sink(
        tmp_path / "a.h5", made_up.layout(zones=1000, profiles=200), made_up.DECK_TEXT, made_up.RESOLVED,
        buffer_bytes=buffer_bytes,
    )  # fmt: skip
    made_up.record(sink, 0, 200, zones=1000)
    path = sink.finish("complete", 200, 0.0)
    kept, read = open_run(path, kept=sink.kept), open_run(path)
    assert (sink.kept("stress") is not None) == (buffer_bytes == 32 << 20)  # else its numbers had to go
    for name in (*read, *(f"{group}/{name}" for group in ("history", "probes") for name in getattr(read, group))):
        assert kept[name].dtype == read[name].dtype, name
        assert np.array_equal(kept[name], read[name], equal_nan=read[name].dtype.kind == "f"), name
    kept.close()
    (tmp_path / "a.h5").unlink()
    with pytest.raises(FileProblem):
        kept["stress"]
