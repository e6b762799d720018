"""Attenuated or enhanced: what a run and a deck say of it, and when it is not decided yet."""

import math
from pathlib import Path

import numpy as np
import pytest

import hydro1d
from hydro1d.analysis.arrival import arrival_of, elastic_speed, front_speed
from hydro1d.analysis.transmission import ends_of, ends_of_data, transmission_of
from hydro1d.analytic import EPPH, pressure_step
from hydro1d.cli import main

MAIN = Path(__file__).parents[2] / "cases" / "pulse_epph.toml"
DECK = MAIN.read_text().replace("zones = 1000", "zones = 50").split("[output]")[0]
WAVE = math.sqrt(51.6 / 22e6)  # s, over the metre of the deck
PISTON = ['left={type="piston", velocity=50}']
MIRRORED = ['right={type="pressure", pulse="constant", peak=3e6}', 'left={type="wall"}']
LATER = "a later time.end may change the answers"


def said(tmp_path, monkeypatch, capsys, command, *overrides):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "deck.toml").write_text(DECK)
    assert main([command, "deck.toml", *(word for text in overrides for word in ("--set", text))]) == 0
    return capsys.readouterr().out


def test_a_decided_run_says_no_more_than_before(tmp_path, monkeypatch, capsys):
    out = said(tmp_path, monkeypatch, capsys, "run")
    assert "support stress: attenuated, 0.4815 times" in out and "not over" not in out


def test_undecided_before_the_wave_has_arrived(tmp_path, monkeypatch, capsys):
    out = said(tmp_path, monkeypatch, capsys, "run", "time.end=1e-3")
    undecided = "support stress: the wave has not reached the support; attenuated or enhanced is not decided yet"
    assert f"{undecided} (applied peak 3.6 MPa)\n" in out
    assert f"not over at t = 1 ms: the pressure still acts and the column is still being crushed; {LATER}\n" in out


def test_a_transmission_that_may_change_says_so(tmp_path, monkeypatch, capsys):
    out = said(tmp_path, monkeypatch, capsys, "run", "time.end=2e-3")
    assert "support stress: attenuated so far, 0.2" in out
    assert f"not over at t = 2 ms: the column is still being crushed; {LATER}" in out


def test_what_acts_is_known_without_the_laws_of_the_deck():
    run = hydro1d.run(hydro1d.load_deck(DECK, ["time.end=1e-3"]))
    assert "the pressure still acts" in transmission_of(run).pending
    run.deck["material"]["foam"]["law"] = "mine.py:Mine"
    assert transmission_of(run).pending[0] == "the pressure still acts"
    run.deck["left"]["pulse"] = "mine.py:Pulse"
    assert transmission_of(run).pending == ("the column is still being crushed",)


def test_a_peak_that_still_rises_is_named():
    run = hydro1d.run(hydro1d.load_deck(DECK, ["time.end=1.5e-3"]))  # the foot of the wave is at the wall
    assert "the peak on the support still rises" in transmission_of(run).pending


def test_enhanced_is_decided_as_soon_as_it_is_seen():
    elastic = 'material.foam={law="elastic", density=51.6, modulus="22 MPa"}'
    deck = hydro1d.load_deck(DECK, [elastic, "left.duration=1", "time.end=2.5e-3"])
    transmission = transmission_of(hydro1d.run(deck), deck)
    assert transmission.ratio == pytest.approx(2.0, abs=0.1)  # a step that a wall reflects, and what rings
    assert (transmission.word, transmission.pending) == ("enhanced", ("the pressure still acts",))


@pytest.mark.parametrize("zones", [20, 300])
@pytest.mark.parametrize(("share", "arrived"), [(0.3, False), (0.6, False), (1.1, True)])
def test_the_precursor_of_a_wave_is_no_wave(zones, share, arrived):
    """In a column of twenty zones it runs ahead by a third of the column."""
    run = hydro1d.run(hydro1d.load_deck(DECK, [f"layer[0].zones={zones}", f"time.end={share * WAVE}"]))
    assert run.history["peak_right_stress"][-1] > 0.0
    assert (transmission_of(run).transmitted > 0.0) == arrived


