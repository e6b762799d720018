"""What every sink shares: from the solver's frames and blocks to tables."""

from __future__ import annotations

import time
from typing import Any, Protocol

import numpy as np

from hydro1d.store.layout import Layout, history_fields, probe_fields, profile_fields
from hydro1d.store.records import Table


class Frame(Protocol):
    """A profile as the solver hands it over: `fields` over nodes (zones + 1,) and zones (zones,), SI."""

    @property
    def time(self) -> float:
        """Time, s."""

    @property
    def fields(self) -> dict[str, np.ndarray]:
        """Arrays by name."""


class Recorder:
    """Records profiles, history and probes in tables; what becomes of them is up to the sink."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self._begun = time.time()
        instants, nodes, zones = profile_fields(layout)
        expected = layout.profiles
        self.instants = Table(instants, (), expected)
        self.nodes = Table(nodes, (layout.zones + 1,), expected)
        self.zones = Table(zones, (layout.zones,), expected)
        columns = history_fields(layout) if layout.history else []
        probe_times, probes = probe_fields(layout)
        self.rows = Table(columns, ())
        self.probe_times = Table(probe_times, ())
        self.probes = Table(probes, (len(layout.probe_coordinate),))
        everything = (self.instants, self.nodes, self.zones, self.rows, self.probe_times, self.probes)
        self.tables = [table for table in everything if table.fields]

    def profile(self, frame: Frame) -> None:
        """Record a profile; the arrays are copied."""
        self.instants.append_row([frame.time])
        self.nodes.append_row([frame.fields[field.path] for field in self.nodes.fields])
        self.zones.append_row([frame.fields[field.path] for field in self.zones.fields])
        self.recorded()

    def history(self, block: np.ndarray, probes: np.ndarray) -> None:
        """Record history rows, block (n, columns) in the layout's order, and probes (n, probe, 4); both are copied."""
        self.rows.append(block.T)
        if self.probes.fields:
            self.probe_times.append(block[:, :1].T)
            self.probes.append(np.moveaxis(probes, 2, 0))
        self.recorded()

    def kept(self, path: str) -> np.ndarray | None:
        """What was recorded of a quantity, or what does not change with time; None if its numbers have been given up."""
        for table in self.tables:
            for index, field in enumerate(table.fields):
                if field.path == path:
                    return table.column(index)
        names = np.array(self.layout.layer_name, dtype=object)
        return {**self.layout.static(), "layer_name": names}.get(path)

    def recorded(self) -> None:
        """Called after each record."""

    def flush(self) -> None:
        """Called when all records up to some time are there; nothing to do where nothing is kept on disk."""

    def relieve(self) -> None:
        """Called while many records are copied: memory may be freed."""

    def checkpoint(self, state: Any) -> Any:
        """A checkpoint is due; nothing to do where nothing is kept on disk."""
