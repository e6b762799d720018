"""Bad decks: every mistake is named, with its place, its value and what is allowed."""

import math
import re
import tomllib

import pytest
from pydantic import ValidationError
from sample_decks import BOUNDARIES, LAWS, MAIN, PULSES, data

from hydro1d.deck import Layer, load_deck
from hydro1d.deck.positions import Positions
from hydro1d.errors import DeckError


def problems(deck, overrides=(), **options):
    with pytest.raises(DeckError) as error:
        load_deck(deck, overrides, **options)
    assert error.value.exit_code == 2
    return error.value.problems


def answered(deck):
    """What is wrong with a deck; nothing, if it is valid."""
    try:
        load_deck(deck)
    except DeckError as error:
        assert error.exit_code == 2
        return error.problems
    return []


def changed(old, new):
    assert old in MAIN
    return MAIN.replace(old, new)


CASES = [  # what is changed, into what; path, line, words of the message
    ('law = "epph"', "", "material.foam.law", 3, ["is missing", "epph-tangent"]),
    ('law = "epph"', 'law = "ephp"', "material.foam.law", 4, ["'ephp' is not a law", "did you mean eph?"]),
    ('law = "epph"', "law = 3", "material.foam.law", 4, ["3 is not a name"]),
    ('density = "51.6 kg/m^3"\n', "", "material.foam.density", 3, ["is missing", "kg/m^3 above 0"]),
    ("modulus =", "modulos =", "material.foam.modulos", 6, ["unknown key; did you mean modulus?"]),
    ('"51.6 kg/m^3"', "-51.6", "material.foam.density", 5, ["-51.6 is out of range", "above 0"]),
    ('"51.6 kg/m^3"', "0", "material.foam.density", 5, ["0 is out of range", "above 0"]),
    ('"51.6 kg/m^3"', '"51.6 kg"', "material.foam.density", 5, ["'51.6 kg' is a mass, not a density"]),
    ('"51.6 kg/m^3"', '"51.6"', "material.foam.density", 5, ["'51.6' has no unit"]),
    ('"51.6 kg/m^3"', "nan", "material.foam.density", 5, ["nan is not a finite number"]),
    ("= 0.689", "= 1.0", "material.foam.densification_strain", 8, ["1.0 is out of range", "above 0 and below 1"]),
    ("= 0.689", "= 0.0", "material.foam.densification_strain", 8, ["out of range"]),
    ('"0.8 MPa"', '"80 MPa"', "material.foam", 3, ["plateau_stress/modulus", "must be below", "densification_strain"]),
    (
        'material = "foam"',
        'material = "fam"',
        "layer[0].material",
        12,
        ["not a material", "mean foam?", "allowed: foam"],
    ),
    ('material = "foam"', "material = 3", "layer[0].material", 12, ["3 is not a material"]),
    ('material = "foam"', "", "layer[0].material", 11, ["is missing", "allowed: foam"]),
    ('material = "foam"', 'material = "foam"\nlaw = "epph"', "layer[0].law", 13, ["unknown key"]),
    ('thickness = "1 m"', "thickness = 0", "layer[0].thickness", 13, ["0 is out of range", "above 0"]),
    ('thickness = "1 m"', 'thickness = "-1 m"', "layer[0].thickness", 13, ["'-1 m' is out of range"]),
    ('thickness = "1 m"', 'thickness = "1 s"', "layer[0].thickness", 13, ["'1 s' is a time, not a length"]),
    ('thickness = "1 m"', "thickness = 1e-320", "layer[0]", 11, ["zones of no size"]),
    ("zones = 1000", "zones = 0", "layer[0].zones", 14, ["0 is out of range", "at least 1 and at most 10000000"]),
    ("zones = 1000", "zones = -1", "layer[0].zones", 14, ["-1 is out of range"]),
    ("zones = 1000", "zones = 10_000_001", "layer[0].zones", 14, ["10000001 is out of range"]),
    ("zones = 1000", "zones = " + "9" * 100, "layer[0].zones", 14, ["an integer of about 101 digits is out of range"]),
    ("zones = 1000", "zones = 1.5", "layer[0].zones", 14, ["1.5 is not an integer"]),
    ("zones = 1000", "", "layer[0].zones", 11, ["is missing", "an integer at least 1"]),
    ("zones = 1000", 'zones = 10\nvelocity = "fast"', "layer[0].velocity", 15, ["'fast' is not a number"]),
    ("[[layer]]", "[layer]", "layer", 11, ["not a list of layers", "[[layer]]"]),
    ('[right]\ntype = "wall"\n', "", "right", None, ["is missing", "wall"]),
    ('type = "pressure"', 'type = "presure"', "left.type", 17, ["did you mean pressure?"]),
    ('type = "pressure"', "", "left.type", 16, ["is missing", "pressure"]),
    ('pulse = "rectangular"', "", "left.pulse", 16, ["is missing", "triangular"]),
    ('pulse = "rectangular"', 'pulse = "rect"', "left.pulse", 18, ["'rect' is not a pulse"]),
    ('peak = "3.6 MPa"', 'peek = "3.6 MPa"', "left.peek", 19, ["unknown key; did you mean peak?"]),
    ('duration = "1.53 ms"', 'duration = "1.53 m"', "left.duration", 20, ["is a length, not a time"]),
    ('duration = "1.53 ms"', "duration = true", "left.duration", 20, ["true is not a number"]),
    ('type = "wall"', 'type = "wall"\nbonded = 1', "right.bonded", 24, ["1 is not true or false"]),
    ('end = "8 ms"', "end = 0", "time.end", 26, ["0 is out of range", "above 0"]),
    ('end = "8 ms"', "", "time.end", 25, ["is missing"]),
    ('end = "8 ms"', 'end = "8 ms"\ncfl = 1.5', "time.cfl", 27, ["1.5 is out of range", "above 0 and at most 1"]),
    ("[time]\nend", "[times]\nend", "times", 25, ["unknown key; did you mean time?"]),
    ('kind = "standard"', 'kind = "standart"', "viscosity.kind", 29, ["did you mean standard?", '"none"']),
    ("profiles = 200", "profiles = 1", "output.profiles", 32, ["1 is neither a count from 2"]),
    ("profiles = 200", "profiles = []", "output.profiles", 32, ["neither"]),
    ("profiles = 200", "profiles = true", "output.profiles", 32, ["true"]),
    ("profiles = 200", "profiles = [0, 1e-3, 1e-3]", "output.profiles", 32, ["rise strictly"]),
    ("profiles = 200", 'profiles = [0, "9 ms"]', "output.profiles[1]", 32, ["outside the run", "0 to 0.008 s"]),
    ("profiles = 200", "profiles = [-1e-3, 0]", "output.profiles[0]", 32, ["outside the run"]),
    ("profiles = 200", 'profiles = [0, "9 m"]', "output.profiles", 32, ["'9 m' is a length, not a time"]),
    ("history = 1", "history = 0", "output.history", 33, ["out of range", "at least 1"]),
    ('"0.5 m"]', '"1.5 m"]', "output.probes[1]", 34, ["outside the column", "0 to 1 m"]),
    ('"0.5 m"]', "nan]", "output.probes", 34, ["nan is not a finite number"]),
    ("cycles = 5000", "cycles = 0", "checkpoint.cycles", 37, ["out of range"]),
    ("cycles = 5000", 'cycles = 5000\nwall = "1 min"', "checkpoint", 36, ["exactly one of cycles, time, wall"]),
    ("cycles = 5000", "", "checkpoint", 36, ["exactly one"]),
    ('title = "Rectangular pulse on a foam"', "title = 3", "title", 1, ["3 is not text"]),
    ('"Rectangular pulse on a foam"', '"a\\u0000b"', "title", 1, ["control characters"]),
    ('"Rectangular pulse on a foam"', '"' + "x" * 1001 + '"', "title", 1, ["at most 1000 characters"]),
    ("[material.foam]", "material = 3\n[materials.foam]", "material", 3, ["3 is not a table"]),
    ("[time]", "[output.x]\n[time]", "output.x", 25, ["unknown key"]),
]


