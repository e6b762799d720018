"""``--set layer[0].zones=2000``: values that take the place of the deck's."""

import re
import tomllib
from collections.abc import Sequence
from typing import Any, NamedTuple

from hydro1d.deck.messages import Finding, Location, path_text

_PART = re.compile(r'\.?(?:"([^"]*)"|\'([^\']*)\'|\[(\d{1,9})\]|([^.\[\]="\']+))')
_MAX_PARTS = 20


class Override(NamedTuple):
    """One ``path=value``, with the text that it came from."""

    path: Location
    value: Any
    text: str


def parse_override(text: str) -> Override | Finding:
    """Return the override that ``text`` means; the value is TOML, or, where that fails, the text itself."""
    path: list[str | int] = []
    position = 0
    while position < len(text) and text[position] != "=" and len(path) <= _MAX_PARTS:
        match = _PART.match(text, position)
        if match is None or (position == 0 and text[0] in ".["):
            break
        name = next(group for group in match.groups() if group is not None)
        path.append(int(name) if match[3] is not None else name.strip())
        position = match.end()
    if not path or position >= len(text) or text[position] != "=" or "" in path:
        return Finding(("--set",), f"{text[:100]!r} is not path=value", text, "for example layer[0].zones=2000")
    return Override(tuple(path), _value(text[position + 1 :].strip()), text)


def _value(text: str) -> Any:
    try:
        data = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text
    return data["value"] if set(data) == {"value"} else text


def apply(data: dict[str, Any], overrides: Sequence[str]) -> tuple[dict[Location, str], list[Finding]]:
    """Change ``data`` in place. Return which path each override's text went to, and what could not be done."""
    origins: dict[Location, str] = {}
    found: list[Finding] = []
    for text in overrides:
        override = parse_override(text)
        if isinstance(override, Finding):
            found.append(override)
            continue
        done = _put(data, override)
        if isinstance(done, Finding):
            found.append(done)
        else:
            origins[done] = text
    return origins, found


def _put(data: dict[str, Any], override: Override) -> Location | Finding:
    """Put the value in its place, making tables on the way; a list keeps its length."""
    place: Any = data
    path: Location = ()
    shown = f"{path_text(override.path)} (--set {override.text[:100]})"
    for depth, part in enumerate(override.path):
        is_last = depth == len(override.path) - 1
        if isinstance(place, list):
            key: Any = int(part) if str(part).isdecimal() and len(str(part)) < 10 else -1
            if not 0 <= key < len(place):
                rows = f"{path_text(path)}[0] to {path_text(path)}[{len(place) - 1}]" if place else "no row at all"
                return Finding(("--set",), f"{shown}: there is no {path_text((*path, part))}", None, rows)
        elif isinstance(place, dict):
            key = str(part)
            if not is_last:
                place.setdefault(key, {})
        else:
            return Finding(("--set",), f"{shown}: {path_text(path)} is a value, not a table", None, "")
        path = (*path, key)
        if is_last:
            place[key] = override.value
        else:
            place = place[key]
    return path
