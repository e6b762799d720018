"""The file format put together: structure, blocks, attributes, seal."""

import json
import os
import zlib
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager
from typing import Any

import h5py
import numpy as np
from h5py import h5d

import hydro1d
from hydro1d.store import hdf5
from hydro1d.store.deflate import LEVEL
from hydro1d.store.files import Temporary
from hydro1d.store.layout import MAXIMA, SCHEMA_VERSION, STATIC, Field
from hydro1d.store.recorder import Recorder
from hydro1d.store.records import Block, Table
from hydro1d.store.seal import make_seal

CONVENTIONS = "CF-1.11"
_STRUCTURE = 8192  # bytes claimed for the header and the attributes of a dataset, which take up to 3 kB
_ENTRY = 64  # bytes claimed for a chunk in the index of its dataset, which takes up to 24
_AUXILIARY = {"zone": "zone_coordinate zone_layer", "node": "node_coordinate", "layer": "layer_name"}

_Pieces = list[tuple[Table, Block, list[list[bytes]]]]  # compressed chunks of each field of a block


def empty(recorder: Recorder) -> bytes:
    """HDF5 image of a file without records, to append to."""
    with hdf5.new_image() as file:
        _structure(file, recorder)
        file.flush()
        return file.id.get_file_image()


def append(temporary: Temporary, tables: list[Table]) -> None:
    """Write the full blocks that the file does not hold yet."""
    pieces = _unwritten(tables)
    if pieces:
        temporary.reserve(_space(pieces, tables))
        with _opened(temporary) as file:
            _write(file, pieces)
        _mark_written(tables)


def complete(
    temporary: Temporary,
    recorder: Recorder,
    attributes: Mapping[str, Any],
    state: Mapping[str, np.ndarray],
    pool: ThreadPoolExecutor | None,
) -> None:
    """Write all that is missing: blocks, the rows beyond them, maxima, state, attributes and the seal.

    Raises TypeError for a state that HDF5 cannot hold exactly.
    """
    tables = recorder.tables
    lasts = [table.last(pool) for table in tables]
    pieces = _unwritten(tables)
    pieces += [(table, block, _chunks(block)) for table, (block, _) in zip(tables, lasts, strict=True) if block]
    arrays = [*recorder.zone_maxima.values(), *state.values()]
    temporary.reserve(_space(pieces, tables) + sum(array.nbytes + _STRUCTURE for array in arrays))
    with _opened(temporary) as file:
        _write(file, pieces)
        paths = [*recorder.layout.static(), *_checksums(file, tables, [sums for _, sums in lasts])]
        paths += [*_maxima(file, recorder), *(_state(file, state) if state else [])]
        for name, value in attributes.items():
            if value is not None:
                hdf5.set_attribute(file.id, name, value)
        data = hdf5.extents(file, paths)
    _mark_written(tables)
    temporary.append(make_seal(lambda offset, size: os.pread(temporary.fd, size, offset), temporary.size(), data))


def _opened(temporary: Temporary) -> AbstractContextManager[h5py.File]:
    """A temporary file, to be written on; it is ours alone, so HDF5's own lock is not needed."""
    return h5py.File(temporary.path, "r+", libver=hdf5.LIBVER, locking=False)


def _unwritten(tables: list[Table]) -> _Pieces:
    return [(table, block, _chunks(block)) for table in tables for block in table.blocks[table.written :]]


def _chunks(block: Block) -> list[list[bytes]]:
    return [job.result() for job in block.jobs]


