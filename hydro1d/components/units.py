"""Unit strings such as ``"22 MPa"`` become SI numbers, correctly rounded.

The units that decks use stand in a static table; any other single unit is looked up with pint, which is imported only
then (its import takes longer than a short run). A product may be written ``kg/m^3``, ``kg/m**3``, ``kg/m3``, ``kg m-3``
or ``kg·m⁻³``; as in pint, ``a/b c`` means (a/b)·c.
"""

import functools
import math
import numbers
import re
from collections.abc import Mapping
from typing import Any

from hydro1d.components.unit_table import ATOMS, KINDS, NUMBER, Dimension, Unit

MAX_TEXT = 100  # characters of a number with its unit


class UnitError(ValueError):
    """A value that is not a number with a fitting unit; the text names the value and what is allowed."""


_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
_NUMERAL = re.compile(r"([+-]?)(\d[\d_]*)?(?:\.([\d_]*))?(?:[eE]([+-]?\d+))?", re.ASCII)
_COMMA = re.compile(r"[+-]?[\d.]*,\d[\d.,]*(?=\D|$)", re.ASCII)
_FACTOR = re.compile(r"([*/ ]?)(1(?!\d)|[^\W\d]+|%|°)(?:\^?([+-]?\d{1,2}))?(?=[*/ ]|$)")


def convert(value: Any, unit: str) -> float:
    """Return ``value`` in SI: a number as it is, a text such as ``"22 MPa"`` converted to the SI unit ``unit``.

    The result is the float nearest to the exact value. Raises UnitError, naming the value and what is allowed, for a
    unit of another dimension, for a text that is no number, and for bool, NaN, infinity and complex numbers.
    """
    if isinstance(value, str):
        return _convert_text(value, unit)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise UnitError(f"{shorten(value)} is not a number")
    try:
        result = float(value)
    except OverflowError:
        raise UnitError(f"{shorten(value)} is too large for a floating-point number") from None
    if not math.isfinite(result):
        raise UnitError(f"{result} is not a finite number")
    return result


def describe(unit: str, bounds: str = "") -> str:
    """What a value of the SI unit ``unit`` may be: "a pressure in Pa above 0, or text with a unit (Pa, kPa, …)"."""
    kind, examples = KINDS.get(parse_unit(unit).dimension, ("a quantity", unit))
    bounds = f" {bounds}" if bounds else ""
    return f"a number{bounds}" if unit == "1" else f"{kind} in {unit}{bounds}, or text with a unit ({examples})"


