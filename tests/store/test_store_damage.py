"""Damaged and hostile files: an error or the right values, never wrong values, never a crash of the interpreter."""

import os
import subprocess
import sys
from pathlib import Path

import h5py
import made_up
import numpy as np
import pytest
from test_store_round_trip import write

from hydro1d.errors import FileProblem
from hydro1d.store import Hdf5Sink, open_run, read_checkpoint

HERE = Path(__file__).parent

# Runs in a process of its own: reads damaged copies of a file and compares all that it is given with the original.
SCRIPT = r"""
import os, sys
import numpy as np
from hydro1d.errors import FileProblem
from hydro1d.store import open_run, read_checkpoint

path, kind, count, seed = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
whole = open(path, "rb").read()
copy = path + ".damaged"

def everything(name):
    found = {}
    if "checkpoint" in path:
        read = read_checkpoint(name)
        found.update({key: array.tobytes() for key, array in read.arrays.items()})
        found["law_hashes"] = read.law_hashes
    run = open_run(name)
    found.update(attributes=run.attributes, deck=run.deck, text=run.deck_text, names=run._source.names)
    for group in (run, run.history, run.probes):
        for key in group:
            array = group[key]
            values = array.tolist() if array.dtype == object else array.tobytes()
            found[key] = (*found.get(key, ()), array.shape, values)
            found[key + " field"] = found.get(key + " field", ()) + (group.describe(key),)
    return found

good = everything(path)
assert len(good) > 50
rng = np.random.default_rng(seed)
refused = 0
for number in range(count):
    damaged = bytearray(whole)
    if kind == "flip":
        place = int(rng.integers(len(whole)))
        damaged[place] ^= 1 << int(rng.integers(8))
    elif kind == "zeros":
        place = int(rng.integers(len(whole)))
        damaged[place : place + 4096] = bytes(len(damaged[place : place + 4096]))
    else:
        place = int(rng.integers(len(whole))) if number else 0
        del damaged[place:]
    with open(copy, "wb") as stream:
        stream.write(damaged)
    try:
        assert everything(copy) == good, f"{kind} at {place} changes what is read"
    except FileProblem as problem:
        assert "\n" not in str(problem) and len(str(problem)) < 400 + len(copy), problem
        refused += 1
print(refused, "of", count, "refused")
"""


