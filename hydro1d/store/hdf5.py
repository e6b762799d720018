"""Low-level HDF5: datasets with units and dimension scales, chunks that are already compressed.

The low-level interface of h5py is used because a file has some fifty datasets: it writes them in a third of the time.
"""

import itertools
from collections.abc import Iterable, Mapping
from typing import Any

import h5py
import numpy as np
from h5py import h5a, h5d, h5ds, h5g, h5p, h5s, h5t

from hydro1d.store.layout import Field

LIBVER = ("v108", "v110")
# Names of a dimension without values, by the netCDF-4 convention.
NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable. %9d"

_TEXT = h5py.string_dtype()
_STRING = h5t.py_create(h5py.string_dtype(), logical=True)  # in the file
_OBJECT = h5t.py_create(h5py.string_dtype())  # in memory
_numbers = itertools.count()
_SCALAR = h5s.create(h5s.SCALAR)


def _creation_list(kind: Any) -> Any:
    properties = h5p.create(kind)
    properties.set_link_creation_order(h5p.CRT_ORDER_TRACKED | h5p.CRT_ORDER_INDEXED)
    return properties


def new_image() -> h5py.File:
    """An HDF5 file in memory; links keep the order in which they were made, for ncdump and h5py alike."""
    access = h5p.create(h5p.FILE_ACCESS)
    access.set_fapl_core(1 << 20, False)
    access.set_libver_bounds(h5py.h5f.LIBVER_V18, h5py.h5f.LIBVER_V110)
    name = f"hydro1d-{next(_numbers)}".encode()  # the library knows even files in memory by name
    identity = h5py.h5f.create(name, h5py.h5f.ACC_TRUNC, _creation_list(h5p.FILE_CREATE), access)
    return h5py.File(identity)


def new_group(file: h5py.File, name: str) -> None:
    """Create a group of the root."""
    h5g.create(file.id, name.encode(), gcpl=_creation_list(h5p.GROUP_CREATE))


def set_attribute(target: Any, name: str, value: Any) -> None:
    """Write one new attribute: text as UTF-8 of variable length, numbers as 64-bit, sequences as arrays."""
    if isinstance(value, str):
        kind, space, array = _STRING, _SCALAR, np.array(value, dtype=_TEXT)
    else:
        array = np.asarray(value)
        if array.dtype.kind == "b":
            array = array.astype(np.int8)
        elif array.dtype.kind == "i":
            array = array.astype(np.int64)
        elif array.dtype.kind in "UO":
            array = array.astype(h5py.string_dtype())
        kind = _STRING if array.dtype.kind == "O" else h5t.py_create(array.dtype, logical=True)
        space = h5s.create_simple(array.shape) if array.shape else _SCALAR
    h5a.create(target, name.encode(), kind, space).write(array, mtype=_OBJECT if kind is _STRING else kind)


def _describe(dataset: Any, field: Field) -> None:
    set_attribute(dataset, "units", field.units)
    set_attribute(dataset, "long_name", field.long_name)


def new_series(file: h5py.File, field: Field, chunk: tuple[int, ...], tail: tuple[int, ...], level: int) -> None:
    """Create an empty dataset that grows along its first dimension, in chunks with shuffle and gzip."""
    properties = h5p.create(h5p.DATASET_CREATE)
    properties.set_chunk(chunk)
    properties.set_shuffle()
    properties.set_deflate(level)
    space = h5s.create_simple((0, *tail), (h5s.UNLIMITED, *tail))
    _describe(h5d.create(file.id, field.path.encode(), h5t.IEEE_F64LE, space, properties), field)


def new_array(file: h5py.File, field: Field, array: np.ndarray) -> Any:
    """Write an array that does not grow, uncompressed."""
    kind = _STRING if array.dtype.kind == "O" else h5t.py_create(array.dtype, logical=True)
    space = h5s.create_simple(array.shape) if array.shape else _SCALAR
    properties = h5p.create(h5p.DATASET_CREATE)
    if array.nbytes:  # space is claimed at once, so that the address is known before the file is closed
        properties.set_alloc_time(h5d.ALLOC_TIME_EARLY)
    dataset = h5d.create(file.id, field.path.encode(), kind, space, properties)
    if array.size:
        values = array if array.flags.c_contiguous else array.copy(order="C")
        dataset.write(h5s.ALL, h5s.ALL, values, mtype=_OBJECT if kind is _STRING else kind)
    _describe(dataset, field)
    return dataset


def attach_scales(file: h5py.File, fields: Iterable[Field]) -> None:
    """Make the coordinates among ``fields`` dimension scales; attach to the others the scales of their group."""
    for field in sorted(fields, key=lambda field: not _is_scale(field)):  # scales first
        folder, slash, name = field.path.rpartition("/")
        dataset = h5d.open(file.id, field.path.encode())
        if _is_scale(field):
            h5ds.set_scale(dataset, name.encode())
        else:
            for axis, dimension in enumerate(field.dimensions):
                h5ds.attach_scale(dataset, h5d.open(file.id, f"{folder}{slash}{dimension}".encode()), axis)


def _is_scale(field: Field) -> bool:
    return field.dimensions == (field.path.rpartition("/")[2],)


def new_dimensions(file: h5py.File, group: str, arrays: Mapping[str, np.ndarray]) -> None:
    """Give arrays without coordinates dimensions named after their size, so that netCDF readers take the group."""
    scales: dict[int, Any] = {}
    for size in sorted({size for array in arrays.values() for size in array.shape}):
        name = f"size_{size}"
        space = h5s.create_simple((size,))
        scales[size] = h5d.create(file.id, f"{group}/{name}".encode(), h5t.IEEE_F32BE, space)
        h5ds.set_scale(scales[size], (NO_VARIABLE % size).encode())
    for name, array in arrays.items():
        dataset = h5d.open(file.id, f"{group}/{name}".encode())
        for axis, size in enumerate(array.shape):
            h5ds.attach_scale(dataset, scales[size], axis)


def extents(file: h5py.File, paths: Iterable[str]) -> list[tuple[int, int]]:
    """Byte ranges (offset, size) in the file that hold the values of the given datasets."""
    found: list[tuple[int, int]] = []
    for path in paths:
        dataset = h5d.open(file.id, path.encode())
        if dataset.get_create_plist().get_layout() == h5d.CHUNKED:
            dataset.chunk_iter(lambda info: found.append((info.byte_offset, info.size)))
        elif dataset.get_offset() is not None:
            found.append((dataset.get_offset(), dataset.get_storage_size()))
    return found
