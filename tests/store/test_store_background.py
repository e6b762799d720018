"""Compressing beside the time loop: the same file as without, in order, and nothing that goes wrong goes unheard."""

from __future__ import annotations

import threading

import made_up
import numpy as np
import pytest

from hydro1d.store import Hdf5Sink, background, open_run
from hydro1d.store.background import Background
from hydro1d.store.layout import Field
from hydro1d.store.records import Table, compress_all

FIELDS = [Field("a", ("row", "zone"), "1", "a"), Field("b", ("row", "zone"), "1", "b")]


def filled(blocks: int) -> Table:
    table = Table(FIELDS, (1000,))
    rows = np.random.default_rng(1).normal(size=(2, blocks * table.rows, 1000)).cumsum(axis=1)
    table.append(rows)
    return table


def compressed(table: Table) -> tuple:
    ((tail, sums),) = compress_all([table], tails=True)
    assert tail is None
    return sums, [block.pieces for block in table.blocks]


def two_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "threads_here", lambda: 2)


@pytest.mark.parametrize("interrupted", [False, True])
def test_the_same_pieces_and_checksums(monkeypatch, interrupted):
    two_processors(monkeypatch)
    plain, beside = filled(4), filled(4)
    work = Background(None)
    work.compress([beside])
    if not interrupted:
        work._pool.shutdown()  # all jobs are done
    work.wait()
    given_back = [block for block in beside.blocks if not block.taken]
    assert interrupted or not given_back
    assert all(bool(block.pieces) == block.taken for block in beside.blocks)
    assert compressed(beside) == compressed(plain)
    work.close()


def test_blocks_not_begun_are_given_back(monkeypatch):
    two_processors(monkeypatch)
    plain, beside, go, begun = filled(3), filled(3), threading.Event(), threading.Event()
    compress = Table.compress_block

    def slow(table, block):
        begun.set()
        go.wait()
        compress(table, block)

    monkeypatch.setattr(Table, "compress_block", slow)
    work = Background(None)
    work.compress([beside])
    begun.wait()
    threading.Timer(0.1, go.set).start()
    work.wait()
    assert [block.taken for block in beside.blocks] == [True, False, False]
    assert compressed(beside) == compressed(plain)
    work.close()


def test_what_goes_wrong_is_raised(monkeypatch):
    two_processors(monkeypatch)

    def fails(table, block):
        raise MemoryError("no room")

    monkeypatch.setattr(Table, "compress_block", fails)
    work = Background(None)
    work.compress([filled(1)])
    work._pool.shutdown()
    with pytest.raises(MemoryError, match="no room"):
        work.wait()


@pytest.mark.parametrize(("threads", "processors"), [(1, 8), (None, 1)])
def test_nothing_beside_the_loop_where_there_is_one_thread(monkeypatch, threads, processors):
    monkeypatch.setattr(background, "threads_here", lambda: processors)
    before, table = threading.active_count(), filled(1)
    work = Background(threads)
    work.compress([table])
    work.wait()
    assert table.blocks[0].values is not None
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
