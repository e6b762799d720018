"""Ctrl-C and SIGTERM: what they leave and how soon; when they are a question, when they are an order, who may ask.

How soon is measured in processor time from the signal to the end of the process, which is wall time on a machine that has
nothing else to do, and means something on one that has.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from decks import RINGING_BAR

import hydro1d
from hydro1d.api import Share
from hydro1d.interrupt import interruptible

DECK = (
    'title = "A bar that rings"'
    + RINGING_BAR
    + """
[time]
end = 1.0
[output]
history = 1000
"""
)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_first_request_is_a_question_the_second_an_order(number):
    before = signal.getsignal(number)
    with pytest.raises(KeyboardInterrupt), interruptible() as asked:
        assert not asked()
        os.kill(os.getpid(), number)
        assert asked()
        os.kill(os.getpid(), number)
    assert signal.getsignal(number) is before


def test_only_the_main_thread_is_asked():
    answers = []

    def work():
        with interruptible() as asked:
            answers.append(asked())

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert answers == [False]


def asking(after: float, heard: list):
    """Progress that sends SIGTERM to this very process once so much is done."""

    def progress(share: Share) -> None:
        heard.append(share)
        if share >= after and not any(earlier >= after for earlier in heard[:-1]):
            os.kill(os.getpid(), signal.SIGTERM)

    return progress


def test_a_run_that_is_asked_to_stop_goes_on_bit_for_bit(tmp_path):
    whole = hydro1d.run(DECK, tmp_path / "whole.h5")
    heard: list[Share] = []
    with pytest.raises(
        hydro1d.Interrupted,
        match=r"interrupted at t = .*\n  what there is: .*\n  to go on: restart from .*a.checkpoint-\d+\.h5",
    ):
        hydro1d.run(DECK, tmp_path / "a.h5", progress=asking(0.3, heard))
    assert heard[-1].time < 0.9 and heard[-1].cycles > 0
    (saved,) = tmp_path.glob("a.checkpoint-*.h5")
    assert hydro1d.open_run(tmp_path / "a.partial.h5").status == "interrupted"
    again = hydro1d.run(DECK, tmp_path / "a.h5", restart=saved)
    assert sorted(path.name for path in tmp_path.glob("a.*")) == [
        "a.checkpoint-" + saved.stem.rpartition("-")[2] + ".h5",
        "a.h5",
    ]
    for group in ("", "history/"):
        for name in whole.history if group else [item for item in whole if item != "layer_name"]:
            assert again[group + name].tobytes() == whole[group + name].tobytes(), name


def test_in_memory_progress_is_told_too():
    heard: list[float] = []
    hydro1d.run(DECK.replace("end = 1.0", "end = 1e-3"), progress=heard.append)
    assert heard[-1] == 1.0


SOONEST = 2.0  # seconds of processor time from a signal to the end
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(hydro1d.__file__).parents[1])}


def stopped(folder: Path, arguments: list[str], under_way, number: int) -> tuple[int, float, str]:
    """Exit code, processor seconds after the signal and standard error of a command that is stopped once under way."""
    with open(folder / "stderr", "w") as errors:
        process = subprocess.Popen(
            [sys.executable, "-m", "hydro1d.cli", *arguments],
            cwd=folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=errors,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a shell may start tests with Ctrl-C ignored
        )  # fmt: skip
        end = time.monotonic() + 120.0
        while not under_way() and time.monotonic() < end:
            assert process.poll() is None, (folder / "stderr").read_text()
            time.sleep(0.02)
        ticks = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()[11:13]
        before = sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK")
        process.send_signal(number)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, used.ru_utime + used.ru_stime - before, (folder / "stderr").read_text()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("zones", [50, 100_000])
def test_a_run_stops_soon_and_leaves_what_it_has(tmp_path, number, zones):
    text = DECK.replace("zones = 50", f"zones = {zones}").replace("end = 1.0", "end = 100.0")
    (tmp_path / "deck.toml").write_text(text + "profiles = 3\n[checkpoint]\nwall = 0.5\n")
    code, seconds, errors = stopped(
        tmp_path, ["run", "deck.toml"], lambda: list(tmp_path.glob("deck.checkpoint-*.h5")), number
    )
    print(f"{zones} zones: stopped after {seconds:.2f} s of processor time")
    assert code == 130 and errors.startswith("hydro1d: interrupted") and "Traceback" not in errors
    assert seconds < SOONEST
    assert hydro1d.open_run(tmp_path / "deck.partial.h5").status == "interrupted"
    newest = max(int(path.stem.rpartition("-")[2]) for path in tmp_path.glob("deck.checkpoint-*.h5"))
    assert f"cycle {newest}" in errors, "the last checkpoint is where it stopped"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_sweep_stops_soon_and_goes_on(tmp_path, number):
    (tmp_path / "deck.toml").write_text(DECK)
    (tmp_path / "sweep.toml").write_text(
        'deck = "deck.toml"\nquantities = ["peak_support_stress"]\n'
        '[[parameter]]\nkey = "left.peak"\nvalues = [' + ", ".join(f"{k}e5" for k in range(1, 25)) + "]\n"
    )
    journal = tmp_path / "sweep.journal"
    arguments = ["sweep", "sweep.toml", "--threads", "2", "--quiet"]
    code, seconds, errors = stopped(
        tmp_path, arguments, lambda: journal.exists() and journal.read_text().count("\n") > 1, number
    )
    print(f"sweep: stopped after {seconds:.2f} s of processor time")
    assert code == 130 and errors.startswith("hydro1d: interrupted") and "Traceback" not in errors
    assert seconds < SOONEST and not (tmp_path / "sweep.h5").exists()
    done = subprocess.run(
        [sys.executable, "-m", "hydro1d.cli", *arguments], cwd=tmp_path, env=ENVIRONMENT, capture_output=True
    )
    assert done.returncode == 0 and (tmp_path / "sweep.csv").read_text().count("\n") == 25 and not journal.exists()
