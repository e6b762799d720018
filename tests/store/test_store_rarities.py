"""What rarely happens: clean-ups that come in between, systems that refuse, records that do not fit each other."""

import dataclasses
import errno
import os
import shutil
import zlib

import h5py
import made_up
import numpy as np
import pytest
from test_store_round_trip import same, write

from hydro1d.errors import FileProblem
from hydro1d.store import Hdf5Sink, MemorySink, deflate, files, hdf5, open_run, read_checkpoint, seal, source


def new(path, probes=2, **options):
    return Hdf5Sink(
        path, made_up.layout(probes=probes), made_up.DECK_TEXT, made_up.RESOLVED, made_up.ATTRIBUTES, **options
    )


def checkpointed(path, probes=2, profiles=10):
    with new(path, probes) as sink:
        made_up.record(sink, 0, profiles, probes=probes)
        return read_checkpoint(sink.checkpoint(made_up.State(350, np.zeros(51))))


def resumed(path, checkpoint, probes=2):
    return Hdf5Sink.resume(
        checkpoint, path, made_up.layout(probes=probes), made_up.DECK_TEXT, made_up.RESOLVED, made_up.ATTRIBUTES
    )


def test_restart_without_probes(tmp_path):
    with resumed(tmp_path / "b.h5", checkpointed(tmp_path / "a.h5", 0), 0) as sink:
        made_up.record(sink, 10, 12, probes=0)
        run = open_run(sink.finish("complete", 1, 0.0))
    expected = made_up.expected(12, probes=0)
    same(run, {path: array for path, array in expected.items() if not path.startswith("probes")})


@pytest.mark.parametrize("name", ["time", "velocity", "stress", "history/momentum", "probes/stress", "probes"])
@pytest.mark.parametrize("rows", [0, 9])
def test_records_that_differ_in_length_are_refused(tmp_path, name, rows):
    path = checkpointed(tmp_path / "a.h5").path
    shortened = ["position", "velocity", "strain", "stress"] if name == "probes" else [name.removeprefix("probes/")]
    with h5py.File(path, "r+") as file:
        for array in (file["probes"][item] if "probes" in name else file[item] for item in shortened):
            array.resize(rows, axis=0)
            array.attrs["crc32"] = np.uint32(zlib.crc32(array[()].tobytes()))
    with pytest.raises(FileProblem, match=r"cannot carry on from .*: its records differ in length"):
        resumed(tmp_path / "b.h5", read_checkpoint(path))
    assert not list(tmp_path.glob(".hydro1d-*"))


def test_other_probes_than_it_claims(tmp_path):
    path = checkpointed(tmp_path / "a.h5").path
    with h5py.File(path, "r+") as file:
        del file["probes/probe"]
        values = np.array([0.5, 0.6, 0.25, 0.75])
        file["probes/probe"] = values
        file["probes/probe"].attrs["crc32"] = np.uint32(zlib.crc32(values.tobytes()))
    with pytest.raises(FileProblem, match=r"cannot carry on from .*: index 2 is out of bounds"):
        resumed(tmp_path / "b.h5", read_checkpoint(path))
    assert not list(tmp_path.glob(".hydro1d-*"))


def test_planes_of_noise_and_of_order():
    """Whichever bytes of the numbers are noise, zlib gives back what was put in."""
    rng = np.random.default_rng(1)
    noise = rng.integers(0, 2**63, 20_000)
    for kept in range(0, 65, 8):
        values = ((noise >> kept) << kept if kept < 64 else noise * 0).view(np.float64)
        planes = np.frombuffer(zlib.decompress(deflate.deflate(values)), np.uint8).reshape(8, -1)
        assert np.array_equal(planes.T.reshape(-1), values.view(np.uint8))
    low = (noise & 0xFF).view(np.float64)  # noise in the last digits alone
    assert zlib.decompress(deflate.deflate(low))[:20_000] == low.view(np.uint8).reshape(-1, 8)[:, 0].tobytes()
    assert len(deflate.deflate(low)) < 1.2 * 20_000 < len(deflate.deflate(noise.view(np.float64)))


def test_a_clean_up_that_comes_between_opening_and_locking(tmp_path, monkeypatch):
    real, times = files._lock, []

    def slow(fd):
        times.append(fd)
        if len(times) == 1:
            next(tmp_path.glob(".hydro1d-*")).unlink()
        return real(fd)

    monkeypatch.setattr(files, "_lock", slow)
    temporary = files.Temporary(tmp_path)
    assert temporary.path.exists() and len(times) == 2
    with pytest.raises(OSError, match="Bad file descriptor"):  # the first is closed again, unless reused
        os.fstat(times[0]) if times[0] != temporary.fd else os.fstat(-1)
    temporary.discard()
    temporary.discard()
    assert not list(tmp_path.iterdir())


def test_a_system_without_locks_or_preallocation(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "fcntl", None)
    monkeypatch.delattr(os, "posix_fallocate", raising=False)
    dead = files.Temporary(tmp_path)
    os.close(dead.fd)
    same(open_run(write(tmp_path / "a.h5", 5, buffer_bytes=1)), made_up.expected(5))
    assert dead.path.exists(), "without locks nobody knows that it is dead"


def test_an_error_that_says_nothing():
    with pytest.raises(FileProblem, match=r"cannot read x: RuntimeError$"), files.explained("read", "x"):
        raise RuntimeError
    with pytest.raises(FileProblem, match=r"cannot read x: not enough memory$"), files.explained("read", "x"):
        raise MemoryError
    with pytest.raises(ZeroDivisionError), files.explained("read", "x"):
        raise ZeroDivisionError


