"""Every code block of the documentation and of the README works as it stands."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from docs_blocks import Session, blocks, matches, run

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


def test_the_readme_shows_what_its_first_command_prints(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """All of its lines; numbers may differ by what another machine's rounding makes of them, times and imbalance freely."""
    shutil.copytree(TOP / "cases", tmp_path / "cases")
    monkeypatch.chdir(tmp_path)
    text = (TOP / "README.md").read_text(encoding="utf-8")
    commands = re.findall(r"^    (python3 -m venv .*)$", text, re.MULTILINE)
    install, program = (part.split(".venv/bin/")[1] for part in commands[0].split(" && ")[1:])
    assert install == "pip install .", "a newcomer needs no tests"
    assert "-e '.[test]'" in commands[1] and len(commands) == 2
    shown = re.search(r"^    Rectangular.*?(?=\n\n)", text, re.MULTILINE | re.DOTALL)[0]
    code, said = run(program)
    assert code == 0
    assert alike(shown.replace("    ", ""), said.rstrip("\n"))
    assert not alike(shown.replace("    ", "").replace("column: fully", "column: not"), said.rstrip("\n"))
    assert not alike(shown.replace("    ", "").replace("1.951", "1.7"), said.rstrip("\n"))


def alike(shown: str, said: str) -> bool:
    """Whether two texts differ in nothing but the last digits of numbers, wall times and imbalances."""
    shown, said = (re.sub(r"in \S+ \S+; energy error \S+", "in …; energy error …", text) for text in (shown, said))
    number = r"\d+(?:\.\d+)?(?![\w-])"
    pairs = zip(re.findall(number, shown), re.findall(number, said), strict=False)
    same = all(float(one) == pytest.approx(float(other), rel=0.02) for one, other in pairs)
    return same and re.sub(number, "#", shown) == re.sub(number, "#", said)


def test_the_comparison_sees_a_difference() -> None:
    assert matches("a … c\n…\nend\n", "a b c\nx\ny\nend")
    assert not matches("a … c\n…\nend\n", "a b d\nx\nend")
    assert not matches("a\n", "a\nb\n")
