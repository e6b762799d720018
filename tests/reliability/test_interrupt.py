"""Ctrl-C and SIGTERM inside one process: when they are a question, when they are an order, who may ask."""

from __future__ import annotations

import os
import signal
import threading

import pytest

import hydro1d
from hydro1d.api import Share
from hydro1d.interrupt import interruptible

DECK = """
title = "A bar that rings"
[material.bar]
law = "elastic"
density = 1000.0
modulus = 1e9
[[layer]]
material = "bar"
thickness = 1
zones = 50
[left]
type = "pressure"
pulse = "rectangular"
peak = 1e6
duration = 2e-4
[right]
type = "free"
[time]
end = 1.0
[output]
history = 1000
"""


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
        hydro1d.Interrupted, match=r"interrupted at t = .*\n  what there is: .*\n  to go on: .*--restart"
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