def test_a_load_without_pressure(tmp_path, monkeypatch, capsys):
    out = said(tmp_path, monkeypatch, capsys, "run", *PISTON, "time.end=1e-3")
    assert "right 0 Pa; no wave has reached the right end yet" in out


@pytest.mark.parametrize(
    ("overrides", "loaded", "by_pressure"),
    [([], "left", True), (MIRRORED, "right", True), (PISTON, "left", False), ([*MIRRORED, *PISTON], "right", True)],
)
def test_the_support_is_the_same_end_with_and_without_the_code_of_the_deck(overrides, loaded, by_pressure):
    deck = hydro1d.load_deck(DECK, overrides)
    ends = ends_of(deck)
    assert ends == ends_of_data(deck.resolved())
    assert (ends.loaded, ends.by_pressure) == (loaded, by_pressure) and ends.support != loaded


def test_check_notes_that_the_wave_comes_too_late(tmp_path, monkeypatch, capsys):
    out = said(tmp_path, monkeypatch, capsys, "check", "time.end=1e-3")
    note = "note: the wave needs about 1.531 ms to reach the support (right end), which feels nothing until t = 1 ms"
    assert note in out


def test_check_notes_that_the_front_comes_too_late(tmp_path, monkeypatch, capsys):
    out = said(tmp_path, monkeypatch, capsys, "check", "time.end=3e-3")
    assert "drives a compaction front to the support (right end) in about 4.033 ms; at t = 3 ms it is under way" in out
    assert "note" not in said(tmp_path, monkeypatch, capsys, "check")


def test_the_estimate_is_that_of_the_jump_conditions():
    deck = hydro1d.load_deck(DECK)
    law, arrival = deck.layers[0].law, arrival_of(deck)
    exact = pressure_step(EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105), 3.6e6, 1.0).jumps()[-1].front_speed
    assert elastic_speed(law) == pytest.approx(1.0 / WAVE)
    assert (arrival.wave, arrival.front) == (pytest.approx(WAVE), pytest.approx(1.0 / exact, rel=1e-6))
    behind = pressure_step(EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105), 3.6e6, 1.0).states[-1]
    assert front_speed(law, 0.0, behind.velocity) == pytest.approx(exact, rel=1e-6)


def test_the_wave_arrives_when_it_is_said_to():
    run = hydro1d.run(hydro1d.load_deck(DECK, ["layer[0].zones=400", "time.end=2e-3"]))
    time, transmitted = run.history["time"], run.history["right_stress"]
    arrived = float(time[np.argmax(transmitted > 0.4e6)])
    assert arrived == pytest.approx(WAVE, rel=0.01)  # a wave of about five zones of 400


@pytest.mark.parametrize(
    "overrides",
    [
        ['right={type="transmitting"}'],
        ['right={type="free"}'],
        ["layer[0].velocity=-5"],
        ['right={type="pressure", pulse="constant", peak=1e6}'],
        ['left={type="free"}'],
    ],
)
def test_no_estimate_where_it_would_mean_nothing(overrides):
    assert arrival_of(hydro1d.load_deck(DECK, overrides)) is None


@pytest.mark.parametrize(
    "overrides", [['left.peak="0.5 MPa"'], ['left.peak="9 MPa"'], ['left={type="piston", velocity=1}']]
)
def test_no_front_where_the_load_makes_none_or_the_curve_does_not_bear_it(overrides):
    assert math.isnan(arrival_of(hydro1d.load_deck(DECK, overrides)).front)


def test_a_sweep_leaves_blank_what_is_not_decided_and_a_search_says_so(tmp_path):
    from hydro1d.sweep import Parameter, Sweep, critical, run_sweep

    ends = [Parameter(key="time.end", values=("1 ms", "7.5 ms"))]
    table = run_sweep(Sweep.of(DECK, ends, ["enhanced", "enhancement"]))
    assert np.isnan(table["enhanced"]).tolist() == [True, False] == np.isnan(table["enhancement"]).tolist()
    with pytest.raises(hydro1d.DeckError, match=r"the wave has not reached the support.*choose a later time.end"):
        critical(DECK, "left.peak", "2 MPa", "4 MPa", "enhanced", overrides=["time.end=1e-3"])
