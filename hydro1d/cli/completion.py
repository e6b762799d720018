"""``hydro1d completion``: let the shell complete commands and options.

The script only tells the shell to ask hydro1d itself, through argcomplete: what it offers is read off the parsers of the
commands at that moment.
"""

import argparse
import os
from collections.abc import Callable, Iterable

from hydro1d.cli import _common

SHELLS = ("bash", "zsh", "fish")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d completion``."""
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = (
        "bash:  hydro1d completion bash > ~/.local/share/bash-completion/completions/hydro1d\n"
        "zsh:   hydro1d completion zsh > a folder of $fpath, as _hydro1d\n"
        "fish:  hydro1d completion fish > ~/.config/fish/completions/hydro1d.fish"
    )
    parser.add_argument("shell", choices=SHELLS, type=_common.one_of(SHELLS))


def run(args: argparse.Namespace) -> None:
    """Print the script."""
    import argcomplete

    # fish would ask the hydro1d on the path; the one that is typed may be another, or the only one.
    asked = "env (commandline -opc)[1]" if args.shell == "fish" else None
    print(argcomplete.shellcode(["hydro1d"], shell=args.shell, argcomplete_script=asked))


def answer() -> None:
    """Tell the shell, whose question is in the environment, what can stand at the cursor; then end the process."""
    import argcomplete

    argcomplete.autocomplete(grammar(os.environ.get("COMP_LINE", "").split()))


def grammar(line: list[str]) -> argparse.ArgumentParser:
    """One parser of all commands; one that cannot be imported, because an extra is not installed, is left out.

    ``laws plot`` and ``laws fit`` have parsers of their own, which take the place of the one of ``laws`` in their lines.
    """
    from hydro1d import cli

    whole = argparse.ArgumentParser(cli.PROGRAM, allow_abbrev=False)
    commands = whole.add_subparsers()
    for name, text in cli.COMMANDS.items():
        try:
            module = cli._module(name)
        except Exception:
            continue
        parser = commands.add_parser(name, help=text, allow_abbrev=False)
        if name == "laws" and len(line) > 2 and line[2] in module.ACTIONS:
            parser = parser.add_subparsers().add_parser(line[2], allow_abbrev=False)
            module = cli._module(module.ACTIONS[line[2]])
        module.add_arguments(parser)
        if parser.prog in _FIRST_WORDS:
            first = parser._get_positional_actions()[0]
            first.completer = _words_or_files(_FIRST_WORDS[parser.prog])  # type: ignore[attr-defined]
    return whole


def _words_or_files(words: Callable[[], Iterable[str]]) -> Callable[..., list[str]]:
    """A completer for argcomplete."""
    from argcomplete.completers import FilesCompleter

    return lambda prefix, **_: [*words(), *FilesCompleter()(prefix)]


def _cases() -> Iterable[str]:
    from hydro1d.cli.new import CASES

    return CASES


def _kinds() -> Iterable[str]:
    from hydro1d.cli.plot import KINDS

    return KINDS


def _laws() -> Iterable[str]:
    from hydro1d.cli.laws import ACTIONS, KINDS
    from hydro1d.components.plugins import builtin_names

    return dict.fromkeys([*ACTIONS, *(name for kind in KINDS for name in builtin_names(kind))])


# What can stand as the first word of a command that its parser does not know: it takes files as well.
_FIRST_WORDS: dict[str, Callable[[], Iterable[str]]] = {
    "hydro1d laws": _laws,
    "hydro1d new": _cases,
    "hydro1d plot": _kinds,
}
