"""Unit strings and tables."""

import contextlib
import math
import subprocess
import sys
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from hydro1d.components.parameters import Component, fraction, not_negative, pairs, positive
from hydro1d.components.tables import TableError, read_table
from hydro1d.components.unit_table import ATOMS, KINDS
from hydro1d.components.units import UnitError, convert, describe, parse_unit, shorten

PRODUCTS = [
    "kg/m^3", "g/cm^3", "g/cm**3", "kg m^-3", "m/s", "km/s", "mm/ms", "mm/us", "kg/m^2", "J/kg", "kJ/kg", "s/m", "s/km",
    "1/s", "1/ms", "m/s^2", "N/mm^2", "kN/m^2", "Pa*s", "kg/m/s", "kg/m s", "lb/ft^3", "lb/in^3", "ft/s", "in/s",
    "J/m^2", "kg*m^2/s^2", "m^2/s^2", "MPa*ms",
]  # fmt: skip


@pytest.fixture(scope="module")
def registry():
    return pytest.importorskip("pint").UnitRegistry()


@pytest.mark.parametrize("text", [*[name for name in ATOMS if name != "1"], *PRODUCTS])
def test_static_table_agrees_with_pint(registry, text):
    unit = parse_unit(text, only_common=True)
    expected = registry.parse_expression(text) if text != "%" else registry.Quantity(1.0, "percent")
    expected = registry.Quantity(1.0, "dimensionless") * expected
    factor = expected.to_base_units().magnitude
    assert unit.numerator / unit.denominator == pytest.approx(factor, rel=1e-14)
    powers = {str(key): power for key, power in expected.dimensionality.items()}
    assert unit.dimension == tuple(powers.get(base, 0) for base in ("[mass]", "[length]", "[time]"))


@pytest.mark.parametrize("kind", KINDS.values())
def test_every_example_in_a_message_is_of_its_kind(kind):
    for dimension, (phrase, examples) in KINDS.items():
        if phrase == kind[0] and any(dimension):
            assert all(parse_unit(example).dimension == dimension for example in examples.split(", "))


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("22 MPa", "Pa", 22e6),
        ("1.53 ms", "s", 0.00153),
        ("1.53ms", "s", 0.00153),
        ("-50 m/s", "m/s", -50.0),
        ("\N{MINUS SIGN}50 m/s", "m/s", -50.0),
        ("51.6 kg·m⁻³", "kg/m^3", 51.6),
        ("51.6 kg/m³", "kg/m^3", 51.6),
        ("51.6 kg m-3", "kg/m^3", 51.6),
        ("51.6 kg / m ** 3", "kg/m^3", 51.6),
        ("0.0516 g/cm3", "kg/m^3", 51.6),
        ("3 µs", "s", 3e-6),
        ("3 μs", "s", 3e-6),
        ("1e3m", "m", 1000.0),
        ("1_000 mm", "m", 1.0),
        (".5 m", "m", 0.5),
        ("5. m", "m", 5.0),
        ("  5 m  ", "m", 5.0),
        ("0 m", "m", 0.0),
        ("-0.0 km", "m", 0.0),
        ("50 %", "1", 0.5),
        ("0.689", "1", 0.689),
        ("2 torr", "Pa", 2 * 101325 / 760),
        (22, "Pa", 22.0),
        (Fraction(1, 2), "Pa", 0.5),
    ],
)
def test_values_become_si(text, unit, expected):
    result = convert(text, unit)
    assert type(result) is float
    assert result == pytest.approx(expected, rel=1e-15, abs=0.0)


@given(st.decimals(-(10**6), 10**6, places=6), st.sampled_from([("ms", "s", -3), ("MPa", "Pa", 6), ("mm", "m", -3)]))
def test_conversion_is_correctly_rounded(number, units):
    given_unit, si, power = units
    exact = Fraction(number) * Fraction(10) ** power
    assert convert(f"{number:f} {given_unit}", si) == float(exact)