def test_a_partial_file_that_cannot_be_copied_leaves_nothing(tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    sink = new(tmp_path / "a.h5", buffer_bytes=1, flush_seconds=1e9)
    made_up.record(sink, 0, 3000)
    assert list(tmp_path.iterdir()), "there is a working file"
    monkeypatch.setattr(shutil, "copyfile", refuse)
    with pytest.raises(FileProblem, match="No space left on device"):
        sink.publish_partial()
    assert len(list(tmp_path.iterdir())) == 1  # its own working file
    sink.abort()
    assert not list(tmp_path.iterdir())


def test_attributes_keep_their_kind():
    values = {"truth": True, "many": [1, 2], "words": ["a", "µ"], "share": 0.5, "name": "σ"}
    with hdf5.new_image() as file:
        for name, value in values.items():
            hdf5.set_attribute(file.id, name, value)
        assert {name: np.asarray(file.attrs[name]).tolist() for name in values} == values | {"truth": 1}
        assert file.attrs["truth"].dtype == np.int8 and file.attrs["many"].dtype == np.int64


def test_a_seal_that_covers_everything_or_nothing():
    data = bytes(range(100))

    def read(offset, size):
        return data[offset : offset + size]

    for ranges in ([], [(0, 100)], [(0, 40), (40, 60)], [(20, 30), (10, 30)]):
        covered = set().union(*(range(offset, offset + size) for offset, size in seal._outside(100, ranges)))
        assert covered == set(range(100)) - set().union(*(range(offset, offset + size) for offset, size in ranges))
        assert len(seal.make_seal(read, 100, ranges)) % 8 == 0


def test_a_seal_that_lies_about_its_size(tmp_path):
    path = write(tmp_path / "a.h5", 2)
    whole = bytearray(path.read_bytes())
    footer = len(whole) - seal._FOOTER.size
    for place in (8, 16, 28):  # bytes of HDF5 data, number of ranges, the footer's own checksum
        damaged = bytearray(whole)
        damaged[footer + place] ^= 1
        path.write_bytes(damaged)
        with pytest.raises(FileProblem, match="does not fit its checksum"):
            open_run(path)


def test_full_blocks_that_wait_while_there_is_a_working_file(tmp_path):
    layout = made_up.layout(profiles=3)  # blocks of three profiles, 11 kB
    with Hdf5Sink(
        tmp_path / "a.h5", layout, made_up.DECK_TEXT, made_up.RESOLVED, buffer_bytes=20_000, threads=1
    ) as sink:
        made_up.record(sink, 0, 6)
        assert len(list(tmp_path.glob(".hydro1d-*"))) == 1, "two blocks were more than the buffer takes"
        made_up.record(sink, 6, 10)
        run = open_run(sink.finish("complete", 1, 0.0))
    same(run, made_up.expected(10))


def test_what_the_library_quotes_of_the_system(tmp_path):
    with (
        pytest.raises(FileProblem, match=r"^cannot open [^:]*a\.h5: No such file or directory$"),
        files.explained("open", tmp_path / "a.h5"),
        h5py.File(tmp_path / "nowhere" / "a.h5", "w"),
    ):
        pass


def test_the_table_of_a_sweep_is_no_run(tmp_path):
    path = write(tmp_path / "a.h5", 2)
    with h5py.File(path, "r+") as file:
        file.attrs["content"] = "table"
    with pytest.raises(FileProblem, match=r"is a table of hydro1d sweep, not the result of a run"):
        open_run(path)


def test_a_run_without_history_and_probes_describes_itself():
    layout = dataclasses.replace(made_up.layout(probes=0), history=())
    sink = MemorySink(layout, "", {})
    sink.profile(made_up.frame(0))
    run = sink.finish("complete", 0, 0.0)
    assert "history" not in repr(run) and "profiles" in repr(run)
    tree = run.to_xarray()
    assert not tree.children and tree["stress"].shape == (1, 50)


def test_an_empty_run_in_memory_describes_itself():
    run = MemorySink(made_up.layout(probes=0), "", {}).finish("complete", 0, 0.0)
    text = repr(run)
    assert "profiles" not in text and "probes" not in text
    assert "time" in run.history and "nonsense" not in run.history


def refused(path, change, message, name="stress"):
    with h5py.File(path, "r+") as file:
        change(file)
    with pytest.raises(FileProblem, match=message):
        list(source.FileSource(path).rows(name, 3))


def test_rows_of_what_is_no_array_of_numbers(tmp_path):
    path = checkpointed(tmp_path / "a.h5").path
    refused(path, lambda file: None, "zone is not an array with a checksum", "zone")
    refused(path, lambda file: file["strain"].attrs.__delitem__("crc32"), "strain is not an array", "strain")
    refused(path, lambda file: file["stress"].__setitem__((3, 3), 1.0), "values of stress do not fit their checksum")


def test_state_without_checksums_is_no_state(tmp_path):
    path = checkpointed(tmp_path / "a.h5").path
    with h5py.File(path, "r+") as file:
        for array in file["state"].values():
            if "crc32" in array.attrs:
                del array.attrs["crc32"]
    with pytest.raises(FileProblem, match="holds no state to start from"):
        read_checkpoint(path)


def test_attributes_of_several_values_are_read_as_lists(tmp_path):
    path = write(tmp_path / "a.h5", 2)
    with h5py.File(path, "r+") as file:
        file.attrs["numbers"] = [1, 2, 3]
    assert open_run(path).attributes["numbers"] == [1, 2, 3]


def test_an_hdf5_file_with_a_broken_body_says_that_it_is_damaged(tmp_path):
    (tmp_path / "a.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + b"\xff" * 5000)
    with pytest.raises(FileProblem, match=r"cannot read .*: it is damaged"):
        open_run(tmp_path / "a.h5")
