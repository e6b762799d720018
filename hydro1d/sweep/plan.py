"""SWEEP.toml: a base deck, parameters, quantities. Its mistakes are told like a deck's: at once, with their place."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import Field, ValidationError, field_validator, model_validator

from hydro1d.deck.messages import Finding, deck_error, findings_of
from hydro1d.deck.positions import Positions
from hydro1d.deck.read import parse, read_text
from hydro1d.errors import DeckError, FileProblem
from hydro1d.parameters import Component
from hydro1d.sweep.base import base_data, check_key, si, value_problem
from hydro1d.sweep.job import Job, override
from hydro1d.sweep.quantity import parse_quantity

MOST_RUNS = 1_000_000
SAMPLERS = ("sobol", "halton", "latin-hypercube", "random")
Plan = Literal["grid", "zip", "sobol", "halton", "latin-hypercube", "random"]


class Parameter(Component):
    """One parameter: a deck's key (or several that move together) and its values, as a list or a range.

    ``values`` is a list; ``first``, ``last`` and, except for samples, ``count`` make a range.
    """

    key: str | tuple[str, ...] = Field(..., description="path of a deck's key, such as left.peak, or a list of them")
    column: str = Field("", max_length=100, description="name of its column; the key unless given")
    values: tuple[Any, ...] | None = Field(None, description="a list of values")
    first: Any = Field(None, description="where a range begins, a number or a text with a unit")
    last: Any = Field(None, description="where it ends")
    count: int | None = Field(None, ge=1, le=MOST_RUNS, description="number of values in the range")
    spacing: Literal["linear", "log"] = Field("linear", description="how the range is divided")
    integer: bool = Field(False, description="round the values of a range to integers")

    @field_validator("key")
    @classmethod
    def _is_a_path(cls, key: str | tuple[str, ...]) -> str | tuple[str, ...]:
        for text in (key,) if isinstance(key, str) else key:
            try:
                check_key(text)
            except DeckError as error:
                raise ValueError(str(error)) from None
        return key

    @model_validator(mode="after")
    def _list_or_range(self) -> Parameter:
        has_range = self.first is not None and self.last is not None
        if (self.values is None) == (not has_range):
            raise ValueError("needs either values, a list, or a range with first and last")
        if self.values is not None and not self.values:
            raise ValueError("values is an empty list")
        if has_range:
            low, high = self.ends
            if not all(isinstance(end, int | float) and not isinstance(end, bool) for end in (low, high)):
                raise ValueError(
                    f"first and last must be numbers, or texts with a unit, not {self.first!r} and {self.last!r}"
                )
            if self.spacing == "log" and min(low, high) <= 0.0:
                raise ValueError('spacing = "log" needs first and last above zero')
        return self

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys that this parameter sets."""
        return (self.key,) if isinstance(self.key, str) else tuple(self.key)

    @property
    def label(self) -> str:
        """Name of its column."""
        return self.column or self.keys[0]

    @property
    def ends(self) -> tuple[Any, Any]:
        """First and last of the range in SI."""
        return si(self.first), si(self.last)

    def at(self, shares: Sequence[float] | np.ndarray) -> list[Any]:
        """Values at shares 0 … 1 of the range; exact at both ends."""
        low, high = (float(end) for end in self.ends)
        values = []
        for share in shares:
            inside = low * (high / low) ** share if self.spacing == "log" else low + (high - low) * share
            value = low if share == 0.0 else high if share == 1.0 else float(inside)
            values.append(round(value) if self.integer else value)
        return values

    def listed(self) -> list[Any]:
        """All values of a list or a counted range, SI."""
        if self.values is not None:
            return [si(value) for value in self.values]
        count = self.count or 1
        return self.at([k / (count - 1) for k in range(count)] if count > 1 else [0.0])


