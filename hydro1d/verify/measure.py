"""Runs and what is measured on them: plateaus, fronts, norms, orders."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from hydro1d.analytic import Jump, State
from hydro1d.boundaries.base import Boundary
from hydro1d.deck import Layer
from hydro1d.errors import BreakdownError
from hydro1d.solver.column import Column, build_column
from hydro1d.solver.driver import Outcome, solve
from hydro1d.solver.sink import Frame, Sink

FRONT_SHARE = 1e-4  # of the stress jump: where q has fallen below it the front has passed
START_UP = 5  # zones at the loaded end whose medians are left out; `worst` has them


class Recording(Sink):
    """A sink that keeps profiles and history; ``recording["momentum"]`` is a column of the history."""

    def __init__(self, column: Column) -> None:
        self.column = column
        self.frames: list[Frame] = []
        self._blocks: list[np.ndarray] = []
        self._probes: list[np.ndarray] = []
        self.outcome: Outcome

    def profile(self, frame: Frame) -> None:
        """Keep a profile."""
        self.frames.append(frame)

    def history(self, rows: np.ndarray, probes: np.ndarray) -> None:
        """Keep rows of history and probes."""
        self._blocks.append(np.array(rows))
        self._probes.append(np.array(probes))

    def __getitem__(self, name: str) -> np.ndarray:
        """A column of the history."""
        names = [variable.name for variable in self.column.history_variables]
        return np.concatenate([block[:, names.index(name)] for block in self._blocks])

    @property
    def probes(self) -> np.ndarray:
        """(row, probe, quantity): position, velocity, strain, stress."""
        return np.concatenate(self._probes)

    @property
    def energy_error(self) -> float:
        """Largest imbalance of the energy at any row of the history, over the energy put in."""
        return float(np.abs(self["energy_error"]).max())

    @property
    def last(self) -> dict[str, np.ndarray]:
        """Fields of the last profile."""
        return self.frames[-1].fields


def simulate(
    layers: Layer | Sequence[Layer],
    left: Boundary,
    right: Boundary,
    *,
    end: float,
    profiles: Sequence[float] = (),
    history: int = 0,
    cfl: float | None = None,
    probes: Sequence[float] = (),
) -> Recording:
    """Run a column with default settings; profiles at the given times (the end unless given).

    cfl: only for studies of the step itself. Raises BreakdownError if the run breaks down.
    """
    layers = [layers] if isinstance(layers, Layer) else list(layers)
    settings: dict[str, Any] = {} if cfl is None else {"cfl": cfl}
    column = build_column(
        layers,
        left,
        right,
        end=end,
        **settings,
        profile_times=profiles or (end,),
        history=history,
        probes=probes,
    )
    recording = Recording(column)
    recording.outcome = outcome = solve(column, recording)
    if outcome.status != "complete":
        raise BreakdownError(outcome.message, outcome.zone or 0, outcome.time, outcome.cycles)
    return recording


class Front(NamedTuple):
    """A front that runs to the right, as measured: the states on both sides, where it is, and how even its plateau is.

    worst: strain of the zone of the plateau, start-up zones included, that is farthest from the exact strain.
    spread: integral over the front of |ε − a sharp front at the exact place between the states as measured|, per strain
    jump, m: the plateau's own error, which need not converge, is no part of it.
    """

    ahead: State
    behind: State
    coordinate: float
    worst: float
    spread: float
    plateau: int


def measure_front(column: Column, fields: dict[str, np.ndarray], exact: Jump, coordinate: float, clear: float) -> Front:
    """Measure the front near ``coordinate`` of a uniform column; ahead of it the plateau reaches to ``clear`` (m)."""
    size = column.layers[0].size
    strain, q = fields["strain"], fields["viscosity"]
    arrived, beyond = int(coordinate / size), min(int(clear / size), column.zones)
    quiet = q <= FRONT_SHARE * exact.stress
    last = arrived - 3
    while last > 2 * START_UP and not quiet[last - 1]:
        last -= 1
    foot = arrived + 3
    while foot < beyond - 3 and not quiet[foot]:
        foot += 1
    behind = _median(fields, slice(START_UP, last))
    ahead = _median(fields, slice(foot, beyond))
    window = slice(last // 2, beyond)
    share = (strain[window] - ahead.strain) / (behind.strain - ahead.strain)
    place = size * (last // 2 + float(share.sum()))
    worst = strain[:last][np.argmax(np.abs(strain[:last] - exact.behind.strain))]
    sharp = np.clip(coordinate / size - np.arange(column.zones), 0.0, 1.0)[window]
    spread = size * float(np.abs(share - sharp).sum())
    return Front(ahead, behind, place, float(worst), spread, last)


def _median(fields: dict[str, np.ndarray], zones: slice) -> State:
    names = ("velocity", "stress", "strain", "density", "internal_energy")
    return State(*(float(np.median(fields[name][zones])) for name in names))
