"""Hostile decks by number: the same for the same seed, made far faster than a property-testing library draws them.

Each is a valid deck, of any law, boundary and pulse, with a few mutations of its data, of its text or of its bytes, or an
input of absurd size.
"""

from __future__ import annotations

import copy
import functools
import json
import random
from typing import Any, NamedTuple

from sample_decks import LAWS, MAIN, data, ends

from hydro1d.deck import load_deck


class Hostile(NamedTuple):
    """What is given to `load_deck`: data, a text or bytes, with overrides."""

    kind: str
    source: dict[str, Any] | str | bytes
    overrides: tuple[str, ...]


def _nested(depth: int, inner: Any = 1.0) -> Any:
    for _ in range(depth):
        inner = [inner] if depth % 2 else {"a": inner}
    return inner


NUMBERS = [
    *(0.0, -0.0, -1.0, 1e308, -1e308, 1.7e308, 1e-308, 5e-324, -5e-324, float("nan"), float("inf"), float("-inf")),
    *(1e16, 1e-16, 1.0 + 2**-52, 1 - 2**-53, 0, -1, 1, 2, 10**6, 10**7, 10**7 + 1, 2**31, 2**63, 2**64),
    *(10**18, -(10**18), 10**400, -(10**400), True, False),
]
TEXTS = [
    *(
        "",
        " ",
        "nan",
        "inf",
        "1e400 m",
        "1e-400 m",
        "-1 m",
        "1 m",
        "3.6 MPa",
        "3.6 mpa",
        "1 furlong",
        "1 degC",
        "1 m^99",
    ),
    *(
        "m",
        "1..2 s",
        "1 m/m",
        "0x10",
        "1_0 s",
        "\uff11 m",
        "1 \u00b5s",
        "\x00",
        "\x1b[2J",
        "é",
        "🦀 m",
        "\u202e",
        "\ufeff",
    ),
    *("x" * 10_000, "9" * 5000 + " m", "rigid", "standard", "epph", "table", "wall", "pressure", "nowhere.csv"),
    *("nowhere.py:Law", "/dev/zero", "/proc/self/mem", "..", "epph:", ".py", "a.py:b:c", "%s%n", "${HOME}", "`id`"),
    "__import__('os')",
]
STRUCTURES = [
    *([], {}, [[]], [[1, 2]], [[1, 2], [1, 3]], [[0, 0], [1, float("nan")]], [None], None, [0.0] * 5000),
    *([[0.0, 0.0]] * 3000, {"a": {"b": {}}}),
]
DEPTHS = (40, 300, 501, 5000)
ODD = [*NUMBERS, *TEXTS, *STRUCTURES]
TOKENS = [
    *("nan", "inf", "1e308", "-1e-308", "9" * 5000, '"1 m"', '"🦀"', "[[", "]]", "[", "]", "{", "}", "=", "\n", "'''"),
    *('"""', "\\", ".", "#", ",", "1979-05-27", "0x_", "\r", "\t", '"\\u0000"', "\\ud800", " " * 1000, "true"),
    *("[layer]", "[[layer]]", "[time]"),
]


def _odd(rng: random.Random) -> Any:
    """Something that has no business in a deck, of its own for each deck."""
    if rng.random() < 0.02:
        return _nested(rng.choice(DEPTHS))  # too deep for a copy
    return copy.deepcopy(rng.choice(ODD))


@functools.cache
def _bases() -> list[dict[str, Any]]:
    return [load_deck(data(law, left=end)).resolved() for law in LAWS for end in ends()]


def hostile(seed: int) -> Hostile:
    """The deck of this number."""
    rng = random.Random(seed)
    if seed % 1000 == 0:
        return Hostile("enormous", _enormous(rng), ())
    deck = copy.deepcopy(rng.choice(_bases()))
    for _ in range(rng.choice((0, 1, 1, 1, 2, 4))):
        _mutate(deck, rng)
    overrides = tuple(_override(deck, rng) for _ in range(rng.choice((0, 0, 0, 0, 1, 3))))
    kind = rng.choice(("data", "text", "text", "bytes"))
    if kind == "data":
        return Hostile(kind, deck, overrides)
    text = toml(deck) if rng.random() < 0.7 else MAIN
    for _ in range(rng.choice((0, 1, 1, 2, 6))):
        text = _scramble(text, rng)
    if kind == "text":
        return Hostile(kind, text + "\n", overrides)
    raw = bytearray(text.encode("utf-8", "surrogatepass"))
    for _ in range(rng.choice((1, 2, 10))):
        raw[rng.randrange(len(raw) or 1) : rng.randrange(len(raw) or 1) + 1] = rng.randbytes(rng.choice((0, 1, 1, 4)))
    return Hostile(kind, bytes(raw), overrides)


def _tables(value: Any):
    waiting = [value]
    while waiting:
        table = waiting.pop()
        yield table
        items = list(table.values()) if isinstance(table, dict) else table
        waiting += [item for item in items if isinstance(item, dict | list)]