class _File(Component):
    title: str = Field("", max_length=1000, description="a line of text")
    deck: str = Field(..., description="the base deck's file, relative to this one")
    set: tuple[str, ...] = Field((), description="overrides for every run, such as layer[0].zones=200")
    plan: Plan = Field("grid", description="how parameters combine")
    samples: int | None = Field(None, ge=1, le=MOST_RUNS, description="number of samples")
    seed: int = Field(0, ge=0, description="seed of the samples")
    quantities: tuple[str, ...] = Field(..., min_length=1, description="quantities to take from each run")


@dataclass(frozen=True)
class Sweep:
    """A sweep: base deck (as data, with the folder of its files), parameters, quantities and how parameters combine.

    In Python::

        Sweep.of("pulse.toml", [Parameter(key="left.peak", values=("2 MPa", "3 MPa"))], ["peak_support_stress"])
    """

    data: Mapping[str, Any]
    folder: str
    parameters: tuple[Parameter, ...]
    quantities: tuple[str, ...]
    overrides: tuple[str, ...] = ()
    plan: Plan = "grid"
    samples: int | None = None
    seed: int = 0
    title: str = ""
    _cache: dict = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def of(
        cls,
        base: str | Path | Mapping[str, Any],
        parameters: Sequence[Parameter],
        quantities: Sequence[str],
        overrides: Sequence[str] = (),
        plan: Plan = "grid",
        samples: int | None = None,
        seed: int = 0,
        title: str = "",
    ) -> Sweep:
        """A sweep of a deck's file, text or data. Raises DeckError with everything that is wrong."""
        data, folder = base_data(base)
        sweep = cls(data, folder, tuple(parameters), tuple(quantities), tuple(overrides), plan, samples, seed, title)
        found = sweep.problems()
        if found:
            raise deck_error("the sweep", found)
        return sweep

    def problems(self) -> list[Finding]:
        """What is wrong between the parts."""
        found = _plan_problems(self)
        found += [
            problem for k, text in enumerate(self.quantities) if (problem := _quantity_problem(k, text)) is not None
        ]
        names = [parameter.label for parameter in self.parameters]
        for k, name in enumerate(names):
            if name in names[:k] or name in self.quantities or name in ("status", "error", "cycles", "run"):
                found.append(Finding(("parameter", k), f"two columns would be called {name}", name))
        for k, parameter in enumerate(self.parameters):
            found += _value_problems(self, k, parameter)
        return found

    @cached_property
    def _points(self) -> list[tuple[Any, ...]]:
        if self.plan in SAMPLERS:
            shares = _samples(self.plan, len(self.parameters), self.samples or 1, self.seed)
            return list(zip(*(p.at(shares[:, k]) for k, p in enumerate(self.parameters)), strict=True))
        lists = [parameter.listed() for parameter in self.parameters]
        return list(zip(*lists, strict=True) if self.plan == "zip" else itertools.product(*lists))

    def points(self) -> list[tuple[Any, ...]]:
        """Values of the parameters of each run, SI; in a grid the first parameter changes slowest."""
        return self._points

    def jobs(self) -> list[Job]:
        """The runs to do."""
        jobs = []
        for point in self.points():
            own = [override(key, value) for p, value in zip(self.parameters, point, strict=True) for key in p.keys]
            jobs.append(Job(self.data, self.folder, (*self.overrides, *own), self.quantities))
        return jobs


def _samples(plan: str, dimensions: int, count: int, seed: int) -> np.ndarray:
    """Points of the unit cube (count, dimensions), the same for the same seed."""
    from scipy.stats import qmc

    random = np.random.default_rng(seed)
    if plan == "random":
        return random.random((count, dimensions))
    kinds = {"sobol": qmc.Sobol, "halton": qmc.Halton, "latin-hypercube": qmc.LatinHypercube}
    return kinds[plan](dimensions, seed=random).random(count)


