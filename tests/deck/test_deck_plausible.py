"""Notes on numbers that lack a unit, it seems; and none where everything is plausible."""

from __future__ import annotations

from pathlib import Path

import pytest

from hydro1d.cli import main
from hydro1d.cli.new import CASES
from hydro1d.components import tables
from hydro1d.deck import load_deck

ROOT = Path(__file__).parents[2]
SHIPPED = [path for path in sorted((ROOT / "cases").rglob("*.toml")) if "[[layer]]" in path.read_text()]
FOAM = """
[material.foam]
law = "table"
density = "51.6 kg/m^3"
modulus = "22 MPa"
curve = [[0.04, "0.82 MPa"], [0.65, "1.2 MPa"], [0.86, "5 MPa"]]
[[layer]]
material = "foam"
thickness = "50 mm"
zones = 10
[left]
type = "pressure"
pulse = "rectangular"
peak = "3 MPa"
duration = "1 ms"
[right]
type = "wall"
[time]
end = "1 ms"
"""


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_decks_that_come_with_hydro1d_are_plausible(path):
    assert load_deck(path).notes == ()


@pytest.mark.parametrize("case", CASES)
def test_decks_to_start_from_are_plausible(case, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", case]) == 0
    (path,) = tmp_path.glob("*.toml")
    assert load_deck(path).notes == ()


@pytest.mark.parametrize("override, says", [
    ("left.peak=3", 'left.peak = 3 is 3 Pa: a number without a unit is SI; "3 MPa"'),
    ("material.foam.modulus=22e6", ""),
    ('material.foam={law="eph",density=50,modulus=70,yield_stress=0.8,hardening_modulus=1}',
     "material.foam.modulus = 70 is 70 Pa, material.foam.yield_stress = 0.8 is 0.8 Pa"),
    ("material.foam.curve=[[0.04, 820], [0.65, 900]]", "the end of material.foam.curve is 900 Pa"),
    ("material.foam.density=0.0516", '"0.0516 g/cm^3"'),
    ("material.foam.density=51600", '"51600 g/m^3"'),
    ("layer[0].thickness=500", '"500 mm"'),
    ("layer[0].velocity=-50000", '"-50000 mm/s"'),
    ("time.end=8", '"8 ms"'),
    ("left.duration=1.53", '"1.53 ms"'),
    ("left={type='piston',velocity=0.0}", ""),
    ('left.peak="3 Pa"', ""),
    ("left.peak=3e6", ""),
    ("left.peak=250", ""),
    ('layer[0].thickness="2 km"', ""),
])  # fmt: skip
def test_a_plain_number_of_the_wrong_order_is_noted(override, says):
    notes = load_deck(FOAM, [override, "material.foam.tension=true"]).notes
    assert len(notes) == bool(says)
    if says:
        assert "is a unit missing?" in notes[0] and says in notes[0]


def test_decks_without_dimensions_are_left_alone():
    gas = '{law="ideal-gas",density=1,gamma=1.4,pressure=1}'
    solid = '{law="elastic",density=1,modulus=1}'
    for material in (gas, solid):
        deck = load_deck(FOAM, [f"material.foam={material}", "left.peak=2", "layer[0].thickness=200", "time.end=50"])
        assert deck.notes == ()


def test_a_light_gas_is_no_solid_without_a_unit():
    hydrogen = 'material.foam={law="ideal-gas",density=0.09,gamma=1.4,pressure=101325}'
    assert load_deck(FOAM, [hydrogen]).notes == ()


@pytest.mark.parametrize("head, noted", [("", True), ("strain,stress\n", True), ("strain,stress [MPa]\n", False)])
def test_a_curve_file_without_a_unit_that_looks_like_mpa_is_noted(tmp_path, head, noted):
    (tmp_path / "curve.csv").write_text(head + "0.04,0.82\n0.65,1.2\n0.86,5\n")
    modulus = "'22 MPa'" if not noted else "100"
    deck = load_deck(FOAM, ["material.foam.curve=curve.csv", f"material.foam.modulus={modulus}"], folder=tmp_path)
    assert bool(deck.notes) == noted
    assert not noted or "the end of material.foam.curve is 5 Pa" in deck.notes[0]


def test_a_curve_file_that_changes_between_two_looks_is_no_matter(tmp_path, monkeypatch):
    real, looks = tables.read_rows, []

    def read_rows(*arguments):
        looks.append(arguments)
        if len(looks) > 1:
            raise tables.TableError("curve.csv cannot be read")
        return real(*arguments)

    monkeypatch.setattr(tables, "read_rows", read_rows)
    (tmp_path / "curve.csv").write_text("0.04,0.82\n0.65,1.2\n0.86,5\n")
    deck = load_deck(FOAM, ["material.foam.curve=curve.csv", "material.foam.modulus=100"], folder=tmp_path)
    assert len(looks) == 2 and "curve" not in "".join(deck.notes)


def test_many_are_told_in_one_line():
    material = 'material.foam={law="eph",density=0.05,modulus=7e5,yield_stress=8,hardening_modulus=1}'
    (note,) = load_deck(FOAM, [material, "left.peak=3", "time.end=8"]).notes
    assert note.count(" is ") == 4 and "and 2 more" in note and "\n" not in note


def test_check_and_run_say_it_and_quiet_does_not(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("deck.toml").write_text(FOAM.replace('"3 MPa"', "3"))
    assert main(["check", "deck.toml"]) == 0
    assert "note: is a unit missing? left.peak = 3 is 3 Pa" in capsys.readouterr().out
    assert main(["run", "deck.toml"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("note: is a unit missing? left.peak") and err == ""
    assert main(["run", "deck.toml", "-q"]) == 0
    assert capsys.readouterr() == ("", "")