@pytest.mark.parametrize(("old", "new", "path", "line", "words"), CASES)
def test_each_mistake_is_named_with_its_place(old, new, path, line, words):
    found = [problem for problem in problems(changed(old, new)) if problem.path == path]
    assert len(found) == 1, problems(changed(old, new))
    assert found[0].line == line
    assert all(word in str(found[0]) for word in words), str(found[0])


def test_column_is_the_value_s_or_the_unknown_key_s():
    assert problems(changed('"51.6 kg/m^3"', "-1"))[0].column == len('density = "')
    assert problems(changed("modulus =", "  modulos ="))[-1].column == 3


def test_all_errors_at_once_in_the_order_of_the_text():
    text = changed('"51.6 kg/m^3"', "-1").replace("zones = 1000", "zones = 0").replace("end =", "ent =")
    text = text.replace('"0.5 m"]', '"1.5 m"]').replace('type = "wall"', 'type = "wal"')
    found = problems(text)
    paths = ["material.foam.density", "layer[0].zones", "right.type", "time.end", "time.ent"]
    assert [problem.path for problem in found] == paths
    assert [problem.line for problem in found] == [5, 14, 23, 25, 26]
    # The column's depth is known only when its layers are right.
    assert {p.path for p in problems(text.replace("zones = 0", "zones = 9").replace("-1", "1"))} >= {"output.probes[1]"}


