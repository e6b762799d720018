"""``hydro1d completion``: let the shell complete commands and options."""

from __future__ import annotations

import argparse
from typing import NamedTuple

from hydro1d.cli import _common

SHELLS = ("bash", "zsh", "fish")


class Option(NamedTuple):
    """What a shell can offer: the words, their explanation, values if there are only a few."""

    words: tuple[str, ...]
    help: str
    choices: tuple[str, ...]
    takes_value: bool = False


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
    print({"bash": _bash, "zsh": _zsh, "fish": _fish}[args.shell](grammar()), end="")


def grammar() -> dict[str, tuple[str, list[Option]]]:
    """Explanation and options of every command, read off its argparse parser; "laws plot" is a command of two words."""
    from hydro1d import cli
    from hydro1d.cli.laws import ACTIONS

    modules = {name: (name, text) for name, text in cli.COMMANDS.items()}
    modules |= {f"laws {action}": (module, "") for action, module in ACTIONS.items()}
    found = {}
    for name, (module, text) in modules.items():
        try:
            parser = argparse.ArgumentParser(add_help=True)
            cli._module(module).add_arguments(parser)
        except Exception:  # a command whose extra is not installed is left out
            continue
        found[name] = (text, [_option(action) for action in parser._actions])
    found.get("new", ("", []))[1].append(Option((), "", _cases()))
    found.get("plot", ("", []))[1].append(Option((), "", _kinds()))
    found.get("laws", ("", []))[1].append(Option((), "", (*ACTIONS, *_components())))
    return found


def _option(action: argparse.Action) -> Option:
    choices = tuple(str(choice) for choice in action.choices) if action.choices else ()
    text = action.help if action.help and action.help != argparse.SUPPRESS else ""
    return Option(tuple(action.option_strings), text.replace("%%", "%"), choices, action.nargs != 0)


def _cases() -> tuple[str, ...]:
    from hydro1d.cli.new import CASES

    return tuple(CASES)


def _kinds() -> tuple[str, ...]:
    from hydro1d.cli.plot import KINDS

    return tuple(KINDS)


def _components() -> tuple[str, ...]:
    from hydro1d.cli.laws import KINDS
    from hydro1d.components.plugins import builtin_names

    return tuple(dict.fromkeys(name for kind in KINDS for name in builtin_names(kind)))


def _of_one_word(commands: dict[str, tuple[str, list[Option]]]) -> list[str]:
    return [name for name in commands if " " not in name]


def _of_two_words(commands: dict[str, tuple[str, list[Option]]]) -> list[str]:
    return [f"'{name}'" for name in commands if " " in name]


def _words(options: list[Option]) -> str:
    """Options, and the words that may stand by themselves."""
    return " ".join(word for option in options for word in (option.words or option.choices))


def _bash(commands: dict[str, tuple[str, list[Option]]]) -> str:
    cases = "\n".join(f"        '{name}') words=\"{_words(options)}\" ;;" for name, (_, options) in commands.items())
    return f"""# bash completion for hydro1d
_hydro1d() {{
    local word="${{COMP_WORDS[COMP_CWORD]}}" command="${{COMP_WORDS[1]}}" words=""
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "{" ".join(_of_one_word(commands))}" -- "$word"))
        return
    fi
    if [ "$COMP_CWORD" -gt 2 ]; then
        case "$command ${{COMP_WORDS[2]}}" in
            {"|".join(_of_two_words(commands))}) command="$command ${{COMP_WORDS[2]}}" ;;
        esac
    fi
    case "$command" in
{cases}
    esac
    COMPREPLY=($(compgen -W "$words" -- "$word") $(compgen -f -- "$word"))
}}
complete -o filenames -F _hydro1d hydro1d
"""


def _zsh(commands: dict[str, tuple[str, list[Option]]]) -> str:
    listed = "\n".join(f"        '{name}:{_quoted(commands[name][0])}'" for name in _of_one_word(commands))
    cases = "\n".join(
        f"        '{name}') compadd -- {_words(options)}; _files ;;" for name, (_, options) in commands.items()
    )
    return f"""#compdef hydro1d
_hydro1d() {{
    local -a commands
    commands=(
{listed}
    )
    if (( CURRENT == 2 )); then
        _describe 'command' commands
        return
    fi
    local command="$words[2]"
    if (( CURRENT > 3 )); then
        case "$words[2] $words[3]" in
            {"|".join(_of_two_words(commands))}) command="$words[2] $words[3]" ;;
        esac
    fi
    case "$command" in
{cases}
    esac
}}
if [[ "$funcstack[1]" == _hydro1d ]]; then  # loaded from $fpath by the first completion, which is still waiting
    _hydro1d "$@"
else
    compdef _hydro1d hydro1d
fi
"""


_FISH = """# fish completion for hydro1d
function __hydro1d_in
    set -l words (commandline -opc)
    set -l name "$words[2]"
    contains -- "$words[2..3]" {two}; and set name "$words[2..3]"
    test "$name" = "$argv"
end"""


def _fish(commands: dict[str, tuple[str, list[Option]]]) -> str:
    lines = [_FISH.format(two=" ".join(_of_two_words(commands)))]
    for name in _of_one_word(commands):
        text = _quoted(commands[name][0])
        lines.append(f"complete -c hydro1d -n __fish_use_subcommand -f -a {name} -d '{text}'")
    for name, (_, options) in commands.items():
        for option in options:
            given = [f"-l {word[2:]}" if word.startswith("--") else f"-s {word[1:]}" for word in option.words]
            values = [f"-a '{' '.join(option.choices)}'"] if option.choices else []
            values += ["-x" if option.choices else "-r"] if option.words and option.takes_value else []
            if given or values:
                about = f"-d '{_quoted(option.help)}'" if option.help else ""
                where = f"-n '__hydro1d_in {name}'"
                lines.append(" ".join(filter(None, ["complete -c hydro1d", where, *given, *values, about])))
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    """Text within single quotes of any of the shells."""
    return text.replace("'", "’").replace("\\", "")
