"""Tables of two columns: a list of pairs, or a CSV file with an optional header and an optional row of units."""

import itertools
import re
import stat
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hydro1d.components.unit_table import ATOMS
from hydro1d.components.units import UnitError, convert, parse_unit, plain, shorten

MAX_FILE_BYTES = 64 * 1024**2  # bytes
MAX_ROWS = 1_000_000  # rows

Table = tuple[tuple[float, float], ...]

_BRACKETED = re.compile(r"^(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\))\s*$")
_COMMA_NUMBER = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?|[+-]?\d+,")
_COMMA_PAIR = re.compile(r"[^\s,]*,[^\s,]+\s+[^\s,]*,[^\s,]+")
_NUMERIC = re.compile(r"[+-]?\.?\d|[+-]?(?:nan|inf)", re.IGNORECASE)


_ABOVE = "; above the numbers only a header and a row of units may stand, or lines that begin with #"


class TableError(UnitError):
    """A table that cannot be used; the text names the file and the row."""


class OrderError(TableError):
    """A table whose first column does not increase."""


def read_table(value: Any, units: tuple[str, str], folder: Path) -> Table:
    """Return the rows of ``value`` in the SI units ``units``; the first column must increase strictly.

    ``value`` is a list of pairs (numbers or texts with a unit) or the name of a CSV file, relative to ``folder``.
    Raises TableError, naming the row (for a file, its line), for anything that is not finite or not in order.
    """
    if isinstance(value, str):
        return _in_order(read_rows(value, units, folder)[0])
    if hasattr(value, "tolist"):  # a numpy array
        value = value.tolist()
    if not isinstance(value, Sequence) or not value:
        raise TableError(f"{shorten(value)} is no list of pairs, [[0, 0], [1, 2]], nor the name of a CSV file")
    if len(value) > MAX_ROWS:
        raise TableError(f"the table has {len(value)} rows; {MAX_ROWS} are possible")
    rows = []
    for number, row in enumerate(value, 1):
        if isinstance(row, str) or not isinstance(row, Sequence) or len(row) != 2:
            raise TableError(f"row {number} is not a pair of numbers")
        rows.append((f"row {number}", _pair(row, units, f"row {number}")))
    return _in_order(rows)


def _pair(cells: Sequence[Any], units: tuple[str, str], place: str) -> tuple[float, float]:
    try:
        return convert(cells[0], units[0]), convert(cells[1], units[1])
    except ValueError as error:
        raise TableError(f"{place}: {error}") from None


def _in_order(rows: list[tuple[str, tuple[float, float]]]) -> Table:
    for (_, earlier), (place, later) in itertools.pairwise(rows):
        if not later[0] > earlier[0]:
            raise OrderError(
                f"{place}: {later[0]:g} is not above {earlier[0]:g}; the first column must increase strictly"
            )
    return tuple(pair for _, pair in rows)


def read_rows(
    name: str, units: tuple[str, str], folder: Path, stated: tuple[str, str] = ("", "")
) -> tuple[list[tuple[str, tuple[float, float]]], list[str]]:
    """Rows of a CSV file in the SI units ``units``, in whatever order, each with its place; the unit of each column.

    ``stated`` are units that are known beforehand; for such a column the header is not asked. "" where no unit is given.
    Columns are separated by semicolon, tab, comma or blanks; where it is not the comma, numbers may have a decimal comma.
    """
    lines = [(number, line.split("#")[0].strip()) for number, line in enumerate(_lines(name, folder), 1)]
    table = _dialect([(number, text) for number, text in lines if text.strip(" \t;,")], name)
    head = [row for row in table[:3] if not any(_NUMERIC.match(cell) for cell in _beyond_unit_one(row[1]))]
    head = head[: next((k for k, row in enumerate(head) if row is not table[k]), len(head))]
    given = _units(head, units, name, stated)
    rows = []
    for number, cells in table[len(head) :]:
        place = f"{name}, line {number}"
        if len(cells) != 2:
            raise TableError(f"{place}: {len(cells)} columns where there must be 2")
        texts = [f"{cell} {unit}" if unit else plain(cell) for cell, unit in zip(cells, given, strict=True)]
        try:
            rows.append((place, _pair(texts, units, place)))
        except TableError as error:
            raise TableError(f"{error}{'' if rows else _ABOVE}") from None
        if len(rows) > MAX_ROWS:
            raise TableError(f"{name} has more than {MAX_ROWS} rows")
    if not rows:
        raise TableError(f"{name} has no row of numbers")
    return rows, given


