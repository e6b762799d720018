"""kill -9 at random instants: what has a name is complete, and a restart ends bit for bit as if nothing had happened.

The long form: ``python -m pytest -n 0 -m slow -s tests/reliability/test_kills.py``. The run that is killed is `hydro1d run`
itself in a forked process: the laws are compiled already, so that every kill falls into the run and none into Python's start.
"""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import time
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import pytest
from decks import FOAM, PULSE

import hydro1d
from hydro1d import cli
from hydro1d.store import Hdf5Sink, open_run, read_checkpoint

ONE_LAYER = (
    FOAM
    + """
[[layer]]
material = "foam"
thickness = 1
zones = 100
"""
    + PULSE
    + """
[time]
end = 0.06
[output]
profiles = 60
history = 50
probes = [0.25, 0.5]
[checkpoint]
cycles = 4000
"""
)
STRUCK_LAYERS = (
    FOAM
    + """
[material.honeycomb]
law = "epph-tangent"
density = 80.0
modulus = 100e6
plateau_stress = 1e6
densification_strain = 0.7
beta = 0.1
gamma = 0.8
[[layer]]
material = "foam"
thickness = 0.5
zones = 50
[[layer]]
material = "honeycomb"
thickness = 0.5
zones = 60
[left]
type = "striker"
mass = 20.0
velocity = 60.0
[right]
type = "wall"
[time]
end = 0.03
[output]
profiles = 40
history = 100
[checkpoint]
time = 5e-3
"""
)
EAGER = {"flush_seconds": 0.02, "buffer_bytes": 100_000}
CASES = {
    "one layer": (ONE_LAYER, {}),
    "struck layers": (STRUCK_LAYERS, {}),
    "partial files and working files all the time": (ONE_LAYER, EAGER),
    "layers, partial files all the time": (STRUCK_LAYERS, EAGER),
}


@dataclass
class Killed:
    """What a killed process had said it had written, and how it ended."""

    checkpoint: int
    profiles: int
    finished: bool


