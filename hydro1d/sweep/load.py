"""SWEEP.toml. Mistakes are reported as for a deck: all in one message, each with its line."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from pydantic import Field, ValidationError

from hydro1d.components.parameters import Component
from hydro1d.deck.messages import Finding, Location, deck_error, findings_of
from hydro1d.deck.positions import Positions
from hydro1d.deck.read import parse, read_text
from hydro1d.errors import DeckError, FileProblem, Problem
from hydro1d.sweep.base import base_data, check_key
from hydro1d.sweep.job import Job
from hydro1d.sweep.plan import MAX_RUNS, Parameter, Plan, Sweep, parameter_problems, plan_problems, quantity_problems

_Part = TypeVar("_Part", bound=Component)


class _File(Component):
    title: str = Field("", max_length=1000, description="a line of text")
    deck: str = Field(..., description="the base deck's file, relative to this one")
    set: tuple[str, ...] = Field((), description="overrides for every run, such as layer[0].zones=200")
    plan: Plan = Field("grid", description="how parameters combine")
    samples: int | None = Field(None, ge=1, le=MAX_RUNS, description="number of samples")
    seed: int = Field(0, ge=0, description="seed of the samples")
    quantities: tuple[str, ...] = Field(..., min_length=1, description="quantities to take from each run")


def load_sweep(path: str | Path) -> Sweep:
    """Read a SWEEP.toml.

    Raises DeckError with every mistake of the file and of its deck, with line and column, FileProblem if the file
    cannot be read.
    """
    path = Path(path)
    text = read_text(path, "sweep")
    data = parse(text, path)
    if "layer" in data and "deck" not in data:
        raise DeckError(f"{path} is a deck, not a sweep: hydro1d run takes it; a sweep names it with deck = …")
    rows = data.pop("parameter", [])
    found: list[Finding] = []
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        found.append(Finding(("parameter",), "must be written as [[parameter]]", None, "[[parameter]]"))
        rows = []
    parameters = [_validated(Parameter, row, ("parameter", k), found) for k, row in enumerate(rows)]
    shown = [parameter or _partial(row) for parameter, row in zip(parameters, rows, strict=True)]
    file = _validated(_File, data, (), found)
    wrong = {finding.path[0] for finding in found}
    file = file or _stand_in(data, wrong)
    base = None if "deck" in wrong else _base(path.parent, file, found)
    sound = tuple(parameter for parameter in parameters if parameter is not None)
    rejected = {finding.path[1] for finding in found if finding.path[0] == "set" and len(finding.path) > 1}
    overrides = tuple(text for n, text in enumerate(file.set) if n not in rejected)
    sweep = Sweep(
        *(base or ({}, "")), sound, file.quantities, overrides, file.plan, file.samples, file.seed, file.title
    )
    if not {"plan", "samples"} & wrong and (rows or "parameter" not in wrong):
        found += plan_problems(sweep, parameters)
    found += quantity_problems(file.quantities)
    found += parameter_problems(sweep, shown) if base is not None else []
    if not found:
        return sweep
    positions = Positions(text)
    raise deck_error(path, found, lambda finding: positions.find(finding.path, finding.at_key))


def _validated(cls: type[_Part], values: dict[str, Any], path: Location, found: list[Finding]) -> _Part | None:
    try:
        return cls(**values)
    except ValidationError as error:
        found += findings_of(error, cls, values, path)
        return None


def _stand_in(data: Mapping[str, Any], wrong: set[str | int]) -> _File:
    """The file without the keys that are wrong, so that the others are checked all the same."""
    right = {key: value for key, value in data.items() if key in _File.model_fields and key not in wrong}
    lists: dict[str, Any] = {key: tuple(right[key]) for key in ("set", "quantities") if key in right}
    values: dict[str, Any] = {"deck": "", "quantities": (), **right, **lists}
    return _File.model_construct(**values)


def _partial(row: Mapping[str, Any]) -> Parameter | None:
    """What of a wrong parameter can be held against the deck: its key with the values that stand there."""
    try:
        check_key(str(row.get("key")))
    except DeckError:
        return None
    values = row.get("values")
    held = (
        {"values": tuple(values)} if isinstance(values, list) else {name: row.get(name) for name in ("first", "last")}
    )
    return Parameter.model_construct(key=row["key"], column=str(row.get("column", "")), **held)


def _base(folder: Path, file: _File, found: list[Finding]) -> tuple[dict[str, Any], str] | None:
    """The base deck's data; it must be right with the overrides of every run."""
    try:
        data, files = base_data(folder / file.deck)
    except (FileProblem, DeckError) as error:
        found.append(Finding(("deck",), " ".join(str(error).split()), file.deck))
        return None
    try:
        Job(data, files, file.set).deck()
    except DeckError as error:
        found += [_in_base(problem, file) for problem in error.problems]
        found += [] if error.problems else [Finding(("deck",), f"{file.deck}: {error}", file.deck)]
    return data, files


def _in_base(problem: Problem, file: _File) -> Finding:
    """A mistake of the deck, placed at the override that made it, else at the deck's name."""
    text = f"{problem.path}: {problem.message}"
    for n, override_text in enumerate(file.set):
        if f"(--set {override_text[:100]})" in problem.path or (
            problem.path == "--set" and repr(override_text) in text
        ):
            where = problem.path.replace(f" (--set {override_text[:100]})", "")
            return Finding(("set", n), f"{where}: {problem.message}", problem.value, problem.allowed)
    return Finding(("deck",), f"in {file.deck}, {text}", problem.value, problem.allowed)
