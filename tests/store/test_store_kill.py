"""kill -9 at any instant: every file under a name that a user sees is complete."""

import contextlib
import os
import random
import signal
import time

import made_up
import numpy as np
import pytest
from test_store_round_trip import same, write

from hydro1d.store import Hdf5Sink, open_run, read_checkpoint

TOTAL = 60
EARLIER = 3


def write_a_run(path, say):
    """Write a run with working files, partial files and checkpoints over an earlier one; say what is safely on disk."""
    layout = made_up.layout(profiles=16)
    with Hdf5Sink(path, layout, made_up.DECK_TEXT, made_up.RESOLVED, buffer_bytes=200_000, flush_seconds=0.01) as sink:
        say("go")
        for number in range(TOTAL):
            made_up.record(sink, number, number + 1)
            if number % 7 == 6:
                sink.publish_partial()
                say(f"partial {number + 1}")
            if number % 10 == 9:
                sink.checkpoint(made_up.State(35 * (number + 1), np.full(51, float(number))))
                say(f"checkpoint {number + 1}")
        sink.maxima(made_up.maxima())
        sink.finish("complete", 35 * TOTAL, 0.1)
        say("complete")


def kill_at_random(folder, chance):
    """Kill a forked writer, which has nothing to import, after some time; its result's name and what it said."""
    path = write(folder / "run.h5", EARLIER)
    reading, writing = os.pipe()
    process = os.fork()
    if process == 0:
        with contextlib.suppress(BaseException):
            write_a_run(path, lambda text: os.write(writing, f"{text}\n".encode()))
            os._exit(0)
        os._exit(99)
    os.close(writing)
    with open(reading) as said:
        assert said.readline() == "go\n"
        time.sleep(chance.uniform(0.0, 0.8))
        os.kill(process, signal.SIGKILL)
        lines = said.read().splitlines()
    _, status = os.waitpid(process, 0)
    assert os.WIFSIGNALED(status) or os.WEXITSTATUS(status) == 0, status
    return path, [line.split() for line in lines]


def check(path, said):
    """All that the writer said was safe is there, and whatever is there is right."""
    run = open_run(path)
    complete = len(run.time) != EARLIER
    same(run, made_up.expected(TOTAL if complete else EARLIER))
    assert complete or ["complete"] not in said
    safe = max([int(number) for what, number in (line for line in said if line[0] == "partial")], default=0)
    partial = path.with_name("run.partial.h5")
    assert partial.exists() or complete or not safe
    if partial.exists():
        run = open_run(partial)
        assert run.status == "running" and len(run.time) >= safe
        if len(run.time):
            rows, arrays = len(run.history["time"]), made_up.expected(len(run.time))
            same(run, {k: v[:rows] if k.startswith(("history", "probes")) else v for k, v in arrays.items()})
    checkpoints = [read_checkpoint(found) for found in path.parent.glob("run.checkpoint-*.h5")]
    assert len(checkpoints) <= 3
    written = [35 * int(line[1]) for line in said if line[0] == "checkpoint"]
    assert not written or max(written) in [checkpoint.cycle for checkpoint in checkpoints]
    assert len(checkpoints) >= min(len(written), 2)
    for checkpoint in checkpoints:
        restart(path.with_name("again.h5"), checkpoint)


def restart(path, read):
    with Hdf5Sink.resume(read, path, made_up.layout(), made_up.DECK_TEXT, made_up.RESOLVED) as sink:
        made_up.record(sink, read.cycle // 35, TOTAL)
        same(open_run(sink.finish("complete", 35 * TOTAL, 0.0)), made_up.expected(TOTAL))


def kill_often(folder, times, seed):
    chance = random.Random(seed)
    for _ in range(times):
        path, said = kill_at_random(folder, chance)
        check(path, said)
        for file in folder.iterdir():
            if not file.name.startswith("."):
                os.unlink(file)
    with Hdf5Sink(folder / "last.h5", made_up.layout(), "", {}) as sink:
        sink.finish("complete", 1, 0.0)
    assert [file.name for file in folder.iterdir()] == ["last.h5"]


def test_kill(tmp_path):
    kill_often(tmp_path, 12, seed=1)


@pytest.mark.slow
def test_kill_500_times(tmp_path):
    kill_often(tmp_path, 500, seed=2)
