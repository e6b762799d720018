"""Results without a file: for sweeps and notebooks."""

from typing import Any

import numpy as np

from hydro1d.store.layout import MAXIMA, STATIC, Field
from hydro1d.store.recorder import Recorder
from hydro1d.store.run import Run


class MemorySource:
    """Arrays and their descriptions by path."""

    name = "this run"

    def __init__(self, recorder: Recorder, attributes: dict[str, Any]) -> None:
        fields = [field for table in recorder.tables for field in table.fields]
        fields += [STATIC[path] for path in (*recorder.layout.static(), "layer_name")] + list(MAXIMA.values())
        kept = {field: recorder.kept(field.path) for field in fields}
        self._arrays = {field.path: array for field, array in kept.items() if array is not None}
        self._fields = {field.path: field for field in fields}
        self.names = tuple(self._arrays)
        self.deck_text, self.deck, self.attributes = recorder.deck_text, recorder.resolved, attributes

    def array(self, path: str) -> np.ndarray:
        """Values of a quantity, SI."""
        return self._arrays[path]

    def forget(self) -> None:
        """Do nothing: there is no file to read the arrays from."""

    def describe(self, path: str) -> Field:
        """Dimensions, unit and description of a quantity."""
        return self._fields[path]


class MemorySink(Recorder):
    """Keeps what the solver hands over; `finish` turns it into a `Run`. Checkpoints are not kept."""

    def finish(self, status: str, cycles: int, wall_seconds: float, **more: Any) -> Run:
        """The run as it stands; `more`: further attributes."""
        attributes = {
            "title": str(self.resolved.get("title", "")),
            "status": status,
            "cycles": int(cycles),
            "wall_seconds": float(wall_seconds),
            **self.attributes,
            **{name: value for name, value in more.items() if value is not None},
        }
        return Run(MemorySource(self, attributes))
