"""The drawing of the package is the package's, and the paths that pages name are there."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

TOP = Path(__file__).parents[2]
sys.path.insert(0, str(TOP / "docs" / "_ext"))
PAGES = [TOP / "CONTRIBUTING.md", TOP / "README.md", *sorted((TOP / "docs").glob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_paths_that_a_page_names_are_there(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    named = re.findall(r"`((?:hydro1d|tests|tools|docs|cases)/[\w./]*)`", text)
    named += re.findall(r"\]\((docs/[\w./-]+)\)", text)
    assert [path for path in named if "NAME" not in path and not (TOP / path).exists()] == []


def test_the_drawing_shows_every_room_and_its_arrows_lead_down() -> None:
    pytest.importorskip("sphinx")
    import architecture

    needs = architecture.rooms_and_needs()
    rooms = {file.parent.name for file in (TOP / "hydro1d").glob("*/__init__.py")}
    assert set(needs) == rooms | {"api"}
    assert "deck" in needs["api"] and "store" in needs["analysis"] and needs["analytic"] == set()
    level, far = architecture.floors(needs), architecture.reach(needs)
    assert all(level[name] > level[room] or room in far[name] for room, name in architecture.arrows(needs))
    figure = architecture.draw()
    assert set(needs) <= {text.get_text() for text in figure.axes[0].texts}


def test_arrows_that_follow_from_others_are_left_out() -> None:
    pytest.importorskip("sphinx")
    import architecture

    needs = {"a": {"b", "c"}, "b": {"c", "d"}, "c": set(), "d": {"b"}}
    assert set(architecture.arrows(needs)) == {("a", "b"), ("b", "c"), ("b", "d"), ("d", "b")}
    level = architecture.floors(needs)
    assert level == {"a": 0, "b": 1, "d": 1, "c": 2}
