"""Zones that opened: counted where foam without tension is at zero stress, and nowhere else."""

import numpy as np
import pytest

import hydro1d
from hydro1d.analysis.openings import find_openings

DECK = """\
[material.foam]
law = "trilinear"
density = 50
modulus = "20 MPa"
plateau_stress = "0.8 MPa"
densification_strain = 0.7
locking_modulus = "40 MPa"
[[layer]]
material = "foam"
thickness = 1
zones = 40
[left]
type = "pressure"
pulse = "rectangular"
peak = "3 MPa"
duration = "0.5 ms"
[right]
type = "wall"
[time]
end = "3 ms"
"""


@pytest.fixture(scope="module")
def run():
    return hydro1d.run(DECK)


def test_what_opened(run):
    deck = hydro1d.load_deck(DECK)
    found = find_openings(run, deck)
    law = deck.layers[0].law
    by_hand = set()
    for row in range(len(run.time)):
        for zone in np.flatnonzero((run["stress"][row] == 0.0) & (run["largest_strain"][row] > 0.0)):
            largest = run["largest_strain"][row, zone]
            loaded, tangent = law.loading(largest)
            closed = largest - loaded / law.slope_below(largest, tangent)
            if closed - run["strain"][row, zone] >= 1e-3:
                by_hand.add((row, int(zone)))
    zones = {zone for _, zone in by_hand}
    assert (found.zones, found.total) == (len(zones), 40) and 0 < found.zones < 40
    assert found.first == run.time[min(row for row, _ in by_hand)] and found.first > 0.5e-3
    assert found.low == pytest.approx(min(zones) / 40) and found.high == pytest.approx((max(zones) + 1) / 40)
    assert found.still == sum(row == len(run.time) - 1 for row, _ in by_hand)
    assert found.widest == pytest.approx(1.0 - min(run["strain"][place] for place in by_hand))
    assert found.stretched == len({zone for row, zone in by_hand if run["strain"][row, zone] < 0.0})


def test_without_the_law_every_zone_at_zero_stress_counts(run):
    assert find_openings(run).zones >= find_openings(run, hydro1d.load_deck(DECK)).zones


def test_what_bears_tension_does_not_open():
    deck = hydro1d.load_deck(DECK, ["material.foam.tension=true"])
    assert find_openings(hydro1d.run(deck), deck) is None


def test_what_is_only_loaded_does_not_open():
    deck = hydro1d.load_deck(DECK, ["left.duration=1"])
    assert find_openings(hydro1d.run(deck), deck) is None
