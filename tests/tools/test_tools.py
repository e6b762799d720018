"""Every script under tools/ that reads a result: --help, what it says, how it fails."""

import csv
import io
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np
import pytest

TOOLS = Path(__file__).parents[2] / "tools"
SCRIPTS = ("xt_plot", "to_csv", "to_xdmf", "compare_runs", "track_front", "energy_table", "jump_check")


def tool(name, *arguments, cwd=None):
    command = [sys.executable, str(TOOLS / f"{name}.py"), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, timeout=120)


@pytest.mark.parametrize("name", SCRIPTS)
def test_help_and_independence(name):
    done = tool(name, "--help")
    assert (done.returncode == 0 and "RUN.h5" in done.stdout) or name in ("compare_runs", "energy_table")
    assert "hydro1d." not in (TOOLS / f"{name}.py").read_text()  # h5py and numpy are enough


@pytest.mark.parametrize("name", SCRIPTS)
def test_bad_files_are_one_line(name, tmp_path):
    (tmp_path / "text.h5").write_text("no HDF5")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["a"] = 1.0
    for bad in ("text.h5", "other.h5", "missing.h5"):
        done = tool(name, *[tmp_path / bad] * (2 if name == "compare_runs" else 1), cwd=tmp_path)
        if name == "compare_runs" and bad == "other.h5":
            continue  # nothing in common is nothing different
        assert done.returncode != 0
        assert done.stderr.startswith(f"{name}: ") and "Traceback" not in done.stderr


def test_xt_plot(result, tmp_path):
    assert tool("xt_plot", result, "--laboratory", "-q", "velocity", "-o", tmp_path / "a.png").returncode == 0
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_to_csv(result):
    with h5py.File(result, "r") as file:
        stress, right = file["stress"][:], file["history/right_stress"][:]
        time = file["time"][:]
    lines = tool("to_csv", result, "zones", "-t", time[5]).stdout.splitlines()
    assert lines[0] == f"# time {time[5]:.9g} s"
    rows = list(csv.DictReader(lines[1:]))
    assert np.allclose([float(row["stress (Pa)"]) for row in rows], stress[5], rtol=1e-8)
    rows = list(csv.DictReader(io.StringIO(tool("to_csv", result).stdout)))
    assert np.allclose([float(row["right_stress (Pa)"]) for row in rows], right, rtol=1e-8)
    assert "stress (Pa) probe 0" in tool("to_csv", result, "probes").stdout
    assert "velocity (m s-1)" in tool("to_csv", result, "nodes").stdout.splitlines()[1]


def test_to_xdmf_points_at_what_is_there(result, tmp_path):
    target = tmp_path / "a.xdmf"
    assert tool("to_xdmf", result, "-o", target).returncode == 0
    root = ElementTree.parse(target).getroot()
    grids = root.findall("./Domain/Grid/Grid")
    with h5py.File(result, "r") as file:
        assert len(grids) == len(file["time"])
        times = [float(grid.find("Time").get("Value")) for grid in grids]
        assert np.allclose(times, file["time"][:])
        for item in grids[3].iter("DataItem"):
            if item.get("Format") == "HDF":
                name, _, dataset = item.text.partition(":")
                assert (target.parent / name).resolve() == result.resolve()
                assert list(map(int, item.get("Dimensions").split())) == list(file[dataset].shape)
    slab = grids[3].find("./Attribute[@Name='stress']/DataItem/DataItem").text.split()
    assert slab == ["3", "0", "1", "1", "1", "100"]


def test_compare_runs(result, tmp_path):
    assert tool("compare_runs", result, result).stdout.endswith("the same\n")
    other = tmp_path / "other.h5"
    other.write_bytes(result.read_bytes())
    with h5py.File(other, "r+") as file:
        file["stress"][3, 5] += 1e5
    done = tool("compare_runs", result, other)
    assert done.returncode == 1
    changed = [line.split()[0] for line in done.stdout.splitlines()[1:-1] if not line.endswith(" 0")]
    assert changed == ["stress"]
    assert tool("compare_runs", result, other, "--tolerance", 1).returncode == 0


def test_track_front_follows_the_front_of_the_history(result):
    rows = list(csv.DictReader(io.StringIO(tool("track_front", result).stdout)))
    with h5py.File(result, "r") as file:
        time, front = file["history/history_time"][:], file["history/front_position"][:]
    early = [row for row in rows if 3e-4 < float(row["time_s"]) < 2.2e-3]
    assert len(early) >= 5
    for row in early:
        assert float(row["coordinate_m"]) == pytest.approx(np.interp(float(row["time_s"]), time, front), abs=0.012)
        assert float(row["strain_behind"]) == pytest.approx(0.91, abs=0.02)


def test_jump_check_holds_a_steady_front(result):
    lines = tool("jump_check", result).stdout.splitlines()
    steady = [line.split() for line in lines[1:-1] if 0.5 < float(line.split()[0]) < 1.5]
    assert len(steady) >= 3
    assert np.array(steady, dtype=float)[:, 2:].max() < 0.03
    assert tool("jump_check", result, "--tolerance", 1e-9).returncode == 1


def test_energy_table(result):
    lines = tool("energy_table", result, result).stdout.splitlines()
    assert len(lines) == 3 and lines[1] == lines[2]
    work, kinetic, internal = map(float, lines[1].split()[1:4])
    assert work == pytest.approx(kinetic + internal, rel=1e-4)
