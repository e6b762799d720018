"""The JSON schema accepts what the deck accepts."""

import json
import tomllib

import pytest
from sample_decks import LAWS, MAIN, data, ends

from hydro1d.components.plugins import builtin_names
from hydro1d.deck import deck_schema


@pytest.fixture(scope="module")
def schema():
    return deck_schema()


@pytest.fixture(scope="module")
def validator(schema):
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def test_it_names_everything(schema):
    text = json.dumps(schema)
    for kind in ("law", "boundary", "pulse"):
        assert all(f'"const": "{name}"' in text for name in builtin_names(kind))
    density = schema["properties"]["material"]["additionalProperties"]["anyOf"][0]["properties"]["density"]
    assert density["x-unit"] == "kg/m^3"
    assert {"type": "number", "exclusiveMinimum": 0.0} in density["anyOf"]
    assert "density" in density["description"]


def test_an_entry_point_that_fails_does_not_hide_the_rest(monkeypatch):
    from hydro1d.deck import schema as module

    def broken():
        raise ImportError

    real = module.available
    monkeypatch.setattr(module, "available", lambda kind: {**real(kind), "broken": broken})
    assert "broken" not in json.dumps(deck_schema())


def test_good_decks_pass(validator):
    for deck in [tomllib.loads(MAIN), *(data(law) for law in LAWS), *(data(left=end) for end in ends())]:
        assert not list(validator.iter_errors(deck))


@pytest.mark.parametrize(
    "change",
    [
        {"titel": "x"},
        {"layer": []},
        {"layer": [{"material": "foam", "thickness": 0, "zones": 10}]},
        {"layer": [{"material": "foam", "thickness": 1, "zones": 0}]},
        {"left": {"type": "pressure", "pulse": "rectangular", "peek": 3}},
        {"left": {"type": "nothing"}},
        {"time": {"end": -1}},
        {"time": {}},
        {"material": {"foam": {"law": "ephp"}}},
        {"material": {"foam": {"law": "epph", "density": 1}}},
        {"viscosity": {"kind": "standart"}},
    ],
)
def test_bad_decks_fail(validator, change):
    assert list(validator.iter_errors(data(**change)))


def test_components_of_the_user_s_own_pass(validator):
    deck = data(material={"foam": {"law": "my.py:Foam", "anything": 1}}, left={"type": "my.py:Boundary", "x": 1})
    assert not list(validator.iter_errors(deck))
