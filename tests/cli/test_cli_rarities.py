"""What the command line rarely meets: odd streams, a library's panic, warnings, options of seldom used commands."""

from __future__ import annotations

import io
import os
import runpy
import sys
import warnings
from pathlib import Path
from types import SimpleNamespace

import pytest

from hydro1d import cli
from hydro1d.cli import _common, completion, main

CRITICAL = ["--key", "a", "--from", "1", "--to", "2", "--outcome", "enhanced"]


class Stream(io.StringIO):
    """Standard output that cannot be flushed."""

    def __init__(self, error: Exception) -> None:
        super().__init__()
        self.error = error

    def flush(self) -> None:
        raise self.error


@pytest.mark.parametrize(
    ("error", "code"),
    [(BrokenPipeError(), 0), (OSError(28, "No space left on device"), 4), (ValueError("closed"), 0)],
)
def test_standard_output_that_cannot_be_flushed(capsys, monkeypatch, error, code):
    monkeypatch.setattr(sys, "stdout", Stream(error))
    assert main(["--version"]) == code
    assert ("standard output: No space left on device" in capsys.readouterr().err) == (code == 4)


def test_a_library_s_panic_is_an_interrupt_and_nothing_else_is(monkeypatch, capsys):
    class PanicException(BaseException):
        pass

    class Other(BaseException):
        pass

    def raising(error):
        def dispatch(_):
            raise error

        return dispatch

    monkeypatch.setattr(cli, "_dispatch", raising(PanicException()))
    assert main(["--version"]) == 130
    assert capsys.readouterr().err == "hydro1d: interrupted\n"
    monkeypatch.setattr(cli, "_dispatch", raising(Other()))
    with pytest.raises(Other):
        main(["--version"])


@pytest.mark.parametrize(("wanted", "shown"), [([], False), (["default"], True)])
def test_warnings_are_for_those_who_ask(monkeypatch, wanted, shown):
    seen = []

    def warn(_):
        warnings.warn("a remark to programmers", DeprecationWarning, stacklevel=1)

    module = SimpleNamespace(add_arguments=lambda parser: None, run=warn)
    monkeypatch.setattr(cli, "_module", lambda name: module)
    monkeypatch.setattr(sys, "warnoptions", wanted)
    monkeypatch.setattr(warnings, "showwarning", lambda *what, **_: seen.append(what))
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        monkeypatch.setattr(warnings, "showwarning", lambda *what, **_: seen.append(what))
        assert main(["schema"]) == 0
    assert bool(seen) == shown


@pytest.mark.parametrize("name", ["hydro1d", "hydro1d.cli"])
def test_the_package_runs_as_a_module(monkeypatch, capsys, name):
    monkeypatch.setattr(sys, "argv", ["hydro1d", "--version"])
    with pytest.raises(SystemExit) as leaving:
        runpy.run_module(name, run_name="__main__")
    assert leaving.value.code == 0 and capsys.readouterr().out.startswith("hydro1d ")


def test_sigterm_ends_a_command_like_ctrl_c(monkeypatch, capsys):
    import signal

    def killed(_):
        assert signal.getsignal(signal.SIGTERM) not in (before, signal.SIG_DFL), "not our own process, please"
        os.kill(os.getpid(), signal.SIGTERM)

    before = signal.getsignal(signal.SIGTERM)
    module = SimpleNamespace(add_arguments=lambda parser: None, run=killed)
    monkeypatch.setattr(cli, "_module", lambda name: module)
    assert main(["schema"]) == 130
    assert signal.getsignal(signal.SIGTERM) == before


def test_progress_of_a_share_that_knows_its_time(monkeypatch, capsys):
    share = type("Share", (float,), {"time": 2e-3, "cycles": 7})
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with _common.progress_bar(quiet=False) as show:
        for part in (0.2, 0.5):
            import time

            time.sleep(0.15)
            show(share(part))
    assert "t = 2 ms, 7 cycles" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["bench", "--nonsense"], "unrecognized arguments"),
        (["critical", "x.toml"], "the following arguments are required"),
        (["critical", "x.toml", *CRITICAL, "--along", "b"], "go together"),
        (["critical", "x.toml", *CRITICAL, "--threads", "0"], "must be 1 at least, an integer, not '0'"),
        (["sweep", "x.toml", "--threads", "0"], "must be 1 at least, an integer, not '0'"),
        (["reproduce", "--threads", "0"], "must be 1 at least, an integer, not '0'"),
        (["reproduce", "--only", "99"], "no such part"),
        (["verify", "--workers", "0"], "must be 1 at least, an integer, not '0'"),
        (["laws", "fit", "x.csv", "--density", "51.6 kg"], "--density: "),
        (["plot", "profiles", "xt"], "name a result"),
        (["plot", "a.h5", "--dpi", "0"], "must be 1 at least"),
    ],
)
def test_options_that_make_no_sense(capsys, arguments, words):
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == "" and words in err and "Traceback" not in err


@pytest.mark.parametrize(
    "values", ["0.1:0.2:x", "0.1:0.2", " , ", "2:1:0", "a:b:3"], ids=["count", "two", "none", "zero", "words"]
)
def test_values_along_a_boundary_that_are_none(tmp_path, monkeypatch, capsys, values):
    monkeypatch.chdir(tmp_path)
    main(["new", "pulse"])
    capsys.readouterr()
    arguments = [
        "--key",
        "left.duration",
        "--from",
        "1 ms",
        "--to",
        "2 ms",
        "--outcome",
        "enhanced",
        "--along",
        "left.peak",
    ]
    assert main(["critical", "pulse.toml", *arguments, "--values", values]) == 2
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize("json", [False, True])
def test_bench_prints_a_table_or_json(monkeypatch, capsys, json):
    from hydro1d.benchmarks import report

    def measured(quick, say):
        say("a row")
        return {"quick": quick}

    monkeypatch.setattr(report, "run", measured)
    assert main(["bench", "--quick", *(["--json"] if json else [])]) == 0
    assert capsys.readouterr().out == ('{\n "quick": true\n}\n' if json else "a row\n")


def test_a_sweep_names_its_hdf5_file(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    main(["new", "pulse"])
    Path("sweep.toml").write_text(
        'deck = "pulse.toml"\nquantities = ["peak_support_stress"]\n'
        '[[parameter]]\nkey = "left.peak"\nvalues = ["1 MPa"]\n'
    )
    capsys.readouterr()
    assert main(["sweep", "sweep.toml", "-o", "table.csv"]) == 2
    assert "name the HDF5 file" in capsys.readouterr().err
    assert main(["sweep", "sweep.toml", "--scheduler", "tcp://127.0.0.1:1"]) in (2, 4)
    assert "Traceback" not in capsys.readouterr().err


def test_a_sweep_without_dask_says_what_to_install(tmp_path, capsys, monkeypatch):
    from hydro1d.cli import sweep

    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(Exception, match=r"pip install 'hydro1d\[sweep\]'"), sweep.executor_at("tcp://x:1"):
        pass


def test_a_deck_cannot_be_written_where_there_is_no_folder(capsys):
    assert main(["new", "pulse", "-o", "/nowhere/at/all.toml"]) == 4
    assert "cannot write /nowhere/at/all.toml: No such file" in capsys.readouterr().err


def test_completion_leaves_out_a_command_that_cannot_be_imported(monkeypatch):
    real = cli._module

    def module(name):
        if name == "schema":
            raise ImportError("no such thing")
        return real(name)

    monkeypatch.setattr(cli, "_module", module)
    offered = completion.grammar(["hydro1d", ""]).format_help()
    assert "schema" not in offered and "check" in offered
