"""Directives that read the program itself, so that the reference cannot fall behind it.

``{keys} law epph`` the keys of a law, boundary, pulse or section of a deck: unit, range, default, from the models.
``{command} run`` the help of a subcommand; ``{commands}`` the table of all.
``{quantities} history`` what a result holds, from the writer's own list.
``{units}`` the units that a deck may use.
"""

import argparse
from collections.abc import Iterable

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

SECTIONS = {"layer": "Layer", "time": "Time", "output": "Output", "checkpoint": "Checkpoint"}


class MarkdownDirective(SphinxDirective):
    """A directive whose result is Markdown, parsed in place."""

    has_content = False
    optional_arguments = 2

    def markdown(self) -> Iterable[str]:
        """Lines of Markdown."""
        raise NotImplementedError

    def run(self) -> list[nodes.Node]:
        """Parse the lines where the directive stands."""
        lines = [line for text in self.markdown() for line in text.split("\n")]
        container = nodes.Element()
        self.state.nested_parse(StringList(lines, "generated"), self.content_offset, container)
        return list(container.children)


def component(kind: str, name: str) -> type:
    """The class of a law, boundary, pulse or section."""
    from hydro1d.deck import model
    from hydro1d.plugins import find
    from hydro1d.viscosity import Viscosity

    if kind == "section":
        return Viscosity if name == "viscosity" else getattr(model, SECTIONS[name])
    return find(kind, name)


def key_rows(cls: type, without: Iterable[str] = ()) -> list[tuple[str, str, str, str]]:
    """(key, meaning, what may stand there, default) of each field."""
    from hydro1d.deck.messages import allowed

    rows = []
    for name, field in cls.model_fields.items():
        if name in without:
            continue
        default = "required" if field.is_required() else "–" if field.default is None else default_text(field.default)
        rows.append((f"`{name}`", field.description or MEANING.get(name, ""), allowed(field), default))
    return rows


MEANING = {
    "unloading": "the path of unloading: steep line, or back along the loading curve",
    "unloading_modulus": "least slope of the unloading line, Pa; `\"rigid\"` is 100 E; default: the modulus",
    "tension": "whether the foam bears tension",
    "negative_phase": "keep the pressure below zero after the positive phase",
    "bonded": "whether the wall holds the end in tension too",
    "kind": "`\"none\"` switches the viscosity off: a chain of masses and springs",
}


def default_text(value: object) -> str:
    """A default as TOML writes it."""
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, tuple):
        return f"`{list(value)}`"
    return f'`"{value}"`' if isinstance(value, str) else f"`{value}`"


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> list[str]:
    """A Markdown table."""
    lines = [head, tuple("---" for _ in head), *rows]
    return ["| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines] + [""]


class Keys(MarkdownDirective):
    """Keys of a component."""

    required_arguments = 2
    optional_arguments = 8

    def markdown(self) -> Iterable[str]:
        """The table, without the keys named after the component."""
        kind, name, *without = self.arguments
        rows = key_rows(component(kind, name), without)
        return table(("key", "meaning", "value", "default"), rows) if rows else ["No keys.", ""]


class Command(MarkdownDirective):
    """The help of one subcommand."""

    required_arguments = 1

    def markdown(self) -> Iterable[str]:
        """The text of ``hydro1d NAME --help``."""
        from hydro1d import cli

        words = self.arguments
        module = cli._module(words[0])
        parser = argparse.ArgumentParser(f"hydro1d {words[0]}", description=module.HELP)
        module.add_arguments(parser)
        if len(words) > 1:
            parser = subparser(parser, words[1])
        return ["```text", parser.format_help().rstrip(), "```", ""]


def subparser(parser: argparse.ArgumentParser, name: str) -> argparse.ArgumentParser:
    """The parser of a word such as ``plot`` in ``hydro1d laws plot``."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            return action.choices[name]
    raise ValueError(f"{parser.prog} has no subcommands")


class Commands(MarkdownDirective):
    """All subcommands."""

    def markdown(self) -> Iterable[str]:
        """A table of names and what they do."""
        from hydro1d import cli

        return table(("command", "does"), [(f"[`{n}`](#hydro1d-{n})", cli._help_of(n)) for n in cli.commands()])


class QuantitiesOf(MarkdownDirective):
    """What a result holds."""

    required_arguments = 1

    def markdown(self) -> Iterable[str]:
        """A table of name, unit, description."""
        from hydro1d import variables
        from hydro1d.store import layout

        which = self.arguments[0]
        if which in ("static", "maxima"):
            fields = {"static": layout.STATIC, "maxima": layout.MAXIMA}[which].values()
            rows = [(f"`/{f.path}`", ", ".join(f.dimensions), f.units, f.long_name) for f in fields]
            return table(("dataset", "over", "unit", "meaning"), rows)
        found = getattr(variables, which.upper())
        if which == "history":
            found = found[1:]
        return table(("name", "unit", "meaning"), [(f"`{v.name}`", v.units, v.long_name) for v in found])


class Units(MarkdownDirective):
    """Units that a deck may use."""

    def markdown(self) -> Iterable[str]:
        """A table by dimension."""
        from hydro1d.unit_table import KINDS

        return table(("quantity", "for example"), [(text, units) for text, units in KINDS.values()])


def setup(app):
    """Register the directives."""
    app.add_directive("keys", Keys)
    app.add_directive("command", Command)
    app.add_directive("commands", Commands)
    app.add_directive("quantities", QuantitiesOf)
    app.add_directive("units", Units)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
