"""One version, wherever it is stated."""

from __future__ import annotations

import re
from pathlib import Path

import hydro1d

ROOT = Path(__file__).parents[2]


def test_the_citation_names_this_version():
    assert f"\nversion: {hydro1d.__version__}\n" in (ROOT / "CITATION.cff").read_text()


def test_the_changelog_begins_with_what_is_not_released_or_with_this_version():
    first = re.search(r"^## \[(.*)\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert first and first[1] == ("Unreleased" if "dev" in hydro1d.__version__ else hydro1d.__version__)
