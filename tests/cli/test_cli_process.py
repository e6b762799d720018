"""The command line as a process: streams, encodings, signals."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from command_line import ENVIRONMENT, command

from hydro1d.cli import main


def test_main_as_a_module():
    done = command("laws", "epph")
    assert (done.returncode, done.stderr) == (0, "")


def test_main_in_a_thread(deck):
    from threading import Thread

    codes = []
    thread = Thread(target=lambda: codes.append(main(["check", deck])))
    thread.start()
    thread.join()
    assert codes == [0]


def test_a_closed_pipe_is_no_error():
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [sys.executable, "-m", "hydro1d.cli", "schema"],
        stdout=writer,
        stderr=subprocess.PIPE,
        check=False,
        env=ENVIRONMENT,
    )
    os.close(writer)
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_standard_output_on_a_full_disk():
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "hydro1d.cli", "laws"],
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
            env=ENVIRONMENT,
        )
    assert done.returncode == 4
    assert done.stderr.startswith(b"hydro1d: ")
    assert b"No space left" in done.stderr
    assert b"Exception" not in done.stderr


def test_any_encoding_of_the_terminal():
    done = command("laws", PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signals_end_a_run_with_130(deck, tmp_path, number):
    arguments = ["--set", "layer[0].zones=2000", "--set", "time.end=10 s", "-o", "long.h5", "--log-json", "log.json"]
    process = subprocess.Popen(
        [sys.executable, "-m", "hydro1d.cli", "run", deck, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=ENVIRONMENT,
    )
    log = tmp_path / "log.json"
    _wait_for(lambda: log.exists() and '"progress"' in log.read_text())
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130, err
    assert out == b""
    assert err.startswith(b"hydro1d: ")
    assert b"Traceback" not in err
    assert not (tmp_path / "long.h5").exists()


def _wait_for(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.05)
