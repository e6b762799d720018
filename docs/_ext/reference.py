"""Directives that read the program itself, so that the reference cannot fall behind it.

``{keys} law epph`` the keys of a law, boundary, pulse or section of a deck: unit, range, default, from the models;
``{keys} foam shared`` those that foams share.
``{command} run`` the help of a subcommand; ``{commands}`` the table of all.
``{quantities} history`` what a result holds, from the writer's own list.
``{units}`` the units that a deck may use.
``{drawing} text`` a figure: the Python code of the directive makes it; the argument says what it shows.
"""

import argparse
import hashlib
import os
from collections.abc import Iterable
from pathlib import Path

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
    from hydro1d.components.plugins import find
    from hydro1d.deck import model
    from hydro1d.scheme.viscosity import Viscosity

    if kind == "foam":
        from hydro1d import Foam

        return Foam
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
    "tension": "whether the foam bears tension",
    "negative_phase": "keep the pressure below zero after the positive phase",
    "bonded": "whether the wall holds the end in tension too",
    "kind": '`"none"` switches the viscosity off: a chain of masses and springs',
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
        from hydro1d import Foam

        kind, name, *without = self.arguments
        cls = component(kind, name)
        if kind == "law" and issubclass(cls, Foam):  # what foams share has a table of its own
            without += [key for key in Foam.model_fields if key != "density"]
        rows = key_rows(cls, without)
        return table(("key", "meaning", "value", "default"), rows) if rows else ["No keys.", ""]


class Command(MarkdownDirective):
    """The help of one subcommand."""

    required_arguments = 1

    def markdown(self) -> Iterable[str]:
        """The text of ``hydro1d NAME --help``."""
        from hydro1d import cli

        words = self.arguments
        name = f"_{words[0]}_{words[1]}" if len(words) > 1 else words[0]
        module = cli._module(name)
        about = cli.COMMANDS.get(name) or module.HELP
        parser = argparse.ArgumentParser(f"hydro1d {' '.join(words)}", description=about)
        module.add_arguments(parser)
        return ["```text", parser.format_help().rstrip(), "```", ""]


class Commands(MarkdownDirective):
    """All subcommands."""

    def markdown(self) -> Iterable[str]:
        """A table of names and what they do."""
        from hydro1d import cli

        return table(
            ("command", "does"), [(f"[`{name}`](#hydro1d-{name})", text) for name, text in cli.COMMANDS.items()]
        )


class QuantitiesOf(MarkdownDirective):
    """What a result holds."""

    required_arguments = 1

    def markdown(self) -> Iterable[str]:
        """A table of name, unit, description."""
        from hydro1d import variables
        from hydro1d.store import layout

        which = self.arguments[0]
        if which == "static":
            rows = [(f"`/{f.path}`", ", ".join(f.dimensions), f.units, f.long_name) for f in layout.STATIC.values()]
            return table(("dataset", "over", "unit", "meaning"), rows)
        found = getattr(variables, which.upper())
        if which == "history":
            found = found[1:]
        return table(("name", "unit", "meaning"), [(f"`{v.name}`", v.units, v.long_name) for v in found])


class Units(MarkdownDirective):
    """Units that a deck may use."""

    def markdown(self) -> Iterable[str]:
        """A table by dimension."""
        from hydro1d.components.unit_table import KINDS

        return table(("quantity", "for example"), [(text, units) for text, units in KINDS.values()])


class Drawing(SphinxDirective):
    """A figure made by code at build time; the last expression may be left out where pyplot has the figure."""

    required_arguments = 1
    final_argument_whitespace = True
    has_content = True

    def run(self) -> list[nodes.Node]:
        """Run the code in the documentation's folder, save what it drew, show it."""
        import figures
        from matplotlib import pyplot as plt

        code = "\n".join(self.content)
        folder = Path(self.env.doctreedir) / "drawings"
        folder.mkdir(parents=True, exist_ok=True)
        target = folder / f"{Path(self.env.docname).name}-{hashlib.sha256(code.encode()).hexdigest()[:12]}.svg"
        before = Path.cwd()
        os.chdir(self.env.srcdir)
        try:
            names = {"figures": figures, "plt": plt}
            exec(compile(code, f"{self.env.docname}:{self.lineno}", "exec"), names)
            (names.get("figure") or plt.gcf()).savefig(target, metadata={"Date": None})
        finally:
            os.chdir(before)
            plt.close("all")
        page = Path(self.env.doc2path(self.env.docname)).parent
        return [nodes.image(uri=os.path.relpath(target, page), alt=self.arguments[0], classes=["drawing"])]


def setup(app):
    """Register the directives."""
    app.add_directive("keys", Keys)
    app.add_directive("command", Command)
    app.add_directive("commands", Commands)
    app.add_directive("quantities", QuantitiesOf)
    app.add_directive("units", Units)
    app.add_directive("drawing", Drawing)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
