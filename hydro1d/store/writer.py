"""Writing a run: everything is kept in memory until a file can be written whole, or a part of a long run must go.

Short runs write one file at their end. Long runs append what is full to a working file beside the output and publish
copies of it as `NAME.partial.h5`, so that a killed run leaves a complete, readable file. Whatever appears under a name
that a user sees was written under a temporary name, synced and renamed.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import time
import weakref
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from hydro1d.errors import FileProblem
from hydro1d.store import files
from hydro1d.store.background import Background
from hydro1d.store.checkpoint import Checkpoint, replay
from hydro1d.store.content import Content, More
from hydro1d.store.layout import MAXIMA, Layout
from hydro1d.store.recorder import Recorder
from hydro1d.store.records import Block, compress_all

KEPT_CHECKPOINTS = 2
_OVERHEAD = 10.0  # a partial file is written at most every so many times what the last one took


class Hdf5Sink(Recorder):
    """Takes what the solver hands over and turns it into HDF5 files; see `finish` for what is left at the end.

    deck_text: the deck as written; resolved: the same in SI, JSON-able; attributes: further attributes of the root,
    numbers or text, those named ``law_hash_…`` being compared on a restart. Raises FileProblem, here and later, when a
    file cannot be written; whatever stood under the final name is then still there.

    Use it as a context manager: what is temporary is removed when the block is left by an exception.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        layout: Layout,
        deck_text: str,
        resolved: Mapping[str, Any],
        attributes: Mapping[str, Any] | None = None,
        *,
        flush_seconds: float = 2.0,
        buffer_bytes: int = 32 << 20,
        threads: int | None = None,
    ) -> None:
        super().__init__(layout)
        self.path = files.check_target(path)
        self.content = Content(
            layout, deck_text, dict(resolved), dict(attributes or {}), datetime.now(UTC).isoformat(timespec="seconds")
        )
        self._flush_seconds, self._buffer_bytes, self._threads = flush_seconds, buffer_bytes, threads
        self._working: files.Temporary | None = None
        self._published: tuple[int, int] | None = None
        self._checkpoints: list[Path] = []
        self._maxima: dict[str, np.ndarray] = {}
        self._due = time.monotonic() + flush_seconds
        self._finalizer: weakref.finalize | None = None
        self._background = Background(threads)
        files.remove_stale(self.path.parent)

    @classmethod
    def resume(
        cls,
        checkpoint: Checkpoint,
        path: str | os.PathLike[str],
        layout: Layout,
        deck_text: str,
        resolved: Mapping[str, Any],
        attributes: Mapping[str, Any] | None = None,
        **options: Any,
    ) -> Hdf5Sink:
        """A sink that starts with everything that was recorded up to `checkpoint`."""
        sink = cls(path, layout, deck_text, resolved, attributes, **options)
        try:
            with files.explained("carry on from", checkpoint.path):
                replay(checkpoint, sink)
        except BaseException:
            sink.abort()
            raise
        if checkpoint.path.parent == sink.path.parent:
            sink._checkpoints = [known for known in sink._checkpoint_files() if _cycle(known) <= checkpoint.cycle]
        return sink

    # What the solver calls -----------------------------------------------------------------------------------------

    def recorded(self) -> None:
        """After each record: write when enough has gathered."""
        self.relieve()  # first, for what must leave memory now is compressed by all threads
        self._background.compress(self.tables)

    def flush(self) -> None:
        """Publish a partial file when enough time has passed since the last."""
        if time.monotonic() > self._due:
            self.publish_partial()

    def relieve(self) -> None:
        """Move what is full out of memory when there is too much of it; numbers that are compressed go first."""
        if self._holds_too_much():
            for table in self.tables:
                table.forget()
            if self._holds_too_much():
                self._drain()

    def _holds_too_much(self) -> bool:
        return sum(table.nbytes() for table in self.tables) > self._buffer_bytes

    def checkpoint(self, state: Any) -> Path:
        """Write `NAME.checkpoint-<cycle>.h5`: all records and `state.arrays()`; keeps the last two of this run."""
        arrays = {name: np.asarray(value) for name, value in state.arrays().items()}
        target = files.sibling(self.path, f"checkpoint-{int(state.cycle)}")
        attributes = {"cycles": int(state.cycle), "checkpoint_time": float(state.time)}
        self._publish(target, "running", attributes, arrays)
        self._checkpoints = [known for known in self._checkpoints if known != target] + [target]
        for old in self._checkpoints[:-KEPT_CHECKPOINTS]:
            with contextlib.suppress(OSError):
                old.unlink()
        self._checkpoints = self._checkpoints[-KEPT_CHECKPOINTS:]
        return target

    def maxima(self, zone_maxima: Mapping[str, np.ndarray]) -> None:
        """Largest strain and stress of each zone, at the end."""
        self._maxima = {name: np.array(zone_maxima[name], dtype=np.float64) for name in MAXIMA if name in zone_maxima}

    # Files -----------------------------------------------------------------------------------------------------------

    @property
    def partial_path(self) -> Path:
        """Where a run that has not finished leaves what it has."""
        return files.sibling(self.path, "partial")

    def publish_partial(self) -> None:
        """Write everything up to now to `NAME.partial.h5`; the next one is due when it costs less than 10 %."""
        begin = time.monotonic()
        self._published = self._publish(self.partial_path, "running", {})
        end = time.monotonic()
        self._due = end + max(self._flush_seconds, _OVERHEAD * (end - begin))

    def finish(self, status: str, cycles: int, wall_seconds: float, **more: Any) -> Path:
        """Write the file of a run that ended; returns its name.

        status ``complete``: the file gets its final name, the partial file is removed. ``interrupted``: what there is
        stays in `NAME.partial.h5`. ``failed``: `NAME.failed.h5`, for diagnosis. `more`: further root attributes.
        """
        if status not in ("complete", "interrupted", "failed"):
            raise ValueError(f"no such status of a run that ended: {status}")
        label = {"interrupted": "partial", "failed": "failed"}
        target = files.sibling(self.path, label[status]) if status in label else self.path
        attributes = {"cycles": int(cycles), "wall_seconds": float(wall_seconds), **more}
        try:
            self._publish(target, status, attributes, last=True)
        finally:
            self.abort()
        for table in self.tables:
            table.drop_pieces()
        if target != self.partial_path:
            self._remove_partial()
        return target

    def abort(self) -> None:
        """Remove what is temporary. Partial file and checkpoints stay."""
        self._background.close()
        if self._finalizer is not None:
            self._finalizer()
        self._working = None

    def __enter__(self) -> Hdf5Sink:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.abort()

    # Inside ----------------------------------------------------------------------------------------------------------

    def _temporary(self) -> files.Temporary:
        return files.Temporary(self.path.parent)

    def _compress(self, tails: bool) -> list[tuple[Block | None, list[int]]]:
        """What the thread beside the loop has not done yet, by all threads; see `compress_all`."""
        self._background.wait()
        return compress_all(self.tables, tails, alone=self._working is None, threads=self._threads)

    def _drain(self) -> None:
        """Move all full blocks to the working file."""
        from hydro1d.store import image  # h5py, which has been imported beside the loop

        self._compress(tails=False)
        with files.explained("write", self.path):
            if self._working is None:
                self._working = self._temporary()
                self._finalizer = weakref.finalize(self, files.Temporary.discard, self._working)
                self._working.append(image.empty(self.content, self.tables))
            for table in self.tables:
                table.forget()
            size = sum(table.nbytes() for table in self.tables)
            self._working.reserve(size + image.MARGIN)
            with image.opened(self._working.path) as file:
                image.write_blocks(file, self.tables)
        for table in self.tables:
            table.blocks.clear()

    def _publish(
        self,
        target: Path,
        status: str,
        attributes: Mapping[str, Any],
        state: Mapping[str, np.ndarray] | None = None,
        last: bool = False,
    ) -> tuple[int, int]:
        """Write all records and rename the file to `target`; returns the file's identity."""
        if self._working is not None and any(table.blocks for table in self.tables):
            self._drain()
        from hydro1d.store import image  # as in `_drain`

        tails = self._compress(tails=True)
        more = More({**attributes, "status": status}, self._maxima, dict(state or {}))
        temporary = None
        try:
            with files.explained("write", target):
                files.refuse_foreign(target)
                if self._working is None:
                    temporary = self._temporary()
                    for part in image.whole(self.content, self.tables, tails, more):
                        temporary.append(part)
                else:
                    temporary = self._working if last else self._copy()
                    image.complete(temporary, self.content, self.tables, tails, more)
                return temporary.commit(target)
        finally:
            if temporary is not None and temporary is not self._working:
                temporary.discard()

    def _copy(self) -> files.Temporary:
        copy = self._temporary()
        try:
            shutil.copyfile(self._working.path, copy.path)  # type: ignore[union-attr]
        except BaseException:
            copy.discard()
            raise
        return copy

    def _remove_partial(self) -> None:
        """Remove the partial file, unless another run that still goes on has put its own there."""
        with contextlib.suppress(OSError, FileProblem):
            status = self.partial_path.stat()
            ours = (status.st_dev, status.st_ino) == self._published
            old = status.st_mtime < self._begun
            if (ours or old) and files.is_ours(self.partial_path):
                self.partial_path.unlink()

    def _checkpoint_files(self) -> list[Path]:
        pattern = files.sibling(self.path, "checkpoint-").name.removesuffix(".h5")
        found = [path for path in self.path.parent.iterdir() if path.name.startswith(pattern) and _cycle(path) >= 0]
        return sorted(found, key=_cycle)


def _cycle(path: Path) -> int:
    """Cycle in the name of a checkpoint; -1 if there is none."""
    number = path.name.removesuffix(".h5").rpartition("checkpoint-")[2]
    return int(number) if number.isdecimal() else -1