def _space(pieces: _Pieces, tables: list[Table]) -> int:
    """Bytes to claim before the HDF5 library writes blocks; an index of chunks may be laid out anew, at twice its length."""
    index = [len(table.first_columns()) * (table.total // table.rows + 1) * _ENTRY for table in tables]
    structure = sum(len(table.fields) * (_STRUCTURE + size) for table, size in zip(tables, index, strict=True))
    return structure + sum(len(chunk) for _, _, fields in pieces for chunks in fields for chunk in chunks)


def _mark_written(tables: list[Table]) -> None:
    for table in tables:
        for block in table.blocks[table.written :]:
            block.jobs = []
        table.written = len(table.blocks)


def _write(file: h5py.File, pieces: _Pieces) -> None:
    """Append blocks, chunk by chunk as they were compressed."""
    for table, block, fields in pieces:
        rest = (0,) * (len(table.tail) - 1)
        for item, chunks in zip(table.fields, fields, strict=True):
            dataset = h5d.open(file.id, item.path.encode())
            dataset.set_extent((block.start + block.rows, *table.tail))
            for column, chunk in zip(table.first_columns(), chunks, strict=True):
                dataset.write_direct_chunk((block.start, column, *rest) if table.tail else (block.start,), chunk)


def _structure(file: h5py.File, recorder: Recorder) -> None:
    static, tables = recorder.layout.static(), recorder.tables
    root = {
        "Conventions": CONVENTIONS,
        "title": str(recorder.resolved.get("title", "")),
        "hydro1d_version": hydro1d.__version__,
        "schema_version": SCHEMA_VERSION,
        "created": recorder.created,
        **recorder.attributes,
    }
    for name, value in root.items():
        hdf5.set_attribute(file.id, name, value)
    groups = {item.path.partition("/")[0] for table in tables for item in table.fields if "/" in item.path}
    for group in [*sorted(groups), "deck"]:
        hdf5.new_group(file, group)
    for table in tables:
        for item in table.fields:
            hdf5.new_series(file, item, table.chunk, table.tail, LEVEL)
    for path, array in static.items():
        _checked(hdf5.new_array(file, STATIC[path], array), array)
    names = np.array(recorder.layout.layer_name, dtype=object)
    hdf5.new_array(file, STATIC["layer_name"], names.astype(h5py.string_dtype()))
    _deck(file, recorder)
    fields = [item for table in tables for item in table.fields]
    fields += [STATIC[path] for path in (*static, "layer_name")]
    hdf5.attach_scales(file, fields)
    for item in fields:
        if item.dimensions[-1] in _AUXILIARY and item.dimensions[0] == "time":
            dataset = h5d.open(file.id, item.path.encode())
            hdf5.set_attribute(dataset, "coordinates", _AUXILIARY[item.dimensions[-1]])


def _deck(file: h5py.File, recorder: Recorder) -> None:
    texts = {
        "deck/toml": (recorder.deck_text, "deck as written, TOML"),
        "deck/resolved": (json.dumps(recorder.resolved), "deck resolved to SI, JSON"),
    }
    for path, (text, long_name) in texts.items():
        hdf5.new_array(file, Field(path, (), "1", long_name), np.array(text, dtype=h5py.string_dtype()))


def _checked(dataset: Any, array: np.ndarray) -> None:
    plain = np.ascontiguousarray(array).reshape(-1).view(np.uint8).data
    hdf5.set_attribute(dataset, "crc32", np.uint32(zlib.crc32(plain)))


def _checksums(file: h5py.File, tables: list[Table], sums: list[list[int]]) -> list[str]:
    """Give each recorded dataset its checksum; returns their paths."""
    paths = []
    for table, numbers in zip(tables, sums, strict=True):
        for item, crc in zip(table.fields, numbers, strict=True):
            hdf5.set_attribute(h5d.open(file.id, item.path.encode()), "crc32", np.uint32(crc))
            paths.append(item.path)
    return paths


def _maxima(file: h5py.File, recorder: Recorder) -> list[str]:
    """Write what was largest in each zone; returns the paths."""
    known = [item for item in MAXIMA.values() if item.path in recorder.zone_maxima]
    for item in known:
        array = recorder.zone_maxima[item.path]
        _checked(hdf5.new_array(file, item, array), array)
    hdf5.attach_scales(file, known)
    return [item.path for item in known]


def _kinds(dtype: np.dtype) -> list[str]:
    """The kind of an array's numbers, or of each member of its records."""
    return [field[0].kind for field in dtype.fields.values()] if dtype.fields else [dtype.kind]


def _state(file: h5py.File, state: Mapping[str, np.ndarray]) -> list[str]:
    hdf5.new_group(file, "state")
    for name, array in state.items():
        if not all(kind in "fiub" for kind in _kinds(array.dtype)):
            raise TypeError(f"the state holds {name} of type {array.dtype}, which cannot be stored exactly")
        stored = array.astype(np.uint8) if array.dtype.kind == "b" else array
        text = f"state of the solver: {name.replace('_', ' ')}"
        dataset = hdf5.new_array(file, Field(f"state/{name}", (), "1", text), stored)
        _checked(dataset, stored)
        if array.dtype.kind == "b":
            hdf5.set_attribute(dataset, "truth", 1)
    hdf5.new_dimensions(file, "state", state)
    return [f"state/{name}" for name in state]
