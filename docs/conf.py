"""Sphinx: python -m sphinx -W -q -b html docs OUT. Pages are MyST Markdown; tutorials are notebooks, run by the build.

Formulas are drawn by MathJax, whose one file is part of what is built: pages show them without a network. The reference
of names is made from the docstrings.
"""

import os
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_ext"))

import mathjax  # noqa: E402 (its files alone, from the package django-static-mathjax)
import matplotlib  # noqa: E402

import hydro1d  # noqa: E402

matplotlib.use("agg")

project = "hydro1d"
author = "The hydro1d developers"
copyright = author
version = release = hydro1d.__version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "api", "architecture", "reference"]
exclude_patterns = ["_build", "jupyter_execute", "**.ipynb_checkpoints"]

html_theme = "furo"
html_title = f"hydro1d {release}"
html_static_path = ["_static", str(Path(mathjax.__file__).parent / "static" / "mathjax" / "es5" / "tex-svg.js")]
html_css_files = ["hydro1d.css"]
html_show_copyright = False
html_theme_options = {"navigation_with_keys": True}

myst_enable_extensions = ["amsmath", "dollarmath", "deflist", "colon_fence"]
myst_heading_anchors = 3
myst_dmath_double_inline = True
mathjax_path = "tex-svg.js"
mathjax3_config = {"svg": {"displayAlign": "left", "displayIndent": "1.5em"}}

autodoc_default_options = {
    "members": True,
    "exclude-members": "model_config,model_post_init,set",
}  # `set` is of matplotlib's figures
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
default_role = "code"  # a `name` in a docstring
python_maximum_signature_line_length = 88
toc_object_entries_show_parents = "hide"

nb_execution_mode = "auto"
nb_execution_raise_on_error = True
nb_execution_in_temp = True
nb_execution_timeout = 180
nb_merge_streams = True

os.environ["COLUMNS"] = "88"  # the width of the help texts


def drop_missing_pages(app, docname, source):
    """A table of contents may name a page that a tool writes (verification results): left out until it is there."""
    lines, inside = [], False
    for line in source[0].split("\n"):
        inside = (inside or "{toctree}" in line) and line.strip() != "```"
        entry = line.strip() if inside and line.strip() and line[0] not in ":`" else None
        base = HERE / Path(docname).parent
        if entry is None or any((base / f"{entry}{ending}").exists() for ending in (".md", ".ipynb")):
            lines.append(line)
        else:
            app.env.note_reread()  # it may be there at the next build
    source[0] = "\n".join(lines)


def setup(app):
    """Hooks of this configuration."""
    app.connect("source-read", drop_missing_pages)
