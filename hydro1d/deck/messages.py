"""From pydantic's errors to sentences: the key, the value as the user wrote it, what is allowed, a suggestion."""

from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from hydro1d.components.fields import kinds_of, said_of
from hydro1d.components.units import describe, shorten
from hydro1d.errors import DeckError, Problem

Location = tuple[str | int, ...]  # where in a deck: ("layer", 1, "zones")

MAX_SHOWN = 50  # problems in one message
MAX_FOUND = 500  # problems collected from one table; each costs time, and 50 are shown


class Finding(NamedTuple):
    """A problem before its place in the text is known. `at_key`: the key is wrong rather than its value."""

    path: Location
    message: str
    value: Any = None
    allowed: str = ""
    at_key: bool = False


class DeckProblems(DeckError):
    """A DeckError that still knows its findings, so that places in a text can be added."""

    findings: list[Finding]


def path_text(path: Location) -> str:
    """Return ``("layer", 1, "zones")`` as ``layer[1].zones``."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            is_bare = len(part) < 100 and part.isascii() and part.replace("_", "").replace("-", "").isalnum()
            part = part if is_bare else shorten(part)
            text += f".{part}" if text else part
    return text or "deck"


def unknown_key(path: Location, known: Iterable[str]) -> Finding:
    """Finding for an unknown key; it suggests the nearest known key."""
    names = list(known)
    return Finding(path, "unknown key" + suggestion(str(path[-1]), names), None, one_of(names), at_key=True)


def unknown_word(path: Location, value: Any, what: str, known: Iterable[str]) -> Finding:
    """Finding for a name that is not among those allowed."""
    names = list(known)
    return Finding(path, f"{shorten(value)} is not {what}{suggestion(value, names)}", value, one_of(names))


def suggestion(word: Any, known: list[str]) -> str:
    """A phrase with the known word nearest to ``word``, or nothing."""
    if not isinstance(word, str) or len(word) > 100:
        return ""
    near = get_close_matches(word.lower().replace(" ", "_"), known, 1, 0.6)
    return f"; did you mean {near[0]}?" if near else ""


def one_of(names: list[str], most: int = 20) -> str:
    """Names as text: ``a, b or c``."""
    return ", ".join(shorten(name)[1:-1] for name in names[:most]) + (", …" if len(names) > most else "")


def allowed(field: FieldInfo) -> str:
    """Values that a field allows, as a phrase made of its unit, type and bounds."""
    extra, words = said_of(field), kinds_of(field.annotation)
    if "units" in extra:
        return f"a list of pairs ({', '.join(extra['units'])}), or the name of a CSV file"
    bounds = _bounds(field)
    if "unit" in extra or float in words:
        first = describe(str(extra.get("unit", "1")), bounds)
    else:
        names = {int: "an integer", bool: "true or false", str: "text"}
        first = " ".join(part for part in (next((names[word] for word in words if word in names), ""), bounds) if part)
    return " or ".join(part for part in (first, *(f'"{word}"' for word in words if isinstance(word, str))) if part)


def _bounds(field: FieldInfo) -> str:
    names = {"gt": "above", "ge": "at least", "lt": "below", "le": "at most"}
    found = [
        f"{phrase} {bound if isinstance(bound, int) else f'{bound:g}'}"
        for part in field.metadata
        for key, phrase in names.items()
        if (bound := getattr(part, key, None)) is not None
    ]
    unit = "characters" if str in kinds_of(field.annotation) else "values"
    lengths = [f"of at most {part.max_length} {unit}" for part in field.metadata if hasattr(part, "max_length")]
    return " and ".join(found) or " ".join(lengths)


def findings_of(
    error: ValidationError, cls: type[BaseModel], raw: Mapping[str, Any], prefix: Location
) -> list[Finding]:
    """Return pydantic's complaints about ``raw``, the values of ``cls`` at ``prefix``, one for each key."""
    found: dict[Location, Finding] = {}
    for detail in error.errors(include_url=False)[:MAX_FOUND]:
        location = detail["loc"]
        owner, values, path = cls, raw, prefix
        while len(location) > 1 and (inner := _model(owner, location[0])) is not None:
            path, location = (*path, location[0]), location[1:]
            own = values.get(str(path[-1]))
            owner, values = inner, own if isinstance(own, Mapping) else {}
        finding = _finding(detail, owner, values, path, location)
        found.setdefault(finding.path, finding)
    return list(found.values())


def _model(owner: type[BaseModel], name: str | int) -> type[BaseModel] | None:
    field = owner.model_fields.get(str(name))
    inner = field.annotation if field is not None else None
    return inner if isinstance(inner, type) and issubclass(inner, BaseModel) else None


def _finding(detail: Any, cls: type[BaseModel], raw: Mapping[str, Any], prefix: Location, own: Location) -> Finding:
    """``own`` is the error's place within ``cls``: nothing, a key, or a key with an index or a union's branch."""
    index = own[1:2] if len(own) > 1 and isinstance(own[1], int) else ()
    path = (*prefix, *own[:1], *index)
    kind = detail.get("ctx", {}).get("type", detail["type"])
    text = detail["msg"].removeprefix("Value error, ")
    field = cls.model_fields.get(str(own[0])) if own else None
    if kind == "extra_forbidden":
        return unknown_key(path, cls.model_fields)
    if field is None:
        return Finding(path, text)
    if kind == "missing":
        return Finding(path, "is missing", None, allowed(field))
    value = raw.get(str(own[0]))
    if index or kind in ("quantity", "value_error"):
        return Finding(path, text, value, allowed(field) if kind == "quantity" else "")
    hint = suggestion(value, [word for word in kinds_of(field.annotation) if isinstance(word, str)])
    reason = "is out of range" if kind.startswith(("greater", "less")) else "is not possible"
    return Finding(path, f"{shorten(value)} {reason}{hint}", value, allowed(field))


def deck_error(
    source: Path | str | None,
    findings: list[Finding],
    place: Callable[[Finding], tuple[int, int] | None] = lambda finding: None,
    origin: Callable[[Location], str] = lambda path: "",
) -> DeckProblems:
    """Return the exception with all findings, in the order of the text.

    ``place`` gives line and column of a finding; ``origin`` names the override that a value came from, if any.
    """
    problems = []
    for finding in findings:
        line, column = place(finding) or (None, None)
        path = path_text(finding.path) + origin(finding.path)
        problems.append(Problem(path, finding.message, finding.value, finding.allowed, line, column))
    problems.sort(key=lambda problem: (problem.line or 0, problem.column or 0))
    where = f"{source}: " if source else "the deck: "
    count = "1 problem" if len(problems) == 1 else f"{len(problems)} problems"
    error = DeckProblems(where + count, problems[:MAX_SHOWN])
    if len(problems) > MAX_SHOWN:
        error.args = (f"{error}\n  … and {len(problems) - MAX_SHOWN} more",)
    error.problems, error.findings = problems, findings
    return error
