"""Good decks: what is read, how it is resolved, how it is built in Python."""

import copy
import json
from pathlib import Path

import pytest
from sample_decks import LAWS, MAIN, data, ends

from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.striker import Striker
from hydro1d.boundaries.wall import Wall
from hydro1d.components.plugins import builtin_names
from hydro1d.deck import Checkpoint, Deck, Layer, Output, Time, load_deck
from hydro1d.errors import DeckError, FileProblem
from hydro1d.laws.elastic import Elastic
from hydro1d.laws.epph import EPPH
from hydro1d.loads.rectangular import Rectangular
from hydro1d.scheme.viscosity import Viscosity

KEYS = {
    "density": 51.6,
    "modulus": 22e6,
    "plateau_stress": 0.8e6,
    "densification_strain": 0.689,
    "shock_slope": 0.00105,
}


def pulse():
    return Pressure(pulse=Rectangular(peak="3.6 MPa", duration="1.53 ms"))


def test_main_deck_in_si(tmp_path):
    path = tmp_path / "main.toml"
    path.write_text(MAIN)
    deck = load_deck(path)
    assert deck.title == "Rectangular pulse on a foam"
    assert deck.layers == (Layer(law=EPPH(**KEYS), thickness=1.0, zones=1000, material="foam"),)
    assert deck.left == pulse()
    assert deck.right == Wall()
    assert deck.time == Time(end=8e-3)
    assert deck.viscosity == Viscosity()
    assert deck.checkpoint == Checkpoint(cycles=5000)
    assert deck.output.probes == (0.25, 0.5)
    assert len(deck.output.profiles) == 200
    assert deck.output.profiles[0] == 0.0
    assert deck.output.profiles[-1] == deck.time.end
    assert all(b > a for a, b in zip(deck.output.profiles, deck.output.profiles[1:], strict=False))
    assert deck.text == MAIN
    assert deck.path == path
    assert deck.user_code() == ()


def test_text_path_and_data_are_the_same(tmp_path):
    path = tmp_path / "main.toml"
    path.write_text("\ufeff" + MAIN.replace("\n", "\r\n"), encoding="utf-8")
    assert load_deck(path) == load_deck(str(path)) == load_deck(MAIN)
    assert hash(load_deck(path)) == hash(load_deck(MAIN))


def test_the_parts_with_defaults_can_be_left_out():
    text = MAIN[: MAIN.index("[viscosity]")].replace('title = "Rectangular pulse on a foam"\n', "")
    deck = load_deck(text)
    assert (deck.title, deck.viscosity, deck.checkpoint) == ("", Viscosity(), None)
    assert len(deck.output.profiles) == 100


def test_built_in_python():
    built = Deck(
        title="Rectangular pulse on a foam",
        layers=[Layer(law=EPPH(**KEYS), thickness="1 m", zones=1000, material="foam")],
        left=pulse(),
        right=Wall(),
        end="8 ms",
        output=Output(profiles=200, history=1, probes=["25 cm", 0.5]),
        checkpoint=Checkpoint(cycles=5000),
    )
    assert built == load_deck(MAIN)
    assert built.text == ""


def test_python_objects_name_themselves():
    law = EPPH(**KEYS)
    layers = [Layer(law=law, thickness=1, zones=10), Layer(law=Elastic(density=1, modulus=1e6), thickness=1, zones=5)]
    deck = Deck(layers=layers, left=Wall(), right=Wall(), end=1.0, cfl=0.5)
    assert [layer.material for layer in deck.layers] == ["epph", "elastic"]
    assert deck.time == Time(end=1.0, cfl=0.5)
    assert load_deck(deck.resolved()) == deck


def test_two_laws_of_one_name_are_kept_apart():
    layers = [Layer(law=Elastic(density=1, modulus=m), thickness=1, zones=5, material="a") for m in (1e6, 2e6, 1e6)]
    deck = Deck(layers=layers, left=Wall(), right=Wall(), end=1.0)
    materials = deck.resolved()["material"]
    assert [materials[row["material"]]["modulus"] for row in deck.resolved()["layer"]] == [1e6, 2e6, 1e6]