def test_many_errors_are_cut_but_all_are_in_the_exception():
    text = MAIN + "".join(f"[unknown{i}]\n" for i in range(80))
    with pytest.raises(DeckError, match="and 30 more") as error:
        load_deck(text)
    assert len(error.value.problems) == 80


def test_too_many_zones_in_all():
    layer = {"material": "foam", "thickness": 1.0, "zones": 6_000_000}
    (found,) = problems(data(layer=[layer, layer]))
    assert "12000000 zones in all layers together; allowed: at most 10000000" in str(found)


def test_too_many_layers_and_materials():
    layer = {"material": "foam", "thickness": 1.0, "zones": 1}
    assert "3000 layers; allowed: at most 2000" in str(problems(data(layer=[layer] * 3000))[0])
    many = {f"m{i}": {} for i in range(3000)}
    assert "3000 materials" in str(problems(data(material=many))[0])


def test_an_empty_deck_names_all_that_is_needed():
    assert {problem.path for problem in problems("\n")} == {"material", "layer", "left", "right", "time"}


@pytest.mark.parametrize("section", ["material", "layer", "left", "right", "time", "viscosity", "output", "checkpoint"])
def test_a_value_where_a_table_belongs(section):
    for value in (3, "text", True, [], [1], math.nan):
        found = answered(data(**{section: value}))
        assert any(problem.path.startswith(section) for problem in found), f"{section} = {value}: {found}"


def test_a_material_s_name_must_be_short():
    assert "is not a name" in str(problems(data(material={"": {"law": "epph"}}))[0])


# --- every numeric key ---------------------------------------------------------------------------------------------

MEANINGFUL = {  # numeric keys for which 0 or a negative number means something
    ("layer", "velocity"): {0, -1},
    ("viscosity", "linear"): {0},
    ("viscosity", "quadratic"): {0},
    ("friedlander", "decay"): {0},
    ("piston", "velocity"): {0, -1},
}


