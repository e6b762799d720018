"""Long runs, many runs, interrupted runs, runs in odd places. Figures in docs/reliability.md."""

from __future__ import annotations

import contextlib
import ctypes
import os
import resource
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from decks import FOAM, PULSE, RINGING_BAR

import hydro1d
from hydro1d.boundaries.free import Free
from hydro1d.boundaries.pressure import Pressure
from hydro1d.laws.elastic import Elastic
from hydro1d.loads.rectangular import Rectangular
from hydro1d.scheme.viscosity import Viscosity
from hydro1d.solver.column import build_column
from hydro1d.solver.driver import solve
from hydro1d.solver.sink import Sink
from hydro1d.variables import HISTORY

DECK = (
    'title = "short"'
    + FOAM
    + """
[[layer]]
material = "foam"
thickness = 1
zones = {zones}
"""
    + PULSE
    + """
[time]
end = {end}
[output]
profiles = 20
history = {history}
{more}
"""
)


def write_deck(folder: Path, zones=40, end=4e-3, history=5, more="") -> Path:
    path = folder / "deck.toml"
    path.write_text(DECK.format(zones=zones, end=end, history=history, more=more))
    return path


def command(*arguments, **options):
    options["env"] = {**options.get("env", os.environ), "PYTHONPATH": str(Path(hydro1d.__file__).parents[1])}
    return subprocess.Popen(
        [sys.executable, "-m", "hydro1d.cli", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        **options,
    )


class EnergyErrors(Sink):
    """A sink that keeps the energy error alone."""

    def __init__(self):
        self.errors = []

    def history(self, rows, probes):
        self.errors += rows[:, ENERGY_ERROR].tolist()


ENERGY_ERROR = [variable.name for variable in HISTORY].index("energy_error")


def ringing(cycles: int, viscosity: str, cfl: float, modulus: float = 1.0004e9) -> np.ndarray:
    """Energy errors, a thousand of them, along a free elastic bar that rings after a short pulse."""
    bar = SimpleNamespace(
        material="bar", law=Elastic(density=1000.0, modulus=modulus), thickness=1.0, zones=50, velocity=0.0
    )
    pulse = Pressure(pulse=Rectangular(peak=1e6, duration=2e-4))
    viscous = 1.62 if viscosity == "standard" else 1.0  # by which the default viscosity shortens the steps of this bar
    step = cfl * (1.0 / 50) / 1000.0 / viscous
    column = build_column(
        [bar], pulse, Free(), end=cycles * step, cfl=cfl, history=cycles // 1000, viscosity=Viscosity(kind=viscosity)
    )
    sink = EnergyErrors()
    outcome = solve(column, sink)
    assert outcome.cycles > 0.9 * cycles
    return np.array(sink.errors)


@pytest.mark.parametrize("cycles", [20_000, 1_000_000])
@pytest.mark.parametrize(("viscosity", "cfl"), [("standard", 0.8), ("none", 0.5), ("none", 0.8), ("none", 0.95)])
def test_a_ringing_bar_keeps_its_energy(cycles, viscosity, cfl):
    """Below 1e-11, and no trend: a chain that never comes to rest drifts by less than a hundredth of that from end to end."""
    errors = ringing(cycles, viscosity, cfl)
    increments = np.diff(errors)
    drift = np.polyfit(np.linspace(0.0, 1.0, len(errors)), errors, 1)[0]
    trend = increments.mean() / increments.std() * np.sqrt(len(increments))  # in standard errors of a random walk
    largest = np.abs(errors).max()
    print(
        f"{viscosity}, {cycles} cycles: largest energy error {largest:.1e}, drift {drift:.1e}, {trend:.1f} standard errors"
    )
    assert largest < 1e-11 and abs(drift) < 1e-13
    if viscosity == "standard":
        assert abs(trend) < 4.0


def test_a_chain_of_round_numbers_keeps_its_energy_too():
    """At 1000 m/s in zones of 2 cm equal steps would round with the motion, to 2e-12 in a million of them."""
    assert np.abs(ringing(1_000_000, "none", 0.5, modulus=1e9)).max() < 5e-13


def arrays_of(run) -> dict[str, np.ndarray]:
    found = {name: run[name] for name in run if name != "layer_name"}
    return found | {f"history/{name}": run.history[name] for name in run.history}


def same(one, other) -> bool:
    a, b = arrays_of(one), arrays_of(other)
    return a.keys() == b.keys() and all(
        np.array_equal(a[name], b[name], equal_nan=a[name].dtype.kind == "f") for name in a
    )


def test_the_same_deck_gives_the_same_data_wherever_it_runs(tmp_path):
    deck = write_deck(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "LC_ALL": "C", "TZ": "Asia/Tokyo", "PYTHONHASHSEED": "7"}
    assert command("run", deck, "-o", tmp_path / "one.h5").wait() == 0
    assert command("run", deck, cwd=tmp_path / "elsewhere", env=environment).wait() == 0
    results: dict[int, object] = {}
    threads = [threading.Thread(target=lambda k=k: results.update({k: hydro1d.run(deck)})) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    one = hydro1d.open_run(tmp_path / "one.h5")
    assert same(one, hydro1d.open_run(tmp_path / "elsewhere" / "deck.h5"))
    assert all(same(one, result) for result in results.values())


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_leaves_a_checkpoint_and_a_readable_file(tmp_path, number):
    deck = write_deck(tmp_path, zones=1000, end=0.5, history=1000, more="[checkpoint]\ncycles = 5000\n")
    running = command("run", deck, "-o", tmp_path / "run.h5")
    while not list(tmp_path.glob("run.checkpoint-*.h5")) and running.poll() is None:  # until it is under way
        time.sleep(0.05)
    running.send_signal(number)
    asked = time.monotonic()
    _, errors = running.communicate(timeout=60)
    waited = time.monotonic() - asked
    assert running.returncode == 130, errors
    assert b"Traceback" not in errors and b"interrupted" in errors
    assert not (tmp_path / "run.h5").exists()
    assert hydro1d.open_run(tmp_path / "run.partial.h5").status == "interrupted"
    assert 1 <= len(list(tmp_path.glob("run.checkpoint-*.h5"))) <= 2
    print(f"stopped {waited:.2f} s after the signal")


def kill_and_restart(folder: Path, deck: Path, whole, seconds: float) -> str:
    """Kill a run after so long, check what it left, go on from its last checkpoint and compare."""
    output = folder / "run.h5"
    for old in folder.glob("run.*"):
        old.unlink()
    running = command("run", deck, "-o", output, "--quiet")
    time.sleep(seconds)
    running.kill()
    running.communicate()
    for left in folder.glob("run*.h5"):
        hydro1d.open_run(left)["strain"]  # whatever has a name is complete and reads
    if output.exists():
        assert same(hydro1d.open_run(output), whole)
        return "finished"
    checkpoints = sorted(folder.glob("run.checkpoint-*.h5"), key=lambda path: int(path.stem.rpartition("-")[2]))
    if not checkpoints:
        return "no checkpoint yet"
    again = command("run", deck, "-o", output, "--restart", checkpoints[-1], "--quiet")
    _, errors = again.communicate()
    assert again.returncode == 0, errors
    assert same(hydro1d.open_run(output), whole)
    return "restarted"


@pytest.mark.nightly
def test_killed_commands_go_on_bit_for_bit(tmp_path):
    """The command as a user starts it; kills with the start left out, by hundreds, are in test_kills.py."""
    deck = write_deck(tmp_path, zones=200, end=8e-3, history=20, more="[checkpoint]\ncycles = 700\n")
    begun = time.monotonic()
    assert command("run", deck, "-o", tmp_path / "whole.h5", "--quiet").wait() == 0
    longest = time.monotonic() - begun
    whole = hydro1d.open_run(tmp_path / "whole.h5")
    rng = np.random.default_rng(1)
    words = [kill_and_restart(tmp_path, deck, whole, rng.uniform(0.2, 1.0) * longest) for _ in range(6)]
    print({word: words.count(word) for word in set(words)})


@pytest.mark.parametrize(("history", "cycles"), [(1000, 1_000_000), pytest.param(1, 1_000_000, marks=pytest.mark.slow)])
def test_memory_stays_flat_over_a_million_steps(tmp_path, history, cycles):
    """With 240 MB of history too, which fill and empty the writer's buffer several times in each third of the run."""
    thirds: dict[int, list[int]] = {0: [], 1: [], 2: [], 3: []}
    handles = set()

    def progress(share):
        thirds[int(3 * share)].append(resident())
        handles.add(len(os.listdir("/proc/self/fd")))

    text = RING.format(end=cycles * 0.8 * 0.02 / 1000.0 / 1.62, history=history)
    run = hydro1d.run(text, tmp_path / "run.h5", progress=progress)
    assert run.attributes["cycles"] > 0.9 * cycles
    middle, last = max(thirds[1]), max(thirds[2])
    print(
        f"history every {history}: at most {middle / 2**20:.1f} MB in the middle, {last / 2**20:.1f} MB in the last third"
    )
    assert last < 1.01 * middle
    assert max(handles) - min(handles) <= 2  # the working file, and the partial file that is being written


RING = (
    RINGING_BAR
    + """
[time]
end = {end}
[output]
profiles = 50
history = {history}
[checkpoint]
cycles = 200000
"""
)


def test_memory_and_files_stay_flat(tmp_path):
    deck = hydro1d.load_deck(write_deck(tmp_path, zones=20, end=1e-3))
    grown, handles = repeat(deck, tmp_path, 20, 60)
    assert handles == 0 and grown < 0.03


@pytest.mark.slow
def test_memory_and_files_stay_flat_over_ten_thousand_runs(tmp_path):
    deck = hydro1d.load_deck(write_deck(tmp_path, zones=20, end=1e-3))
    grown, handles = repeat(deck, tmp_path, 500, 10_000)
    print(f"memory grew by {100 * grown:.2f} %, {handles} handles leaked")
    assert handles == 0 and grown < 0.01


def repeat(deck, folder: Path, warm: int, runs: int) -> tuple[float, int]:
    """Share by which the process grew, and handles that it leaked, over so many runs after some to warm up.

    Names of files that come and go use up places in Python's own table of strings; after some thousand runs it is made anew,
    twice as large (0.9 MB more). That happens here before memory is counted.
    """
    for number in range(50_000):
        sys.intern(f"a name that is forgotten at once, number {number}")
    for count in range(warm + runs):
        if count == warm:
            memory, handles = resident(), len(os.listdir("/proc/self/fd"))
        hydro1d.run(deck, folder / "run.h5")
    return resident() / memory - 1.0, len(os.listdir("/proc/self/fd")) - handles


def resident() -> float:
    """Resident memory of this process, bytes, less what the allocator keeps for later."""
    with contextlib.suppress(AttributeError):
        ctypes.CDLL(None).malloc_trim(0)
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize()


@pytest.mark.nightly  # both compile everything anew
@pytest.mark.parametrize("home", ["no home", "read-only cache"])
def test_a_run_needs_no_home_and_no_cache(tmp_path, home):
    deck = write_deck(tmp_path)
    environment = {
        key: value for key, value in os.environ.items() if key not in ("HOME", "XDG_CACHE_HOME", "HYDRO1D_CACHE_DIR")
    }
    if home == "read-only cache":
        environment["HYDRO1D_CACHE_DIR"] = "/proc/nowhere"
    else:
        environment["HOME"] = "/nonexistent"
    running = command("run", deck, "-o", tmp_path / "run.h5", env=environment)
    assert running.wait() == 0, running.stderr.read()


@pytest.mark.nightly  # four processes that all compile at once
def test_concurrent_runs_share_a_folder_and_a_cache(tmp_path):
    deck = write_deck(tmp_path)
    environment = {**os.environ, "HYDRO1D_CACHE_DIR": str(tmp_path / "cache")}
    running = [command("run", deck, "-o", tmp_path / f"run{k % 2}.h5", env=environment) for k in range(4)]
    assert [one.wait() for one in running] == [0, 0, 0, 0]
    assert same(hydro1d.open_run(tmp_path / "run0.h5"), hydro1d.open_run(tmp_path / "run1.h5"))
    assert not list(tmp_path.glob("*partial*"))
