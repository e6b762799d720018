"""--set: values in place of the deck's."""

import pytest
from sample_decks import MAIN

from hydro1d.deck import load_deck
from hydro1d.deck.messages import Finding
from hydro1d.deck.overrides import parse_override
from hydro1d.errors import DeckError


@pytest.mark.parametrize(
    ("text", "path", "value"),
    [
        ("layer.0.zones=2000", ("layer", "0", "zones"), 2000),
        ("layer[0].zones=2000", ("layer", 0, "zones"), 2000),
        ("left.peak=3 MPa", ("left", "peak"), "3 MPa"),
        ('left.peak="3 MPa"', ("left", "peak"), "3 MPa"),
        ("time.end = 1e-3", ("time", "end"), 1e-3),
        ("title=", ("title",), ""),
        ("title=a = b", ("title",), "a = b"),
        ("title=a\nb", ("title",), "a\nb"),
        ("title='a'\nx=1", ("title",), "'a'\nx=1"),
        ("output.profiles=[0, 1e-3]", ("output", "profiles"), [0, 1e-3]),
        ("right.bonded=false", ("right", "bonded"), False),
        ('material."my foam".density=1', ("material", "my foam", "density"), 1),
        ("material.'a.b'.density=1", ("material", "a.b", "density"), 1),
        ("a[0][1]=" + "[" * 10_000, ("a", 0, 1), "[" * 10_000),
    ],
)
def test_path_and_value(text, path, value):
    override = parse_override(text)
    assert (override.path, override.value) == (path, value)


@pytest.mark.parametrize(
    "text", ["", "=", "=1", "foo", "a..b=1", "a.=1", ".a=1", "[0]=1", "a[x]=1", "a]=1", "." * 99, "a." * 99]
)
def test_what_is_no_override(text):
    assert isinstance(parse_override(text), Finding)
    with pytest.raises(DeckError, match="is not path=value; allowed: for example"):
        load_deck(MAIN, [text])


def test_values_are_put_in_place():
    deck = load_deck(
        MAIN, ["layer.0.zones=20", "layer[0].velocity=-5 m/s", "viscosity.kind=none", "title=new", "time.cfl=0.5"]
    )
    assert (deck.layers[0].zones, deck.layers[0].velocity) == (20, -5.0)
    assert (deck.viscosity.kind, deck.title, deck.time.cfl) == ("none", "new", 0.5)
    assert deck.text == MAIN


def test_a_missing_table_is_made():
    text = MAIN.replace("[checkpoint]\ncycles = 5000\n", "")
    assert load_deck(text, ["checkpoint.time=1 ms"]).checkpoint.time == 1e-3


def test_later_overrides_win():
    assert load_deck(MAIN, ["layer.0.zones=20", "layer[0].zones=30"]).layers[0].zones == 30


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("layer.0.zones=0", "layer[0].zones (--set layer.0.zones=0): 0 is out of range"),
        ("layer.0.zoness=1", "layer[0].zoness (--set layer.0.zoness=1): unknown key; did you mean zones?"),
        ("layer[1].zones=1", "there is no layer[1]; allowed: layer[0] to layer[0]"),
        ("layer.x.zones=1", "there is no layer.x"),
        ("title.x=1", "title is a value, not a table"),
        ("lefft.peak=1", "lefft (--set lefft.peak=1): unknown key; did you mean left?"),
        ("left=3", "left (--set left=3): 3 is not a table"),
        ("title=a\x00", "title (--set title=a"),
        ("title=\udcff", "title (--set title="),
    ],
)
def test_errors_point_to_the_override(override, words):
    with pytest.raises(DeckError) as error:
        load_deck(MAIN, [override])
    assert words in str(error.value)
    assert all(problem.line is None for problem in error.value.problems)


def test_a_list_without_rows():
    text = MAIN.replace('probes = ["0.25 m", "0.5 m"]', "probes = []")
    with pytest.raises(DeckError, match="no row at all"):
        load_deck(text, ["output.probes.0=1"])


def test_errors_of_text_and_overrides_come_together():
    with pytest.raises(DeckError) as error:
        load_deck(MAIN.replace("history = 1", "history = 0"), ["layer.0.zones=0", "foo"])
    assert len(error.value.problems) == 3