@pytest.mark.parametrize(
    ("value", "unit", "words"),
    [
        ("22", "Pa", ["'22'", "has no unit"]),
        ("22 kg", "Pa", ["'22 kg'", "a mass", "not a pressure"]),
        ("22 kg/m", "Pa", ["dimension", "not a pressure"]),
        ("22 Mpa", "Pa", ["did you mean MPa"]),
        ("22 furlongfoo", "m", ["'furlongfoo' is not a unit"]),
        ("3 degC", "1", ["degC"]),
        ("3 A", "1", ["'A'"]),
        ("abc", "Pa", ["'abc'", "not a number with a unit"]),
        ("", "Pa", ["not a number"]),
        ("m", "m", ["not a number"]),
        ("nan m", "m", ["not a number"]),
        ("inf", "1", ["not a number"]),
        ("1,5 m", "m", ["'1,5 m' has a comma", "a decimal point: '1.5 m'"]),
        ("-0,689", "1", ["'-0.689'"]),
        ("1.000,5 m", "m", ["has a comma", "nothing between thousands"]),
        ("1,000,000 Pa", "Pa", ["has a comma", "nothing between thousands"]),
        ("1, m", "m", ["not a unit"]),
        ("1 m/", "m", ["not a unit"]),
        ("1 /m", "m", ["not a unit"]),
        ("1 m^2^3", "m", ["not a unit"]),
        ("1 m**9**9**9**9", "m", ["not a unit"]),
        ("1 m^999", "m", ["not a unit"]),
        ("1 m\x00", "m", ["not a unit"]),
        ("٣ m", "m", ["not a number"]),
        ("1e400 m", "m", ["too large"]),
        ("1e99999999 m", "m", ["too large"]),
        ("1e308 km", "m", ["too large"]),
        ("1e-400 m", "m", ["too small"]),
        ("1e-99999999 m", "m", ["too small"]),
        ("1 " + "m" * 10_000, "m", ["too long"]),
        ("1" * 10_000, "1", ["too long"]),
        (True, "Pa", ["true is not a number"]),
        (None, "Pa", ["None is not a number"]),
        (1j, "Pa", ["not a number"]),
        ([1], "Pa", ["[1] is not a number"]),
        ({}, "Pa", ["not a number"]),
        (math.nan, "Pa", ["nan is not a finite number"]),
        (-math.inf, "Pa", ["-inf is not a finite number"]),
        (10**400, "Pa", ["too large"]),
    ],
)
def test_what_is_no_quantity_is_refused(value, unit, words):
    with pytest.raises(UnitError) as error:
        convert(value, unit)
    assert all(word in str(error.value) for word in words), str(error.value)
    assert len(str(error.value)) < 300


@given(st.text(max_size=120), st.sampled_from(["Pa", "1", "kg/m^3"]))
def test_any_text_is_a_number_or_a_unit_error(text, unit):
    with contextlib.suppress(UnitError):
        assert math.isfinite(convert(text, unit))


