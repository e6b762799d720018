"""Every script under tools/ that reads a result: --help, what it says, how it fails."""

import contextlib
import csv
import io
import re
import runpy
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np
import pytest

TOOLS = Path(__file__).parents[2] / "tools"
SCRIPTS = ("contents", "xt_plot", "to_csv", "to_xdmf", "compare_runs", "track_front", "energy_table", "jump_check")


def tool(name, *arguments):
    """A script run as a program in this process, which has loaded h5py, numpy and matplotlib already."""
    command = [str(TOOLS / f"{name}.py"), *map(str, arguments)]
    out, err = io.StringIO(), io.StringIO()
    code = 0
    with pytest.MonkeyPatch.context() as patch, contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        patch.setattr(sys, "argv", command)
        patch.syspath_prepend(TOOLS)
        try:
            runpy.run_path(command[0], run_name="__main__")
        except SystemExit as end:
            code = end.code or 0
    return subprocess.CompletedProcess(command, code, out.getvalue(), err.getvalue())


def test_every_script_beside_these_is_tested_here():
    others = {"bench", "viscosity_study", "fuzz_atheris", "mutate"}  # they calculate, or test
    assert {path.stem for path in TOOLS.glob("*.py")} == {*SCRIPTS, *others}


@pytest.mark.parametrize("name", SCRIPTS)
def test_help_and_independence(name):
    """As a user starts it: in a process of its own, in which nothing is loaded yet."""
    command = [sys.executable, str(TOOLS / f"{name}.py"), "--help"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert (done.returncode == 0 and "RUN.h5" in done.stdout) or name in ("compare_runs", "energy_table")
    text = (TOOLS / f"{name}.py").read_text()
    assert "import hydro1d" not in text and "from hydro1d" not in text  # h5py and numpy are enough


@pytest.fixture(scope="module")
def bad_files(result, tmp_path_factory):
    """One file of each kind, and the words in which a script must say what is wrong with it."""
    folder = tmp_path_factory.mktemp("bad")
    (folder / "folder.h5").mkdir()
    (folder / "text.h5").write_text("no HDF5")
    (folder / "empty.h5").write_text("")
    (folder / "truncated.h5").write_bytes(result.read_bytes()[:100_000])
    (folder / "newer.h5").write_bytes(result.read_bytes())
    (folder / "lacking.h5").write_bytes(result.read_bytes())
    with h5py.File(folder / "foreign.h5", "w") as file:
        file["a"] = 1.0
    with h5py.File(folder / "table.h5", "w") as file:
        file.attrs.update({"hydro1d_version": "0", "schema_version": 1, "content": "table"})
    with h5py.File(folder / "newer.h5", "r+") as file:
        file.attrs["schema_version"] = 99
    with h5py.File(folder / "lacking.h5", "r+") as file:
        for name in ("time", "history", "stress", "node_coordinate"):
            del file[name]
    words = {
        "missing": "No such file", "folder": "it is a folder", "text": "it is not an HDF5 file", "empty": "it is empty",
        "truncated": "not all of it is written yet", "foreign": "not one of hydro1d's", "table": "a table of hydro1d sweep",
        "newer": "schema version 99",
    }  # fmt: skip
    return folder, words


@pytest.mark.parametrize("name", SCRIPTS)
def test_bad_files_are_one_sentence_of_ours_and_exit_code_4(name, bad_files, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder, words = bad_files
    for bad, text in words.items():
        done = tool(name, *[folder / f"{bad}.h5"] * (2 if name == "compare_runs" else 1))
        assert (done.returncode, done.stdout) == (4, ""), (bad, done)
        assert done.stderr.startswith(f"{name}: ") and text in done.stderr and "Unable to" not in done.stderr
        assert done.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", sorted({*SCRIPTS} - {"contents", "compare_runs"}))
def test_what_a_file_lacks_is_named(name, bad_files, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = tool(name, bad_files[0] / "lacking.h5")
    assert done.returncode == 4
    assert re.search(
        "there is no (time|history|node_coordinate) in it|no (profiles of 'stress'|history) in", done.stderr
    )
    assert "Unable to" not in done.stderr and done.stderr.count("\n") == 1


def test_contents(result):
    lines = tool("contents", result).stdout.splitlines()
    assert any(line.split()[:5] == ["stress", "36", "x", "100", "Pa"] for line in lines)


def test_a_reader_that_has_had_enough(result):
    command = f"{sys.executable} {TOOLS / 'to_csv.py'} {result} | head -1"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=120)
    assert done.stdout.startswith("history_time") and done.stderr == ""


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


def test_the_readers_of_paraview_and_visit_open_the_xdmf(result, tmp_path):
    vtk = pytest.importorskip("vtk")
    assert tool("to_xdmf", result, "-o", tmp_path / "a.xdmf").returncode == 0
    reader = vtk.vtkXdmfReader()
    reader.SetFileName(str(tmp_path / "a.xdmf"))
    reader.UpdateInformation()
    steps = reader.GetExecutive().GetOutputInformation(0).Get(vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    reader.UpdateTimeStep(steps[7])
    grid = reader.GetOutputDataObject(0)
    with h5py.File(result, "r") as file:
        assert np.allclose(steps, file["time"][:])
        stress, position = file["stress"][7], file["position"][7]
    assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells()) == (101, 100)
    assert [grid.GetCellData().GetArray("stress").GetTuple1(k) for k in range(100)] == pytest.approx(stress)
    assert [grid.GetPoint(k)[0] for k in range(101)] == pytest.approx(position)


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


def test_energy_table_of_a_gas_that_only_expands(tmp_path):
    import hydro1d

    hydro1d.run(TOOLS.parent / "cases" / "sod.toml", tmp_path / "sod.h5")
    line = tool("energy_table", tmp_path / "sod.h5").stdout.splitlines()[1]
    assert line.split()[-2] == "–" and "nan" not in line


def test_jump_check_holds_a_steady_front(result):
    note, more, head, *rows, median = tool("jump_check", result).stdout.splitlines()
    assert "good for a steady front" in note and '"unsteady" rows' in more
    assert head.split()[:2] == ["time", "(ms)"] and median.startswith("    median of steady")
    steady = [row.split() for row in rows if 0.5 < float(row.split()[0]) < 1.5]
    assert len(steady) >= 3
    assert np.array(steady, dtype=float)[:, 2:].max() < 0.03
    assert tool("jump_check", result, "--tolerance", 1e-9).returncode == 1


def test_jump_check_tells_rows_of_a_steady_front_from_others(result):
    """The pulse ends at 1.53 ms, and the wave from there catches up with the front at 2.1 ms; a profile comes every 0.2 ms."""
    *_, median = rows = tool("jump_check", result).stdout.splitlines()[3:]
    unsteady = [float(row.split()[0]) for row in rows if row.endswith("unsteady")]
    assert unsteady and min(unsteady) > 1.7
    clear = np.array([row.split() for row in rows[:-1] if not row.endswith("unsteady")], dtype=float)
    assert np.array(median.split()[3:], dtype=float) == pytest.approx(np.median(clear[:, 2:], axis=0), rel=0.06)


def test_the_help_of_jump_check_says_what_is_good():
    said = tool("jump_check", "--help").stdout
    assert "What to expect" in said and "under a blast the front decays" in said


def test_energy_table(result):
    lines = tool("energy_table", result, result).stdout.splitlines()
    assert len(lines) == 3 and lines[1] == lines[2]
    work, kinetic, internal = map(float, lines[1].split()[1:4])
    assert work == pytest.approx(kinetic + internal, rel=1e-4)
