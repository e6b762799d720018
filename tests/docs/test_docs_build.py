"""The documentation is built without a warning, and names everything that there is."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from hydro1d.cli import COMMANDS
from hydro1d.components.plugins import builtin_names

DOCS = Path(__file__).parents[2] / "docs"
PAGES = {"law": "laws.md", "boundary": "boundaries.md", "pulse": "boundaries.md"}


@pytest.mark.slow
def test_sphinx_builds_without_warnings(tmp_path: Path) -> None:
    """Notebooks and figures included."""
    pytest.importorskip("sphinx")
    pytest.importorskip("myst_nb")
    pytest.importorskip("furo")
    pytest.importorskip("mathjax")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "-d", str(tmp_path / "trees")]
    done = subprocess.run([*command, str(DOCS), str(tmp_path / "html")], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(("kind", "page"), PAGES.items())
def test_every_component_has_its_section(kind: str, page: str) -> None:
    text = (DOCS / page).read_text(encoding="utf-8")
    missing = [
        name for name in builtin_names(kind)
        if not re.search(rf"^###? `{name}`$", text, re.MULTILINE)
        or (f"{{keys}} {kind} {name}\n" not in text and name != "pressure")
    ]  # fmt: skip
    assert not missing


def test_every_command_has_its_section() -> None:
    text = (DOCS / "cli.md").read_text(encoding="utf-8")
    assert [name for name in COMMANDS if f"{{command}} {name}\n" not in text] == []


def test_links_between_pages_lead_somewhere() -> None:
    """Pages and headings: the build checks this too, where Sphinx is installed."""
    lost = []
    for page in sorted(DOCS.glob("*.md")):
        for target in re.findall(r"\]\(([\w./-]+\.(?:md|ipynb))(?:#[\w-]+)?\)", page.read_text(encoding="utf-8")):
            if not (page.parent / target).exists():
                lost.append(f"{page.name} → {target}")
    assert not lost
