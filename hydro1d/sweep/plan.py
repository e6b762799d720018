"""A sweep: a base deck, parameters, quantities, how they combine, and what must fit together."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Literal, Self

import numpy as np
from pydantic import Field, field_validator, model_validator

from hydro1d.analysis.quantity import parse_quantity
from hydro1d.components.parameters import Component
from hydro1d.deck.messages import Finding, deck_error
from hydro1d.errors import DeckError
from hydro1d.sweep.base import base_data, check_key, si, unit_of, value_problem
from hydro1d.sweep.job import Job, override

MAX_RUNS = 1_000_000
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
    count: int | None = Field(None, ge=1, le=MAX_RUNS, description="number of values in the range")
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
    def _list_or_range(self) -> Self:
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
        """Name of the parameter's column in the table."""
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
    ) -> Self:
        """A sweep of a deck's file, text or data. Raises DeckError with everything that is wrong."""
        data, folder = base_data(base)
        sweep = cls(data, folder, tuple(parameters), tuple(quantities), tuple(overrides), plan, samples, seed, title)
        found = sweep.problems()
        if found:
            raise deck_error("the sweep", found)
        return sweep

    def problems(self) -> list[Finding]:
        """Problems between parameters, plan and quantities."""
        found = plan_problems(self, self.parameters)
        found += quantity_problems(self.quantities)
        return found + parameter_problems(self, self.parameters)

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

    def units(self) -> list[str]:
        """SI unit of each parameter's values; empty for words, counts and pure numbers, and where keys of several units move."""
        deck, units = self.jobs()[0].deck(), []
        for parameter in self.parameters:
            own = {unit_of(deck, key) for key in parameter.keys}
            units.append(own.pop() if len(own) == 1 else "")
        return units

    def jobs(self) -> list[Job]:
        """All runs of the sweep, in the table's order."""
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


def plan_problems(sweep: Sweep, parameters: Sequence[Parameter | None]) -> list[Finding]:
    """What the plan has to say against the parameters; None stands for one that is wrong itself."""
    if not parameters:
        return [Finding(("parameter",), "there is none", None, "one [[parameter]] or more")]
    found = []
    sampled = sweep.plan in SAMPLERS
    for k, parameter in enumerate(parameters):
        if parameter is None:
            continue
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
    whole = [parameter for parameter in parameters if parameter is not None]
    if found or sampled or len(whole) < len(parameters):
        return found
    return _size_problems(sweep, [len(p.values) if p.values is not None else p.count or 1 for p in whole])


def _size_problems(sweep: Sweep, lengths: list[int]) -> list[Finding]:
    if sweep.plan == "zip" and len(set(lengths)) > 1:
        return [Finding(("plan",), f'plan = "zip" needs lists of one length, not {", ".join(map(str, lengths))}')]
    if sweep.plan == "grid" and int(np.prod(np.array(lengths, dtype=float))) > MAX_RUNS:
        return [Finding(("plan",), f"the grid has more than {MAX_RUNS} points")]
    return []


def quantity_problems(quantities: Sequence[str]) -> list[Finding]:
    """Quantities that there are not."""
    found = []
    for k, text in enumerate(quantities):
        try:
            parse_quantity(text)
        except ValueError as error:
            found.append(Finding(("quantities", k), str(error), text))
    return found


def parameter_problems(sweep: Sweep, parameters: Sequence[Parameter | None]) -> list[Finding]:
    """Columns of one name, and values that the deck does not take."""
    found, names = [], [*sweep.quantities, "status", "error", "cycles", "run"]
    for k, parameter in enumerate(parameters):
        if parameter is None:
            continue
        if parameter.label in names:
            found.append(Finding(("parameter", k), f"two columns would be called {parameter.label}", parameter.label))
        names.append(parameter.label)
        found += _value_problems(sweep, k, parameter)
    return found


def _value_problems(sweep: Sweep, k: int, parameter: Parameter) -> list[Finding]:
    """What the deck says against the values as they are written, each on its own."""
    tried: list[tuple[tuple[str | int, ...], Any]]
    if parameter.values is not None:
        tried = [(("values", n), value) for n, value in enumerate(parameter.values[:100])]
    else:
        texts = {name: getattr(parameter, name) for name in ("first", "last")}
        tried = [((name,), _at_end(parameter, text)) for name, text in texts.items() if text is not None]
    found = []
    for place, value in tried:
        for key in parameter.keys:
            problem = value_problem(sweep.data, sweep.folder, key, value, sweep.overrides)
            if problem is not None:
                found.append(Finding(("parameter", k, *place), f"{key}: {problem}", value))
    return found


def _at_end(parameter: Parameter, text: Any) -> Any:
    """An end of a range as it is tried: a text as written, a number as the runs get it."""
    if isinstance(text, str) or not parameter.integer:
        return text
    return round(text)