def in_a_fork(deck: Path, output: Path, options: dict, restart: Path | None = None, seconds: float = 1e9) -> Killed:
    """`hydro1d run` in a process of its own, killed after so many seconds of processor time unless it has ended."""
    reading, writing = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(reading)
        with contextlib.suppress(BaseException):
            _tell(writing, options)
            more = ["--restart", str(restart)] if restart else []
            os._exit(cli.main(["run", str(deck), "-o", str(output), "--quiet", *more]))
        os._exit(99)
    os.close(writing)
    while (
        processor_time(process) < seconds and os.waitid(os.P_PID, process, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None
    ):
        time.sleep(0.001)
    os.kill(process, signal.SIGKILL)
    _, status = os.waitpid(process, 0)
    assert os.WIFSIGNALED(status) or os.WEXITSTATUS(status) == 0, status
    with os.fdopen(reading) as said:
        words = [line.split() for line in said.read().splitlines()]
    last = {what: int(number) for what, number in words}
    return Killed(last.get("checkpoint", -1), last.get("profiles", 0), os.WIFEXITED(status))


def processor_time(process: int) -> float:
    """Seconds that a process has been running on a processor: what a busy machine does not stretch."""
    return int(Path(f"/proc/{process}/schedstat").read_text().split()[0]) * 1e-9


def _tell(pipe: int, options: dict) -> None:
    """Have the writer say, in this process, what is safely on disk."""
    Hdf5Sink.__init__.__kwdefaults__.update(options)
    checkpoint, publish = Hdf5Sink.checkpoint, Hdf5Sink.publish_partial

    def said_checkpoint(self, state):
        checkpoint(self, state)
        os.write(pipe, f"checkpoint {state.cycle}\n".encode())

    def said_partial(self):
        publish(self)
        os.write(pipe, f"profiles {self.instants.total}\n".encode())

    Hdf5Sink.checkpoint, Hdf5Sink.publish_partial = said_checkpoint, said_partial


def content(path: Path) -> dict:
    """Every array of a file, bit for bit, its status and its cycles."""
    found: dict = {}
    with h5py.File(path) as file:
        file.visititems(
            lambda name, item: (
                found.__setitem__(name, np.asarray(item[()]).tobytes())
                if isinstance(item, h5py.Dataset) and item.dtype.kind != "O"
                else None
            )
        )
        found["status"], found["cycles"] = file.attrs["status"], int(file.attrs["cycles"])
    return found


def is_a_beginning(partial: Path, whole, said: int) -> None:
    """A partial result holds all that was said, all profiles up to its last row, and nothing but the truth."""
    run = open_run(partial)
    profiles, rows = len(run.time), len(run.history["time"])
    assert run.status == "running" and profiles >= said
    assert profiles >= np.count_nonzero(whole.time < run.history["time"][-1])
    for group, known, count in (
        (run, whole, profiles),
        (run.history, whole.history, rows),
        (run.probes, whole.probes, rows),
    ):
        for name in (name for name in group if name != "layer_name"):
            grows = group.describe(name).dimensions[0] in ("time", "history_time")
            expected = known[name][:count] if grows else known[name]
            assert group[name].tobytes() == expected.tobytes(), name


def everything_is_complete(folder: Path, output: Path, earlier: bytes | None, whole, killed: Killed) -> None:
    """Every file under a name that a user sees reads to its last array; the earlier result is there or replaced whole."""
    for path in folder.glob("run*.h5"):
        run = read_checkpoint(path).source if ".checkpoint-" in path.name else open_run(path)
        for name in (item for item in run.names) if hasattr(run, "names") else run:
            (run.array if hasattr(run, "array") else run.__getitem__)(name)
    replaced = output.exists() and (earlier is None or output.read_bytes() != earlier)
    if replaced:
        assert content(output) == content(whole.path)
    assert replaced >= killed.finished and output.exists() >= (earlier is not None)
    partial = output.with_name("run.partial.h5")
    assert partial.exists() or replaced or not killed.profiles
    if partial.exists():
        is_a_beginning(partial, whole, killed.profiles)


def newest(folder: Path) -> Path | None:
    found = folder.glob("run.checkpoint-*.h5")
    return max(found, key=lambda path: int(path.stem.rpartition("-")[2]), default=None)


def clear(folder: Path) -> None:
    for path in [*folder.glob("run*"), *folder.glob(".hydro1d-*")]:
        path.unlink()


def kill_and_go_on(folder: Path, case: str, whole, longest: float, rng: np.random.Generator) -> str:
    """Kill a run, and now and then the run that goes on from it too; the end must be that of the uninterrupted run."""
    _, options = CASES[case]
    deck, output = folder / "deck.toml", folder / "run.h5"
    clear(folder)
    earlier = None
    if rng.random() < 0.5:
        earlier = (folder / "earlier.h5").read_bytes()
        output.write_bytes(earlier)
    restart = None
    for _ in range(3 if rng.random() < 0.3 else 1):
        killed = in_a_fork(deck, output, options, restart, seconds=rng.uniform(0.0, 0.8) * longest)
        everything_is_complete(folder, output, earlier, whole, killed)
        if killed.finished:
            return "had finished"
        restart = newest(folder)
        if killed.checkpoint >= 0:
            assert restart is not None and read_checkpoint(restart).cycle >= killed.checkpoint
        if restart is None:
            return "no checkpoint yet"
    in_a_fork(deck, output, options, restart)
    assert content(output) == content(whole.path), restart
    assert not list(folder.glob(".hydro1d-*")), "what dead runs left is cleared away"
    return "restarted"


def children_time() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


SLOW = [pytest.param(seed, 125, marks=pytest.mark.slow) for seed in range(1, 5)]


@pytest.mark.parametrize(("seed", "kills"), [(0, 12), *SLOW])
def test_killed_runs_go_on_bit_for_bit(tmp_path, seed, kills):
    rng, words = np.random.default_rng(seed), []
    wholes = {}
    for number, (case, (text, options)) in enumerate(CASES.items()):
        folder = tmp_path / str(number)
        (folder / "whole").mkdir(parents=True)
        (folder / "deck.toml").write_text(text)
        result = hydro1d.run(folder / "deck.toml", folder / "whole" / "whole.h5")
        short = text.replace("end = 0.0", "end = 0.000")
        hydro1d.run(short, folder / "earlier.h5")
        before = children_time()
        in_a_fork(folder / "deck.toml", folder / "run.h5", options)
        wholes[case] = (folder, result, children_time() - before)
    while words.count("restarted") < kills:
        case = list(CASES)[len(words) % len(CASES)]
        folder, result, longest = wholes[case]
        words.append(kill_and_go_on(folder, case, result, longest, rng))
        if len(words) % 25 == 0:
            print({word: words.count(word) for word in sorted(set(words))}, flush=True)
        assert len(words) < 4 * kills + 20, words
    print({case: round(longest, 2) for case, (_, _, longest) in wholes.items()})
    print({word: words.count(word) for word in sorted(set(words))}, "of", len(words))
