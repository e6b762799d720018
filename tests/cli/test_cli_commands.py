"""Rare ways through the commands: a log of what went wrong, a page's name, a boundary without a file, a cluster."""

from __future__ import annotations

import importlib
import json
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from hydro1d.cli import main
from hydro1d.components.units import convert
from hydro1d.errors import BreakdownError, Interrupted

BREAKDOWN = BreakdownError("the zone is inverted", 3, 1e-3, 12)


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (BREAKDOWN, 3, "zone 3 at t = 0.001 s, cycle 12: the zone is inverted"),
        (Interrupted("interrupted at t = 1 s"), 130, "interrupted at t = 1 s"),
        (KeyboardInterrupt(), 130, ""),
        (RuntimeError("oops"), 1, "oops"),
    ],
)
def test_the_log_ends_with_what_went_wrong(deck, calculated, capsys, error, code, words):
    calculated.answer = error
    assert main(["run", deck, "--log-json", "log.json"]) == code
    start, last = [json.loads(line) for line in Path("log.json").read_text().splitlines()]
    assert (start["event"], start["zones"]) == ("start", 20)
    assert (last["event"], last["exit_code"]) == ("error", code)
    assert words in last["message"]
    assert "Traceback" not in capsys.readouterr().err


def test_a_report_s_name_ends_in_html(capsys):
    assert main(["report", "nowhere.h5", "-o", "page.txt"]) == 2
    assert "page.txt: a report's name ends in .html" in capsys.readouterr().err


@pytest.mark.parametrize("output", [[], ["-o", "runs.csv"]])
def test_a_boundary_traced_with_and_without_files(deck, capsys, output):
    short = ["--set", "layer[0].zones=5", "--set", "time.end=3 ms", "--threads", "1", "--quiet"]
    search = ["--key", "left.peak", "--from", "0.1 MPa", "--to", "10 MPa", "--scan", "2", "--tolerance", "0.3"]
    along = ["--along", "left.duration", "--values", "1 ms, 1.5 ms", "--outcome", "support_peak > 0.5 MPa"]
    assert main(["critical", deck, *search, *along, *short, *output]) == 0
    header, *points = capsys.readouterr().out.splitlines()
    assert header.split() == ["left.duration", "left.peak"]
    found = [re.split(r"\s{2,}", point.strip()) for point in points]
    assert [duration for duration, _ in found] == ["1 ms", "1.5 ms"]
    assert all(1e5 < convert(peak, "Pa") < 1e7 for _, peak in found)
    assert {path.name for path in Path().glob("*.csv")} == ({"runs.boundary.csv", "runs.csv"} if output else set())


def test_an_outcome_that_flips_more_than_once_is_said(deck, capsys, monkeypatch):
    searching = importlib.import_module("hydro1d.sweep.critical")  # the package has a function of this name
    point = searching.Critical(1.5e-3, 1e-3, 2e-3, False, False, [(1e-3, False, 0.0, "complete")])
    monkeypatch.setattr(searching, "critical", lambda *_, **__: point)
    arguments = ["--key", "left.duration", "--from", "1 ms", "--to", "2 ms", "--outcome", "enhanced"]
    assert main(["critical", deck, *arguments]) == 0
    out = capsys.readouterr().out
    assert "enhanced begins at left.duration = 0.0015" in out and "1 run\n" in out
    assert "not monotonic: the outcome flips more than once" in out


def test_a_class_that_is_nothing_for_a_deck(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("mine.py").write_text("class Mine:\n    pass\n")
    assert main(["laws", "mine.py:Mine"]) == 2
    assert "mine.py:Mine is not a subclass of hydro1d." in capsys.readouterr().err


@pytest.mark.parametrize("quiet", [False, True])
def test_reproduce_says_what_it_makes_and_where(tmp_path, monkeypatch, capsys, quiet):
    import hydro1d.studies.harrigan2010.reproduce as reproducing

    calls = []

    def reproduce(out, *, quick, only, threads, executor, say):
        calls.append((out, quick, only, threads))
        say("figure 6")
        return out / "index.html"

    monkeypatch.setattr(reproducing, "reproduce", reproduce)
    options = ["--out", str(tmp_path), "--quick", "--only", "6", "--threads", "2", *(["--quiet"] if quiet else [])]
    assert main(["reproduce", *options]) == 0
    assert calls == [(tmp_path, True, ("6",), 2)]
    assert capsys.readouterr().out == ("" if quiet else f"figure 6\npage: {tmp_path / 'index.html'}\n")


def test_a_sweep_on_a_cluster(deck, capsys, monkeypatch):
    from concurrent.futures import ThreadPoolExecutor

    closed = []

    class Client:
        """What the command needs of dask.distributed."""

        def __init__(self, address, timeout):
            self.address = address

        def __enter__(self):
            return self

        def __exit__(self, *_):
            closed.append(self.address)

        def get_executor(self, pure):
            assert not pure, "two runs of one deck are two runs"
            return ThreadPoolExecutor(1)

    monkeypatch.setitem(sys.modules, "distributed", SimpleNamespace(Client=Client))
    Path("sweep.toml").write_text(
        'deck = "decks/short.toml"\nquantities = ["peak_support_stress"]\n'
        '[[parameter]]\nkey = "left.peak"\nvalues = ["1 MPa", "2 MPa"]\n'
    )
    assert main(["sweep", "sweep.toml", "--scheduler", "tcp://cluster:1"]) == 0
    assert "2 runs, 0 failed" in capsys.readouterr().out
    assert closed == ["tcp://cluster:1"]


def test_verify_writes_the_page_of_the_documentation(tmp_path, capsys):
    page = tmp_path / "page.md"
    assert main(["verify", "--only", "noh", "--quiet", "--workers", "1", "--markdown", str(page)]) == 0
    out = capsys.readouterr().out
    assert len(out.splitlines()) == 1 and "all passed" in out, "quiet: failures and the last line only"
    assert page.read_text(encoding="utf-8").startswith("#")
