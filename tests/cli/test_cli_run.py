"""The command line: run, its output, its exit codes, and what every command says of mistakes."""

import json
import shlex
import sys
import time
from pathlib import Path

import pytest
from command_line import DECK, command, outcome

from hydro1d.analysis.openings import Openings
from hydro1d.cli import _common, main
from hydro1d.cli.run import summary
from hydro1d.deck import load_deck
from hydro1d.errors import BreakdownError, FileProblem, Interrupted
from hydro1d.jit import build


def test_run_for_real(deck, capsys, tmp_path):
    assert main(["run", deck]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert (tmp_path / "short.h5").is_file()
    assert "result: short.h5" in out
    assert "support stress: the wave has not reached the support; attenuated or enhanced is not decided yet" in out
    assert main(["run", deck, "-o", "other.h5", "--quiet"]) == 0
    assert main(["run", deck, "-o", "other.h5", "-q"]) == 0
    assert capsys.readouterr() == ("", "")
    assert (tmp_path / "other.h5").is_file()


def test_run_hands_everything_over(deck, calculated):
    arguments = [
        "-o",
        "x.h5",
        "--restart",
        "c.h5",
        "--force",
        "--set",
        "layer.0.zones=7",
        "--set",
        "title=new",
        "--quiet",
    ]
    assert main(["run", deck, *arguments]) == 0
    (call,) = calculated.calls
    assert (call.deck.layers[0].zones, call.deck.title) == (7, "new")
    assert (call.output, call.restart, call.force, call.progress) == (Path("x.h5"), Path("c.h5"), True, None)


@pytest.mark.parametrize("target", ["decks", "missing/x.h5", "decks/short.toml", "/proc/x.h5", "/dev/null"])
def test_a_target_that_cannot_be_written_is_named_before_anything_is_computed(deck, calculated, capsys, target):
    assert main(["run", deck, "-o", target]) == 4
    assert not calculated.calls
    out, err = capsys.readouterr()
    assert out == ""
    assert target in err
    assert Path(deck).read_text() == DECK


def test_a_bad_deck_is_named_before_the_target(deck, calculated, capsys):
    assert main(["run", deck, "--set", "time.end=0", "-o", "missing/x.h5"]) == 2
    assert "time.end (--set time.end=0): 0 is out of range" in capsys.readouterr().err
    assert not calculated.calls


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (
            BreakdownError("the zone is inverted", 3, 1e-3, 12),
            3,
            "zone 3 at t = 0.001 s, cycle 12: the zone is inverted",
        ),
        (FileProblem("cannot write x.h5: disk full"), 4, "disk full"),
        (Interrupted("interrupted at t = 1 s"), 130, "interrupted at t = 1 s"),
        (KeyboardInterrupt(), 130, "interrupted"),
        (MemoryError(), 3, "not enough memory"),
        (PermissionError(13, "Permission denied", "x.h5"), 4, "x.h5: Permission denied"),
        (OSError("odd"), 4, "odd"),
        (RuntimeError("oops"), 1, "an error in hydro1d itself"),
        (SystemExit(None), 0, ""),
        (SystemExit("text"), 2, ""),
        (BrokenPipeError(), 0, ""),
    ],
)
def test_exit_codes(deck, calculated, capfd, monkeypatch, error, code, words):
    monkeypatch.delenv("HYDRO1D_DEBUG", raising=False)
    calculated.answer = error
    assert main(["run", deck]) == code
    out, err = capfd.readouterr()
    assert out == ""
    assert words in err
    assert "Traceback" not in err


def test_the_way_on_is_a_command_with_all_that_was_given(deck, calculated, capsys, tmp_path):
    calculated.answer = Interrupted("interrupted at t = 1 s", tmp_path / "x.checkpoint-64.h5")
    given = [deck, "--set", 'left.peak="3 MPa"', "--set", "layer[0].zones=40", "-o", "my result.h5", "--quiet"]
    assert main(["run", *given]) == 130
    err = capsys.readouterr().err
    assert "restart from" not in err
    command = err.split("to go on: ")[1].strip()
    words = shlex.split(command)
    assert words == ["hydro1d", "run", *given[:-1], "--restart", str(tmp_path / "x.checkpoint-64.h5"), "--quiet"]
    calculated.answer = outcome()
    assert main(words[1:]) == 0
    first, again = calculated.calls
    assert (again.deck, again.output) == (first.deck, first.output) and again.restart == tmp_path / "x.checkpoint-64.h5"


