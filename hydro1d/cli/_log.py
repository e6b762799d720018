"""A run's messages for other programs: JSON, one object a line."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from hydro1d.errors import file_problems

if TYPE_CHECKING:
    from hydro1d.deck import Deck
    from hydro1d.store import Run

INTERVAL = 1.0  # s of wall time between two messages of progress


class JsonLog:
    """Writes {"event": "start", …} and so on, values in SI, to a file or (-) standard output.

    Events: start, compiling (for each kernel that is not in the cache), progress, done or error.
    """

    def __init__(self, target: Path) -> None:
        from hydro1d.cli._common import refuse_result

        self._began = self._last = time.monotonic()
        self.on_standard_output = str(target) == "-"
        self._stream: TextIO = sys.stdout
        if not self.on_standard_output:
            with file_problems("write", target):
                self._stream = open(refuse_result(target), "w", encoding="utf-8")  # noqa: SIM115

    def write(self, event: str, **values: Any) -> None:
        """One line, at once readable by whoever follows the file."""
        finite = {
            name: None if isinstance(value, float) and value != value else value for name, value in values.items()
        }
        record = {"event": event, "wall": round(time.monotonic() - self._began, 3), **finite}
        print(json.dumps(record), file=self._stream, flush=True)

    def start(self, deck: Deck, output: Path) -> None:
        """Write the event `start`: title, result, zones, end time."""
        zones = sum(layer.zones for layer in deck.layers)
        self.write("start", title=deck.title, output=str(output), zones=zones, end_time=deck.time.end)

    def compiling(self, what: str) -> None:
        """A kernel that is compiled now; the next run finds it in the cache."""
        self.write("compiling", what=what)

    def progress(self, share: float) -> None:
        """Write the event `progress`, once every `INTERVAL`."""
        if time.monotonic() - self._last >= INTERVAL:
            self._last = time.monotonic()
            seen = {name: getattr(share, name) for name in ("time", "cycles") if hasattr(share, name)}
            self.write("progress", share=round(float(share), 6), **seen)

    def done(self, result: Run, output: Path) -> None:
        """Write the event `done`: status, peaks, energy error."""
        history = result.history
        last = ("peak_left_stress", "peak_right_stress", "peak_stress", "uncrushed_fraction", "boundary_work")
        self.write(
            "done",
            status=result.status,
            output=str(output),
            time=float(history["time"][-1]),
            cycles=int(result.attributes["cycles"]),
            wall_seconds=float(result.attributes["wall_seconds"]),
            peak_applied_pressure=float(result.attributes["peak_applied_pressure"]),
            energy_error=float(abs(history["energy_error"]).max()),
            **{name: float(history[name][-1]) for name in last},
        )

    def error(self, error: BaseException) -> None:
        """Write the event `error`; the exit code is that of the command."""
        code = 130 if isinstance(error, KeyboardInterrupt) else int(getattr(error, "exit_code", 1))
        self.write("error", exit_code=code, message=str(error))

    def close(self) -> None:
        """Close the file, if it is one."""
        if not self.on_standard_output:
            self._stream.close()
