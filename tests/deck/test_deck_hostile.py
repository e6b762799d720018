"""A hundred thousand hostile decks: none a traceback, none slow, each refusal names the key, its value and what is allowed.

The long form: ``python -m pytest -n 0 -m slow -s tests/deck/test_deck_hostile.py``.
"""

from __future__ import annotations

import re
import resource
import time
from collections import Counter
from pathlib import Path

import pytest
from hostile_decks import Hostile, hostile

from hydro1d.components.units import shorten
from hydro1d.deck import Deck, load_deck
from hydro1d.errors import DeckError, Problem

MAX_SECONDS = 10.0  # seconds of processor time for one deck
MAX_MEMORY = 512 << 20  # bytes that the process may grow by at its worst moment
MAX_TEXT = 100_000  # characters of a message
# A message without a list of what is allowed says in its own words what the rule is, or what went wrong.
RULE = re.compile(
    "must|needs|never|neither|rise|steeper|raised|exactly|not UTF-8|no row|does not|cannot|is not|no size|="
)


def complain(problem: Problem) -> str:
    """What a message lacks, if anything."""
    if not (problem.path and problem.message):
        return "names no key"
    if problem.path in ("TOML", "deck"):
        return ""
    if not problem.allowed and not RULE.search(problem.message) and "unknown key" not in problem.message:
        return "does not say what is allowed"
    value, text = problem.value, str(problem)
    forms = [shorten(value).strip("'\"")[:15], f"{value:g}" if isinstance(value, float) else ""]
    named = not isinstance(value, str | int | float) or any(form in text for form in forms if form) or not forms[0]
    # A quantity that was not finite, a text with a unit and a file's name are shown as what they were understood to be.
    return "" if named or re.search("finite|neither|exist", text) else "does not name the value"


def judge(deck: Hostile, path: Path) -> str:
    """How the deck ends, or what is wrong with that."""
    source = deck.source
    if isinstance(source, bytes):
        path.write_bytes(source)
        source = path
    try:
        return "valid" if isinstance(load_deck(source, deck.overrides), Deck) else "not a deck"
    except DeckError as error:
        if len(str(error)) > MAX_TEXT or not str(error):
            return f"a message of {len(str(error))} characters"
        lacking = [f"{found}: {problem}" for problem in error.problems if (found := complain(problem))]
        return lacking[0] if lacking else "refused"
    except Exception as error:
        return f"raised {type(error).__name__}: {error}"


def campaign(seeds: range, path: Path) -> Counter:
    """Count how hostile decks end; fail if one is answered badly."""
    words: Counter = Counter()
    bad, slowest = [], (0.0, -1)
    for seed in seeds:
        deck = hostile(seed)
        begun = time.process_time()
        word = judge(deck, path)
        slowest = max(slowest, (time.process_time() - begun, seed))
        words[word if word in ("valid", "refused") else "bad"] += 1
        if word not in ("valid", "refused"):
            bad.append((seed, deck.kind, word[:300]))
    print(dict(words), f"slowest {slowest[0]:.2f} s, number {slowest[1]}")
    for seed, kind, word in bad:
        print(f"number {seed}, {kind}: {word}")
    assert not bad, bad[:20]
    assert slowest[0] < MAX_SECONDS, slowest
    return words


def peak() -> int:
    """The most memory that this process has held, bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


@pytest.mark.parametrize("count", [1_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_hostile_decks(tmp_path, count):
    before = peak()
    words = campaign(range(count), tmp_path / "deck.toml")
    grown = peak() - before
    print(f"memory grew by {grown / 2**20:.0f} MB at most")
    assert words["valid"] > count // 100 and words["refused"] > count // 2
    assert grown < MAX_MEMORY
