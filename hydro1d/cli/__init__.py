"""The command line. Each subcommand is a module of this package: HELP, add_arguments(parser), run(args) -> int | None.

A new subcommand is a new file. Nothing heavy may be imported at the top of such a module: `hydro1d --help` reads HELP
of all of them.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib
import os
import signal
import sys
import threading
import warnings
from collections.abc import Sequence
from types import ModuleType
from typing import Any

PROGRAM = "hydro1d"
DONE, FAILED, USAGE, BROKEN_DOWN, FILE_PROBLEM, INTERRUPTED = 0, 1, 2, 3, 4, 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; what goes wrong is said in one block on standard error."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # whatever the terminal's encoding, σ is no error
    previous = _interrupt_on_sigterm()
    try:
        code = _guarded(arguments)
        return _flushed(code)
    finally:
        if previous is not None:
            signal.signal(signal.SIGTERM, previous)


def commands() -> list[str]:
    """Names of the subcommands: the modules of this package."""
    files = (name for folder in __path__ for name in os.listdir(folder))
    return sorted({name[:-3] for name in files if name.endswith(".py") and not name.startswith(("_", "."))})


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
    names = commands()
    if arguments and arguments[0] in names:
        module = _module(arguments[0])
        parser = argparse.ArgumentParser(f"{PROGRAM} {arguments[0]}", description=module.HELP, allow_abbrev=False)
        module.add_arguments(parser)
        options = parser.parse_args(arguments[1:])
        with warnings.catch_warnings():
            if not sys.warnoptions:
                warnings.simplefilter("ignore")  # a library's remarks to programmers are not for standard error
            return int(module.run(options) or DONE)
    if arguments and arguments[0] in ("-h", "--help", "help"):
        print(_overview(names))
        return DONE
    if arguments and arguments[0] in ("-V", "--version"):
        from hydro1d import __version__

        print(f"{PROGRAM} {__version__}")
        return DONE
    if not arguments:
        print(_overview(names), file=sys.stderr)
        return USAGE
    return _unknown(arguments[0], names)


def _unknown(name: str, names: list[str]) -> int:
    from difflib import get_close_matches

    near = get_close_matches(name, names, 1)
    hint = f" (did you mean {near[0]}?)" if near else ""
    return _complain(f"there is no command {name[:100]!r}{hint}; there are {', '.join(names)}", USAGE)


def _module(name: str) -> Any:
    module: ModuleType = importlib.import_module(f"{__name__}.{name}")
    return module


def _overview(names: list[str]) -> str:
    rows = [f"  {name:<{max(map(len, names)) + 2}}{_help_of(name)}" for name in names]
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


def _help_of(name: str) -> str:
    try:
        return str(_module(name).HELP)
    except Exception as error:  # one command that cannot be imported must not hide the others
        return f"(not available: {error})"


def _complain(text: str, code: int) -> int:
    with contextlib.suppress(OSError):  # nobody may be listening
        print(f"{PROGRAM}: {_showable(text)}", file=sys.stderr)
    return code


def _showable(text: str) -> str:
    """The text without characters that a terminal would act upon."""
    return "".join(part if part.isprintable() or part == "\n" else "\N{REPLACEMENT CHARACTER}" for part in text)


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
    with contextlib.suppress(OSError, ValueError, AttributeError):  # a captured stream has no file
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return code


def _interrupt_on_sigterm() -> Any:
    """Let SIGTERM do what Ctrl-C does. Returns the handler to restore, or None outside the main thread."""
    if threading.current_thread() is not threading.main_thread():
        return None

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    return signal.signal(signal.SIGTERM, interrupt) or signal.SIG_DFL
