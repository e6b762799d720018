"""Recording: profiles, history rows and probes are copied into tables."""

import time
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

import numpy as np

from hydro1d.solver.sink import Frame, Sink
from hydro1d.store.layout import MAXIMA, Layout, history_fields, probe_fields, profile_fields
from hydro1d.store.records import Table


class Recorder(Sink):
    """Base of the sinks of this folder: it records profiles, history, probes and maxima.

    deck_text: the deck as written; resolved: the same in SI, JSON-able; attributes: further attributes of the root,
    numbers or text, those named ``law_hash_…`` being compared on a restart.
    """

    def __init__(
        self,
        layout: Layout,
        deck_text: str = "",
        resolved: Mapping[str, Any] | None = None,
        attributes: Mapping[str, Any] | None = None,
    ) -> None:
        self.layout, self.deck_text = layout, deck_text
        self.resolved, self.attributes = dict(resolved or {}), dict(attributes or {})
        self.created = datetime.now(UTC).isoformat(timespec="seconds")
        self.zone_maxima: dict[str, np.ndarray] = {}
        self._begun = time.time()
        instants, nodes, zones = profile_fields(layout)
        columns = history_fields(layout) if layout.history else []
        probe_times, probes = probe_fields(layout)
        self.instants = Table(instants, (), layout.profiles)
        self.nodes = Table(nodes, (layout.zones + 1,), layout.profiles)
        self.zones = Table(zones, (layout.zones,), layout.profiles)
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

    def history(self, rows: np.ndarray, probes: np.ndarray) -> None:
        """Record history rows (n, columns) in the layout's order and probes (n, probe, 4); both are copied."""
        self.rows.append(rows.T)
        if self.probes.fields:
            self.probe_times.append(rows[:, :1].T)
            self.probes.append(np.moveaxis(probes, 2, 0))
        self.recorded()

    def maxima(self, zone_maxima: Mapping[str, np.ndarray]) -> None:
        """Record what was largest in each zone over the run."""
        self.zone_maxima = {
            MAXIMA[name].path: np.array(values, dtype=np.float64)
            for name, values in zone_maxima.items()
            if name in MAXIMA
        }

    def kept(self, path: str) -> np.ndarray | None:
        """What was recorded of a quantity, or what does not change with time; None if its numbers have been given up."""
        for table in self.tables:
            for index, field in enumerate(table.fields):
                if field.path == path:
                    return table.column(index)
        names = np.array(self.layout.layer_name, dtype=object)
        return {**self.layout.static(), "layer_name": names, **self.zone_maxima}.get(path)

    def recorded(self) -> None:
        """Called after records: blocks may have become full. In memory there is nothing to do."""