def shorten(value: Any, limit: int = 60) -> str:
    """Return ``repr(value)``, cut to ``limit`` characters, for messages; never fails, never takes long."""
    if isinstance(value, str) and len(value) > limit:
        return repr(value[:limit]) + "…"
    if isinstance(value, int) and abs(value) >= 10**limit:
        return f"an integer of about {int(value.bit_length() * 0.30103) + 1} digits"
    if isinstance(value, Mapping):
        return f"a table with {len(value)} keys" if len(value) != 1 else "a table with 1 key"
    if isinstance(value, list | tuple) and len(value) > 4:
        return f"a list of {len(value)} values"
    if isinstance(value, list | tuple):
        return "[" + ", ".join("[…]" if isinstance(item, list | tuple) else shorten(item, 20) for item in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    text = str(value) if isinstance(value, numbers.Real) else repr(value)
    return text if len(text) <= limit else text[:limit] + "…"


@functools.lru_cache(maxsize=1024)
def parse_unit(text: str, only_common: bool = False) -> Unit:
    """Return the exact factor to SI and the dimension of a product of units. Raises UnitError.

    With ``only_common`` pint is not asked.
    """
    if len(text) > MAX_TEXT:
        raise UnitError(f"{shorten(text)} is not a unit")
    plain = text.replace("**", "^").replace("·", "*").replace("⋅", "*").replace("−", "-")
    plain = plain.replace("µ", "u").replace("μ", "u").translate(_SUPERSCRIPTS)
    plain = re.sub(r"\s*([*/^])\s*", r"\1", " ".join(plain.split()))
    numerator, denominator, dimension = 1, 1, [0.0, 0.0, 0.0]
    position = 0
    while position < len(plain):
        match = _FACTOR.match(plain, position)
        if match is None or bool(match[1]) != (position > 0):
            raise UnitError(f"{shorten(text)} is not a unit")
        atom = ATOMS.get(match[2]) or _from_pint(match[2], only_common)
        power = int(match[3] or 1) * (-1 if match[1] == "/" else 1)
        up, down = (atom.numerator, atom.denominator) if power > 0 else (atom.denominator, atom.numerator)
        numerator, denominator = numerator * up ** abs(power), denominator * down ** abs(power)
        dimension = [total + power * part for total, part in zip(dimension, atom.dimension, strict=True)]
        position = match.end()
    if not plain:
        raise UnitError("the unit is empty")
    return Unit(numerator, denominator, (dimension[0], dimension[1], dimension[2]))


def _convert_text(text: str, unit: str) -> float:
    quoted = shorten(text)
    if len(text) > MAX_TEXT:
        raise UnitError(f"{quoted} is too long for a number with a unit")
    body = text.strip().replace("−", "-")
    if comma := _COMMA.match(body):
        raise UnitError(f"{quoted} has a comma; {_without_comma(comma[0], body)}")
    match = _NUMERAL.match(body)
    if match is None or not ((match[2] or "") + (match[3] or "")).strip("_"):
        raise UnitError(f"{quoted} is not a number with a unit")
    wanted = parse_unit(unit)
    name = body[match.end() :].strip()
    if not name and wanted.dimension != NUMBER:
        raise UnitError(f"{quoted} has no unit")
    try:
        given = parse_unit(name or "1")
    except UnitError as error:
        raise UnitError(f"{quoted}: {error}") from None
    if given.dimension != wanted.dimension:
        raise UnitError(f"{quoted} is {_kind(given.dimension)}, not {_kind(wanted.dimension)}")
    return _scaled(match, given.numerator * wanted.denominator, given.denominator * wanted.numerator, quoted)


def _without_comma(number: str, body: str) -> str:
    """How to write a number with a comma, which may be decimal or stand between thousands."""
    if number.count(",") == 1 and "." not in number:
        return f"a number has a decimal point: {shorten(body.replace(',', '.', 1))}"
    return "a number has a decimal point and nothing between thousands"


def _scaled(number: re.Match[str], numerator: int, denominator: int, quoted: str) -> float:
    """The decimal ``number`` times an exact ratio, rounded once: "1.53 ms" is the same float as 0.00153."""
    sign, whole, decimals, exponent = number.groups("")
    decimals = decimals.replace("_", "")
    digits = int(whole.replace("_", "") + decimals)
    power = int(exponent or 0) - len(decimals)
    if digits == 0:
        return 0.0
    if abs(power) > 500:  # keeps the integers below short; the text is at most MAX_TEXT characters
        raise UnitError(f"{quoted} is too {'large' if power > 0 else 'small'} for a floating-point number")
    try:
        size = digits * numerator * 10 ** max(power, 0) / (denominator * 10 ** max(-power, 0))
    except OverflowError:
        raise UnitError(f"{quoted} is too large for a floating-point number") from None
    if size == 0.0:
        raise UnitError(f"{quoted} is too small for a floating-point number")
    return -size if sign == "-" else size


def _kind(dimension: Dimension) -> str:
    if dimension in KINDS:
        return KINDS[dimension][0]
    powers = " ".join(f"{base}^{power:g}" for base, power in zip(("kg", "m", "s"), dimension, strict=True) if power)
    return f"of the dimension {powers}"


@functools.cache
def _registry() -> Any:
    import pint  # 0.2 s; only for units outside the table

    return pint.UnitRegistry()


def _from_pint(name: str, only_common: bool) -> Unit:
    try:
        if only_common:
            raise LookupError
        registry = _registry()
        quantity = registry.Quantity(1.0, registry.parse_units(name)).to_base_units()
        powers = {str(key): float(power) for key, power in quantity.dimensionality.items()}
        numerator, denominator = float(quantity.magnitude).as_integer_ratio()
        multiplicative = registry.Quantity(0.0, registry.parse_units(name)).to_base_units().magnitude == 0.0
    except Exception:  # pint raises many kinds, also AttributeError and its tokenizer's own
        raise UnitError(f"{name!r} is not a unit{_suggest(name)}") from None
    if not multiplicative or set(powers) - {"[mass]", "[length]", "[time]"} or numerator <= 0:
        raise UnitError(f"{name!r} is not a unit of mass, length and time")
    return Unit(numerator, denominator, (powers.get("[mass]", 0), powers.get("[length]", 0), powers.get("[time]", 0)))


def _suggest(name: str) -> str:
    from difflib import get_close_matches

    same = [known for known in ATOMS if known.lower() == name.lower()] or get_close_matches(name, ATOMS, 1)
    return f"; did you mean {' or '.join(same)}?" if same else ""


def plain(text: str) -> float | str:
    """The number that a text is; a text with a unit, or with anything else, as it stands."""
    try:
        return float(text)
    except ValueError:
        return text
