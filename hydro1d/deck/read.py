"""From bytes to plain data: reading the file, TOML's grammar, and bounds that keep any input harmless."""

import re
import tomllib
from pathlib import Path
from typing import Any

from hydro1d.errors import DeckError, FileProblem, Problem

MAX_DECK_BYTES = 512 * 1024  # bytes; measured tables belong into CSV files
DEEPEST_KEY = 50  # dots in one key

_COMMA = re.compile(r"^[^=#\"]*=\s*([+-]?\d+),(\d+)")
_BARE_UNIT = re.compile(r"^[^=#\"]*=\s*([+-]?[\d._]+(?:[eE][+-]?\d+)?)\s*([^\W\d][\w*/^.-]{0,19})")
_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")
_LONG_INTEGER = re.compile(r"[0-9_]{4000}")


def read_text(path: Path, what: str = "deck") -> str:
    """Return the text of a deck's (or another) file. Raises FileProblem if it cannot be read, DeckError if it is not UTF-8."""
    try:
        with open(path, "rb") as file:
            raw = file.read(MAX_DECK_BYTES + 1)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        reason = getattr(error, "strerror", None) or str(error)
        raise FileProblem(f"the {what} {str(path)[:300]!r} cannot be read: {reason}") from None
    if raw.startswith(b"\x89HDF"):
        raise DeckError(f"{path} is a result (HDF5), not a {what}; hydro1d plot and hydro1d report take it")
    if len(raw) > MAX_DECK_BYTES:
        raise DeckError(f"{path}: larger than {MAX_DECK_BYTES // 1024} kB; put long tables into CSV files")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = raw[: error.start]
        line, column = before.count(b"\n") + 1, error.start - (before.rfind(b"\n") + 1) + 1
        problem = Problem("deck", f"byte {raw[error.start]:#04x} is not UTF-8", None, "text in UTF-8", line, column)
        raise DeckError(f"{path}: not a text file", [problem]) from None


def parse(text: str, source: Path | str | None = None) -> dict[str, Any]:
    """Return the data of a TOML text. Raises DeckError with line and column."""
    where = f"{source}: " if source else "the deck: "
    if len(text) > MAX_DECK_BYTES:
        raise DeckError(f"{where}larger than {MAX_DECK_BYTES // 1024} kB; put long tables into CSV files")
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        raise DeckError(f"{where}not text that UTF-8 can hold") from None
    # tomllib takes time quadratic in the parts of a dotted key; this takes linear time to find such keys.
    if "a." * DEEPEST_KEY in re.sub(r"[^.\n=\[\]{},]+", "a", text):
        raise DeckError(f"{where}a key of more than {DEEPEST_KEY} parts")
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise DeckError(f"{where}not valid TOML", [_syntax_problem(str(error), text)]) from None
    except RecursionError:
        raise DeckError(f"{where}brackets nested too deeply") from None
    except ValueError:  # Python refuses to read integers of thousands of digits, and dates such as 0000-13-99
        match = _LONG_INTEGER.search(text)
        line = text.count("\n", 0, match.start()) + 1 if match else None
        column = match.start() - text.rfind("\n", 0, match.start()) if match else None
        problem = Problem(
            "deck", "a number with too many digits" if match else "an impossible value", None, "", line, column
        )
        raise DeckError(f"{where}not valid TOML", [problem]) from None


def _syntax_problem(message: str, text: str) -> Problem:
    match = _PLACE.search(message)
    if match is None:
        return Problem("TOML", message[:300])
    line = int(match[1]) if match[1] else text.count("\n") + 1
    column = int(match[2]) if match[2] else len(text) - (text.rfind("\n") + 1) + 1
    return Problem("TOML", message[: match.start()][:300] + _slip(text.split("\n")[line - 1]), None, "", line, column)


def _slip(row: str) -> str:
    """Hint at the likely mistake in a line that is no TOML, or nothing."""
    if match := _COMMA.match(row):
        return f"; a number has a decimal point, {match[1]}.{match[2]}, and with a unit stands in quotes"
    if match := _BARE_UNIT.match(row):
        return f'; a number with a unit stands in quotes, "{match[1]} {match[2]}"'
    return ""
