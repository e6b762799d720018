"""HDF5's filters shuffle and gzip, twice as fast: bytes that are noise are stored uncompressed.

Shuffled, the values of a chunk become eight planes, one for each byte of a float64: the exponents compress well, the
last digits of a solution behind a shock do not at all, and gzip spends most of its time on finding that out. A sample
of each plane tells. The result is an ordinary zlib stream, which may mix stored and compressed blocks.

Measured on the 14 MB of a 1 m column of 1000 zones with 200 profiles: plain gzip at level 1 takes three times as long for 7.7
instead of 8.9 MB, at level 6 four times for 7.5 MB.
"""

import zlib

import numpy as np

LEVEL = 1
_SAMPLE = 2048
_PIECES = 8
_WORTHWHILE = 0.7  # a plane whose sample stays larger than this is stored
_SMALL = 1 << 16  # bytes of a chunk that is not worth sampling
_STORED = 65535  # bytes in a stored block


def deflate(values: np.ndarray) -> bytes:
    """A chunk of float64 values as the filters shuffle and gzip leave it in the file."""
    planes = np.ascontiguousarray(np.ascontiguousarray(values).reshape(-1).view(np.uint8).reshape(-1, 8).T)
    if planes.nbytes < _SMALL:
        return zlib.compress(planes.data, LEVEL)
    parts: list[bytes | memoryview] = [b"\x78\x01"]
    noise = _noise(planes)
    for number, plane in enumerate(planes):
        parts += _stored(plane) if number < noise else _compressed(plane)
    parts += [
        b"\x01\x00\x00\xff\xff",
        zlib.adler32(planes.data).to_bytes(4, "big"),
    ]  # an empty last block
    return b"".join(parts)


def _noise(planes: np.ndarray) -> int:
    """Number of planes that are noise, counted from the last digits; all digits behind a noisy one are noise too."""
    if _compresses(planes[0]):
        return 0
    number = len(planes) - 1
    while number and _compresses(planes[number]):
        number -= 1
    return number + 1


def _compresses(plane: np.ndarray) -> bool:
    step = plane.size // _PIECES
    sample = plane[: step * _PIECES].reshape(_PIECES, step)[:, : _SAMPLE // _PIECES]
    return len(zlib.compress(sample.tobytes(), LEVEL)) < _WORTHWHILE * sample.size + 16


def _compressed(plane: np.ndarray) -> list[bytes | memoryview]:
    compressor = zlib.compressobj(LEVEL, zlib.DEFLATED, -zlib.MAX_WBITS, 9)
    return [compressor.compress(plane.data), compressor.flush(zlib.Z_FULL_FLUSH)]


def _stored(plane: np.ndarray) -> list[bytes | memoryview]:
    parts: list[bytes | memoryview] = []
    view = plane.data
    for start in range(0, len(view), _STORED):
        block = view[start : start + _STORED]
        parts += [b"\x00", len(block).to_bytes(2, "little"), (_STORED - len(block)).to_bytes(2, "little"), block]
    return parts
