"""`Run`: reading, messages, notebooks, handles, memory."""

import gc
import os
import pickle
import subprocess
import sys
import threading
from pathlib import Path

import made_up
import numpy as np
import pytest
from test_store_round_trip import write

import hydro1d.store
from hydro1d.errors import FileProblem, Hydro1dError
from hydro1d.store import Hdf5Sink, Layout, MemorySink, open_run, source

HERE = Path(__file__).parent


def handles():
    links = [Path(f"/proc/self/fd/{fd}") for fd in os.listdir("/proc/self/fd")]
    return sorted(os.readlink(link) for link in links if link.is_symlink())


def in_memory(path):
    sink = MemorySink(made_up.layout(), made_up.DECK_TEXT, made_up.RESOLVED)
    made_up.record(sink, 0, 4)
    return sink.finish("complete", 1, 0.0)


@pytest.fixture(params=["file", "memory"])
def run(request, tmp_path):
    if request.param == "file":
        return open_run(write(tmp_path / "a.h5", 4))
    return in_memory(tmp_path)


def test_names(run):
    assert run["stress"].shape == (4, 50) and run.time.shape == (4,)
    assert run["history/momentum"] is run.history["momentum"]
    assert run["probes/stress"] is run.probes["stress"]
    assert run.history["time"] is run.history["history_time"] and "time" in run.history
    assert "stress" in run and "history/momentum" in run and "nonsense" not in run
    assert run.keys() == list(run) and run.keys()[0] == "time"
    assert run.describe("stress").units == "Pa" and run.describe("history/momentum").dimensions == ("history_time",)
    assert [layer.name for layer in run.layers] == ["foam", "Schaum – µ"]
    assert run["strain"][:, run.layers[1].zones].shape == (4, 25)
    assert "stress" in repr(run.history)


def test_missing_quantity(run):
    with pytest.raises(FileProblem, match=r"no quantity 'stres' in .*; did you mean 'stress'\? There is: time, "):
        run["stres"]
    with pytest.raises(FileProblem, match=r"no quantity 'x' in /history of .* There is: history_time, time_step"):
        run.history["x"]
    with pytest.raises(FileProblem, match="no quantity 'x' in /history"):
        run["history/x"]
    with pytest.raises(FileProblem, match="no quantity 3"):
        run.history[3]


def test_arrays_are_read_once_and_cannot_be_changed(run):
    assert run["stress"] is run["stress"]
    with pytest.raises(ValueError, match="read-only"):
        run["stress"][0, 0] = 1.0


def test_notebook(run):
    for text in (repr(run), run._repr_html_()):
        assert "Made up" in text and "complete" in text and "50 in 2 layer(s)" in text and "peak_stress" in text
    assert "<script" not in run._repr_html_()


def test_title_is_escaped():
    sink = MemorySink(made_up.layout(), "", {"title": "<script>alert(1)</script>"})
    assert "<script" not in sink.finish("complete", 1, 0.0)._repr_html_()


def test_to_xarray(run):
    pytest.importorskip("xarray")
    tree = run.to_xarray()
    assert tree["stress"].dims == ("time", "zone") and tree["stress"].attrs["units"] == "Pa"
    assert tree["history"]["momentum"].dims == ("history_time",)
    assert tree["probes"]["stress"].dims == ("history_time", "probe")
    assert {"zone_coordinate", "zone_layer"} <= set(tree["stress"].coords)
    tree["stress"][0, 0] = 1.0  # a copy


def test_to_xarray_without_xarray(run, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(Hydro1dError, match=r"pip install 'hydro1d\[xarray\]'"):
        run.to_xarray()


def test_nothing_is_held_open(tmp_path):
    path = write(tmp_path / "a.h5", 4)
    before = handles()
    with open_run(path) as run:
        run["stress"]
        assert handles() == before
    again = open_run(path)
    os.unlink(path)
    with pytest.raises(FileProblem, match="No such file"):
        again["stress"]
    assert handles() == before


def test_no_handle_leaks(tmp_path):
    write(tmp_path / "a.h5", 1)
    before = handles()
    for number in range(30):
        run = open_run(write(tmp_path / "a.h5", 2, flush_seconds=0.0, buffer_bytes=1))
        run["stress"]
        (tmp_path / "bad").write_bytes((tmp_path / "a.h5").read_bytes()[: 1000 * number])
        with pytest.raises(FileProblem):
            open_run(tmp_path / "bad")
        with Hdf5Sink(tmp_path / "b.h5", made_up.layout(), "", {}) as sink:
            sink.checkpoint(made_up.State(number, np.zeros(51)))
    assert handles() == before


def test_schema_may_be_left_to_the_caller(tmp_path):
    assert source.FileSource(write(tmp_path / "a.h5", 1)).schema_version == 1


def test_lazy_names():
    assert all(getattr(hydro1d.store, name) is not None for name in hydro1d.store.__all__)
    with pytest.raises(AttributeError):
        hydro1d.store.nonsense
    code = "import sys, hydro1d.store as s; s.MemorySink, s.Layout; assert 'h5py' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_layout_of_a_column():
    class Column:
        node_coordinate, zone_coordinate, zone_mass = np.arange(3.0), np.array([0.5, 1.5]), np.ones(2)
        zone_layer, layer_name, zone_history, history_variables = np.zeros(2), ["foam"], [], made_up.HISTORY
        probes, profile_times = [0.5], np.array([0.0, 1.0])

    layout = Layout.of(Column())
    assert (layout.zones, layout.layer_name, layout.profiles) == (2, ("foam",), 2)
    assert layout.probe_coordinate.dtype == np.float64


# Hands over much more than the buffer holds and says how the memory grows.
FLAT = r"""
import resource, sys
import made_up
import numpy as np
from hydro1d.store import Hdf5Sink

def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

block = np.random.default_rng(0).standard_normal((1000, len(made_up.HISTORY)))
probes = np.zeros((1000, 2, 4))
with Hdf5Sink(sys.argv[1], made_up.layout(), "", {}, buffer_bytes=4 << 20, flush_seconds=1.0) as sink:
    for number in range(int(sys.argv[2])):
        sink.history(block, probes)
        sink.flush()
        if number == int(sys.argv[2]) // 4:
            before = peak()
    sink.finish("complete", 1, 0.0)
print(peak() / before)
"""


def growth(path, blocks):
    done = subprocess.run([sys.executable, "-c", FLAT, path, str(blocks)], cwd=HERE, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return float(done.stdout)


def test_memory_is_flat(tmp_path):
    assert growth(tmp_path / "a.h5", 400) < 1.03


@pytest.mark.slow
def test_memory_is_flat_over_a_million_rows(tmp_path):
    assert growth(tmp_path / "a.h5", 1000) < 1.01


def test_reading_from_several_threads(tmp_path):
    run, results = open_run(write(tmp_path / "a.h5", 4)), []
    threads = [threading.Thread(target=lambda: results.append(run["stress"].sum())) for _ in range(8)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert len(set(results)) == 1 and len(results) == 8
    gc.collect()


def test_a_run_goes_to_another_process_without_what_it_has_in_memory(tmp_path):
    sink = Hdf5Sink(tmp_path / "a.h5", made_up.layout(), made_up.DECK_TEXT, made_up.RESOLVED)
    made_up.record(sink, 0, 40)
    run = open_run(sink.finish("complete", 1, 0.0), kept=sink.kept)
    packed = pickle.dumps(run)
    assert len(packed) < run["stress"].nbytes
    assert np.array_equal(pickle.loads(packed)["stress"], run["stress"])