def test_pint_is_imported_only_for_rare_units():
    code = (
        "import sys; from hydro1d.components.units import convert; convert('22 MPa', 'Pa'); convert('3 mm/ms', 'm/s');"
        "assert 'pint' not in sys.modules; convert('2 torr', 'Pa'); assert 'pint' in sys.modules"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_messages_stay_short_and_name_bounds():
    assert describe("Pa", "above 0") == "a pressure in Pa above 0, or text with a unit (Pa, kPa, MPa, GPa, bar, psi)"
    assert describe("1") == "a number"
    assert shorten("x" * 1000).endswith("…")
    assert shorten(10**5000) == "an integer of about 5001 digits"
    assert shorten(list(range(100))) == "a list of 100 values"
    assert shorten({"a": 1}) == "a table with 1 key"
    assert shorten(False) == "false"
    assert len(shorten([["a"] * 3, "b" * 1000])) < 100


class Sample(Component):
    pressure: float = positive("Pa")
    strain: float = fraction()
    word: float | str = not_negative("1", default=0.0)
    switch: bool = False
    count: int = 1


def test_all_errors_of_a_component_come_at_once():
    with pytest.raises(ValidationError) as error:
        Sample(pressure="3 kg", strain=2.0, switch=1, count=True, unknown=3)
    assert {detail["loc"][0] for detail in error.value.errors()} == {"pressure", "strain", "switch", "count", "unknown"}
    assert "'3 kg' is a mass, not a pressure" in str(error.value)


@pytest.mark.parametrize("count", [1.0, "1", None])
def test_integers_are_integers(count):
    with pytest.raises(ValidationError, match="not an integer"):
        Sample(pressure=1, strain=0.5, count=count)


# --- tables -------------------------------------------------------------------------------------------------------

EXPECTED = ((0.0, 0.0), (0.5, 1e6), (0.6, 3e6))


@pytest.mark.parametrize(
    "text",
    [
        "0,0\n0.5,1e6\n0.6,3e6\n",
        "strain,stress\n0,0\n0.5,1e6\n0.6,3e6",
        "strain,stress\n1,MPa\n0,0\n0.5,1\n0.6,3\n",
        "strain,stress\n-,MPa\n0,0\n0.5,1\n0.6,3\n",
        "strain,stress\n,MPa\n0,0\n0.5,1\n0.6,3\n",
        "1,MPa\n0,0\n0.5,1\n0.6,3\n",
        "strain,stress (MPa)\n0,0\n0.5,1\n0.6,3\n",
        '"strain [%]";"stress [MPa]"\n0;0\n50;1\n60;3\n',
        "\ufeffstrain\tstress\r\n0\t0\r\n0.5\t1e6\r\n0.6\t3e6\r\n",
        "# measured in 1987\n\n0 0\n0.5  1e6 # knee\n0.6 3e6\n",
        "strain,stress\n0,0 Pa\n0.5,1 MPa\n0.6,3 MPa\n",
        "Dehnung [%];Spannung [MPa]\n0,0;0,0\n50,0;1,0\n60;3\n",
        "strain\tstress [MPa]\n0\t0\n0,5\t1,0\n0,6\t3\n",
        "strain stress\n1 MPa\n0,0 0,0\n0,5 1,0\n0,6 3,0\n",
        "strain, stress [N/mm²]\n0, 0\n0.5, 1\n0.6, 3\n",
        "strain,stress\n0;0\n5,0e-1;1e6\n,6;3e6\n",
    ],
)
def test_csv_forms(tmp_path, text):
    (tmp_path / "curve.csv").write_text(text, encoding="utf-8")
    assert read_table("curve.csv", ("1", "Pa"), tmp_path) == EXPECTED


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0,0\n0.5,nan\n", ["line 2", "nan"]),
        ("0,0\n0.5,inf\n", ["line 2", "inf"]),
        ("0,0\n0.5,\n", ["line 2"]),
        ("0,0\nabc,3\n", ["line 2", "abc"]),
        ("0,0,0\n", ["line 1", "3 columns"]),
        ("0\n1\n", ["line 1", "1 columns"]),
        ("0,0\n0.5,1\n0.5,2\n", ["line 3", "must increase strictly"]),
        ("0,0\n0.5,1\n0.4,2\n", ["line 3", "must increase strictly"]),
        ("strain,stress\n1,kg\n0,0\n", ["line 2", "kg"]),
        ("strain,stress (Mpa)\n0,0\n", ["line 1", "did you mean MPa"]),
        ("strain,Mpa\n0,0\n", ["line 1", "did you mean MPa"]),
        ("strain,stress (MPa)\n1,kPa\n0,0\n", ["line 2", "contradicts"]),
        ("a,b\nc,d\n0,0\n", ["line 2"]),
        ("a,b\n1,Pa\nc,d\n0,0\n", ["line 3"]),
        ("a,b,c\n0,0\n", ["line 1", "3 columns"]),
        ("strain,stress\n", ["no row of numbers"]),
        ("", ["no row of numbers"]),
        ("0,0\n0,5,1,5\n", ["line 2", "4 columns"]),
        ("0,0;0\n0.5;1\n", ["line 1", "0,0", "decimal point"]),
        ("0\t0\n0.5\t1,234\n", ["line 2", "1,234", "decimal point"]),
    ],
)
def test_bad_csv_names_file_and_line(tmp_path, text, words):
    (tmp_path / "curve.csv").write_text(text)
    with pytest.raises(TableError) as error:
        read_table("curve.csv", ("1", "Pa"), tmp_path)
    assert all(word in str(error.value) for word in ["curve.csv", *words]), str(error.value)


