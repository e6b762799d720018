"""Where in a deck's text each key and each value stands, for messages.

The text is valid TOML by then (tomllib has read it), so this scanner only has to follow the brackets.
"""

import bisect
import re
import tomllib
from collections.abc import Iterator
from typing import NamedTuple

from hydro1d.deck.messages import Location

_MAX_PLACES = 200_000
# No possessive quantifier around alternatives: Python 3.11 before 3.11.5 loses matches with it.
_TOKEN = re.compile(
    r'''(?P<space>[ \t\r]+|\#[^\n]*)
    |(?P<newline>\n)
    |(?P<string>"""[^"\\]*(?:(?:\\[\s\S]|"(?!""))[^"\\]*)*"{3,5}|\'\'\'[\s\S]*?\'{3,5}|"[^"\\\n]*(?:\\.[^"\\\n]*)*"|'[^'\n]*')
    |(?P<mark>[\[\]{}=,.])
    |(?P<bare>[^\s\[\]{}=,.#"']+)''',
    re.VERBOSE,
)


class Place(NamedTuple):
    """Offsets in the text: of a key (or a table's header) and of its value."""

    key: int
    value: int


class _Token(NamedTuple):
    kind: str
    text: str
    start: int


class Positions:
    """Line and column, counted from 1, of every key path such as ("layer", 1, "thickness") in ``text``."""

    def __init__(self, text: str) -> None:
        self._lines = [0, *(match.end() for match in re.finditer("\n", text))]
        self._places = _Scanner(text).places

    def find(self, path: Location, of_key: bool = False) -> tuple[int, int] | None:
        """Line and column of the value at ``path`` (or of its key), else of the nearest table around it, else None."""
        for length in range(len(path), 0, -1):
            place = self._places.get(path[:length])
            if place is not None:
                offset = place.key if of_key or length < len(path) else place.value
                line = bisect.bisect_right(self._lines, offset)
                return line, offset - self._lines[line - 1] + 1
        return None


class _Scanner:
    def __init__(self, text: str) -> None:
        self.places: dict[Location, Place] = {}
        self._rows: dict[Location, int] = {}
        self._tokens = _tokens(text)
        self._token = next(self._tokens)
        table: Location = ()
        try:
            while self._token.kind != "end" and len(self.places) < _MAX_PLACES:
                if self._token.kind == "newline":
                    self._advance()
                elif self._token.text == "[":
                    table = self._header()
                else:
                    self._key_and_value(table)
        except RecursionError:
            pass  # what has been found so far will do

    def _advance(self) -> _Token:
        token = self._token
        self._token = next(self._tokens)
        return token

    def _header(self) -> Location:
        start = self._advance().start
        is_row = self._token.text == "[" and self._token.start == start + 1
        if is_row:
            self._advance()
        keys = self._key()
        path: Location = ()
        for key in keys[:-1]:
            path = self._with_row((*path, key))
        path = (*path, keys[-1])
        if is_row:
            self._rows[path] = self._rows.get(path, -1) + 1
            self.places.setdefault(path, Place(start, start))
            path = self._with_row(path)
            self._advance()
        self._advance()
        self.places[path] = Place(start, start)
        return path

    def _with_row(self, path: Location) -> Location:
        return (*path, self._rows[path]) if path in self._rows else path

    def _key(self) -> list[str]:
        keys = []
        while self._token.text not in ("=", "]") and self._token.kind in ("bare", "string", "mark"):
            token = self._advance()
            if token.kind == "string":
                keys.append(tomllib.loads(f"key = {token.text}")["key"])
            elif token.kind == "bare":
                keys.append(token.text)
        return keys

    def _key_and_value(self, table: Location) -> None:
        start = self._token.start
        keys = self._key()
        self._advance()  # the "="
        for length in range(1, len(keys)):
            self.places.setdefault((*table, *keys[:length]), Place(start, start))
        self._value((*table, *keys), start)

    def _value(self, path: Location, key: int) -> None:
        token = self._token
        self.places[path] = Place(key, token.start)
        if token.text == "[":
            self._array(path)
        elif token.text == "{":
            self._advance()
            while self._token.text != "}" and self._token.kind != "end":
                if self._token.text == "," or self._token.kind == "newline":
                    self._advance()
                else:
                    self._key_and_value(path)
            self._advance()
        else:  # a number such as 1.5 is several tokens
            while self._token.kind not in ("newline", "end") and self._token.text not in (",", "]", "}"):
                self._advance()

    def _array(self, path: Location) -> None:
        self._advance()
        row = 0
        while self._token.text != "]" and self._token.kind != "end":
            if self._token.text == "," or self._token.kind == "newline":
                self._advance()
            else:
                self._value((*path, row), self._token.start)
                row += 1
        self._advance()


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text):
        if match.lastgroup != "space":
            yield _Token(str(match.lastgroup), match[0], match.start())
    while True:
        yield _Token("end", "", len(text))
