"""hydro1d plot, new, completion, run --log-json: names, defaults, messages, exit codes."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import pytest

from hydro1d.cli import main
from hydro1d.cli.new import CASES
from hydro1d.deck import load_deck
from hydro1d.sweep import Column, Table

ROOT = Path(__file__).parents[2]


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_plot_without_options(result, here, capsys):
    assert main(["plot", str(result), "--dpi", "40"]) == 0
    assert capsys.readouterr().out == "coarse-overview.png\n"
    assert (here / "coarse-overview.png").exists()


@pytest.mark.parametrize(
    "options",
    [
        ["profiles", "-t", "1 ms,2 ms", "-q", "strain", "--frame", "laboratory"],
        ["xt", "-q", "density", "--format", "svg"],
        ["history", "-q", "right_stress,probes/strain"],
        ["hugoniot", "--zone", "10", "--format", "pdf"],
        ["animate", "--frames", "3"],
        ["compare", "-t", "0.002"],
    ],
)
def test_plot_kinds(result, here, capsys, options):
    assert main(["plot", str(result), *options, "--dpi", "40"]) == 0
    assert (here / capsys.readouterr().out.strip()).stat().st_size > 1000


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="needs ffmpeg")
def test_film_with_ffmpeg(result, here, capsys):
    assert main(["plot", str(result), "animate", "--frames", "7", "--fps", "5", "--format", "mp4", "--dpi", "60"]) == 0
    assert capsys.readouterr().out == "coarse-animate.mp4\n"
    ask = ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=codec_name,nb_read_frames,r_frame_rate"]
    told = subprocess.run([*ask, "-of", "csv=p=0", "coarse-animate.mp4"], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "h264,5/1,7"


def test_several_runs_are_compared(result, here, capsys):
    shutil.copy(result, "b.h5")
    assert main(["plot", str(result), "b.h5", "-o", "c.png", "--dpi", "40"]) == 0
    assert (here / "c.png").exists()


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (["none.h5"], 4, "none.h5"),
        (["{}", "profile"], 2, "did you mean profiles"),
        (["{}", "xt", "history"], 2, "one kind"),
        (["xt"], 2, "name a result"),
        (["{}", "{}", "xt"], 2, "compare draws several"),
        (["{}", "xt", "-q", "sterss"], 4, "it has position"),
        (["{}", "xt", "-q", "stress,strain"], 2, "takes one --quantity"),
        (["{}", "profiles", "-t", "2 s"], 4, "profiles from"),
        (["{}", "profiles", "-t", "2 bananas"], 2, "--time"),
        (["{}", "-o", "a.bmp"], 2, ".svg"),
        (["{}", "history", "-q", "nothing"], 4, "There is"),
        (["{}", "xt", "-q", "sterss"], 4, "did you mean stress"),
        (["{}", "profiles", "-q", "right_stress"], 4, "the history has it"),
        (["{}", "-q", "strain"], 2, "overview takes no --quantity; it is for profiles, xt"),
        (["{}", "hugoniot", "-t", "1 ms"], 2, "hugoniot takes no --time"),
        (["{}", "xt", "--fps", "3"], 2, "xt takes no --fps; it is for animate"),
        (["{}", "xt", "--format", "gif"], 2, ".svg"),
    ],
)
def test_plot_says_what_is_wrong(result, here, capsys, words, code, message):
    assert main(["plot", *[word.format(result) for word in words]]) == code
    err = capsys.readouterr().err
    assert message in err and "Traceback" not in err and err.startswith("hydro1d: ")


def damage(kind, result, path):
    """A file with one thing wrong."""
    data = result.read_bytes()
    if kind == "text":
        path.write_text("just words")
    elif kind == "empty":
        path.write_bytes(b"")
    elif kind == "truncated":
        path.write_bytes(data[: len(data) // 2])
    elif kind == "not ours":
        with h5py.File(path, "w") as file:
            file["a"] = [1.0]
    elif kind == "newer":
        path.write_bytes(data)
        with h5py.File(path, "r+") as file:
            file.attrs["schema_version"] = 99
    elif kind == "table":
        Table([Column("peak", "Pa", "a column", [1.0, 2.0])]).write_hdf5(path)
    elif kind == "flipped":
        path.write_bytes(data[:-20_000] + bytes(byte ^ 255 for byte in data[-20_000:]))


WORDS = {
    "text": "it is not an HDF5 file", "empty": "it is empty", "truncated": "not all of it is written yet",
    "not ours": "not one of hydro1d's", "newer": "schema version 99", "flipped": "damaged",
    "table": "a table of hydro1d sweep, not the result of a run",
}  # fmt: skip


@pytest.mark.parametrize("kind", WORDS)
@pytest.mark.parametrize("command", ["plot", "report"])
def test_bad_files_are_one_message_in_our_words(result, here, capsys, kind, command):
    path = here / "bad.h5"
    damage(kind, result, path)
    assert main([command, str(path)]) == 4
    captured = capsys.readouterr()
    assert captured.err.startswith("hydro1d: ") and "bad.h5" in captured.err and "Traceback" not in captured.err
    assert WORDS[kind] in captured.err and "synchronously" not in captured.err
    assert len(captured.err.splitlines()) <= 3
    assert not list(here.glob("*.png")) and not list(here.glob("*.html"))


@pytest.mark.parametrize("case", CASES)
def test_new_writes_decks_that_load(case, here, capsys):
    assert main(["new", case, "-o", "mine.toml"]) == 0
    out = capsys.readouterr().out
    assert "mine.toml" in out and "hydro1d run mine.toml" in out
    deck = load_deck("mine.toml")
    assert deck.title and "#" in deck.text and "{name}" not in deck.text
    assert main(["new", case, "-o", "mine.toml"]) == 4
    assert "already" in capsys.readouterr().err


def test_new_lists_and_suggests(here, capsys):
    assert main(["new"]) == 0
    listed = capsys.readouterr().out
    assert all(case in listed for case in CASES)
    assert main(["new", "strikr"]) == 2
    assert "did you mean striker" in capsys.readouterr().err
    assert main(["new", "pulse", "-o", "a.txt"]) == 2
    assert not list(here.iterdir())


@pytest.fixture
def shell(here, monkeypatch, capsys):
    """Runs lines of a shell that has loaded its completion script, in a folder with the command and nothing else."""
    (here / "hydro1d").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m hydro1d "$@"\n')
    (here / "hydro1d").chmod(0o755)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.setenv("PATH", f"{here}:{os.environ['PATH']}")

    def run(name, lines, *options):
        if shutil.which(name) is None:
            pytest.skip(f"needs {name}")
        assert main(["completion", name]) == 0
        (here / "_hydro1d").write_text(capsys.readouterr().out)
        done = subprocess.run([name, *options, "-c", lines], capture_output=True, text=True, timeout=60)
        assert done.stderr == ""
        return done.stdout

    return run


BASH = """
source ./_hydro1d
COMP_LINE='{typed}' COMP_POINT={length} COMP_WORDS=({typed}) COMP_CWORD={last} COMP_TYPE=9
$(complete -p hydro1d | sed 's/.*-F \\([^ ]*\\) .*/\\1/') hydro1d
printf '%s\\n' "${{COMPREPLY[@]}}"
"""


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("pl", ["plot"]),
        ("plot hug", ["hugoniot"]),
        ("plot hyd", ["hydro1d"]),
        ("plot --frame lab", ["laboratory"]),
        ("new bl", ["blast"]),
        ("new str", ["striker"]),
        ("run --qui", ["--quiet"]),
        ("laws pl", ["plot"]),
        ("laws epph-", ["epph-tangent"]),
        ("laws plot --mat", ["--material"]),
        ("laws plot --fra", []),
        ("laws fit --str", ["--strain-unit", "--stress-unit"]),
    ],
)
def test_bash_completion_works(shell, typed, offered):
    line = f"hydro1d {typed}"
    lines = BASH.format(typed=line, length=len(line), last=len(line.split()) - 1)
    assert shell("bash", lines).split() == offered


# The keys of a terminal would bring `_describe` the same list.
ZSH = """
autoload -U compinit && compinit -D
_describe() { print -l -- ${(P)2} }
complete_line() { BUFFER=$1 CURSOR=${#1} words=(${=1}); _hydro1d; print -- --- }
fpath=(. $fpath); autoload -Uz _hydro1d is-at-least
complete_line 'hydro1d plot hug'
complete_line 'hydro1d plot --'
complete_line 'hydro1d p'
complete_line 'hydro1d laws fit --'
unfunction _hydro1d; source ./_hydro1d; print $_comps[hydro1d]
"""


def test_zsh_completion_works(shell):
    kinds, options, commands, fit, registered = (part.split("\n") for part in shell("zsh", ZSH, "-f").split("---\n"))
    assert any(line.startswith("hugoniot") for line in kinds)
    assert any(line.startswith("--frame:where things are") for line in options)
    assert any(line.startswith("plot:draw figures of a run") for line in commands)
    assert any(line.startswith("--stress-unit:") for line in fit) and not any(
        line.startswith("--frame") for line in fit
    )
    assert registered[0] == "_python_argcomplete"


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("hydro1d pl", "plot\tdraw figures"),
        ("./hydro1d pl", "plot\tdraw figures"),
        ("hydro1d plot hug", "hugoniot"),
        ("hydro1d plot --frame lab", "laboratory"),
        ("hydro1d plot hyd", "hydro1d"),
        ("hydro1d new bl", "blast"),
        ("hydro1d run --qui", "--quiet\tno progress"),
        ("hydro1d laws fit --stress", "--stress-unit\t"),
        ("hydro1d laws plot --mat", "--material\t"),
        ("hydro1d laws epph-t", "epph-tangent"),
    ],
)
def test_fish_completion_works(shell, typed, offered):
    found = shell("fish", f"source _hydro1d; complete -C '{typed}'", "--no-config")
    assert any(line.startswith(offered) for line in found.splitlines()), found


def test_fish_does_not_take_laws_plot_for_plot(shell):
    found = shell("fish", "source _hydro1d; complete -C 'hydro1d laws plot --'", "--no-config")
    assert "--material" in found and "--frame" not in found


def test_log_json(here, capsys):
    main(["new", "piston"])
    capsys.readouterr()
    small = ["--set", "layer[0].zones=20", "--set", "output.profiles=3"]
    assert main(["run", "piston.toml", *small, "--log-json", "log.json"]) == 0
    assert "result: piston.h5" in capsys.readouterr().out
    events = [json.loads(line) for line in (here / "log.json").read_text().splitlines()]
    assert [events[0]["event"], events[-1]["event"]] == ["start", "done"]
    assert events[-1]["status"] == "complete" and events[-1]["cycles"] > 10 and events[0]["zones"] == 20
    assert main(["run", "piston.toml", *small, "--log-json", "-"]) == 0
    assert all(json.loads(line)["event"] for line in capsys.readouterr().out.splitlines())
    assert main(["run", "piston.toml", *small, "--log-json", "no/log.json"]) == 4
