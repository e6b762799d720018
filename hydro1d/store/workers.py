"""Threads beside the time loop, which holds no interpreter lock while it computes."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor

from hydro1d.threads import threads_here

_MAX_THREADS = 8


class Job:
    """Compression of one field of a block, by a thread or, if none has begun it, by the caller of `result`."""

    def __init__(self, work: Callable[[], list[bytes]], pool: ThreadPoolExecutor | None) -> None:
        self._work = work
        self._future: Future[list[bytes]] | None = pool.submit(work) if pool is not None else None

    def result(self) -> list[bytes]:
        """Compressed chunks. Raises what the work raised."""
        if self._future is None or self._future.cancel():
            return self._work()
        return self._future.result()

    def nbytes(self) -> int:
        """Memory that the finished result holds."""
        done = self._future is not None and self._future.done() and not self._future.cancelled()
        return sum(map(len, self.result())) if done else 0


class Workers:
    """A pool of ``threads`` (default: processors, at most 8) less the one of the time loop; None where that leaves no thread."""

    def __init__(self, threads: int | None) -> None:
        count = threads or min(threads_here(), _MAX_THREADS)
        self.pool = ThreadPoolExecutor(count - 1) if count > 1 else None

    def close(self) -> None:
        """Wait for the jobs under way and drop the others."""
        if self.pool is not None:
            self.pool.shutdown(cancel_futures=True)
            self.pool = None
