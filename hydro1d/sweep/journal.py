"""What an interrupted sweep leaves: finished rows, one JSON line each, so that nothing is run twice."""

import contextlib
import json
import os
import time
from pathlib import Path
from typing import Any

from hydro1d.errors import FileProblem, file_problems

_SYNC = 0.5  # seconds between syncs: a killed process loses nothing, a power cut this much


class Journal:
    """Rows of a sweep by number, in a file that only grows. The first line is the digest of the sweep it belongs to."""

    def __init__(self, path: Path, digest: str, fresh: bool = False) -> None:
        """Open or begin. Raises FileProblem for the journal of another sweep, unless ``fresh`` throws it away."""
        self.path, self.rows = path, {}  # type: Path, dict[int, dict[str, Any]]
        with file_problems("write", path):
            if fresh:
                path.unlink(missing_ok=True)
            kept = self._read(digest) if path.exists() else 0
            self._fd = os.open(path, os.O_CREAT | os.O_RDWR | getattr(os, "O_CLOEXEC", 0), 0o666)
            os.ftruncate(self._fd, kept)  # a torn last line goes
            os.lseek(self._fd, 0, os.SEEK_END)
            if kept == 0:
                self._write({"digest": digest})
            os.fsync(self._fd)
        self._synced = time.monotonic()

    def _read(self, digest: str) -> int:
        """Take over the whole lines; returns their length in bytes."""
        kept = 0
        for number, line in enumerate(self.path.read_bytes().splitlines(keepends=True)):
            try:
                entry = json.loads(line)
            except ValueError:
                break
            if not line.endswith(b"\n") or not isinstance(entry, dict):
                break
            if number == 0 and entry.get("digest") != digest:
                raise FileProblem(
                    f"{self.path} is what an interrupted sweep left, and it was another sweep (its deck, parameters, "
                    "quantities or hydro1d have changed); --fresh throws it away"
                )
            if number > 0:
                self.rows[int(entry["run"])] = entry["row"]
            kept += len(line)
        return kept

    def _write(self, entry: dict[str, Any]) -> None:
        os.write(self._fd, (json.dumps(entry) + "\n").encode())

    def add(self, run: int, row: dict[str, Any]) -> None:
        """Keep a row: in the system's hands at once, on the disk within half a second."""
        with file_problems("write", self.path):
            self._write({"run": run, "row": row})
            if time.monotonic() - self._synced > _SYNC:
                os.fsync(self._fd)
                self._synced = time.monotonic()
        self.rows[run] = row

    def close(self) -> None:
        """Sync and close."""
        if self._fd >= 0:
            with contextlib.suppress(OSError):
                os.fsync(self._fd)
            os.close(self._fd)
            self._fd = -1
