"""The command line. Each subcommand is a module of this package: add_arguments(parser), run(args) -> int | None.

A new subcommand is a new file and its line in `COMMANDS`. Python itself starts in a hundredth of a second and most of the
standard library costs as much, so everything here is imported where it is used: `hydro1d --help` needs none of it.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

COMMANDS = {
    "bench": "measure the speed beside a C reference, plain numpy and the memory's bound",
    "check": "check a deck and say what it asks for, without running it",
    "completion": "print a completion script for bash, zsh or fish",
    "critical": "find the value of a deck's key at which an outcome flips, or trace that boundary",
    "laws": "list the laws, boundaries and pulses, show the keys of one, plot a law, fit a law",
    "new": "write a commented deck to start from",
    "plot": "draw figures of a run: x-t diagram, profiles, histories, Hugoniot plane",
    "report": "write one self-contained HTML page about a run",
    "reproduce": "regenerate every figure and number of Harrigan, Reid & Seyed Yaghoubi 2010",
    "run": "run a deck and write its result as HDF5",
    "schema": "print the JSON schema of a deck, for editors",
    "sweep": "run a deck over lists, ranges, grids or samples of its keys: one table",
    "verify": "measure the solver against exact solutions",
}
PROGRAM = "hydro1d"
DONE, FAILED, USAGE, BROKEN_DOWN, FILE_PROBLEM, INTERRUPTED = 0, 1, 2, 3, 4, 130
GARBAGE = 100_000  # objects made and not freed before Python looks for garbage among them


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; what goes wrong is said in one block on standard error."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # whatever the terminal's encoding, σ is no error
    if "_ARGCOMPLETE" in os.environ:  # a shell asks what can stand at its cursor
        from hydro1d.cli import completion

        completion.answer()
    return _flushed(_guarded(arguments))


def _guarded(arguments: list[str]) -> int:
    """The command's exit code, whatever it raises."""
    try:
        return _dispatch(arguments)
    except SystemExit as leaving:  # argparse
        return leaving.code if isinstance(leaving.code, int) else DONE if leaving.code is None else USAGE
    except KeyboardInterrupt:
        return _complain("interrupted", INTERRUPTED)
    except BrokenPipeError:
        return _silenced()
    except MemoryError:
        return _complain("not enough memory for what this deck asks", BROKEN_DOWN)
    except Exception as error:
        return _explained(error)
    except BaseException as error:
        # Ctrl-C while a compiled library is being imported reaches us as that library's own panic.
        if type(error).__name__ != "PanicException":
            raise
        return _complain("interrupted", INTERRUPTED)


def _explained(error: Exception) -> int:
    from hydro1d.errors import Hydro1dError

    if os.environ.get("HYDRO1D_DEBUG"):
        raise error
    if isinstance(error, Hydro1dError):
        return _complain(str(error), error.exit_code)
    if isinstance(error, OSError):
        name = f"{error.filename}: " if error.filename else ""
        return _complain(f"{name}{error.strerror or error}", FILE_PROBLEM)
    text = f"{type(error).__name__}: {error}"
    return _complain(f"an error in hydro1d itself, please report it (HYDRO1D_DEBUG=1 shows where): {text}", FAILED)


def _dispatch(arguments: list[str]) -> int:
    if arguments and arguments[0] in COMMANDS:
        return _execute(arguments[0], arguments[1:])
    if arguments and arguments[0] in ("-h", "--help", "help"):
        print(_overview())
        return DONE
    if arguments and arguments[0] in ("-V", "--version"):
        from hydro1d import __version__

        print(f"{PROGRAM} {__version__}")
        return DONE
    if not arguments:
        print(_overview(), file=sys.stderr)
        return USAGE
    return _unknown(arguments[0])


def _execute(name: str, arguments: list[str]) -> int:
    import argparse
    import atexit
    import gc
    import signal
    import warnings

    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # numpy starts a pool for matrices, of which there are none here
    # pydantic would look through every installed package for plugins of its own, which a deck has no use for.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    # What is left at the end goes with the process: Python need not look through it for garbage, which takes long.
    atexit.register(gc.freeze)
    # Nor a hundred times while modules are imported, whose objects all stay.
    thresholds = gc.get_threshold()
    gc.set_threshold(GARBAGE, *thresholds[1:])
    previous = _interrupt_on_sigterm()
    try:
        module = _module(name)
        parser = argparse.ArgumentParser(f"{PROGRAM} {name}", description=COMMANDS[name], allow_abbrev=False)
        module.add_arguments(parser)
        options = parser.parse_args(arguments)
        with warnings.catch_warnings():
            if not sys.warnoptions:
                warnings.simplefilter("ignore")  # a library's remarks to programmers are not for standard error
            return int(module.run(options) or DONE)
    finally:
        gc.set_threshold(*thresholds)
        if previous is not None:
            signal.signal(signal.SIGTERM, previous)


def _unknown(name: str) -> int:
    from difflib import get_close_matches

    near = get_close_matches(name, COMMANDS, 1)
    hint = f" (did you mean {near[0]}?)" if near else ""
    return _complain(f"there is no command {name[:100]!r}{hint}; there are {', '.join(COMMANDS)}", USAGE)


def _module(name: str) -> Any:
    import importlib

    return importlib.import_module(f"{__name__}.{name}")


def _overview() -> str:
    width = max(map(len, COMMANDS)) + 2
    rows = [f"  {name:<{width}}{text}" for name, text in COMMANDS.items()]
    return "\n".join(
        [
            f"usage: {PROGRAM} COMMAND … ({PROGRAM} COMMAND --help says more)",
            "",
            "A 1-D Lagrangian shock code for cellular materials under impact and blast.",
            "",
            "commands:",
            *rows,
            "",
            "exit codes: 0 done; 1 a verification failed; 2 bad deck or usage; 3 the calculation broke down;",
            "            4 a file problem; 130 interrupted",
        ]
    )


def _complain(text: str, code: int) -> int:
    import contextlib

    with contextlib.suppress(OSError):  # nobody may be listening
        print(f"{PROGRAM}: {_showable(text)}", file=sys.stderr)
    return code


def _showable(text: str) -> str:
    """The text without characters that a terminal would act upon."""
    return "".join(part if part.isprintable() or part == "\n" else "\ufffd" for part in text)


def _flushed(code: int) -> int:
    """Flush standard output here, where a closed pipe or a full disk can still be answered."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        return _silenced(code)
    except OSError as error:
        _silenced()
        return _complain(f"standard output: {error.strerror or error}", FILE_PROBLEM)
    except ValueError:
        pass  # closed already
    return code


def _silenced(code: int = DONE) -> int:
    """The reader of standard output has had enough (``hydro1d laws | head``): stop without a word."""
    import contextlib

    with contextlib.suppress(OSError, ValueError, AttributeError):  # a captured stream has no file
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return code


def _interrupt_on_sigterm() -> Any:
    """Let SIGTERM do what Ctrl-C does. Returns the handler to restore, or None outside the main thread."""
    import signal
    import threading

    if threading.current_thread() is not threading.main_thread():
        return None

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    return signal.signal(signal.SIGTERM, interrupt) or signal.SIG_DFL
