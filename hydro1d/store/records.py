"""Tables that grow row by row in memory and are compressed in blocks."""

import functools
import zlib
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import numpy as np

from hydro1d.store.deflate import deflate
from hydro1d.store.layout import Field
from hydro1d.store.workers import Job

_CHUNK = 65536  # values in a chunk, 512 KB: profiles and time series are both read at a fair speed
_MAX_ROWS = 16384  # rows in a chunk
_PARALLEL = 1 << 20  # bytes of an unfinished block; threads gain nothing on fewer


@dataclass
class Block:
    """Consecutive rows of all fields of a table, values (fields, rows, *tail), with a compression job for each field."""

    start: int
    rows: int
    values: np.ndarray
    jobs: list[Job] = field(default_factory=list)

    def nbytes(self) -> int:
        """Memory held."""
        return self.values.nbytes + sum(job.nbytes() for job in self.jobs)


class Table:
    """Fields that grow together, row by row: shape (fields, rows, *tail).

    Full blocks of `rows` rows are kept in `blocks` until they are given up; the first `written` of them are in the file.
    """

    def __init__(self, fields: list[Field], tail: tuple[int, ...], expected: int | None = None) -> None:
        self.fields, self.tail = fields, tail
        self.rows = min(max(_CHUNK // max(int(np.prod(tail)), 1), 1), _MAX_ROWS)
        if expected:  # chunks of equal size waste least
            chunks = -(-expected // self.rows)
            self.rows = -(-expected // chunks)
        self.chunk = (self.rows, *((min(tail[0], _CHUNK), *tail[1:]) if tail else ()))
        self.blocks: list[Block] = []
        self.written = self.start = 0
        self.crc = [0] * len(fields)
        self._new_block()

    def _new_block(self) -> None:
        self.values = np.empty((len(self.fields), self.rows, *self.tail))
        self.fill = 0

    @property
    def total(self) -> int:
        """Rows recorded."""
        return self.start + self.fill

    def nbytes(self) -> int:
        """Memory held by the full blocks."""
        return sum(block.nbytes() for block in self.blocks)

    def append_row(self, row: Iterable[np.ndarray | float]) -> None:
        """Record one row, a value of shape tail for each field."""
        for values, value in zip(self.values, row, strict=True):
            values[self.fill] = value
        self.fill += 1
        self._turn()

    def append(self, values: np.ndarray) -> None:
        """Record rows: values of shape (fields, n, *tail)."""
        done, count = 0, values.shape[1]
        while done < count:
            n = min(count - done, self.rows - self.fill)
            self.values[:, self.fill : self.fill + n] = values[:, done : done + n]
            self.fill += n
            done += n
            self._turn()

    def _turn(self) -> None:
        if self.fill == self.rows:
            self.blocks.append(Block(self.start, self.rows, self.values))
            self.start += self.rows
            self._new_block()

    def give_up(self) -> None:
        """Give up the numbers of all full blocks: the file has them."""
        self.blocks.clear()
        self.written = 0

    def column(self, index: int) -> np.ndarray | None:
        """Everything recorded of one field, (total, *tail); None where numbers have been given up."""
        whole = np.concatenate([*(block.values[index] for block in self.blocks), self.values[index, : self.fill]])
        return whole if len(whole) == self.total else None

    def shrink_chunk(self) -> None:
        """Let the chunks of a file that will not grow any more be no longer than what it holds."""
        if self.fill and not self.start:
            self.chunk = (self.fill, *self.chunk[1:])

    def compress(self, pool: ThreadPoolExecutor | None) -> bool:
        """Begin to compress the blocks that have become full; returns whether there are any."""
        fresh = [block for block in self.blocks[self.written :] if not block.jobs]
        for block in fresh:
            self.crc = self._checksums(block)
            block.jobs = self._jobs(block.values, pool)
        return bool(fresh)

    def last(self, pool: ThreadPoolExecutor | None) -> tuple[Block | None, list[int]]:
        """The block being filled, padded with zeros to whole chunks and compressed, and the checksums up to its end."""
        if not self.fill:
            return None, self.crc
        values = np.zeros((len(self.fields), self.chunk[0], *self.tail))
        values[:, : self.fill] = self.values[:, : self.fill]
        block = Block(self.start, self.fill, values)
        block.jobs = self._jobs(values, pool if values.nbytes > _PARALLEL else None)
        return block, self._checksums(block)

    def _checksums(self, block: Block) -> list[int]:
        return [zlib.crc32(part[: block.rows].data, crc) for part, crc in zip(block.values, self.crc, strict=True)]

    def _jobs(self, values: np.ndarray, pool: ThreadPoolExecutor | None) -> list[Job]:
        return [Job(functools.partial(self._chunks, part), pool) for part in values]

    def first_columns(self) -> list[int]:
        """First column of each chunk in a row of chunks."""
        return list(range(0, self.tail[0], self.chunk[1])) if self.tail else [0]

    def _chunks(self, values: np.ndarray) -> list[bytes]:
        """Chunks of one field of a block as they stand in the file."""
        if len(self.first_columns()) == 1:
            return [deflate(values)]
        pieces = []
        for start in self.first_columns():
            piece = np.zeros((len(values), *self.chunk[1:]))
            part = values[:, start : start + self.chunk[1]]
            piece[:, : part.shape[1]] = part
            pieces.append(deflate(piece))
        return pieces
