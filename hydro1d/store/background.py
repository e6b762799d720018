"""What is done while the time loop runs, which does not need the interpreter: h5py is imported, full blocks are compressed."""

from __future__ import annotations

import importlib
from concurrent.futures import Future, ThreadPoolExecutor

from hydro1d.store.records import Block, Table
from hydro1d.threads import threads_here


class Background:
    """One thread beside the loop; blocks are compressed in their order, so that checksums run on."""

    def __init__(self, threads: int | None) -> None:
        """With one of ``threads`` or one processor nothing is done here; `records.compress_all` does it at the end."""
        self._pool = ThreadPoolExecutor(1) if (threads or threads_here()) > 1 else None
        self._jobs: list[tuple[Future, Block | None]] = []
        self._imports = True  # not before the loop: until then the interpreter is needed elsewhere

    def compress(self, tables: list[Table]) -> None:
        """Take the blocks that have become full; import h5py when first called."""
        if self._pool is None:
            return
        if self._imports:
            self._jobs.append((self._pool.submit(importlib.import_module, "hydro1d.store.image"), None))
            self._imports = False
        for table in tables:
            for block in table.blocks:
                if not block.pieces and not block.taken:
                    block.taken = True
                    self._jobs.append((self._pool.submit(table.compress_block, block), block))

    def wait(self) -> None:
        """Until the job under way is done; blocks that no job has begun on are given back. Raises what a job raised."""
        under_way = []
        for job, block in reversed(self._jobs):  # the last first, for the thread goes on with the next meanwhile
            if block is not None and job.cancel():
                block.taken = False
            else:
                under_way.append(job)
        self._jobs.clear()
        for job in under_way:
            job.result()

    def close(self) -> None:
        """Wait for the job under way; nothing is compressed after it."""
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)
            self._pool = None
