"""Paths of fronts from the measure in the history: they do not go back, and they know where they met."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

import hydro1d
from hydro1d.analysis.fronts import front_arrival, front_path
from hydro1d.sweep import parse_quantity

sys.path.insert(0, str(Path(__file__).parents[1] / "plot"))
from synthetic import made_run

CASES = Path(__file__).parents[2] / "cases"
TEMPLATES = Path(hydro1d.__file__).parent / "templates"


@pytest.fixture(scope="module")
def pulse():
    deck = hydro1d.load_deck(CASES / "pulse_epph_tangent.toml", ["layer[0].zones=100"])
    return deck, hydro1d.run(deck)


@pytest.fixture(scope="module")
def blast():
    fewer = ["layer[1].zones=60", "layer[2].zones=40"]
    return hydro1d.run(hydro1d.load_deck(TEMPLATES / "blast.toml", fewer))


def test_a_measure_that_wavers_makes_no_front_that_goes_back(pulse):
    _, run = pulse
    for name, sign in (("front_position", 1.0), ("distal_front_position", -1.0)):
        measured = run.history[name]
        assert (sign * np.diff(measured) < -1e-4).any()  # the two fronts are within each other's window at last
        path = front_path(run, name)
        known = np.isfinite(path)
        assert (sign * np.diff(path[known]) >= 0.0).all()
        assert known.sum() >= 0.98 * np.isfinite(measured).sum()
        assert np.abs(path - measured)[known].max() < 0.03  # three zones


def test_a_measure_in_a_plate_or_beyond_what_is_crushed_is_no_front():
    run = made_run()
    path = run.history["front_position"].copy()
    path[200] = 0.95
    run.history._arrays["front_position"] = path
    assert np.isnan(front_path(run, "front_position")[200])
    assert np.isfinite(front_path(run, "front_position")[201:]).all()


def test_behind_a_plate_and_through_two_layers(blast):
    path, time = front_path(blast, "front_position"), blast.history["time"]
    assert np.nanmin(path) > 0.002  # the plate is no foam
    for layer, (low, high) in {1: (0.002, 0.062), 2: (0.062, 0.102)}.items():
        inside = path[(path > low) & (path < high)]
        assert len(inside) > 20, layer
        assert np.ptp(inside) > 0.4 * (high - low)
    seen = np.isfinite(path) & (time > 0.2e-3) & (time < 0.4e-3)
    rows = np.flatnonzero((blast.time > 0.2e-3) & (blast.time < 0.4e-3))
    for row in rows:  # the half level of the strain is at most some zones off
        half = blast["zone_coordinate"][2 + int(np.argmin(blast["largest_strain"][row][2:62] > 0.4))]
        assert np.interp(blast.time[row], time[seen], path[seen]) == pytest.approx(half, abs=0.003)


def test_every_place_is_crushed_at_some_time_by_one_of_the_fronts(pulse):
    deck, run = pulse
    crushed = parse_quantity("crushed_time").take(run, deck)
    meeting = np.nanmax(front_path(run, "front_position"))
    for place in np.linspace(0.02, 0.98, 25):
        times = [
            parse_quantity(f"{name}({place})").take(run, deck) for name in ("front_arrival", "distal_front_arrival")
        ]
        first = parse_quantity(f"crushed_time({place} m)").take(run, deck)
        assert first == np.nanmin(times) <= crushed
        assert math.isnan(times[0]) == (place > meeting + 0.01) or abs(place - meeting) < 0.01
        row = int(np.argmax(run["largest_strain"][:, round(place * 100 - 0.5)] > 0.689))
        slow = 5e-4  # in which the far front, 35 m/s, passes two zones
        assert run.time[row - 1] - slow < first < run.time[row] + slow


def test_a_front_alone_arrives_at_the_very_end():
    run = made_run()
    run.history._arrays["distal_front_position"] = np.full(400, np.nan)
    left, path = run.history["uncrushed_fraction"].copy(), run.history["front_position"].copy()
    left[-5:], path[-5:] = 0.0, np.nan
    run.history._arrays |= {"uncrushed_fraction": left, "front_position": path}
    crushed = float(run.history["time"][-5])
    assert front_arrival(run, "front_position", 1.0) == pytest.approx(crushed)
    assert 3.9e-3 < front_arrival(run, "front_position", 0.9) < crushed
    assert math.isnan(front_arrival(run, "distal_front_position", 0.9))