def _plan_problems(sweep: Sweep) -> list[Finding]:
    if not sweep.parameters:
        return [Finding(("parameter",), "there is none", None, "one [[parameter]] or more")]
    found = []
    sampled = sweep.plan in SAMPLERS
    for k, parameter in enumerate(sweep.parameters):
        if sampled and parameter.values is not None:
            found.append(
                Finding(("parameter", k, "values"), f'plan = "{sweep.plan}" samples ranges', None, "first and last")
            )
        if sampled and parameter.count is not None:
            found.append(
                Finding(("parameter", k, "count"), "samples have no count of their own", None, "samples = … at the top")
            )
        if not sampled and parameter.values is None and parameter.count is None:
            found.append(Finding(("parameter", k, "count"), "is missing", None, "the number of values in the range"))
    if sampled and sweep.samples is None:
        found.append(Finding(("samples",), "is missing", None, f'the number of samples of plan = "{sweep.plan}"'))
    if not sampled and sweep.samples is not None:
        found.append(
            Finding(("samples",), f'plan = "{sweep.plan}" takes no samples', None, f"with plan = {', '.join(SAMPLERS)}")
        )
    if found or sampled:
        return found
    lengths = [len(p.values) if p.values is not None else p.count or 1 for p in sweep.parameters]
    if sweep.plan == "zip" and len(set(lengths)) > 1:
        found.append(Finding(("plan",), f'plan = "zip" needs lists of one length, not {", ".join(map(str, lengths))}'))
    if sweep.plan == "grid" and int(np.prod(np.array(lengths, dtype=float))) > MOST_RUNS:
        found.append(Finding(("plan",), f"the grid has more than {MOST_RUNS} points"))
    return found


def _quantity_problem(k: int, text: str) -> Finding | None:
    try:
        parse_quantity(text)
    except ValueError as error:
        return Finding(("quantities", k), str(error), text)
    return None


def _value_problems(sweep: Sweep, k: int, parameter: Parameter) -> list[Finding]:
    """What the deck says against the values as they are written, each on its own."""
    tried: list[tuple[tuple[str | int, ...], Any]]
    if parameter.values is not None:
        tried = [(("values", n), value) for n, value in enumerate(parameter.values[:100])]
    else:
        low, high = (round(end) if parameter.integer else end for end in parameter.ends)
        texts = (parameter.first, parameter.last)
        ends = zip(("first", "last"), texts, (low, high), strict=True)
        tried = [((name,), text if isinstance(text, str) else number) for name, text, number in ends]
    found = []
    for place, value in tried:
        for key in parameter.keys:
            problem = value_problem(sweep.data, sweep.folder, key, value, sweep.overrides)
            if problem is not None:
                found.append(Finding(("parameter", k, *place), f"{key}: {problem}", value))
    return found


def load_sweep(path: str | Path) -> Sweep:
    """Read a SWEEP.toml. Raises DeckError with every mistake, its line and column; FileProblem if it "
    "cannot be read."""
    path = Path(path)
    text = read_text(path)
    data = parse(text, path)
    rows = data.pop("parameter", [])
    found: list[Finding] = []
    parameters = []
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        found.append(Finding(("parameter",), "must be written as [[parameter]]", None, "[[parameter]]"))
        rows = []
    for k, row in enumerate(rows):
        try:
            parameters.append(Parameter(**row))
        except ValidationError as error:
            found += findings_of(error, Parameter, row, ("parameter", k))
    file, base = None, None
    try:
        file = _File(**data)
    except ValidationError as error:
        found += findings_of(error, _File, data, ())
    if file is not None:
        base = _base(path.parent / file.deck, file, found)
    if not found and file is not None and base is not None:
        sweep = Sweep(
            *base, tuple(parameters), file.quantities, file.set, file.plan, file.samples, file.seed, file.title
        )
        found = sweep.problems()
        if not found:
            return sweep
    positions = Positions(text)
    raise deck_error(path, found, lambda finding: positions.find(finding.path, finding.at_key))


def _base(path: Path, file: _File, found: list[Finding]) -> tuple[dict[str, Any], str] | None:
    """The base deck's data; it must be right with the overrides of every run."""
    try:
        data, folder = base_data(path)
    except FileProblem as error:
        found.append(Finding(("deck",), str(error), file.deck))
        return None
    Job(data, folder, file.set).deck()
    return data, folder
