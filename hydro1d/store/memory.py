"""Results without a file: for sweeps and notebooks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hydro1d.store.layout import MAXIMA, STATIC, Field, Layout
from hydro1d.store.recorder import Recorder
from hydro1d.store.run import Run


class MemorySource:
    """Arrays and their descriptions by path."""

    name = "this run"

    def __init__(
        self, arrays: dict[str, np.ndarray], fields: dict[str, Field], deck_text: str, deck: dict, attributes: dict
    ) -> None:
        self._arrays, self._fields = arrays, fields
        self.names = tuple(arrays)
        self.deck_text, self.deck, self.attributes = deck_text, deck, attributes

    def array(self, path: str) -> np.ndarray:
        """Values, SI."""
        return self._arrays[path]

    def forget(self) -> None:
        """Nothing: there is no file to read it from."""

    def describe(self, path: str) -> Field:
        """Dimensions, unit, description."""
        return self._fields[path]


class MemorySink(Recorder):
    """Keeps what the solver hands over; `finish` turns it into a `Run`. Checkpoints are not kept."""

    def __init__(
        self,
        layout: Layout,
        deck_text: str = "",
        resolved: Mapping[str, Any] | None = None,
        attributes: Mapping[str, Any] | None = None,
    ) -> None:
        super().__init__(layout)
        self._deck_text, self._resolved, self._attributes = deck_text, dict(resolved or {}), dict(attributes or {})
        self._maxima: dict[str, np.ndarray] = {}

    def maxima(self, zone_maxima: Mapping[str, np.ndarray]) -> None:
        """Largest strain and stress of each zone, at the end."""
        self._maxima = {name: np.array(zone_maxima[name], dtype=np.float64) for name in MAXIMA if name in zone_maxima}

    def finish(self, status: str, cycles: int, wall_seconds: float, **more: Any) -> Run:
        """The run as it stands; `more`: further attributes."""
        fields: dict[str, Field] = {field.path: field for table in self.tables for field in table.fields}
        fields |= {path: STATIC[path] for path in (*self.layout.static(), "layer_name")}
        kept = {path: self.kept(path) for path in fields}
        arrays = {path: array for path, array in kept.items() if array is not None}
        for name, array in self._maxima.items():
            field = MAXIMA[name]
            arrays[field.path], fields[field.path] = array, field
        attributes = {
            "title": str(self._resolved.get("title", "")),
            "status": status,
            "cycles": int(cycles),
            "wall_seconds": float(wall_seconds),
            **self._attributes,
            **{name: value for name, value in more.items() if value is not None},
        }
        return Run(MemorySource(arrays, fields, self._deck_text, self._resolved, attributes))
