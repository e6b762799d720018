"""Writing a run: all records go through one working file, whether the run completes, fails or is killed.

Blocks stay in memory until there are too many of them or something is to be published; then those that are full are
appended to a working file beside the output. A partial file or a checkpoint is a copy of the working file, completed; the
result is the working file itself, completed. Whatever appears under a name that a user sees was written under a temporary
name, synced and renamed, so that a killed run leaves complete, readable files.
"""

import contextlib
import importlib
import os
import shutil
import time
import weakref
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np

from hydro1d.errors import FileProblem
from hydro1d.store import files
from hydro1d.store.checkpoint import Checkpoint, replay
from hydro1d.store.layout import Layout
from hydro1d.store.recorder import Recorder
from hydro1d.store.workers import Workers

KEPT_CHECKPOINTS = 2
_OVERHEAD = 10.0  # least time between partial files, over the time that the last one took


class Hdf5Sink(Recorder):
    """Takes what the solver hands over and turns it into HDF5 files; see `finish` for what is left at the end.

    Arguments beside the path are those of `Recorder`. Raises FileProblem, here and later, when a file cannot be written;
    whatever stood under the final name is then still there.

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
        super().__init__(layout, deck_text, resolved, attributes)
        self.path = files.check_target(path)
        self._flush_seconds, self._buffer_bytes = flush_seconds, buffer_bytes
        self._working: files.Temporary | None = None
        self._published: tuple[int, int] | None = None
        self._checkpoints: list[Path] = []
        self._due = time.monotonic() + flush_seconds
        self._finalizer: weakref.finalize | None = None
        self._workers = Workers(threads)
        self._imports = True
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
    ) -> Self:
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
        """Compress the blocks that have become full; where too much is held, move them out of memory."""
        fresh = [table for table in self.tables if table.compress(self._workers.pool)]
        if fresh and sum(table.nbytes() for table in self.tables) > self._buffer_bytes:
            with files.explained("write", self.path):
                self._append()
            for table in self.tables:
                table.give_up()

    def flush(self) -> None:
        """Publish a partial file when enough time has passed since the last."""
        if self._imports and self._workers.pool is not None:  # h5py, while the time loop needs no interpreter
            self._workers.pool.submit(importlib.import_module, "hydro1d.store.image")
        self._imports = False
        if time.monotonic() > self._due:
            self.publish_partial()

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

    # Files -----------------------------------------------------------------------------------------------------------

    @property
    def partial_path(self) -> Path:
        """File of a run that has not finished."""
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
        if target != self.partial_path:
            self._remove_partial()
        return target

    def abort(self) -> None:
        """Remove what is temporary. Partial file and checkpoints stay."""
        self._workers.close()
        if self._finalizer is not None:
            self._finalizer()
        self._working = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.abort()

    # Inside ----------------------------------------------------------------------------------------------------------

    def _append(self, last: bool = False) -> files.Temporary:
        """The working file, created when first needed, with all full blocks; those of the `last` call `image.complete` writes."""
        from hydro1d.store import image  # h5py, which has been imported beside the loop

        if self._working is None:
            if last:
                for table in self.tables:
                    table.shrink_chunk()
            self._working = files.Temporary(self.path.parent)
            self._finalizer = weakref.finalize(self, files.Temporary.discard, self._working)
            self._working.append(image.empty(self))
        if not last:
            image.append(self._working, self.tables)
        return self._working

    def _publish(
        self,
        target: Path,
        status: str,
        attributes: Mapping[str, Any],
        state: Mapping[str, np.ndarray] | None = None,
        last: bool = False,
    ) -> tuple[int, int]:
        """Write all records and rename the file to `target`; returns the file's identity."""
        from hydro1d.store import image  # as in `_append`

        with files.explained("write", target):
            files.refuse_foreign(target)
            working = self._append(last)
            with contextlib.nullcontext(working) if last else files.Temporary(self.path.parent) as temporary:
                if not last:
                    shutil.copyfile(working.path, temporary.path)
                image.complete(temporary, self, {**attributes, "status": status}, state or {}, self._workers.pool)
                return temporary.commit(target)

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
