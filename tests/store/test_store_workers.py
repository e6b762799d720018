"""Compressing beside the time loop: the same file as without, in order, and nothing that goes wrong goes unheard."""

from __future__ import annotations

import threading

import made_up
import numpy as np
import pytest

from hydro1d.store import Hdf5Sink, open_run, workers
from hydro1d.store.layout import Field
from hydro1d.store.records import Table
from hydro1d.store.workers import Workers

FIELDS = [Field("a", ("row", "zone"), "1", "a"), Field("b", ("row", "zone"), "1", "b")]


def filled(blocks: int) -> Table:
    table = Table(FIELDS, (1000,))
    rows = np.random.default_rng(1).normal(size=(2, blocks * table.rows, 1000)).cumsum(axis=1)
    table.append(rows)
    return table


def compressed(table: Table) -> tuple:
    """Checksums and chunks of all full blocks."""
    block, sums = table.last(None)
    assert block is None
    return sums, [[job.result() for job in block.jobs] for block in table.blocks]


def by_itself(blocks: int) -> tuple:
    table = filled(blocks)
    assert table.compress(None)
    return compressed(table)


def two_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workers, "threads_here", lambda: 2)


@pytest.mark.parametrize("finished", [True, False])
def test_the_same_chunks_and_checksums(monkeypatch, finished):
    two_processors(monkeypatch)
    beside, work = filled(4), Workers(None)
    assert beside.compress(work.pool) and not beside.compress(work.pool)
    if finished:
        work.pool.shutdown()  # all jobs are done
        assert all(job.nbytes() > 0 for block in beside.blocks for job in block.jobs)
        held = sum(len(piece) for block in compressed(beside)[1] for pieces in block for piece in pieces)
        assert beside.nbytes() == held + sum(block.values.nbytes for block in beside.blocks)
    assert compressed(beside) == by_itself(4)
    work.close()


def test_blocks_as_they_become_full(monkeypatch):
    two_processors(monkeypatch)
    rows, beside, work = filled(4), Table(FIELDS, (1000,)), Workers(None)
    for block in rows.blocks:
        beside.append(block.values)
        assert beside.compress(work.pool)
    assert compressed(beside) == by_itself(4)
    work.close()


def test_what_no_thread_has_begun_is_done_by_who_asks(monkeypatch):
    two_processors(monkeypatch)
    beside, go, begun, done_by = filled(3), threading.Event(), threading.Event(), set()
    chunks = Table._chunks

    def slow(table, values):
        done_by.add(threading.current_thread().name)
        if threading.current_thread() is not threading.main_thread():
            begun.set()
            go.wait()
        return chunks(table, values)

    monkeypatch.setattr(Table, "_chunks", slow)
    work = Workers(None)
    beside.compress(work.pool)
    begun.wait()
    assert all(job.nbytes() == 0 for block in beside.blocks for job in block.jobs), "nothing is finished"
    last = [[job.result() for job in block.jobs] for block in beside.blocks[1:]]
    assert len(done_by) == 2, "the thread waits in the first job, the others were done here"
    threading.Timer(0.1, go.set).start()
    expected = by_itself(3)
    assert last == expected[1][1:] and compressed(beside) == expected
    work.close()


def test_what_goes_wrong_is_raised(monkeypatch):
    two_processors(monkeypatch)

    def fails(table, values):
        raise MemoryError("no room")

    monkeypatch.setattr(Table, "_chunks", fails)
    table, work = filled(1), Workers(None)
    table.compress(work.pool)
    work.pool.shutdown()
    with pytest.raises(MemoryError, match="no room"):
        compressed(table)


@pytest.mark.parametrize(("threads", "processors"), [(1, 8), (None, 1)])
def test_nothing_beside_the_loop_where_there_is_one_thread(monkeypatch, threads, processors):
    monkeypatch.setattr(workers, "threads_here", lambda: processors)
    before, table = threading.active_count(), filled(1)
    work = Workers(threads)
    table.compress(work.pool)
    assert table.nbytes() == table.blocks[0].values.nbytes
    assert compressed(table) == by_itself(1)
    assert threading.active_count() == before
    work.close()


def test_no_thread_is_left(monkeypatch, tmp_path):
    two_processors(monkeypatch)
    before = threading.active_count()
    with Hdf5Sink(tmp_path / "a.h5", made_up.layout(profiles=3), made_up.DECK_TEXT, made_up.RESOLVED) as sink:
        made_up.record(sink, 0, 10)
        run = open_run(sink.finish("complete", 1, 0.0))
    assert len(run.time) == 10
    assert threading.active_count() == before
