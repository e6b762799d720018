"""Where output goes: nothing is lost, nothing is left over, problems have one sentence."""

import os
import resource
import subprocess
import sys
import threading
from pathlib import Path

import h5py
import made_up
import numpy as np
import pytest
from test_store_round_trip import same, write

from hydro1d.errors import FileProblem
from hydro1d.store import Hdf5Sink, check_target, files, open_run

HERE = Path(__file__).parent


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def new(path, **options):
    return Hdf5Sink(
        path, made_up.layout(profiles=16), made_up.DECK_TEXT, made_up.RESOLVED, made_up.ATTRIBUTES, **options
    )


def test_target_is_missing_or_ours(tmp_path):
    assert check_target(tmp_path / "a.h5") == Path(os.path.realpath(tmp_path)) / "a.h5"
    check_target(write(tmp_path / "a.h5", 2))
    with h5py.File(tmp_path / "a.h5", "r+") as file:  # drops the seal
        file.attrs["note"] = "mine"
    check_target(tmp_path / "a.h5")
    assert names(tmp_path) == ["a.h5"]


def test_bad_targets(tmp_path):
    (tmp_path / "text.h5").write_text("mine")
    (tmp_path / "empty.h5").touch()
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1.0
    (tmp_path / "broken.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    os.mkfifo(tmp_path / "fifo")
    before = names(tmp_path)
    cases = {
        "missing/a.h5": "does not exist",
        "text.h5/a.h5": "is not a folder|Not a directory",
        ".": "it is a folder",
        "text.h5": "hydro1d did not write",
        "empty.h5": "hydro1d did not write",
        "other.h5": "hydro1d did not write",
        "broken.h5": "hydro1d did not write",
        "fifo": "not a regular file",
        "n" * 300 + ".h5": "too long",
    }
    for name, message in cases.items():
        with pytest.raises(FileProblem, match=message):
            check_target(tmp_path / name)
        with pytest.raises(FileProblem, match=message):
            new(tmp_path / name)
    assert names(tmp_path) == before


def test_no_permission(tmp_path):
    folder = tmp_path / "f"
    folder.mkdir()
    folder.chmod(0o500)
    if os.access(folder, os.W_OK):
        pytest.skip("the super-user may write everywhere")
    with pytest.raises(FileProblem, match="Permission denied"):
        check_target(folder / "a.h5")


@pytest.fixture
def mounted(tmp_path):
    """A folder with a file system of 1 MB of its own."""
    folder = tmp_path / "small"
    folder.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", folder], capture_output=True).returncode:
        pytest.skip("mounting is not permitted")
    yield folder
    subprocess.run(["umount", folder], check=True)


def test_read_only_folder(mounted):
    path = write(mounted / "a.h5", 2)
    subprocess.run(["mount", "-o", "remount,ro", mounted], check=True)
    with pytest.raises(FileProblem, match="Read-only file system"):
        check_target(path)
    same(open_run(path), made_up.expected(2))


def noise(sink, profiles):
    rng = np.random.default_rng(1)
    for number in range(profiles):
        frame = made_up.frame(number)
        frame.fields = {name: rng.standard_normal(values.shape) for name, values in frame.fields.items()}
        sink.profile(frame)
        sink.flush()


ROUTES = [{}, {"buffer_bytes": 50_000}, {"flush_seconds": 0.0}, {"buffer_bytes": 50_000, "flush_seconds": 0.0}]


@pytest.mark.parametrize("options", ROUTES)
def test_disk_full(mounted, options):
    path = write(mounted / "a.h5", 2)
    before = path.read_bytes()
    with pytest.raises(FileProblem, match=r"cannot write .*: No space left on device"), new(path, **options) as sink:
        noise(sink, 1000)
        sink.finish("complete", 1, 0.0)
    assert path.read_bytes() == before
    assert set(names(mounted)) <= {"a.h5", "a.partial.h5"}
    for name in names(mounted):
        open_run(mounted / name)["stress"]


@pytest.mark.parametrize("options", ROUTES)
def test_checkpoint_on_a_full_disk(mounted, options):
    with pytest.raises(FileProblem, match="No space left on device"), new(mounted / "a.h5", **options) as sink:
        noise(sink, 150)
        for cycle in range(5):
            sink.checkpoint(made_up.State(cycle, np.random.default_rng(0).standard_normal(60_000)))
    assert not list(mounted.glob(".*"))
    for name in names(mounted):
        open_run(mounted / name)["stress"]


def test_file_size_limit(tmp_path):
    path = write(tmp_path / "a.h5", 2)
    before = path.read_bytes()
    old = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, old[1]))
    try:
        for options in ROUTES:
            with pytest.raises(FileProblem, match="File too large"), new(path, **options) as sink:
                noise(sink, 500)
                sink.finish("complete", 1, 0.0)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, old)
    assert path.read_bytes() == before
    assert not list(tmp_path.glob(".*"))


def test_folder_vanishes(tmp_path):
    folder = tmp_path / "f"
    folder.mkdir()
    sink = new(folder / "a.h5")
    made_up.record(sink, 0, 2)
    folder.rmdir()
    with pytest.raises(FileProblem, match="No such file"):
        sink.finish("complete", 1, 0.0)


