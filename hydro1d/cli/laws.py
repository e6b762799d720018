"""``hydro1d laws``: what can stand in a deck."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from hydro1d.errors import DeckError

if TYPE_CHECKING:
    from hydro1d.components.parameters import Component

ACTIONS = {"plot": "_laws_plot", "fit": "_laws_fit"}
KINDS = {"law": "law = ", "boundary": "type = ", "pulse": "pulse = "}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d laws``."""
    parser.add_argument(
        "name", metavar="NAME", nargs="?",
        help='a law, boundary or pulse, or "file.py:Class"; or plot DECK, fit CURVE.csv (laws plot --help says more)',
    )  # fmt: skip
    parser.add_argument("rest", nargs=argparse.REMAINDER, help=argparse.SUPPRESS)


def run(args: argparse.Namespace) -> None:
    """Print the list, or one entry; or plot or fit a law."""
    if args.name in ACTIONS:
        _act(args.name, args.rest)
        return
    if args.rest:
        raise DeckError(f"laws shows one thing at a time, not {args.rest[0][:80]!r} as well")
    print("\n".join(_overview() if args.name is None else _entry(args.name)))


def _act(name: str, arguments: list[str]) -> None:
    """``laws plot`` and ``laws fit`` have options of their own."""
    import importlib

    module = importlib.import_module(f"hydro1d.cli.{ACTIONS[name]}")
    parser = argparse.ArgumentParser(f"hydro1d laws {name}", description=module.HELP, allow_abbrev=False)
    module.add_arguments(parser)
    module.run(parser.parse_args(arguments))


def _overview() -> list[str]:
    from hydro1d.components.plugins import available

    lines = []
    for kind, key in KINDS.items():
        lines.append(f"{kind} ({key}…)")
        for name, load in sorted(available(kind).items()):
            try:
                text = first_line(load())
            except Exception as error:  # someone else's entry point
                text = f"(cannot be loaded: {error})"
            lines.append(f"  {name:<14}{text}")
        lines.append("")
    return [*lines, "hydro1d laws NAME shows the keys of one."]


def first_line(cls: type[Component]) -> str:
    """The first line of a component's description."""
    return description(cls)[0]


def description(cls: type[Component]) -> list[str]:
    """The lines of a component's docstring."""
    import inspect

    return (inspect.getdoc(cls) or "").split("\n")


def _entry(name: str) -> list[str]:
    found = _classes(name)
    lines = []
    for kind, cls in found:
        lines += [f'{kind}: {KINDS[kind]}"{name}"', "", *description(cls), "", "keys:"]
        lines += [*keys(cls), ""]
    return lines[:-1]


def _classes(name: str) -> list[tuple[str, type[Component]]]:
    """A name may stand for several things ("table" is a law and a pulse)."""
    from pathlib import Path

    from hydro1d.components.plugins import available, find
    from hydro1d.deck.messages import suggestion

    if ".py" in name:
        for kind in KINDS:
            try:
                return [(kind, find(kind, name, Path.cwd()))]
            except ValueError as error:
                reason = error
                if kind == "law" and "subclass" not in str(error):
                    break
        raise DeckError(str(reason))
    found = [(kind, available(kind)[name]()) for kind in KINDS if name in available(kind)]
    if not found:
        names = sorted({word for kind in KINDS for word in available(kind)})
        raise DeckError(f"nothing is called {name[:100]!r}{suggestion(name, names)}; there are {', '.join(names)}")
    return found


def keys(cls: type[Component]) -> list[str]:
    """One line for each key: name, what it is, what is allowed, the default."""
    from hydro1d.deck.messages import allowed

    lines = []
    for name, field in cls.model_fields.items():
        if name == "pulse":
            lines.append("  pulse                 a pulse; its keys stand beside (hydro1d laws lists the pulses)")
            continue
        default = "required" if field.is_required() else f"default {_default(field.default)}"
        text = "; ".join(part for part in (field.description, allowed(field), default) if part)
        lines.append(f"  {name:<22}{text}")
    return lines or ["  none"]


def _default(value: object) -> str:
    if value is None:
        return "none"
    return str(value).lower() if isinstance(value, bool) else str(value)
