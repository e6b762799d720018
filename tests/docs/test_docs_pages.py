"""Every code block of the documentation and of the README works as it stands."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from docs_blocks import Session, blocks, matches

TOP = Path(__file__).parents[2]
PAGES = [TOP / "README.md", *sorted((TOP / "docs").glob("*.md"))]


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page)], ids=lambda page: page.stem)
def test_blocks_of_a_page(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In order, in a folder of their own that holds the cases and the scripts."""
    for name in ("cases", "tools"):
        shutil.copytree(TOP / name, tmp_path / name)
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("HYDRO1D_DEBUG", raising=False)
    session = Session(page)
    for block in blocks(page):
        session.try_block(block)


def test_the_comparison_sees_a_difference() -> None:
    assert matches("a … c\n…\nend\n", "a b c\nx\ny\nend")
    assert not matches("a … c\n…\nend\n", "a b d\nx\nend")
    assert not matches("a\n", "a\nb\n")
