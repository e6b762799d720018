"""Made-up runs: data that look like a shock in foam, without a solver."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hydro1d.store import Layout
from hydro1d.variables import HISTORY, NODE, ZONE, Variable

DECK_TEXT = 'title = "Made up – σ"\n[time]\nend = "8 ms"\n'
RESOLVED = {
    "title": "Made up – σ",
    "material": {"foam": {"law": "epph", "modulus": 22e6}},
    "left": {"type": "pressure"},
    "time": {"end": 0.008, "cfl": 0.5},
    "output": {"profiles": [0.0, 0.008], "history": 1},
}
ATTRIBUTES = {"law_hash_foam": "abc123"}
EXTRA = (Variable("largest_strain", "1", "largest strain so far"),)


@dataclass
class Frame:
    time: float
    cycle: int
    fields: dict[str, np.ndarray]


@dataclass
class State:
    """What a solver would save."""

    cycle: int
    position: np.ndarray
    contact: bool = True

    @property
    def time(self) -> float:
        return self.cycle * 1e-6

    def arrays(self) -> dict[str, Any]:
        return {
            "ledger": np.array([self.time, self.cycle, np.nan, -0.0]),
            "steps": np.int64(self.cycle),
            "position": self.position,
            "contact": np.array([self.contact, False]),
            "table": np.arange(6.0).reshape(2, 3) * np.pi,
            "nothing": np.empty(0),
        }


def layout(zones: int = 50, probes: int = 2, profiles: int | None = None) -> Layout:
    nodes = np.linspace(0.0, 1.0, zones + 1)
    middle = zones // 2
    return Layout(
        node_coordinate=nodes,
        zone_coordinate=0.5 * (nodes[1:] + nodes[:-1]),
        zone_mass=np.full(zones, 51.6 / zones),
        zone_layer=(np.arange(zones) >= middle).astype(int),
        layer_name=("foam", "Schaum – µ"),
        zone_history=EXTRA,
        history=HISTORY,
        probe_coordinate=np.linspace(0.25, 0.75, probes),
        profiles=profiles,
    )


def frame(number: int, zones: int = 50, of: int = 200) -> Frame:
    """A front that moves to the right, noise behind it; the same for the same number."""
    rng = np.random.default_rng(number)
    x = np.linspace(0.0, 1.0, zones + 1)
    fields = {}
    for index, variable in enumerate((*NODE, *ZONE, *EXTRA)):
        values = np.where(x < number / of, (index + 1) * 1e5 * (1.0 + 1e-4 * rng.standard_normal(zones + 1)), 0.0)
        fields[variable.name] = values if variable in NODE else values[:-1]
    fields["viscosity"] = fields["viscosity"].copy()
    fields["viscosity"][0] = np.nan
    return Frame(number * 4e-5, 35 * number, fields)


def rows(number: int, count: int = 35, probes: int = 2) -> tuple[np.ndarray, np.ndarray]:
    """History between two profiles."""
    rng = np.random.default_rng(1000 + number)
    block = rng.standard_normal((count, len(HISTORY)))
    block[:, 0] = (number + (1 + np.arange(count)) / count) * 4e-5
    return block, rng.standard_normal((count, probes, 4))


def record(sink: Any, first: int, last: int, zones: int = 50, probes: int = 2) -> None:
    """Hand over the profiles first … last - 1 and the history after each."""
    for number in range(first, last):
        sink.profile(frame(number, zones))
        sink.history(*rows(number, probes=probes))
        sink.flush()


def expected(profiles: int, zones: int = 50, probes: int = 2) -> dict[str, np.ndarray]:
    """All arrays that a file must hold after `record(sink, 0, profiles)`, by path."""
    frames = [frame(number, zones) for number in range(profiles)]
    blocks = [rows(number, probes=probes) for number in range(profiles)]
    arrays = {name: np.array([f.fields[name] for f in frames]) for name in frames[0].fields}
    arrays["time"] = np.array([f.time for f in frames])
    history = np.concatenate([block for block, _ in blocks])
    for index, variable in enumerate(HISTORY[1:], 1):
        arrays[f"history/{variable.name}"] = history[:, index]
    at_probes = np.concatenate([values for _, values in blocks])
    for index, name in enumerate(("position", "velocity", "strain", "stress")):
        arrays[f"probes/{name}"] = at_probes[:, :, index]
    arrays["history/history_time"] = arrays["probes/history_time"] = history[:, 0]
    return arrays


def maxima(zones: int = 50) -> dict[str, np.ndarray]:
    return {"largest_strain": np.linspace(0, 0.7, zones)}