def test_a_class_from_anywhere_names_its_file():
    class Mine(Elastic):
        pass

    deck = Deck(
        layers=[Layer(law=Mine(density=1, modulus=1e6), thickness=1, zones=5)], left=Wall(), right=Wall(), end=1
    )
    assert deck.resolved()["material"].popitem()[1]["law"].endswith("Mine")


def test_python_gets_the_same_checks():
    layer = Layer(law=EPPH(**KEYS), thickness=1.0, zones=10)
    with pytest.raises(DeckError) as error:
        Deck(layers=[layer], left=Wall(), end=-1.0, title="a\nb")
    assert {problem.path for problem in error.value.problems} == {"right", "time.end", "title"}
    with pytest.raises(DeckError, match=r"output\.probes\[0\]: 2 m lies outside the column; allowed: 0 to 1 m"):
        Deck(layers=[layer], left=Wall(), right=Wall(), end=1, output=Output(probes=[2.0]))
    with pytest.raises(DeckError, match=r"layer: there is none"):
        Deck(layers=[], left=Wall(), right=Wall(), end=1)
    with pytest.raises(DeckError, match="does not close on this end"):
        Deck(layers=[layer], left=Wall(), right=Striker(mass=1.0, velocity=5.0), end=1)


@pytest.mark.parametrize("law", LAWS)
def test_resolved_deck_loads_again(law):
    deck = load_deck(data(law))
    again = load_deck(json.loads(json.dumps(deck.resolved(), allow_nan=False)))
    assert again == deck
    assert again.resolved() == deck.resolved()


@pytest.mark.parametrize("end", ends(), ids=lambda end: end.get("pulse", end["type"]))
def test_every_boundary_on_either_end(end):
    mirrored = copy.deepcopy(end)
    if "velocity" in end:
        mirrored["velocity"] = -end["velocity"]
    deck = load_deck(data(left=end, right=mirrored))
    assert load_deck(deck.resolved()) == deck
    assert deck.left.peak() >= 0.0


def test_samples_cover_everything_built_in():
    assert set(LAWS) == set(builtin_names("law"))
    assert {end["type"] for end in ends()} == set(builtin_names("boundary"))
    assert {end["pulse"] for end in ends() if "pulse" in end} == set(builtin_names("pulse"))


def test_files_are_relative_to_the_deck(tmp_path, monkeypatch):
    (tmp_path / "deck").mkdir()
    (tmp_path / "deck" / "curve.csv").write_text("strain,stress (MPa)\n0.05,0.8\n0.6,1\n0.8,10\n")
    text = MAIN.replace('law = "epph"', 'law = "table"\ncurve = "curve.csv"')
    text = "\n".join(line for line in text.split("\n") if not line.startswith(("plateau", "densif", "shock")))
    (tmp_path / "deck" / "main.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    assert load_deck("deck/main.toml").layers[0].law.curve[1] == (0.6, 1e6)
    assert load_deck(text, folder=Path("deck")).layers[0].law.curve[1] == (0.6, 1e6)
    with pytest.raises(DeckError, match=r"curve\.csv cannot be read"):
        load_deck(text)


def test_profiles_as_times():
    assert load_deck(MAIN.replace("= 200", '= [0, "1 ms", 0.008]')).output.profiles == (0.0, 1e-3, 8e-3)


@pytest.mark.parametrize("name", ["missing.toml", ".", "a\0b", "x" * 5000, ""])
def test_no_file(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileProblem, match="cannot be read"):
        load_deck(name)


def test_a_sweep_is_no_deck():
    with pytest.raises(DeckError, match="the deck is a sweep, not a deck; hydro1d sweep takes it"):
        load_deck('deck = "pulse.toml"\nquantities = ["peak_support_stress"]\n')