def test_foreign_file_appears_meanwhile(tmp_path):
    with new(tmp_path / "a.h5") as sink:
        (tmp_path / "a.h5").write_text("mine")
        with pytest.raises(FileProblem, match="hydro1d did not write"):
            sink.finish("complete", 1, 0.0)
    assert (tmp_path / "a.h5").read_text() == "mine" and names(tmp_path) == ["a.h5"]
    (tmp_path / "b.partial.h5").write_text("mine")
    with new(tmp_path / "b.h5") as sink:
        with pytest.raises(FileProblem, match="hydro1d did not write"):
            sink.publish_partial()
        sink.finish("complete", 1, 0.0)
    assert (tmp_path / "b.partial.h5").read_text() == "mine"


def test_earlier_output_stays_until_the_new_is_complete(tmp_path):
    path = write(tmp_path / "a.h5", 3)
    with new(path, flush_seconds=0.0) as sink:
        made_up.record(sink, 0, 5)
        same(open_run(path), made_up.expected(3))
        sink.finish("complete", 1, 0.0)
    same(open_run(path), made_up.expected(5))


@pytest.mark.parametrize("status, name", [("failed", "a.failed.h5"), ("interrupted", "a.partial.h5")])
def test_run_that_does_not_complete(tmp_path, status, name):
    path = write(tmp_path / "a.h5", 3)
    with new(path) as sink:
        made_up.record(sink, 0, 5)
        assert sink.finish(status, 7, 0.1, message="zone 3 is inverted").name == name
    same(open_run(path), made_up.expected(3))
    run = open_run(tmp_path / name)
    same(run, made_up.expected(5))
    assert run.status == status and run.attributes["message"] == "zone 3 is inverted"


def test_unknown_status(tmp_path):
    with new(tmp_path / "a.h5") as sink, pytest.raises(ValueError, match="finished"):
        sink.finish("finished", 1, 0.0)


def test_link_is_followed(tmp_path):
    (tmp_path / "real").mkdir()
    (tmp_path / "a.h5").symlink_to(tmp_path / "real" / "b.h5")
    write(tmp_path / "a.h5", 2)
    assert (tmp_path / "a.h5").is_symlink() and names(tmp_path / "real") == ["b.h5"]


def test_exception_leaves_nothing_temporary(tmp_path):
    with pytest.raises(ZeroDivisionError), new(tmp_path / "a.h5", buffer_bytes=1) as sink:
        noise(sink, 300)
        assert list(tmp_path.glob(".*"))
        raise ZeroDivisionError
    assert not names(tmp_path)
    sink = new(tmp_path / "a.h5", buffer_bytes=1)
    noise(sink, 300)
    del sink
    assert not names(tmp_path)


def test_names_beside_the_output():
    assert files.sibling(Path("run.h5"), "partial").name == "run.partial.h5"
    assert files.sibling(Path("run.v2"), "checkpoint-7").name == "run.v2.checkpoint-7.h5"


def test_leftovers_of_dead_runs_go_those_of_living_ones_stay(tmp_path):
    living = new(tmp_path / "a.h5", buffer_bytes=1)
    noise(living, 300)
    dead = files.Temporary(tmp_path)
    os.close(dead.fd)
    new(tmp_path / "b.h5")
    assert not dead.path.exists() and len(list(tmp_path.glob(".*"))) == 1
    living.finish("complete", 1, 0.0)
    assert names(tmp_path) == ["a.h5"]


def test_same_name_at_once(tmp_path):
    def run(number):
        with new(tmp_path / "a.h5", buffer_bytes=20_000, flush_seconds=0.0) as sink:
            made_up.record(sink, 0, 10 + number)
            sink.finish("complete", number, 0.0)

    lengths = set()
    threads = [threading.Thread(target=run, args=(number,)) for number in range(4)]
    [thread.start() for thread in threads]
    while any(thread.is_alive() for thread in threads):
        if (tmp_path / "a.h5").exists():
            try:
                lengths.add(len(open_run(tmp_path / "a.h5")["stress"]))
            except FileProblem as problem:
                assert "was replaced" in str(problem)
    [thread.join() for thread in threads]
    result = open_run(tmp_path / "a.h5")
    same(result, made_up.expected(10 + result.attributes["cycles"]))
    assert lengths <= {10, 11, 12, 13}
    assert set(names(tmp_path)) <= {"a.h5", "a.partial.h5"}


def test_same_folder_from_two_processes(tmp_path):
    script = (
        "import sys, made_up; from test_store_round_trip import write\n"
        "for n in range(4): write(f'{sys.argv[1]}/{sys.argv[2]}.h5', 10 + n, buffer_bytes=20_000, flush_seconds=0.0)"
    )
    runs = [
        subprocess.Popen([sys.executable, "-c", script, tmp_path, name], cwd=HERE, stderr=subprocess.PIPE)
        for name in ("a", "b", "b")
    ]
    for run in runs:
        assert run.communicate()[1] == b"" and run.returncode == 0
    for name in ("a", "b"):
        same(open_run(tmp_path / f"{name}.h5"), made_up.expected(13))
    assert set(names(tmp_path)) <= {"a.h5", "b.h5", "b.partial.h5"}


def test_partial_files_cost_little(tmp_path):
    with new(tmp_path / "a.h5", flush_seconds=0.02) as sink:
        written = []
        sink.publish_partial()
        original = sink._publish
        sink._publish = lambda *args, **more: written.append(original(*args, **more)) or written[-1]
        made_up.record(sink, 0, 100)
    assert len(written) < 50