def test_debugging_shows_the_error_itself(deck, calculated, monkeypatch):
    monkeypatch.setenv("HYDRO1D_DEBUG", "1")
    calculated.answer = RuntimeError("oops")
    with pytest.raises(RuntimeError, match="oops"):
        main(["run", deck])


PRESSURE = 'type = "pressure"\npulse = "rectangular"\npeak = "3.6 MPa"\nduration = "1.53 ms"'


@pytest.mark.parametrize(
    ("text", "result", "lines"),
    [
        (DECK, outcome(), ["enhanced, 1.5 times the applied peak (5.4 MPa over 3.6 MPa)", "25 % is not crushed"]),
        (DECK, outcome(right=1.8e6, uncrushed=0.0), ["attenuated, 0.5 times", "column: fully crushed"]),
        (DECK, outcome(uncrushed=float("nan")), ["enhanced"]),
        (
            DECK.replace(PRESSURE, 'type = "wall"').replace('[right]\ntype = "wall"', f"[right]\n{PRESSURE}"),
            outcome(left=7.2e6),
            ["enhanced, 2 times the applied peak (7.2 MPa over 3.6 MPa)"],
        ),
        (
            DECK.replace(PRESSURE, 'type = "piston"\nvelocity = 50'),
            outcome(),
            ["peak stress on the ends: left 3.6 MPa, right 5.4 MPa"],
        ),
    ],
)
def test_summary_answers_the_question_first(text, result, lines):
    found = summary(load_deck(text), result, Path("x.h5"))
    assert all(any(line in row for row in found) for line in lines), found
    assert found[0] == "A short run"
    assert lines[0] in found[1]
    assert found[-2:] == ["123 cycles to t = 2 ms in 20 ms; energy error 3.0e-15", "result: x.h5"]


def test_summary_names_what_opened():
    opened = Openings(322, 1000, 0, 1.568e-3, 0.0, 0.589, 5, 89.36)
    line = summary(load_deck(DECK), outcome(), Path("x.h5"), opened)[3]
    assert line == (
        "opened: 322 of 1000 zones, first seen at 1.568 ms, X from 0 m to 589 mm; all closed again at the end; "
        "5 stretched beyond the initial length, to 89.4 times it at most"
    )
    still = summary(load_deck(DECK), outcome(), Path("x.h5"), opened._replace(still=7, stretched=0))[3]
    assert still.endswith("; 7 still open at the end")


@pytest.mark.nightly
def test_compiling_is_said_on_a_terminal_and_to_the_log_and_not_when_quiet(deck, tmp_path):
    """A cache of its own, so that everything is compiled in the first run and nothing in the second."""
    cache = {"HYDRO1D_CACHE_DIR": str(tmp_path / "cache")}
    soft = ["--set", 'material.foam={law="elastic", density=50, modulus=2e7}']
    first = command("run", deck, *soft, "--log-json", "log.json", **cache)
    events = [json.loads(line) for line in (tmp_path / "log.json").read_text().splitlines()]
    kinds = [event["event"] for event in events]
    assert (first.returncode, first.stderr) == (0, "")
    assert kinds[0] == "start" and kinds[1] == "compiling" and kinds[-1] == "done"
    assert {"march"} < {event["what"] for event in events if event["event"] == "compiling"}
    command("run", deck, *soft, "--log-json", "log.json", **cache)
    assert "compiling" not in (tmp_path / "log.json").read_text()


