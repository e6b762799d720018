"""The search for the value at which an outcome flips."""

import re

import pytest

from hydro1d.cli import main
from hydro1d.deck import load_deck
from hydro1d.errors import DeckError
from hydro1d.sweep import NoFlip, critical, find_flip, parse_outcome, trace
from hydro1d.sweep.base import unit_of
from hydro1d.sweep.critical import evaluations_table

DECK = """
[material.foam]
law = "rppl"
density = "51.6 kg/m^3"
plateau_stress = "0.8 MPa"
densification_strain = 0.689
stiffness = 400
[[layer]]
material = "foam"
thickness = "1 m"
zones = 50
[left]
type = "pressure"
pulse = "rectangular"
peak = "4 MPa"
duration = "1.5 ms"
[right]
type = "wall"
[time]
end = "12 ms"
"""


def test_find_flip_brackets_the_change():
    flip = find_flip(lambda x: x > 0.3, 0.0, 1.0, tolerance=1e-6)
    assert flip.value == pytest.approx(0.3, rel=1e-6)
    assert flip.monotonic and not flip.before
    assert len(flip.evaluations) < 30


def test_find_flip_sees_more_than_one_change():
    assert not find_flip(lambda x: 0.2 < x < 0.6, 0.0, 1.0, scan=11).monotonic


def test_nothing_flips():
    with pytest.raises(NoFlip, match="yes"):
        find_flip(lambda x: True, 0.0, 1.0)


def test_critical_duration_and_what_was_evaluated():
    found = critical(DECK, "left.duration", "0.8 ms", "2.5 ms", "fully_crushed", tolerance=5e-3)
    assert found.value == pytest.approx(1.49e-3, rel=0.08)  # Eq. 30
    assert found.monotonic and not found.before
    assert all(answer == (value >= found.high) for value, answer, _, _ in found.evaluations)


def test_trace_is_in_the_order_of_the_values():
    points = trace(
        DECK,
        "left.duration",
        "0.8 ms",
        "2.5 ms",
        "support_peak > 2 MPa",
        "left.peak",
        ["4 MPa", "3 MPa", "1 MPa"],
        tolerance=2e-2,
    )
    assert points[0].value < points[1].value
    assert "nothing flips" in points[2].message


@pytest.mark.parametrize(
    "text", ["enhanced ", "support_peak > 2 MPa", "uncrushed_fraction <= 0.1", "max(left_velocity) > 10"]
)
def test_outcomes(text):
    assert parse_outcome(text).holds(parse_outcome(text).bound) == ("=" in text)


@pytest.mark.parametrize(
    "text", ["enhansed", "support_peak > 2 ms", "1 > 0", "exit() > 0", "enhanced and separated", "x > y"]
)
def test_no_outcome_is_evaluated(text):
    with pytest.raises(DeckError, match="is not an outcome"):
        parse_outcome(text)


def test_outcomes_that_the_deck_cannot_show():
    with pytest.raises(DeckError, match="neither a striker"):
        critical(DECK, "left.duration", 1e-3, 2e-3, "separated")
    with pytest.raises(DeckError, match="did you mean duration"):
        critical(DECK, "left.durtion", 1e-3, 2e-3, "enhanced")
    with pytest.raises(DeckError, match="empty"):
        critical(DECK, "left.duration", 2e-3, 1e-3, "enhanced")


@pytest.mark.parametrize(
    ("key", "unit"),
    [
        ("left.duration", "s"),
        ("left.peak", "Pa"),
        ("time.end", "s"),
        ("time.cfl", ""),
        ("layer[0].thickness", "m"),
        ("layer[0].velocity", "m/s"),
        ("layer[0].zones", ""),
        ("material.foam.density", "kg/m^3"),
        ("material.foam.stiffness", ""),
        ("left", ""),
        ("nothing.at.all", ""),
    ],
)
def test_the_unit_of_a_key(key, unit):
    assert unit_of(load_deck(DECK), key) == unit


def test_a_table_of_a_search_has_units():
    found = critical(DECK, "left.duration", "0.8 ms", "2.5 ms", "fully_crushed", tolerance=0.2)
    table = evaluations_table([found], "left.duration", "fully_crushed")
    assert table.columns["left.duration"].units == "s"


def test_command_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "deck.toml").write_text(DECK)
    common = [
        "critical",
        "deck.toml",
        "--key",
        "left.duration",
        "--from",
        "0.8 ms",
        "--to",
        "2.5 ms",
        "--tolerance",
        "0.05",
    ]
    assert main([*common, "--outcome", "fully_crushed", "-o", "runs.csv"]) == 0
    said = capsys.readouterr().out
    assert re.match(
        r"fully_crushed begins at left\.duration = 1\.\d+ ms\nbetween 1\.\d+ ms and 1\.\d+ ms, \d+ runs\n", said
    )
    assert (tmp_path / "runs.csv").read_text().startswith("run,left.duration,outcome,fully_crushed,status")
    arguments = ["--outcome", "fully_crushed", "--along", "left.peak", "--values", "3 MPa:4 MPa:2", "-o", "b.csv"]
    assert main([*common, *arguments]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert rows[0].split() == ["left.peak", "left.duration"] and rows[1].split()[:2] == ["3", "MPa"]
    assert re.fullmatch(r" +4 MPa +1\.\d+ ms", rows[2])
    assert len((tmp_path / "b.boundary.csv").read_text().splitlines()) == 3
    assert main([*common[:-6], "--from", "0.1 ms", "--to", "0.2 ms", "--outcome", "fully_crushed"]) == 2
    assert "the outcome is no from 0.0001 s to 0.0002 s: nothing flips" in capsys.readouterr().err
    assert main([*common, "--outcome", "exploded"]) == 2
    assert "is not an outcome" in capsys.readouterr().err
