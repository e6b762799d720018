"""The command line: what it prints, where, and its exit codes."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hydro1d import cli
from hydro1d.cli import _common, main
from hydro1d.cli.run import summary
from hydro1d.deck import load_deck
from hydro1d.errors import BreakdownError, FileProblem, Interrupted
from hydro1d.kernels import build
from hydro1d.openings import Openings

DECK = """\
title = "A short run"
[material.foam]
law = "epph"
density = "51.6 kg/m^3"
modulus = "22 MPa"
plateau_stress = "0.8 MPa"
densification_strain = 0.689
shock_slope = "0.00105 s/m"
[[layer]]
material = "foam"
thickness = "1 m"
zones = 20
[left]
type = "pressure"
pulse = "rectangular"
peak = "3.6 MPa"
duration = "1.53 ms"
[right]
type = "wall"
[time]
end = "1 ms"
[output]
profiles = 3
"""
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(cli.__file__).parents[2])}
HEAVY = {"numpy", "numba", "h5py", "pydantic", "scipy", "matplotlib", "pint", "tqdm"}


@pytest.fixture
def deck(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "decks").mkdir()
    path = tmp_path / "decks" / "short.toml"
    path.write_text(DECK)
    return str(path)


@pytest.fixture
def calculated(monkeypatch):
    """Stands for `hydro1d.api.run`: remembers how it was called, returns or raises what a test wants."""
    import hydro1d.api

    record = SimpleNamespace(calls=[], answer=outcome())

    def run(deck, output, *, restart, force, progress):
        record.calls.append(SimpleNamespace(deck=deck, output=output, restart=restart, force=force, progress=progress))
        if isinstance(record.answer, BaseException):
            raise record.answer
        return record.answer

    monkeypatch.setattr(hydro1d.api, "run", run)
    return record


def outcome(left=3.6e6, right=5.4e6, uncrushed=0.25):
    history = {
        "time": np.array([0.0, 1e-3]),
        "peak_left_stress": np.array([0.0, left]),
        "peak_right_stress": np.array([0.0, right]),
        "uncrushed_fraction": np.array([1.0, uncrushed]),
        "energy_error": np.array([0.0, -3e-15]),
    }
    return SimpleNamespace(title="A short run", history=history, attributes={"cycles": 123, "wall_seconds": 0.02})


def command(*arguments, **options):
    return subprocess.run(
        [sys.executable, "-m", "hydro1d.cli", *arguments],
        capture_output=True,
        text=True,
        check=False,
        env=ENVIRONMENT | options,
    )


# --- finding a command ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("word", ["--help", "-h", "help"])
def test_help_names_every_command(capsys, word):
    assert main([word]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert all(f"\n  {name} " in out for name in cli.COMMANDS)
    assert "exit codes" in out


@pytest.mark.parametrize("name", ["run", "check", "laws", "schema"])
def test_help_of_each_command(capsys, name):
    assert name in cli.COMMANDS
    assert main([name, "--help"]) == 0
    assert capsys.readouterr().out.startswith(f"usage: hydro1d {name}")


def test_help_imports_nothing_heavy():
    code = "import sys; from hydro1d.cli import main; main(['--help']); main(['run', '-h']); print(sorted(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=ENVIRONMENT)
    modules = set(done.stdout.split("\n")[-2].strip("[]").replace("'", "").split(", "))
    assert not modules & HEAVY


def test_every_module_is_a_command():
    files = Path(cli.__file__).parent.glob("[!_]*.py")
    assert sorted(file.stem for file in files) == sorted(cli.COMMANDS)


def test_help_costs_no_import():
    """Python itself has loaded a few modules; of the standard library the overview needs no more."""
    code = "import sys; from hydro1d.cli import main; was = set(sys.modules); main(['--help']); print(set(sys.modules) - was)"
    command = [sys.executable, "-c", f"import sys; bare = set(sys.modules); {code}; print(was - bare)"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=ENVIRONMENT)
    *_, during, before = done.stdout.splitlines()
    assert during == "set()"
    assert eval(before) <= {"__future__", "hydro1d", "hydro1d.cli"}


def test_version(capsys):
    from hydro1d import __version__

    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"hydro1d {__version__}\n"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "usage: hydro1d"),
        (["runn"], "did you mean run?"),
        (["\x1b[31m"], "there is no command"),
        (["run"], "the following arguments are required: DECK"),
        (["run", "a", "b"], "unrecognized arguments"),
        (["run", "a", "--outp", "b"], "unrecognized arguments"),
        (["check", "--nonsense", "x"], "unrecognized arguments"),
        (["laws", "ephp"], "did you mean eph?"),
        (["laws", "missing.py:Law"], "does not exist"),
    ],
)
def test_usage_errors(capsys, arguments, words):
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert words in err
    assert "\x1b" not in err


# --- check, laws, schema --------------------------------------------------------------------------------------------


def test_check_reads_the_deck_back(deck, capsys):
    assert main(["check", deck]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out.startswith(f"{deck}: in order\ntitle: A short run\n")
    assert "layer[0]: foam (epph), 1 m in 20 zones of 50 mm" in out
    assert "left: pressure, rectangular, peak 3.6 MPa" in out
    assert not list(Path.cwd().glob("*.h5"))


def test_check_names_all_errors_in_one_block(deck, capsys):
    assert main(["check", deck, "--set", "layer[0].zones=0", "--set", "time.end=0", "--set", "left.peek=1"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"hydro1d: {deck}: 3 problems\n")
    assert all(line.startswith("  ") for line in err.strip().split("\n")[1:])
    assert "Traceback" not in err


def test_check_says_what_code_it_ran(deck, capsys, tmp_path):
    (tmp_path / "decks" / "mine.py").write_text(
        "from hydro1d.laws.elastic import Elastic\nclass Mine(Elastic):\n    pass\n"
    )
    text = DECK.replace('"epph"', '"mine.py:Mine"')
    text = "\n".join(line for line in text.split("\n") if not line.startswith(("plateau", "densif", "shock")))
    Path(deck).write_text(text)
    assert main(["check", deck]) == 0
    assert "note: mine.py is Python code that this deck names; it was run to check it" in capsys.readouterr().out


@pytest.mark.parametrize("path", ["missing.toml", "decks", "\0", "x" * 5000])
def test_a_deck_that_is_no_file(deck, capsys, path):
    assert main(["check", path]) == 4
    assert "cannot be read" in capsys.readouterr().err


def test_laws_lists_everything(capsys):
    from hydro1d.plugins import builtin_names

    assert main(["laws"]) == 0
    out = capsys.readouterr().out
    assert all(f"  {name} " in out for kind in ("law", "boundary", "pulse") for name in builtin_names(kind))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("epph", ["Eq. 39", "density", "kg/m^3", "above 0", "required", "default elastic"]),
        ("table", ["law: ", "pulse: ", "CSV file"]),
        ("pressure", ["a pulse; its keys stand beside"]),
        ("free", ["  none"]),
        ("wall", ["true or false; default true"]),
    ],
)
def test_laws_shows_one(capsys, name, words):
    assert main(["laws", name]) == 0
    out = capsys.readouterr().out
    assert all(word in out for word in words), out


@pytest.mark.parametrize(("base", "kind"), [("laws.base:Law", "law"), ("boundaries.base:Boundary", "boundary")])
def test_laws_shows_one_of_a_file(deck, capsys, tmp_path, base, kind):
    module, name = base.split(":")
    (tmp_path / "mine.py").write_text(f'from hydro1d.{module} import {name}\nclass Mine({name}):\n    "All mine."\n')
    assert main(["laws", "mine.py:Mine"]) == 0
    assert capsys.readouterr().out.startswith(
        f'{kind}: {"law" if kind == "law" else "type"} = "mine.py:Mine"\n\nAll mine.'
    )


def test_an_entry_point_that_cannot_be_loaded(capsys, monkeypatch):
    import hydro1d.plugins

    def broken():
        raise ImportError("gone")

    monkeypatch.setattr(hydro1d.plugins, "available", lambda kind: {"theirs": broken})
    assert main(["laws"]) == 0
    assert "theirs        (cannot be loaded: gone)" in capsys.readouterr().out


def test_schema(deck, capsys, tmp_path):
    assert main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out)["title"] == "hydro1d deck"
    assert main(["schema", "-o", "schema.json"]) == 0
    assert json.loads((tmp_path / "schema.json").read_text())["title"] == "hydro1d deck"
    assert main(["schema", "-o", "missing/schema.json"]) == 4
    assert "missing/schema.json: No such file" in capsys.readouterr().err


# --- run ------------------------------------------------------------------------------------------------------------


def test_run_for_real(deck, capsys, tmp_path):
    assert main(["run", deck]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert (tmp_path / "short.h5").is_file()
    assert "result: short.h5" in out
    assert "attenuated" in out
    assert main(["run", deck, "-o", "other.h5", "--quiet"]) == 0
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
    assert found[-2:] == ["123 cycles to t = 1 ms in 20 ms; energy error 3.0e-15", "result: x.h5"]


def test_summary_names_what_opened():
    opened = Openings(322, 1000, 0, 1.568e-3, 0.0, 0.589, 5, 89.36)
    line = summary(load_deck(DECK), outcome(), Path("x.h5"), opened)[3]
    assert line == (
        "opened: 322 of 1000 zones, first seen at 1.568 ms, X from 0 m to 589 mm; all closed again at the end; "
        "5 stretched beyond the initial length, to 89.4 times it at most"
    )
    still = summary(load_deck(DECK), outcome(), Path("x.h5"), opened._replace(still=7, stretched=0))[3]
    assert still.endswith("; 7 still open at the end")


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
    monkeypatch.setattr(build, "_read", lambda key: None)
    monkeypatch.setattr(build, "_write", lambda key, code: None)
    monkeypatch.setattr(build, "_compile", lambda kernel, signature: b"")
    monkeypatch.setattr(build, "_load", lambda code: 0)
    with _common.progress_bar(quiet=False) as progress:
        build.address("some kernel", "i", "of this test", lambda: None)
        said = capsys.readouterr().err
        time.sleep(1.1)
        progress(0.5)
        time.sleep(0.2)
        progress(0.75)
    assert "compiling, once" in said
    assert "00:01" not in capsys.readouterr().err.split("50%")[-1]
    build.address("another kernel", "i", "of this test", lambda: None)
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
    assert _common.figure(0.5) == "500 m"
    assert _common.count(1, "cycle") == "1 cycle"
    assert _common.count(2, "cycle") == "2 cycles"


# --- the process ----------------------------------------------------------------------------------------------------


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
    arguments = ["--set", "layer[0].zones=2000", "--set", "time.end=10 s", "-o", "long.h5"]
    process = subprocess.Popen(
        [sys.executable, "-m", "hydro1d.cli", "run", deck, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=ENVIRONMENT,
    )
    _wait_for(lambda: len(list(tmp_path.iterdir())) > 1)  # the file that the run writes to
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
    time.sleep(0.5)
