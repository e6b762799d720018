"""The reference of names: what autodoc says, without what would not help a reader."""

import re

from pydantic import BaseModel

from hydro1d.components.plugins import builtin_names, find

# What numpy's names for types are spelled out as, and the names.
SPELLED = {
    r"(?:~?\w+\.)*_?Buffer \| .*?_NestedSequence\[[^\[\]]*\]": "ArrayLike",
    r"((?:~?\w+\.)*ndarray)\[tuple\[.*?\], (?:~?\w+\.)*dtype\[[^\[\]]*\]\]": r"\1",
}


def short_signature(app, what, name, thing, options, signature, returns):
    """Keys alone for a model: their checks are told by its pages. None for a figure: matplotlib's are many."""
    if what != "class":
        return named(signature), named(returns)
    if issubclass(thing, BaseModel):
        keys = [key if field.is_required() else f"{key}=…" for key, field in thing.model_fields.items()]
        return f"({', '.join(['*', *keys] if keys else [])})", returns
    return ("", returns) if thing.__name__ == "Picture" else (named(signature), returns)


def named(text):
    """A signature or what is returned, with numpy's types by their names."""
    for spelled, name in SPELLED.items():
        text = re.sub(spelled, name, text) if text else text
    return text


def without_aliases(app, what, name, thing, options, lines):
    """Python's own words about a field of a named tuple say nothing."""
    if lines and lines[0].startswith("Alias for field number"):
        lines.clear()


def setup(app):
    """Register the hooks.

    All laws are loaded first: autodoc gives `Foam` the annotations that type checkers alone see, and a law derived after that
    would take them for keys.
    """
    for name in builtin_names("law"):
        find("law", name)
    app.connect("autodoc-process-signature", short_signature)
    app.connect("autodoc-process-docstring", without_aliases)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