def numeric_keys():
    """Every numeric key: who has it, its name, and how a deck with a value there is made."""
    for law, keys in LAWS.items():
        for key in keys:
            yield (
                law,
                key,
                lambda value, law=law, key=key: data(material={"foam": {"law": law, **LAWS[law], key: value}}),
            )
        if law not in ("elastic", "ideal-gas", "eph"):
            yield (
                law,
                "unloading_modulus",
                lambda value, law=law: data(material={"foam": {"law": law, **LAWS[law], "unloading_modulus": value}}),
            )
    for name, keys in BOUNDARIES.items():
        for key in keys:
            yield name, key, lambda value, name=name, key=key: data(left={"type": name, **BOUNDARIES[name], key: value})
    for name, keys in PULSES.items():
        for key in keys:
            yield (
                name,
                key,
                lambda value, name=name, key=key: data(
                    left={"type": "pressure", "pulse": name, **PULSES[name], key: value}
                ),
            )
    for section, keys in (("time", ("end", "cfl")), ("viscosity", ("linear", "quadratic")), ("output", ("history",))):
        for key in keys:
            yield (
                section,
                key,
                lambda value, section=section, key=key: data(
                    **{
                        section: {**data()[section], "profiles": 2, key: value}
                        if section == "output"
                        else {**data()[section], key: value}
                    }
                ),
            )
    for key in ("thickness", "zones", "velocity"):
        yield "layer", key, lambda value, key=key: data(layer=[{**data()["layer"][0], key: value}])
    for key in ("cycles", "time", "wall"):
        yield "checkpoint", key, lambda value, key=key: data(checkpoint={key: value})


NUMERIC = list(numeric_keys())
IDS = [f"{owner}-{key}" for owner, key, _ in NUMERIC]


NO_NUMBERS = [math.nan, math.inf, -math.inf, True, False, "", "abc", "3 A", "nan", [], {}, 10**400]


@pytest.mark.parametrize(("owner", "key", "make"), NUMERIC, ids=IDS)
def test_every_numeric_key_refuses_what_is_no_number(owner, key, make):
    for value in NO_NUMBERS:
        found = answered(make(value))
        assert any(re.search(rf"\b{key}\b", problem.path) for problem in found), f"{key} = {str(value)[:20]}: {found}"


@pytest.mark.parametrize(("owner", "key", "make"), NUMERIC, ids=IDS)
def test_zero_and_negative_are_refused_or_mean_something(owner, key, make):
    for value in (0, -1):
        deck = make(value)
        if deck.get("output", {}).get("profiles") == [0.0, 1e-3] and key == "end":
            deck["output"] = {}
        found = answered(deck)
        if value in MEANINGFUL.get((owner, key), ()):
            assert not found, f"{key} = {value}: {found}"
        else:
            assert any(key in problem.path or key in problem.message for problem in found), f"{key} = {value}: {found}"


# --- files that are no decks ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("raw", "line", "column", "words"),
    [
        (b"title = \n", 1, 9, "Invalid value"),
        (b"a = 1\nb = [1,\n", 3, 1, "end of document|Unexpected|Invalid|Unclosed"),
        (b"a = 1\nb = \xff\n", 2, 5, "0xff is not UTF-8"),
        (b"a = 1\na = 2\n", 2, 6, "overwrite"),
        (b"a = " + b"9" * 5000 + b"\n", 1, 5, "too many digits"),
        (b"a = 2026-02-31\n", None, None, "date|impossible"),
    ],
)
def test_syntax_errors_have_a_place(tmp_path, raw, line, column, words):
    path = tmp_path / "bad.toml"
    path.write_bytes(raw)
    (found,) = problems(path)
    assert re.search(words, str(found))
    if line is not None:
        assert (found.line, found.column) == (line, column)


