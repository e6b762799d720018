"""Where figures are made: runs as HDF5 files, tables, numbers, and the pictures drawn from them."""

import csv
import io
import math
import re
import time
import tomllib
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, Self

import numpy as np

from hydro1d.api import run
from hydro1d.deck import load_deck
from hydro1d.errors import FileProblem
from hydro1d.plot import Picture as Drawing
from hydro1d.store import Run
from hydro1d.studies.harrigan2010 import foam
from hydro1d.sweep import Column, Table, read_table
from hydro1d.sweep.base import base_data
from hydro1d.threads import threads_here


class Number(NamedTuple):
    """One number in three columns: what the paper prints, what its equations give, what the solver gives."""

    figure: str
    quantity: str
    unit: str
    paper: float
    equations: float
    solver: float
    note: str = ""

    @property
    def difference(self) -> float:
        """Solver against equations, else equations against paper, as a share."""
        pair = (self.equations, self.solver) if not math.isnan(self.solver) else (self.paper, self.equations)
        return pair[1] / pair[0] - 1.0 if pair[0] else float("nan")


class Picture(NamedTuple):
    """A finished figure: name, title, what to see."""

    name: str
    title: str
    caption: str

    @property
    def figure(self) -> str:
        """The figure's number as in numbers.csv: fig11a is 11a, new2_peak_map is new 2."""
        kind, number = re.fullmatch(r"(fig|new)0*(\d+[ab]?)(?:_\w+)?", self.name).groups()  # type: ignore[union-attr]
        return number if kind == "fig" else f"new {number}"


@dataclass(frozen=True)
class Size:
    """How much is computed: everything, or enough to see that it works."""

    pressures: int = 30
    zones: int = 100
    masses: tuple[int, ...] = (10, 20, 50, 100, 500)
    mass_pressures: int = 13
    tolerance: float = 1e-3
    map_points: int = 22
    strip_points: int = 25
    band_points: int = 161
    energy_pressures: int = 10
    fine_zones: int = 1000
    striker_points: int = 8
    steps: int = 9
    stiffness: tuple[float, float] = (2500.0, 10000.0)
    unloading: tuple[float, ...] = (5.0, 20.0)
    studies: bool = True


QUICK = Size(
    pressures=6,
    zones=50,
    masses=(10, 20),
    mass_pressures=4,
    tolerance=5e-3,
    map_points=9,
    strip_points=9,
    band_points=41,
    energy_pressures=4,
    fine_zones=400,
    striker_points=3,
    steps=4,
    stiffness=(1000.0, 4000.0),
    unloading=(20.0,),
    studies=False,
)


class Workshop:
    """The folder that everything goes to, and what has been made so far."""

    def __init__(
        self, folder: Path, size: Size, pool: Executor | None = None, say: Callable[[str], None] = print
    ) -> None:
        self.folder, self.size, self.say = folder, size, say
        self.pool = pool or ThreadPoolExecutor(threads_here())
        self.data = folder / "data"
        self.numbers: list[Number] = []
        self.pictures: list[Picture] = []
        try:
            self.data.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileProblem(f"cannot write {folder}: {error.strerror}") from None

    def run(self, deck: str, label: str, overrides: Sequence[str] = ()) -> Run:
        """Run one of the paper's decks into ``data/LABEL.h5`` and open the file."""
        return run(load_deck(deck_path(deck), overrides), self.data / f"{label}.h5")

    def table(self, label: str, table: Table) -> Table:
        """Write a table as HDF5 and read it back: figures are drawn from files."""
        table.write_hdf5(self.data / f"{label}.h5")
        return read_table(self.data / f"{label}.h5")

    def number(
        self,
        figure: str,
        quantity: str,
        unit: str,
        *,
        paper: Any = math.nan,
        equations: Any = math.nan,
        solver: Any = math.nan,
        note: str = "",
    ) -> None:
        """Keep a number for numbers.csv; one that is known in no column is none."""
        item = Number(figure, quantity, unit, float(paper), float(equations), float(solver), note)
        if not all(math.isnan(value) for value in (item.paper, item.equations, item.solver)):
            self.numbers.append(item)

    def picture(self, name: str, figure: Drawing, data: Table, **values: Any) -> None:
        """Write NAME.png, NAME.svg and NAME.csv; ``values`` are those that its caption in pictures.toml has in braces."""
        import matplotlib

        figure.savefig(self.folder / f"{name}.png", dpi=130)
        with matplotlib.rc_context({"svg.hashsalt": name}):
            figure.savefig(self.folder / f"{name}.svg", metadata={"Date": None})
        data.write_csv(self.folder / f"{name}.csv")
        words = tomllib.loads(Path(__file__).with_name("pictures.toml").read_text(encoding="utf-8"))[name]
        caption = words["caption"].format(beta=foam.BETA, gamma=foam.GAMMA, **values)
        self.pictures.append(Picture(name, words["title"], caption))

    def write_numbers(self) -> None:
        """numbers.csv: figure, quantity, paper, equations, solver, then unit, difference and note."""
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["figure", "quantity", "paper", "equations", "solver", "unit", "difference", "note"])
        for item in self.numbers:
            values = [f"{x:.6g}" if x == x else "" for x in (item.paper, item.equations, item.solver)]
            change = f"{item.difference:.2e}" if item.difference == item.difference else ""
            writer.writerow([item.figure, item.quantity, *values, item.unit, change, item.note])
        (self.folder / "numbers.csv").write_text(out.getvalue(), encoding="utf-8")

    def timed(self, label: str, work: Callable[[Self], None]) -> None:
        """Do a part of the work and say how long it took."""
        begun = time.perf_counter()
        work(self)
        self.say(f"{label:<12}{time.perf_counter() - begun:7.1f} s")


def deck_path(name: str) -> Path:
    """One of the decks of the paper: in the package where it was installed, in ``cases`` of a working copy."""
    here = Path(__file__).parent
    root = here.parents[2]
    for folder in (here / "cases", here / "cases" / "paper", root / "cases" / "paper", root / "cases"):
        if (folder / name).is_file():
            return folder / name
    raise FileProblem(f"the deck {name} is not part of this installation")


def deck_data(name: str) -> dict[str, Any]:
    """The data of one of the paper's decks, as nested tables."""
    return base_data(deck_path(name))[0]


def columns(**named: Sequence[float] | np.ndarray) -> Table:
    """A table of series of any length: shorter ones end in NaN. Names are as given, ``__`` and a unit behind them."""
    longest = max(len(values) for values in named.values())
    made = []
    for name, values in named.items():
        padded = [float(value) for value in values] + [math.nan] * (longest - len(values))
        label, _, unit = name.partition("__")
        unit = unit.replace("m_s", "m s-1")
        made.append(Column(f"{label} ({unit})" if unit else label, unit, label, padded))
    return Table(made)


def plain(criterion: str) -> str:
    """The name of an outcome in words, fully_crushed as "fully crushed"."""
    return criterion.replace("_", " ")


def new_figure(width: float = 6.4, height: float = 4.4, **grid: Any) -> tuple[Drawing, Any]:
    """A figure with its axes, without pyplot's global state."""
    figure = Drawing(figsize=(width, height), layout="constrained")
    axes = figure.subplots(**grid)
    for ax in np.atleast_1d(axes).flat:
        ax.grid(alpha=0.25)
        ax.spines[["top", "right"]].set_visible(False)
    return figure, axes
