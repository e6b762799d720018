"""The file format put together: structure, blocks, attributes, seal."""

from __future__ import annotations

import json
import os
import zlib
from collections.abc import Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from h5py import h5d

import hydro1d
from hydro1d.store import hdf5
from hydro1d.store.content import Content, More
from hydro1d.store.deflate import LEVEL
from hydro1d.store.files import Temporary
from hydro1d.store.layout import MAXIMA, SCHEMA_VERSION, STATIC, Field
from hydro1d.store.records import Block, Table
from hydro1d.store.seal import make_seal

CONVENTIONS = "CF-1.11"
MARGIN = 1 << 20  # for the structure itself, when space is claimed
_AUXILIARY = {"zone": "zone_coordinate zone_layer", "node": "node_coordinate", "layer": "layer_name"}

Tails = list[tuple[Block | None, list[int]]]


def opened(path: Path) -> AbstractContextManager[h5py.File]:
    """An existing file, to be written on; it is ours alone, so HDF5's own lock is not needed."""
    return h5py.File(path, "r+", libver=hdf5.LIBVER, locking=False)


def empty(content: Content, tables: list[Table]) -> bytes:
    """HDF5 image of a file without records, to append to."""
    with hdf5.new_image() as file:
        _structure(file, content, tables, alone=False)
        file.flush()
        return file.id.get_file_image()


def whole(content: Content, tables: list[Table], tails: Tails, more: More) -> tuple[bytes, bytes]:
    """Image of a complete file, and its seal."""
    with hdf5.new_image() as file:
        _structure(file, content, tables, alone=True)
        write_blocks(file, tables)
        data = _finish(file, content, tables, tails, more)
        file.flush()
        image = file.id.get_file_image()
    view = memoryview(image)
    return image, make_seal(lambda offset, size: view[offset : offset + size], len(image), data)


def complete(temporary: Temporary, content: Content, tables: list[Table], tails: Tails, more: More) -> None:
    """Turn a working file into a complete one, sealed."""
    size = sum(block.nbytes() for block, _ in tails if block) + sum(array.nbytes for array in more.state.values())
    temporary.reserve(size + MARGIN + 16 * content.layout.zones)
    with opened(temporary.path) as file:
        data = _finish(file, content, tables, tails, more)
    temporary.append(make_seal(lambda offset, size: os.pread(temporary.fd, size, offset), temporary.size(), data))


def write_blocks(file: h5py.File, tables: list[Table]) -> None:
    """Append the full blocks of all tables, already compressed."""
    for table in tables:
        for block in table.blocks:
            _write_block(file, table, block)


def _write_block(file: h5py.File, table: Table, block: Block) -> None:
    for index, item in enumerate(table.fields):
        dataset = h5d.open(file.id, item.path.encode())
        dataset.set_extent((block.start + block.rows, *table.tail))
        rest = (0,) * (len(table.tail) - 1)
        for column, piece in zip(table.piece_columns(), block.pieces[index], strict=True):
            offset = (block.start, column, *rest) if table.tail else (block.start,)
            dataset.write_direct_chunk(offset, piece)


def _structure(file: h5py.File, content: Content, tables: list[Table], alone: bool) -> None:
    static = content.layout.static()
    root = {
        "Conventions": CONVENTIONS,
        "title": str(content.resolved.get("title", "")),
        "hydro1d_version": hydro1d.__version__,
        "schema_version": SCHEMA_VERSION,
        "created": content.created,
        **content.attributes,
    }
    for name, value in root.items():
        hdf5.set_attribute(file.id, name, value)
    groups = {item.path.partition("/")[0] for table in tables for item in table.fields if "/" in item.path}
    for group in [*sorted(groups), "deck"]:
        hdf5.new_group(file, group)
    for table in tables:
        for item in table.fields:
            hdf5.new_series(file, item, table.chunk(alone), table.tail, LEVEL)
    for path, array in static.items():
        _checked(hdf5.new_array(file, STATIC[path], array), array)
    names = np.array(content.layout.layer_name, dtype=object)
    hdf5.new_array(file, STATIC["layer_name"], names.astype(h5py.string_dtype()))
    _deck(file, content)
    fields = [item for table in tables for item in table.fields]
    fields += [STATIC[path] for path in (*static, "layer_name")]
    hdf5.attach_scales(file, fields)
    for item in fields:
        if item.dimensions[-1] in _AUXILIARY and item.dimensions[0] == "time":
            dataset = h5d.open(file.id, item.path.encode())
            hdf5.set_attribute(dataset, "coordinates", _AUXILIARY[item.dimensions[-1]])


def _deck(file: h5py.File, content: Content) -> None:
    texts = {
        "deck/toml": (content.deck_text, "deck as written, TOML"),
        "deck/resolved": (json.dumps(content.resolved), "deck resolved to SI, JSON"),
    }
    for path, (text, long_name) in texts.items():
        hdf5.new_array(file, Field(path, (), "1", long_name), np.array(text, dtype=h5py.string_dtype()))


def _checked(dataset: Any, array: np.ndarray) -> None:
    plain = np.ascontiguousarray(array).reshape(-1).view(np.uint8).data
    hdf5.set_attribute(dataset, "crc32", np.uint32(zlib.crc32(plain)))


def _finish(file: h5py.File, content: Content, tables: list[Table], tails: Tails, more: More) -> list[tuple[int, int]]:
    """Write what comes last; returns the byte ranges of all arrays that carry a checksum of their own."""
    paths = list(content.layout.static())
    for table, (tail, sums) in zip(tables, tails, strict=True):
        if tail is not None:
            _write_block(file, table, tail)
        for item, crc in zip(table.fields, sums, strict=True):
            hdf5.set_attribute(h5d.open(file.id, item.path.encode()), "crc32", np.uint32(crc))
            paths.append(item.path)
    for name, array in more.maxima.items():
        item = MAXIMA[name]
        _checked(hdf5.new_array(file, item, array), array)
        hdf5.attach_to(file, item)
        paths.append(item.path)
    if more.state:
        paths += _state(file, more.state)
    for name, value in more.attributes.items():
        if value is not None:
            hdf5.set_attribute(file.id, name, value)
    return hdf5.extents(file, paths)


def _state(file: h5py.File, state: Mapping[str, np.ndarray]) -> list[str]:
    hdf5.new_group(file, "state")
    for name, array in state.items():
        if array.dtype.kind not in "fiub":
            raise TypeError(f"the state holds {name} of type {array.dtype}, which cannot be stored exactly")
        stored = array.astype(np.uint8) if array.dtype.kind == "b" else array
        text = f"state of the solver: {name.replace('_', ' ')}"
        dataset = hdf5.new_array(file, Field(f"state/{name}", (), "1", text), stored)
        _checked(dataset, stored)
        if array.dtype.kind == "b":
            hdf5.set_attribute(dataset, "truth", 1)
    hdf5.new_dimensions(file, "state", state)
    return [f"state/{name}" for name in state]
