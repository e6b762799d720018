"""Buffers for what grows during a run: filled in memory, taken in chunks, compressed by threads."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from hydro1d.store.deflate import deflate
from hydro1d.store.layout import Field
from hydro1d.threads import threads_here

_CHUNK = 65536  # values in a chunk, 512 KB: profiles and time series are both read at a fair speed
_MAX_ROWS = 16384  # rows in a chunk
_PARALLEL = 1 << 20  # bytes that are worth starting threads for


@dataclass
class Block:
    """Consecutive rows of all fields of a table: as numbers, and compressed, one list of pieces per field.

    taken: a thread compresses it, or will. Numbers may be given up once there are pieces.
    """

    start: int
    rows: int
    values: np.ndarray | None
    pieces: list[list[bytes]] = field(default_factory=list)
    taken: bool = False

    def nbytes(self) -> int:
        """Memory held."""
        held = 0 if self.values is None else self.values.nbytes
        return held + sum(len(piece) for pieces in self.pieces for piece in pieces)


def _field(block: Block, index: int) -> np.ndarray:
    assert block.values is not None, "a block is compressed once"
    return block.values[index]


class Table:
    """Fields that grow together, row by row: shape (fields, rows, *tail).

    Full blocks of `rows` rows wait in `blocks` until the file takes them; the block being filled stays in memory.
    """

    def __init__(self, fields: list[Field], tail: tuple[int, ...], expected: int | None = None) -> None:
        self.fields = fields
        self.tail = tail
        width = max(int(np.prod(tail)), 1)
        self.rows = min(max(_CHUNK // width, 1), _MAX_ROWS)
        if expected:  # chunks of equal size waste least
            chunks = -(-expected // self.rows)
            self.rows = -(-expected // chunks)
        self.columns = (min(tail[0], _CHUNK), *tail[1:]) if tail else ()
        self.blocks: list[Block] = []
        self.crc = [0] * len(fields)
        self.start = 0
        self.fill = 0
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

    def forget(self) -> None:
        """Give up the numbers of what is compressed."""
        for block in self.blocks:
            if block.pieces:
                block.values = None

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

    def drop_pieces(self) -> None:
        """Give up what is compressed: a file has it."""
        for block in self.blocks:
            block.pieces = []

    def column(self, index: int) -> np.ndarray | None:
        """Everything recorded of one field, (total, *tail); None where numbers have been given up."""
        parts = [block.values[index] for block in self.blocks if block.values is not None]
        whole = np.concatenate([*parts, self.values[index, : self.fill]])
        return whole if len(whole) == self.total else None

    def tail_block(self, alone: bool) -> Block | None:
        """The rows of the block being filled: as they are if they are `alone` in their file, else padded with zeros."""
        if not self.fill:
            return None
        if alone and not self.start:
            return Block(0, self.fill, self.values[:, : self.fill].copy())
        values = self.values.copy()
        values[:, self.fill :] = 0.0
        return Block(self.start, self.fill, values)

    def chunk(self, alone: bool) -> tuple[int, ...]:
        """Shape of the chunks of a new file; see `tail_block`."""
        return (self.fill if alone and self.fill and not self.start else self.rows, *self.columns)

    def piece_columns(self) -> list[int]:
        """First column of each chunk of a row of chunks."""
        return list(range(0, self.tail[0], self.columns[0])) if self.tail else [0]

    def compress_block(self, block: Block) -> None:
        """Compress a full block."""
        block.pieces = [self.compress_next(block, index) for index in range(len(self.fields))]

    def compress_next(self, block: Block, index: int) -> list[bytes]:
        """Chunks of one field of the block that follows; the field's checksum runs on."""
        self.crc[index] = zlib.crc32(_field(block, index).data, self.crc[index])
        return self.compress(block, index)

    def compress(self, block: Block, index: int) -> list[bytes]:
        """Chunks of one field of a block as they stand in the file."""
        values = _field(block, index)
        if len(self.piece_columns()) == 1:
            return [deflate(values)]
        pieces = []
        for start in self.piece_columns():
            piece = np.zeros((len(values), *self.columns))
            part = values[:, start : start + self.columns[0]]
            piece[:, : part.shape[1]] = part
            pieces.append(deflate(piece))
        return pieces


def compress_all(
    tables: list[Table], tails: bool, alone: bool = False, threads: int | None = None
) -> list[tuple[Block | None, list[int]]]:
    """Compress all full blocks of all tables and, with `tails`, what has been recorded beyond them.

    Returns for each table the compressed tail and the checksum of each field up to its end. One job a field, so that
    its checksum runs on in order; numpy and zlib release the interpreter lock.
    """
    results: list[tuple[Block | None, list[int]]] = []
    jobs: list[Callable[[], None]] = []
    size = 0
    for table in tables:
        tail = table.tail_block(alone) if tails else None
        sums = list(table.crc)
        results.append((tail, sums))
        waiting = [block for block in table.blocks if not block.pieces]
        size += sum(_field(block, 0).nbytes for block in [*waiting, *([tail] if tail else [])]) * len(table.fields)
        for block in [*waiting, *([tail] if tail else [])]:
            block.pieces = [[] for _ in table.fields]
        jobs += [_job(table, index, waiting, tail, sums) for index in range(len(table.fields))]
    _run(jobs, threads if size > _PARALLEL else 1)
    for tail, _ in results:
        if tail is not None:  # the numbers of the block being filled are the table's
            tail.values = None
    return results


def _job(table: Table, index: int, blocks: list[Block], tail: Block | None, sums: list[int]) -> Callable[[], None]:
    def work() -> None:
        for block in blocks:
            block.pieces[index] = table.compress_next(block, index)
        sums[index] = table.crc[index]
        if tail is not None:
            sums[index] = zlib.crc32(_field(tail, index)[: tail.rows].data, sums[index])
            tail.pieces[index] = table.compress(tail, index)

    return work


def _run(jobs: list[Callable[[], None]], threads: int | None) -> None:
    count = threads or min(threads_here(), 8)
    if count < 2 or len(jobs) < 2:
        for job in jobs:
            job()
        return
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(count) as pool:
        for done in [pool.submit(job) for job in jobs]:
            done.result()
