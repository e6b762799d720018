"""A seal behind the HDF5 data: a checksum of everything in the file but the arrays, which carry their own.

The HDF5 library trusts the structure of a file; a flipped bit there can change a shape, an address or a filter unseen,
or crash the interpreter. The seal is checked in plain Python before the library opens the file. HDF5 ignores what
follows its data, so that every other tool reads a sealed file; a tool that rewrites the file drops the seal.

Layout: the HDF5 data; pairs (offset, size) of the sealed byte ranges, 64-bit; then the footer (see `_FOOTER`).
"""

import os
import struct
import zlib
from collections.abc import Callable, Iterable
from pathlib import Path

from hydro1d.errors import FileProblem

_MAGIC = b"h1d-seal"
_FOOTER = struct.Struct("<8sQQII")  # magic, bytes of HDF5 data, number of ranges, their checksum, checksum of the rest
_RANGE = struct.Struct("<QQ")
_STEP = 1 << 22


def make_seal(read: Callable[[int, int], bytes | memoryview], size: int, data: Iterable[tuple[int, int]]) -> bytes:
    """Seal for a file of `size` bytes, all but the byte ranges `data` (offset, size) that hold checksummed arrays."""
    ranges = _outside(size, data)
    table = b"".join(_RANGE.pack(*pair) for pair in ranges)
    footer = _FOOTER.pack(_MAGIC, size, len(ranges), _checksum(read, ranges), 0)
    return table + footer[:-4] + struct.pack("<I", zlib.crc32(footer[:-4], zlib.crc32(table)))


def _outside(size: int, data: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    ranges, position = [], 0
    for offset, length in sorted(data):
        if offset > position:
            ranges.append((position, offset - position))
        position = max(position, offset + length)
    if position < size:
        ranges.append((position, size - position))
    return ranges


def _checksum(read: Callable[[int, int], bytes | memoryview], ranges: list[tuple[int, int]]) -> int:
    value = 0
    for offset, length in ranges:
        for start in range(offset, offset + length, _STEP):
            value = zlib.crc32(read(start, min(_STEP, offset + length - start)), value)
    return value


def _footer(fd: int) -> bytes:
    size = os.fstat(fd).st_size
    return os.pread(fd, _FOOTER.size, max(size - _FOOTER.size, 0))


def has_seal(path: Path) -> bool:
    """Whether the file ends with a seal; it may be broken."""
    fd = os.open(path, os.O_RDONLY)
    try:
        return _footer(fd).startswith(_MAGIC)
    finally:
        os.close(fd)


def check_seal(path: Path) -> bool:
    """Check the seal of a file; False if there is none. Raises FileProblem if it does not fit the file."""
    fd = os.open(path, os.O_RDONLY)
    try:
        footer = _footer(fd)
        if not footer.startswith(_MAGIC):
            return False
        _, size, count, content, rest = _FOOTER.unpack(footer)
        if size + count * _RANGE.size + _FOOTER.size == os.fstat(fd).st_size:
            table = os.pread(fd, count * _RANGE.size, size)
            if zlib.crc32(footer[:-4], zlib.crc32(table)) == rest:
                ranges = list(_RANGE.iter_unpack(table))
                if _checksum(lambda offset, length: os.pread(fd, length, offset), ranges) == content:
                    return True
    finally:
        os.close(fd)
    raise FileProblem(f"{path} is damaged: its content does not fit its checksum")