def _dialect(lines: list[tuple[int, str]], name: str) -> list[tuple[int, list[str]]]:
    """The cells of each line, decimal commas as points; what separates columns is read off the last line."""
    last = lines[-1][1] if lines else ""
    mark = next((mark for mark in (";", "\t", ",") if mark in last), " ")
    if mark == "," and _COMMA_PAIR.fullmatch(last):
        mark = " "
    table = [(number, _cells(text, mark)) for number, text in lines]
    commas = [
        (number, cell) for number, cells in table for cell in cells if mark != "," and _COMMA_NUMBER.fullmatch(cell)
    ]
    if not commas:
        return table
    if any("." in cell and _NUMERIC.match(cell) for _, cells in table for cell in cells):
        number, cell = commas[0]
        raise TableError(f"{name}, line {number}: {cell} has a comma where other numbers have a decimal point")
    return [
        (number, [cell.replace(",", ".") if _COMMA_NUMBER.fullmatch(cell) else cell for cell in cells])
        for number, cells in table
    ]


def _beyond_unit_one(cells: list[str]) -> list[str]:
    """The cells, without a lone "1", which in a row of units means a pure number."""
    return cells if all(_NUMERIC.match(cell) for cell in cells) else [cell for cell in cells if cell != "1"]


def _cells(text: str, mark: str) -> list[str]:
    """Cells of a line; a header may be separated by another mark than the numbers."""
    found = mark if mark in text else next((other for other in (";", ",", "\t") if other in text), " ")
    return [cell.strip().strip('"').strip() for cell in (text.split() if found == " " else text.split(found))]


def _lines(name: str, folder: Path) -> list[str]:
    path = folder / name
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            raise TableError(f"{name} is not a file")
        if status.st_size > MAX_FILE_BYTES:
            raise TableError(f"{name} is larger than {MAX_FILE_BYTES // 1024**2} MB")
        return _text(path.read_bytes(), name).splitlines()
    except OSError as error:
        raise TableError(f"the file {name[:200]} cannot be read: {error.strerror or error}") from None
    except ValueError as error:  # a NUL in the name
        if isinstance(error, TableError):
            raise
        raise TableError(f"{name[:200]!r} is not the name of a file") from None


def _text(raw: bytes, name: str) -> str:
    """Text in UTF-8 or, as older instruments write it, in the Western European encoding of Windows."""
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        if any(byte < 9 for byte in raw):
            raise TableError(f"{name} is not text in UTF-8") from None
        return raw.decode("cp1252", errors="replace")


def _units(head: list[tuple[int, list[str]]], units: tuple[str, str], name: str, stated: tuple[str, str]) -> list[str]:
    """The unit of each column as stated, or as the header says ("stress (MPa)", or a row of units); "" where none is."""
    if len(head) > 2:
        raise TableError(f"{name}, line {head[2][0]}: not numbers, after a header and a row of units")
    given = list(stated)
    for row, (number, cells) in enumerate(head):
        place = f"{name}, line {number}"
        if len(cells) != 2:
            raise TableError(f"{place}: {len(cells)} columns where there must be 2")
        for column, cell in enumerate(cells):
            if stated[column]:
                continue
            unit = _unit(cell, units[column], place, must_be_unit=row == 1)
            if unit and given[column] and unit != given[column]:
                raise TableError(f"{place}: the unit {unit} contradicts {given[column]} in the row above")
            given[column] = unit or given[column]
    return given


def _unit(cell: str, wanted: str, place: str, must_be_unit: bool) -> str:
    """The unit that a cell of the header names, or "" for a mere title or an empty cell."""
    bracketed = _BRACKETED.match(cell)
    text = (bracketed[2] or bracketed[3] or "").strip() if bracketed else cell
    if text in ("", "-", "–"):
        return ""
    try:
        only_common = not (bracketed or must_be_unit)  # a mere title must not be taken for an exotic unit
        fits = parse_unit(text, only_common).dimension == parse_unit(wanted).dimension
        problem = f"{text} is not a unit of {'a pure number, 1 or %' if wanted == '1' else f'the kind {wanted}'}"
    except ValueError as error:
        fits, problem = False, str(error)
    if fits:
        return text
    if bracketed or must_be_unit or _is_misspelt(text, wanted):
        raise TableError(f"{place}: {problem}")
    return ""


def _is_misspelt(text: str, wanted: str) -> bool:
    """Whether the title of a column is one of its units in the wrong case: a "Mpa" taken for a title is 1e6 off."""
    dimension = parse_unit(wanted).dimension
    return text.lower() in {name.lower() for name, unit in ATOMS.items() if unit.dimension == dimension}
