"""The command line: finding a command; check, laws and schema."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import DECK, ENVIRONMENT

from hydro1d import cli
from hydro1d.cli import main

HEAVY = {"numpy", "numba", "h5py", "pydantic", "scipy", "matplotlib", "pint", "tqdm"}


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


def test_check_reads_the_deck_back(deck, capsys):
    assert main(["check", deck]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out.startswith(f"{deck}: in order\ntitle: A short run\n")
    assert "layer[0]: foam (epph), 1 m in 20 zones of 50 mm" in out
    assert "left: pressure, rectangular, peak 3.6 MPa, duration 1.53 ms\nright: wall\n" in out
    assert not list(Path.cwd().glob("*.h5"))


@pytest.mark.parametrize(
    ("end", "line"),
    [
        ('{type="striker", mass="40 kg/m^2", velocity="200 m/s"}', "striker, mass 40 kg/m^2, velocity 200 m/s"),
        ('{type="piston", table=[[0, 0], ["1 ms", 9]]}', "piston, table of 2 points"),
        ('{type="wall", bonded=false}', "wall, bonded = false"),
        (
            '{type="pressure", pulse="friedlander", peak=1e6, duration=1e-3, decay=1, negative_phase=true}',
            "pressure, friedlander, peak 1 MPa, duration 1 ms, decay 1, negative phase = true",
        ),
    ],
)
def test_check_shows_what_an_end_is_given(deck, capsys, end, line):
    assert main(["check", deck, "--set", f"left={end}"]) == 0
    assert f"\nleft: {line}\n" in capsys.readouterr().out


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
    from hydro1d.components.plugins import builtin_names

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
    import hydro1d.components.plugins

    def broken():
        raise ImportError("gone")

    monkeypatch.setattr(hydro1d.components.plugins, "available", lambda kind: {"theirs": broken})
    assert main(["laws"]) == 0
    assert "theirs        (cannot be loaded: gone)" in capsys.readouterr().out


def test_schema(deck, capsys, tmp_path):
    assert main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out)["title"] == "hydro1d deck"
    assert main(["schema", "-o", "schema.json"]) == 0
    assert json.loads((tmp_path / "schema.json").read_text())["title"] == "hydro1d deck"
    assert main(["schema", "-o", "missing/schema.json"]) == 4
    assert "missing/schema.json: No such file" in capsys.readouterr().err