@pytest.mark.parametrize(
    "text",
    [
        "a = " + "[" * 100_000 + "\n",
        "a = " + "{b = " * 50_000 + "\n",
        "a." * 100_000 + "b = 1\n",
        '"x y".' * 50_000 + "b = 1\n",
        "x" * 11_000_000 + "\n",
        "a = '\ud800'\n",
        "\n".join(f"key{i} = 1" for i in range(40_000)),
        "[left]\ntype = 'pressure'\npulse = 'constant'\n" + "\n".join(f"k{i} = 1" for i in range(40_000)),
    ],
    ids=["brackets", "braces", "dots", "quoted-dots", "large", "surrogate", "keys", "pulse-keys"],
)
def test_hostile_texts_are_refused_quickly(text):
    with pytest.raises(DeckError) as error:
        load_deck(text)
    assert len(str(error.value)) < 20_000


def test_large_file(tmp_path):
    (tmp_path / "large.toml").write_bytes(b"#" * 10_000_000)
    with pytest.raises(DeckError, match="larger than 512 kB"):
        load_deck(tmp_path / "large.toml")


# --- code of the user's --------------------------------------------------------------------------------------------

LAW = """\
from hydro1d.laws.base import Law
from hydro1d.components.parameters import positive

class Mine(Law):
    modulus: float = positive("Pa")

    def point(self, strain, largest, rate, energy, history):
        {body}
        return self.modulus * strain, self.modulus, self.modulus, True, history
"""


@pytest.fixture
def user_deck(tmp_path):
    def make(body="pass", spec="mine.py:Mine", text=None):
        (tmp_path / "mine.py").write_text(text if text is not None else LAW.format(body=body))
        return {"material": {"foam": {"law": spec, "density": 50.0, "modulus": 1e6}}}, tmp_path

    return make


def test_a_user_s_law(user_deck):
    material, folder = user_deck()
    deck = load_deck(data(**material), folder=folder)
    assert deck.user_code() == ("mine.py",)
    assert deck.resolved()["material"]["foam"]["law"] == "mine.py:Mine"
    assert load_deck(deck.resolved(), folder=folder) == deck


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"spec": "mine.py:Yours"}, "has no class Yours; it defines .*Mine"),
        ({"spec": "mine.py"}, "names no class"),
        ({"spec": "missing.py:Mine"}, "does not exist"),
        ({"spec": "../\0.py:Mine"}, "null|NUL|exist"),
        ({"text": "x = = 1"}, "SyntaxError"),
        ({"text": "raise RuntimeError('no')"}, "RuntimeError: no"),
        ({"text": "raise SystemExit(3)"}, "SystemExit"),
        ({"text": "class Mine: pass"}, "not a subclass"),
        ({"body": "raise KeyError('oops')"}, "oops"),
        ({"body": "return float('nan'), self.modulus, self.modulus, True, history"}, "nan|NaN|finite"),
        ({"body": "return self.modulus * strain, -1.0, -1.0, True, history"}, "modulus|stiffness|positive|tangent"),
        ({"body": "return 3.0"}, "return"),
    ],
)
def test_a_user_s_law_that_fails(user_deck, options, words):
    material, folder = user_deck(**options)
    found = problems(data(**material), folder=folder)
    assert any(re.search(words, str(problem)) for problem in found), found


def test_a_user_s_validator_may_raise_anything(user_deck):
    text = LAW.format(body="pass") + "\n    def model_post_init(self, _):\n        raise ZeroDivisionError('1/0')\n"
    material, folder = user_deck(text=text)
    assert "Mine raised ZeroDivisionError: 1/0" in str(problems(data(**material), folder=folder)[0])


def test_a_file_that_no_deck_names_is_not_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "epph.py").write_text("raise SystemExit(9)")
    (tmp_path / "sitecustomize.py").write_text("raise SystemExit(9)")
    load_deck(MAIN)


# --- what rarely happens -------------------------------------------------------------------------------------------


def test_data_nested_too_deeply():
    value: list = []
    for _ in range(5000):
        value = [value]
    with pytest.raises(DeckError, match="nested too deeply"):
        load_deck(data(output=value))