def damage(path, kind, count, seed=1):
    command = [sys.executable, "-c", SCRIPT, path, kind, str(count), str(seed)]
    done = subprocess.run(command, cwd=HERE, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return int(done.stdout.split()[0])


@pytest.fixture(scope="module")
def originals(tmp_path_factory):
    folder = tmp_path_factory.mktemp("damage")
    write(folder / "a.h5", 40, 200)
    with Hdf5Sink(folder / "c.h5", made_up.layout(200), made_up.DECK_TEXT, made_up.RESOLVED) as sink:
        made_up.record(sink, 0, 5, 200)
        sink.checkpoint(made_up.State(7, np.linspace(0.0, 1.0, 2000)))
    return {"result": folder / "a.h5", "checkpoint": folder / "c.checkpoint-7.h5"}


@pytest.mark.parametrize("kind, least", [("flip", 0.8), ("cut", 0.9), ("zeros", 0.9)])
@pytest.mark.parametrize("which", ["result", "checkpoint"])
def test_damage(originals, which, kind, least):
    assert damage(originals[which], kind, 30) >= least * 30


@pytest.mark.slow
@pytest.mark.parametrize("kind, least", [("flip", 0.8), ("cut", 0.9), ("zeros", 0.9)])
@pytest.mark.parametrize("which", ["result", "checkpoint"])
def test_much_damage(originals, which, kind, least):
    assert damage(originals[which], kind, 1000, seed=2) >= least * 1000


def test_the_message_says_what_is_wrong(originals, tmp_path):
    whole = originals["result"].read_bytes()
    cases = {
        "empty": (b"", "it is empty"),
        "text": (b"time,stress\n0,1\n", "it is not an HDF5 file"),
        "cut": (whole[: len(whole) // 2], "it is truncated"),
        "broken": (whole[:200] + b"\x55" + whole[201:], "does not fit its checksum"),
    }
    for name, (data, message) in cases.items():
        (tmp_path / name).write_bytes(data)
        for read in (open_run, read_checkpoint):
            with pytest.raises(FileProblem, match=message):
                read(tmp_path / name)
    for path, message in [(tmp_path / "missing.h5", "No such file"), (tmp_path, "it is a folder")]:
        with pytest.raises(FileProblem, match=message):
            open_run(path)


def test_cut_behind_the_data_loses_nothing_but_the_seal(originals, tmp_path):
    whole = originals["result"].read_bytes()
    (tmp_path / "a.h5").write_bytes(whole[:-5])
    assert open_run(tmp_path / "a.h5")["stress"].tobytes() == open_run(originals["result"])["stress"].tobytes()


@pytest.fixture
def edited(originals, tmp_path):
    """A result opened for editing with another program, which drops the seal."""
    path = tmp_path / "a.h5"
    path.write_bytes(originals["result"].read_bytes())

    def edit(change):
        with h5py.File(path, "r+") as file:
            change(file)
        return path

    return edit


def refused(path, message, name="stress"):
    with pytest.raises(FileProblem, match=message):
        open_run(path)[name]


def test_edited_values(edited):
    def change(file):
        file["stress"][3, 3] = 1.0

    path = edited(change)
    refused(path, "values of stress do not fit")
    open_run(path)["strain"]


def test_another_program_may_add_things(edited):
    def change(file):
        file.attrs["note"] = "mine"
        file["mine"] = [1.0]

    run = open_run(edited(change))
    assert run.attributes["note"] == "mine" and run["stress"].shape == (40, 200)
    with pytest.raises(FileProblem, match="no checksum"):
        run["mine"]


def test_newer_schema_and_foreign_files(edited, tmp_path):
    refused(edited(lambda file: file.attrs.__setitem__("schema_version", 99)), "schema version 99; .* up to 1")
    refused(edited(lambda file: file.attrs.__delitem__("schema_version")), "not one of hydro1d's")
    with h5py.File(tmp_path / "b.h5", "w") as file:
        file["x"] = 1.0
    refused(tmp_path / "b.h5", "not one of hydro1d's")


def replace(name, make):
    def change(file):
        del file[name]
        make(file)

    return change


def test_links_and_foreign_storage(edited, tmp_path):
    np.zeros(100).tofile(tmp_path / "raw")
    with h5py.File(tmp_path / "other.h5", "w") as other:
        other["stress"] = np.zeros(3)
    external = h5py.ExternalLink(str(tmp_path / "other.h5"), "/stress")
    refused(edited(replace("stress", lambda f: f.__setitem__("stress", external))), "is a link to elsewhere")
    refused(edited(replace("stress", lambda f: f.__setitem__("stress", h5py.SoftLink("/strain")))), "is a link")
    refused(
        edited(
            replace("stress", lambda f: f.create_dataset("stress", (100,), "f8", external=[(tmp_path / "raw", 0, 800)]))
        ),
        "from another file",
    )
    layout = h5py.VirtualLayout((3,), "f8")
    layout[:] = h5py.VirtualSource(str(tmp_path / "other.h5"), "stress", (3,))
    refused(edited(replace("stress", lambda f: f.create_virtual_dataset("stress", layout))), "from another file")
    group = h5py.ExternalLink(str(tmp_path / "other.h5"), "/")
    refused(edited(replace("history", lambda f: f.__setitem__("history", group))), "is a link to elsewhere")
    refused(edited(replace("deck/toml", lambda f: f.__setitem__("deck/toml", external))), "is a link to elsewhere")


def test_absurd_sizes(edited):
    def big(file):
        file.create_dataset("stress", (10**7, 10**7), "f8", chunks=(100, 100))

    def squeezed(file):
        data = file.create_dataset("stress", (10**6, 10**6), "f8", chunks=(1000, 1000), compression="gzip")
        data[:1000, :1000] = 0.0

    refused(edited(replace("stress", big)), r"claims 800000000000000 bytes but 0 are there; refused")
    refused(edited(replace("stress", squeezed)), "refused")


def test_wrong_kinds(edited):
    refused(edited(replace("stress", lambda f: f.create_group("stress"))), "is not a dataset")
    refused(edited(replace("stress", lambda f: f.__setitem__("stress", np.array([1 + 2j])))), "has the type complex128")
    refused(
        edited(replace("deck/resolved", lambda f: f.__setitem__("deck/resolved", "{"))),
        "cannot read .*: it is damaged",
    )
    refused(edited(replace("deck/toml", lambda f: f.__setitem__("deck/toml", [1, 2]))), "toml is not a text")
    refused(edited(replace("history", lambda f: f.__setitem__("history", 1.0))), "history is not a group")


def test_nothing_is_executed():
    source = "".join(path.read_text() for path in (HERE.parents[1] / "hydro1d" / "store").glob("*.py"))
    for word in ("pickle", "eval(", "exec(", "allow_pickle", "marshal", "shelve"):
        assert word not in source


def test_replaced_while_open(tmp_path):
    run = open_run(write(tmp_path / "a.h5", 3))
    stress = run["stress"]
    os.replace(write(tmp_path / "b.h5", 5), tmp_path / "a.h5")
    assert run["stress"] is stress
    with pytest.raises(FileProblem, match="was replaced since it was opened"):
        run["strain"]