def _mutate(deck: dict[str, Any], rng: random.Random) -> None:
    """Change one thing anywhere in the data."""
    table = rng.choice([table for table, _ in zip(_tables(deck), range(300), strict=False)])
    keys = list(table) if isinstance(table, dict) else list(range(len(table)))
    action = rng.choice(("odd", "odd", "odd", "scale", "delete", "rename", "add", "swap"))
    if not keys or action == "add":
        if isinstance(table, dict):
            table[_word(rng)] = _odd(rng)
        else:
            table.append(_odd(rng))
        return
    key = rng.choice(keys)
    if action == "odd":
        table[key] = _odd(rng)
    elif action == "scale" and isinstance(table[key], float):
        table[key] *= rng.choice((-1, 0, 1e-300, 1e-9, 1e9, 1e300))
    elif action == "delete":
        del table[key]
    elif action == "swap":
        other = rng.choice(keys)
        table[key], table[other] = table[other], table[key]
    elif isinstance(table, dict):
        table[_misspelt(str(key), rng)] = table.pop(key)


def _word(rng: random.Random) -> str:
    words = (
        "density",
        "modulus",
        "law",
        "type",
        "pulse",
        "zones",
        "end",
        "cfl",
        "",
        "🦀",
        "a.b",
        "x" * 300,
        "\x00",
        "tension",
    )
    return rng.choice(words)


def _misspelt(word: str, rng: random.Random) -> str:
    place = rng.randrange(len(word) + 1)
    return word[:place] + rng.choice(("", "x", "🦀", " ", "é", "\x00", ".")) + word[place + rng.choice((0, 1)) :]


def _override(deck: dict[str, Any], rng: random.Random) -> str:
    """``path=value`` for a place of the deck, or nonsense."""
    if rng.random() < 0.2:
        return "".join(rng.choice((*TOKENS, *TEXTS, "layer", "[0]")) for _ in range(rng.randint(0, 6)))
    path, place = "", deck
    while isinstance(place, dict | list) and place and rng.random() < 0.8:
        key = rng.choice(list(place)) if isinstance(place, dict) else rng.randrange(len(place) + 1)
        path += f"[{key}]" if isinstance(place, list) else f".{key}" if path else str(key)
        place = place[key] if isinstance(place, dict) or key < len(place) else None
    return f"{path}={rng.choice((*TOKENS, *TEXTS, '1e308', '-1', 'nan', '1e18', '99999999999999999999'))}"


def _scramble(text: str, rng: random.Random) -> str:
    start = rng.randrange(len(text) + 1)
    end = min(start + rng.choice((0, 0, 1, 5, 30, 200)), len(text))
    new = rng.choice((rng.choice(TOKENS), chr(rng.randrange(0xD7FF)), text[start:end] * 2, ""))
    return text[:start] + new + text[end:]


def _enormous(rng: random.Random) -> str | bytes:
    """Ten megabytes, a hundred thousand brackets, half a megabyte of legal nonsense."""
    shapes = [
        lambda: b"#" * 10_000_000,
        lambda: MAIN + "\n" * 10_000_000,
        lambda: rng.randbytes(10_000_000),
        lambda: MAIN.encode() + b"\x00" * 10_000_000,
        lambda: "a = " + "[" * 100_000 + "\n",
        lambda: "a = " + "{b = " * 50_000 + "\n",
        lambda: "a." * 100_000 + "b = 1\n",
        lambda: '"x y".' * 50_000 + "b = 1\n",
        lambda: "[a" + ".a" * 49 + "]\n" + "".join(f"[b{k}.c.d]\n" for k in range(20_000)),
        lambda: MAIN + '[[layer]]\nmaterial = "foam"\nthickness = 1\nzones = 1\n' * 8_000,
        lambda: MAIN + "".join(f"[material.m{k}]\nlaw = 'elastic'\n" for k in range(10_000)),
        lambda: MAIN.replace("[output]", "[output]\n" + "".join(f"k{i} = {i}\n" for i in range(40_000))),
        lambda: MAIN.replace("profiles = 200", "profiles = [" + ", ".join(map(str, range(70_000))) + "]"),
        lambda: MAIN.replace('probes = ["0.25 m", "0.5 m"]', "probes = [" + "'0.5 m', " * 40_000 + "]"),
        lambda: MAIN.replace('law = "epph"', 'law = "table"\ncurve = [' + "[0.1, 1e5], " * 40_000 + "]"),
        lambda: MAIN.replace('"Rectangular', '"' + "🦀" * 100_000),
        lambda: MAIN.replace("zones = 1000", "zones = 1" + "0" * rng.choice((7, 18, 4000, 400_000))),
    ]
    return rng.choice(shapes)()


def toml(deck: dict[str, Any]) -> str:
    """Plain data as TOML; what TOML cannot hold is written as Python would, which is wrong TOML and welcome."""
    lines = []
    for key, value in deck.items():
        if isinstance(value, dict) and key != "material":
            lines += [f"[{_key(key)}]", *(f"{_key(name)} = {_value(item)}" for name, item in value.items())]
        elif isinstance(value, list) and value and all(isinstance(row, dict) for row in value):
            for row in value:
                lines += [f"[[{_key(key)}]]", *(f"{_key(name)} = {_value(item)}" for name, item in row.items())]
        else:
            lines.insert(0, f"{_key(key)} = {_value(value)}")
    return "\n".join(lines)


def _key(key: Any) -> str:
    text = str(key)
    return (
        text
        if text.isascii() and text.replace("_", "").replace("-", "").isalnum()
        else json.dumps(text, ensure_ascii=False)
    )


def _value(value: Any, depth: int = 0) -> str:
    if depth > 200:
        return "[" * 5000
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and abs(value) > 10**30:
        return "9" * 5000
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return "[" + ", ".join(_value(item, depth + 1) for item in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(key)} = {_value(item, depth + 1)}" for key, item in value.items()) + "}"
    return str(value)
