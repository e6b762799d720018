"""The recorded front of a foam behind a plate: it begins at the plate, not within it, and does not step back."""

import numpy as np
import pytest

import hydro1d

DECK = """
[material.plate]
law = "elastic"
density = 2700.0
modulus = "7 GPa"
[material.foam]
law = "epph-tangent"
density = 52.0
modulus = "70 MPa"
plateau_stress = "0.8 MPa"
densification_strain = 0.7
beta = 1.0
gamma = 0.8
[[layer]]
material = "plate"
thickness = "5 mm"
zones = {plate}
[[layer]]
material = "foam"
thickness = "0.2 m"
zones = {foam}
[left]
type = "{left}"
{pressed_left}
[right]
type = "{right}"
{pressed_right}
[time]
end = "1 ms"
[output]
history = 20
"""
PULSE = 'pulse = "rectangular"\npeak = "2.5 MPa"\nduration = "3 ms"'


@pytest.mark.parametrize(("plate", "foam"), [(5, 100), (10, 200)])
def test_a_front_behind_a_plate_starts_at_the_plate(plate, foam):
    deck = DECK.format(plate=plate, foam=foam, left="pressure", pressed_left=PULSE, right="wall", pressed_right="")
    history = hydro1d.run(hydro1d.load_deck(deck)).history
    front = history["front_position"][np.isfinite(history["front_position"])]
    size = 0.2 / foam
    assert 0.005 <= front[0] < 0.005 + 4 * size  # seen when its first zone counts as crushed, three zones thick
    assert np.diff(front).min() > -0.01 * size and 0.06 < front[-1] < 0.07


@pytest.mark.parametrize(("plate", "foam"), [(5, 100), (10, 200)])
def test_a_front_that_runs_to_a_plate_stops_at_it(plate, foam):
    deck = DECK.format(plate=plate, foam=foam, left="wall", pressed_left="", right="pressure", pressed_right=PULSE)
    deck = deck.replace('end = "1 ms"', 'end = "3 ms"')
    history = hydro1d.run(hydro1d.load_deck(deck)).history
    front = history["distal_front_position"][np.isfinite(history["distal_front_position"])]
    size = 0.2 / foam
    assert 0.205 - 4 * size < front[0] <= 0.205
    assert np.diff(front).max() < 0.25 * size  # its window meets other zones
