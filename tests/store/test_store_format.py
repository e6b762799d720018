"""The file format: what other programs find in a file."""

import json
import shutil
import subprocess

import h5py
import made_up
import numpy as np
import pytest
from test_store_round_trip import same, write

from hydro1d.store import Hdf5Sink

TREE = {
    "/": {"time", "position", "velocity", "strain", "stress", "viscosity", "density", "internal_energy"},
    "/history": {"history_time", "time_step", "right_stress", "energy_error", "peak_stress", "front_position"},
    "/probes": {"history_time", "probe", "position", "velocity", "strain", "stress"},
}


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return write(tmp_path_factory.mktemp("format") / "a.h5")


def test_root_attributes(path):
    with h5py.File(path) as file:
        attributes = dict(file.attrs)
    assert attributes["Conventions"].startswith("CF-")
    assert attributes["title"] == made_up.RESOLVED["title"]
    assert attributes["status"] == "complete"
    assert attributes["cycles"] == 1400 and attributes["wall_seconds"] == 0.25
    assert attributes["schema_version"] == 1 and attributes["hydro1d_version"]
    assert attributes["law_hash_foam"] == "abc123" and attributes["nodes"] == 51
    assert "created" in attributes and "peak_load" not in attributes


def test_deck(path):
    with h5py.File(path) as file:
        assert file["deck/toml"][()].decode() == made_up.DECK_TEXT
        assert json.loads(file["deck/resolved"][()]) == made_up.RESOLVED


def test_everything_has_unit_and_name_and_a_plain_type(path):
    def look(name, item):
        for key, value in item.attrs.items():
            assert key == "REFERENCE_LIST" or np.asarray(value).dtype.kind not in "bV", (name, key)
        if isinstance(item, h5py.Dataset):
            assert item.attrs["units"] and item.attrs["long_name"], name
            if item.dtype.kind == "O":
                assert h5py.check_string_dtype(item.dtype).length is None, name
            else:
                assert item.dtype.kind in "fi", name
            for axis in range(item.ndim):
                assert item.is_scale or item.dims[axis].keys(), name

    with h5py.File(path) as file:
        file.visititems(look)


def test_dimensions(path):
    with h5py.File(path) as file:
        names = lambda item: tuple(axis[0].name for axis in item.dims)  # noqa: E731
        assert names(file["strain"]) == ("/time", "/zone")
        assert names(file["velocity"]) == ("/time", "/node")
        assert names(file["zone_mass"]) == ("/zone",)
        assert names(file["layer_name"]) == ("/layer",)
        assert names(file["maximum_strain"]) == ("/zone",)
        assert names(file["history/momentum"]) == ("/history/history_time",)
        assert names(file["probes/stress"]) == ("/probes/history_time", "/probes/probe")


@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_xarray(path, engine):
    xarray = pytest.importorskip("xarray")
    with xarray.open_dataset(path, engine=engine) as data:
        assert TREE["/"] <= set(data.variables)
        assert data["strain"].dims == ("time", "zone") and data["velocity"].dims == ("time", "node")
        assert set(data["stress"].coords) == {"time", "zone", "zone_coordinate", "zone_layer"}
        assert list(data["layer_name"].values) == list(made_up.layout().layer_name)
        same({name: data[name].values for name in TREE["/"]}, subset("", TREE["/"]))
    with xarray.open_datatree(path, engine=engine) as tree:
        for group in ("history", "probes"):
            assert TREE[f"/{group}"] <= set(tree[group].variables)
            names = [name for name in TREE[f"/{group}"] if name != "probe"]
            same({name: tree[group][name].values for name in names}, subset(f"{group}/", names))


def subset(prefix, names):
    expected = made_up.expected(40)
    return {name: expected[prefix + name] for name in names}


@pytest.mark.parametrize("program", ["ncdump", "h5dump"])
def test_dump(path, program):
    if not shutil.which(program):
        pytest.skip(f"{program} is not installed")
    done = subprocess.run([program, path], capture_output=True, text=True, check=True)
    assert not done.stderr
    assert "front_position" in done.stdout and "e-p" not in done.stderr
    if program == "ncdump":
        assert "time = UNLIMITED ; // (40 currently)" in done.stdout
        assert "phony" not in done.stdout


@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_checkpoints_and_partial_files_too(tmp_path, engine):
    xarray = pytest.importorskip("xarray")
    with Hdf5Sink(tmp_path / "a.h5", made_up.layout(), made_up.DECK_TEXT, made_up.RESOLVED) as sink:
        made_up.record(sink, 0, 5)
        sink.publish_partial()
        sink.checkpoint(made_up.State(175, np.linspace(0, 1, 51)))
    for name in ("a.partial.h5", "a.checkpoint-175.h5"):
        with xarray.open_datatree(tmp_path / name, engine=engine) as tree:
            assert tree.attrs["status"] == "running"
            assert tree["stress"].shape == (5, 50)