def test_a_text_that_the_scanner_of_places_gives_up_on_keeps_the_places_found_before():
    places = Positions("first = 1\ndeep = " + "[" * 3000 + "]" * 3000 + "\nlast = 2\n")
    assert places.find(("first",)) == (1, 9)
    assert places.find(("deep",), of_key=True) == (2, 1)
    assert places.find(("last",)) is None


def test_a_result_is_no_deck(tmp_path):
    (tmp_path / "run.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    with pytest.raises(DeckError, match=r"is a result \(HDF5\), not a deck"):
        load_deck(tmp_path / "run.h5")


def test_a_syntax_error_without_a_place(monkeypatch):
    def fail(_):
        raise tomllib.TOMLDecodeError("something is odd")

    monkeypatch.setattr(tomllib, "loads", fail)
    with pytest.raises(DeckError, match="not valid TOML\n  TOML: something is odd"):
        load_deck("a = 1\n")


def test_an_end_that_is_wrong_itself_is_not_judged_with_the_layers():
    found = problems(data(left={"type": "striker", "mass": -1.0, "velocity": -50.0}))
    assert [problem.path for problem in found] == ["left.mass"]


def test_a_load_that_flies_away_is_named_with_its_end():
    (found,) = problems(data(right={"type": "striker", "mass": 1.0, "velocity": 50.0}))
    assert found.path == "right" and "does not close" in found.message


def test_a_boundary_s_own_code_may_raise_anything(tmp_path):
    (tmp_path / "mine.py").write_text(
        "from hydro1d.boundaries.base import Boundary\n"
        "class Mine(Boundary):\n    def start(self, *_):\n        raise ZeroDivisionError\n"
    )
    (found,) = problems(data(left={"type": "mine.py:Mine"}), folder=tmp_path)
    assert (found.path, found.message) == ("left", "raised ZeroDivisionError: no message")


def test_many_profiles_outside_the_run_are_cut():
    found = problems(data(output={"profiles": [float(time) for time in range(1, 3000)]}))
    assert 100 < len(found) < 1000 and all("outside the run" in problem.message for problem in found)


def test_a_layer_of_a_deck_without_materials():
    found = problems(data(material={}))
    assert "the NAME of a table [material.NAME]" in str(next(one for one in found if one.path == "layer[0].material"))


@pytest.mark.parametrize(
    ("text", "words"),
    [("1 " + "m" * 99, "is too long for a number with a unit"), ("1 *", "not"), ("1 m/", "is not a unit"), ("5 %", "")],
)
def test_units_at_the_edge(text, words):
    if words:
        with pytest.raises(DeckError, match=words):
            load_deck(data(left={"type": "piston", "velocity": text}))
    else:
        assert load_deck(data(time={"end": 1e-2, "cfl": text})).time.cfl == pytest.approx(0.05)


def test_a_component_that_is_given_no_table():
    with pytest.raises(ValidationError):
        Layer.model_validate(3)


@pytest.mark.parametrize("row, says", [
    ("peak = 0,8", "a number has a decimal point, 0.8"),
    ("peak = -12,75 MPa", "a number has a decimal point, -12.75"),
    ("peak = 0.8 MPa", 'a number with a unit stands in quotes, "0.8 MPa"'),
    ("peak = 5kg/m^3", 'a number with a unit stands in quotes, "5 kg/m^3"'),
])  # fmt: skip
def test_a_slip_of_notation_is_guessed(row, says):
    with pytest.raises(DeckError, match="not valid TOML") as caught:
        load_deck(f'title = "x"\n[left]\n{row}\n')
    assert says in str(caught.value) and "line 3" in str(caught.value)


def test_a_row_that_is_simply_wrong_is_not_guessed_at():
    with pytest.raises(DeckError) as caught:
        load_deck('title = "x"\npeak = [1 2]\n')
    assert "quotes" not in str(caught.value) and "decimal" not in str(caught.value)
