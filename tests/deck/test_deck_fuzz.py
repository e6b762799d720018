"""Any text and any data is a deck or a DeckError, soon; what fails is shrunk to the smallest that does."""

import copy
import time

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sample_decks import LAWS, MAIN, data, ends

from hydro1d.deck import Deck, load_deck
from hydro1d.errors import DeckError

MAX_SECONDS = 10.0  # seconds
FLOATS = [0.0, -0.0, 1e308, -1e308, 1e-308, 5e-324, float("nan"), float("inf"), float("-inf")]
ODD = [
    *FLOATS,
    0,
    -1,
    10**400,
    2**63,
    True,
    "",
    "nan",
    "1e400 m",
    "\x00",
    "é",
    "🦀 m",
    "x" * 10_000,
    [],
    {},
    [[]],
    [[1, 2]],
]
TOKENS = [
    "nan",
    "inf",
    "1e308",
    "-1e-308",
    "9" * 5000,
    '"1 m"',
    '"🦀"',
    "[[",
    "]]",
    "[",
    "]",
    "{",
    "}",
    "=",
    "\n",
    "'''",
    '"""',
    "\\",
    ".",
]

texts = st.text(max_size=200)
mutations = st.lists(
    st.tuples(st.integers(0, len(MAIN)), st.integers(0, 30), st.sampled_from(TOKENS) | st.text(max_size=10)), max_size=6
)
plain = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20) | st.sampled_from(ODD),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=10), inner, max_size=4),
    max_leaves=12,
)


def check(source, overrides=()):
    started = time.perf_counter()
    try:
        assert isinstance(load_deck(source, overrides), Deck)
    except DeckError as error:
        assert error.problems or str(error)
        assert len(str(error)) < 100_000
        assert all(problem.path and problem.message for problem in error.problems)
    assert time.perf_counter() - started < MAX_SECONDS


@st.composite
def mutated_texts(draw):
    text = MAIN
    for start, length, new in draw(mutations):
        text = text[:start] + new + text[start + length :]
    return text + "\n"


def tables(value):
    """Every table and list within a deck's data."""
    if isinstance(value, dict | list):
        yield value
        for item in value.values() if isinstance(value, dict) else value:
            yield from tables(item)


@st.composite
def mutated_data(draw):
    end = draw(st.sampled_from(ends()))
    deck = load_deck(data(draw(st.sampled_from(sorted(LAWS))), left=end)).resolved()
    for _ in range(draw(st.integers(1, 4))):
        table = draw(st.sampled_from(list(tables(deck))))
        if not table:
            continue
        key = draw(st.sampled_from(list(table) if isinstance(table, dict) else list(range(len(table)))))
        action = draw(st.sampled_from(["odd", "any", "delete", "rename"]))
        if action == "odd":
            table[key] = copy.deepcopy(draw(st.sampled_from(ODD)))
        elif action == "any":
            table[key] = copy.deepcopy(draw(plain))
        elif action == "delete":
            del table[key]
        elif isinstance(table, dict):
            table[draw(st.text(max_size=12))] = table.pop(key)
    return deck


quick = settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))


@quick
@given(texts)
def test_any_text(text):
    check(text + "\n")


@quick
@given(mutated_texts())
def test_mutated_text(text):
    check(text)


@quick
@given(mutated_data())
def test_mutated_data(deck):
    check(deck)


@quick
@given(st.dictionaries(st.sampled_from(["title", "material", "layer", "left", "right", "time", "output"]), plain))
def test_any_data(deck):
    check(deck)


@quick
@given(
    st.lists(
        st.text(max_size=40) | mutations.map(lambda many: "layer[0].zones=" + "".join(m[2] for m in many)), max_size=3
    )
)
def test_any_override(overrides):
    check(MAIN, overrides)


@settings(max_examples=50, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.binary(max_size=200))
def test_any_bytes(tmp_path, raw):
    (tmp_path / "deck.toml").write_bytes(raw)
    check(tmp_path / "deck.toml")
