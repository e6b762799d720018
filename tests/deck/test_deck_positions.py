"""Line and column of keys and values, whatever way TOML is written."""

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hydro1d.deck.positions import Positions

TEXT = '''\
# comment with = and [brackets]
title = "a # no comment" # a comment
"quoted key" = 1
'literal key'.inner = 2
a.b.c = 1.5e3
text = """
[not.a.table]
x = "1" \\""" still
"""
raw = \'\'\'
[no]\'\'\'\'
date = 2020-01-01 12:00:00

[table]
  inline = { x = 1, "y z" = [1, 2, { deep = true }] }
  array = [
    [0.0, "1 MPa"], # row
    [1.0, 2.0],
  ]

[[row]]
k = 1
[[row]]
k = 2
[row.sub]
m = 3
[[row.list]]
n = 4
[[row.list]]
n = 5
[ spaced . header ]
z = 1
'''


def where(path, **options):
    return Positions(TEXT).find(path, **options)


@pytest.mark.parametrize(
    ("path", "value", "key"),
    [
        (("title",), (2, 9), (2, 1)),
        (("quoted key",), (3, 16), (3, 1)),
        (("literal key", "inner"), (4, 23), (4, 1)),
        (("a", "b", "c"), (5, 9), (5, 1)),
        (("a", "b"), (5, 1), (5, 1)),
        (("text",), (6, 8), (6, 1)),
        (("raw",), (10, 7), (10, 1)),
        (("date",), (12, 8), (12, 1)),
        (("table",), (14, 1), (14, 1)),
        (("table", "inline", "x"), (15, 18), (15, 14)),
        (("table", "inline", "y z", 1), (15, 33), (15, 33)),
        (("table", "inline", "y z", 2, "deep"), (15, 45), (15, 38)),
        (("table", "array"), (16, 11), (16, 3)),
        (("table", "array", 0, 1), (17, 11), (17, 11)),
        (("table", "array", 1), (18, 5), (18, 5)),
        (("row",), (21, 1), (21, 1)),
        (("row", 0), (21, 1), (21, 1)),
        (("row", 1, "k"), (24, 5), (24, 1)),
        (("row", 1, "sub", "m"), (26, 5), (26, 1)),
        (("row", 1, "list", 1, "n"), (30, 5), (30, 1)),
        (("spaced", "header", "z"), (32, 5), (32, 1)),
        (("row", 1, "missing"), (23, 1), (23, 1)),
    ],
)
def test_places(path, value, key):
    tomllib.loads(TEXT)
    assert where(path) == value
    assert where(path, of_key=True) == key


def test_what_is_nowhere():
    assert where(("missing",)) is None
    assert where(()) is None


def paths(data, path=()):
    yield path
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield from paths(value, (*path, key))


def toml(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f'"{key}" = {toml(item)}' for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value).lower()


words = st.text(st.characters(codec="ascii", categories=["L", "N"], include_characters=" .=[]{}#'"), max_size=8)
values = st.recursive(
    st.integers() | st.booleans() | words,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(words, inner, max_size=3),
    max_leaves=10,
)


@given(st.dictionaries(words, values, max_size=5))
def test_every_path_is_found(data):
    text = "".join(f'"{key}" = {toml(value)}\n' for key, value in data.items())
    assert tomllib.loads(text) == data
    positions = Positions(text)
    for path in paths(data):
        if path:
            line, column = positions.find(path)
            assert line == 1 + list(data).index(path[0])
            leaf = text.split("\n")[line - 1][column - 1 :]
            value = data
            for key in path:
                value = value[key]
            assert leaf.startswith(toml(value))