@pytest.mark.parametrize("name", ["missing.csv", "", ".", "a\0b", "x" * 5000, "/dev/zero"])
def test_files_that_are_none(tmp_path, name):
    with pytest.raises(TableError):
        read_table(name, ("1", "Pa"), tmp_path)


def test_csv_of_an_old_instrument(tmp_path):
    (tmp_path / "curve.csv").write_bytes("Dehnung;Spannung [N/mm²]\n0;0\n0,5;1\n0,6;3\n".encode("cp1252"))
    assert read_table("curve.csv", ("1", "Pa"), tmp_path) == EXPECTED


def test_csv_that_is_no_text(tmp_path):
    (tmp_path / "curve.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(TableError, match="UTF-8"):
        read_table("curve.csv", ("1", "Pa"), tmp_path)


def test_csv_too_large(tmp_path, monkeypatch):
    (tmp_path / "curve.csv").write_text("0,0\n1,1\n2,2\n")
    monkeypatch.setattr("hydro1d.components.tables.MAX_ROWS", 2)
    with pytest.raises(TableError, match="more than 2 rows"):
        read_table("curve.csv", ("1", "Pa"), tmp_path)
    with pytest.raises(TableError, match="has 3 rows"):
        read_table([[0, 0], [1, 1], [2, 2]], ("1", "Pa"), tmp_path)
    monkeypatch.setattr("hydro1d.components.tables.MAX_FILE_BYTES", 3)
    with pytest.raises(TableError, match="larger than"):
        read_table("curve.csv", ("1", "Pa"), tmp_path)


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ([], "list of pairs"),
        (3.0, "list of pairs"),
        ({"a": 1}, "list of pairs"),
        ([1, 2], "row 1 is not a pair"),
        ([[0, 0], [1]], "row 2 is not a pair"),
        ([[0, 0], [1, 2, 3]], "row 2 is not a pair"),
        ([[0, 0], [1, math.nan]], "row 2: nan is not a finite number"),
        ([[0, 0], [1, True]], "row 2: true is not a number"),
        ([[0, 0], [1, "3 kg"]], "row 2: '3 kg' is a mass"),
        ([[0, 0], [0, 1]], "row 2: 0 is not above 0"),
        (["ab"], "row 1 is not a pair"),
    ],
)
def test_bad_lists_name_the_row(tmp_path, value, words):
    with pytest.raises(TableError) as error:
        read_table(value, ("s", "Pa"), tmp_path)
    assert words in str(error.value)


def test_tables_in_a_component(tmp_path):
    np = pytest.importorskip("numpy")

    class Curve(Component):
        curve: tuple[tuple[float, float], ...] | None = pairs("1", "Pa", default=None)

    assert Curve().curve is None
    assert Curve(curve=np.array(EXPECTED)).curve == EXPECTED
    assert Curve(curve=[[0, 0], [0.5, "1 MPa"], ["60 %", "3 MPa"]]).curve == EXPECTED
    (tmp_path / "c.csv").write_text("0,0\n0.5,1e6\n0.6,3e6\n")
    assert Curve.model_validate({"curve": "c.csv"}, context={"folder": tmp_path}).curve == EXPECTED
    with pytest.raises(ValidationError, match=r"missing\.csv"):
        Curve(curve="missing.csv")
