"""What a case of the verification suite is."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

from hydro1d.verify.rows import Table


@dataclass(frozen=True)
class Effort:
    """How fine the runs are: the default suite takes a minute, the full one adds finer resolutions."""

    full: bool = False

    def zones(self, coarsest: int, levels: int = 3) -> tuple[int, ...]:
        """Numbers of zones, each twice the one before; the full suite adds one more doubling."""
        return tuple(coarsest * 2**k for k in range(levels + self.full))


@dataclass(frozen=True)
class Case:
    """One entry of the suite.

    `study(table, effort)` runs the solver and fills the table with exactly `rows` rows; about: what is run and
    compared, one paragraph, for the report.
    """

    name: str
    title: str
    about: str
    rows: int
    study: Callable[[Table, Effort], None]

    @classmethod
    def of(cls, name: str, title: str, rows: int, study: Callable[[Table, Effort], None]) -> Self:
        """A case about which the docstring of its study says what there is to say."""
        told = inspect.getdoc(getattr(study, "func", study)) or ""
        return cls(name, title, " ".join(told.split()), rows, study)