def test_the_bar_says_that_it_compiles_and_begins_anew_after_it(monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setattr(build.cache, "read", lambda key: None)
    monkeypatch.setattr(build.cache, "write", lambda key, code: "")
    monkeypatch.setattr(build.compile, "machine_code", lambda *arguments: build.compile.MachineCode(b""))
    monkeypatch.setattr(build, "_loaded", lambda made: 0)
    shared = build.Shared("Nothing", {})
    with _common.progress_bar(quiet=False) as progress:
        build.address(build.Request("some kernel", lambda _: None, lambda: "of this test"), shared)
        said = capsys.readouterr().err
        time.sleep(1.1)
        progress(0.5)
        time.sleep(0.2)
        progress(0.75)
    assert "compiling, once" in said
    assert "00:01" not in capsys.readouterr().err.split("50%")[-1]
    build.address(build.Request("another kernel", lambda _: None, lambda: "of this test"), shared)
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    "arguments",
    [
        ["schema", "-o"],
        ["verify", "--only", "noh", "--json"],
        ["verify", "--only", "noh", "--html"],
        ["verify", "--only", "noh", "--markdown"],
        ["run", "decks/short.toml", "--log-json"],
    ],
)
def test_a_result_is_never_overwritten_with_text(deck, capsys, arguments, tmp_path):
    precious = b"\x89HDF\r\n\x1a\n and what took a week"
    (tmp_path / "precious.h5").write_bytes(precious)
    assert main([*arguments, "precious.h5"]) == 4
    assert "precious.h5: a result (HDF5) is there" in capsys.readouterr().err
    assert (tmp_path / "precious.h5").read_bytes() == precious


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["completion", "zhs"], "did you mean zsh"),
        (["plot", "x.h5", "--frame", "labratory"], "did you mean laboratory"),
        (["plot", "x.h5", "--format", "jpg"], "png, svg, pdf, gif, mp4; did you mean png"),
        (["plot", "x.h5", "--dpi", "0"], "must be 1 at least, an integer, not '0'"),
        (["laws", "plot", "x.toml", "--dpi", "0"], "must be 1 at least, an integer, not '0'"),
        (["verify", "--only", "nho"], "did you mean noh"),
        (["new", "blats"], "did you mean blast"),
        (["laws", "trilinaer"], "did you mean trilinear"),
        (
            ["critical", "x.toml", "--key", "a", "--from", "1", "--to", "2", "--outcome", "enhnced"],
            "did you mean enhanced",
        ),
        (
            [
                "critical",
                "x.toml",
                "--key",
                "a",
                "--from",
                "1",
                "--to",
                "2",
                "--outcome",
                "enhanced",
                "--spacing",
                "lin",
            ],
            "did you mean linear",
        ),
    ],
)
def test_the_nearest_word_is_suggested(deck, capsys, arguments, words):
    (Path.cwd() / "x.toml").write_text(DECK)
    assert main(arguments) == 2
    assert words in capsys.readouterr().err


def test_progress_is_shown_on_a_terminal_only(monkeypatch, capsys):
    with _common.progress_bar(quiet=False) as progress:
        assert progress is None
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with _common.progress_bar(quiet=True) as progress:
        assert progress is None
    with _common.progress_bar(quiet=False) as progress:
        time.sleep(0.2)  # the bar is drawn ten times a second at most
        progress(0.5)
        time.sleep(0.2)
        progress(1.5)
    assert "100%" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (3.6e6, "3.6 MPa"),
        (0.0, "0 Pa"),
        (1e3, "1 kPa"),
        (999.9999999, "1 kPa"),
        (-5e-5, "-50 uPa"),
        (1e-12, "1e-12 Pa"),
    ],
)
def test_figures(value, text):
    assert _common.figure(value, "Pa") == text


def test_figures_that_are_none():
    assert _common.figure(float("nan"), "Pa") == "nan Pa"
    assert _common.figure(0.5) == "0.5"
    assert _common.figure(1234.5, "kg/m^3", 3) == "1.23e+03 kg/m^3"
    assert _common.count(1, "cycle") == "1 cycle"
    assert _common.count(2, "cycle") == "2 cycles"
