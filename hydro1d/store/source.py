"""Reading arrays out of a file that may be damaged or hostile."""

from __future__ import annotations

import json
import os
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hydro1d.errors import FileProblem
from hydro1d.store.files import explained, not_hdf5
from hydro1d.store.layout import GROUPS, SCHEMA_VERSION, Field
from hydro1d.store.seal import check_seal

if TYPE_CHECKING:
    import h5py

_ZLIB_LIMIT = 1100  # no deflate stream grows by more than 1032
_SMALL = 1 << 20


class FileSource:
    """The datasets of one file by path, checked as they are read. The file is open only while something is read.

    `check_schema=False` leaves the version to the caller; what is `kept` in memory is not read.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        check_schema: bool = True,
        kept: Callable[[str], np.ndarray | None] | None = None,
    ) -> None:
        self.path, self._kept = Path(path), kept
        self.name = os.fspath(path)
        if self.path.is_dir():
            raise FileProblem(f"cannot read {self.name}: it is a folder")
        with explained("read", self.name):
            self._identity = _identity(self.path)
            self.sealed = check_seal(self.path)
        with self._open() as file:
            self.attributes = _attributes(file)
            if "hydro1d_version" not in self.attributes or "schema_version" not in self.attributes:
                raise FileProblem(f"{self.name} is an HDF5 file, but not one of hydro1d's")
            if self.attributes.get("content") == "table":
                raise FileProblem(
                    f"{self.name} is a table of hydro1d sweep, not the result of a run; its CSV file or "
                    "hydro1d.sweep.read_table read it"
                )
            self.schema_version = int(self.attributes["schema_version"])
            if check_schema and self.schema_version > SCHEMA_VERSION:
                raise FileProblem(
                    f"{self.name} has schema version {self.schema_version}; this hydro1d "
                    f"({self.attributes['hydro1d_version']} wrote it) knows versions up to {SCHEMA_VERSION}"
                )
            self.names = tuple(_names(file, self.name))
            self.groups = tuple(name for name in (*GROUPS, "deck", "state") if name in file)
            self.deck_text = self._text(file, "deck/toml")
            self.deck = json.loads(self._text(file, "deck/resolved"))

    @contextmanager
    def _open(self) -> Iterator[h5py.File]:
        import h5py

        with explained("read", self.name):
            try:
                file = h5py.File(self.path, "r", locking=False)
            except OSError as error:
                raise FileProblem(f"cannot read {self.name}: {not_hdf5(self.path, error)}") from error
            with file:
                if _identity(file.id.get_vfd_handle()) != self._identity:
                    raise FileProblem(f"{self.name} was replaced since it was opened; open it again")
                yield file

    def _text(self, file: h5py.File, path: str) -> str:
        dataset = self._dataset(file, path)
        value = dataset[()]
        if dataset.shape != () or not isinstance(value, bytes):
            raise FileProblem(f"{self.name} is damaged: {path} is not a text")
        return value.decode()

    def _dataset(self, file: h5py.File, path: str) -> h5py.Dataset:
        import h5py

        dataset = file[path]
        if not isinstance(dataset, h5py.Dataset):
            raise FileProblem(f"{self.name} is damaged: {path} is not a dataset")
        properties = dataset.id.get_create_plist()
        if properties.get_external_count() or dataset.is_virtual:
            raise FileProblem(f"{self.name}: {path} takes its values from another file, which is refused")
        declared = dataset.size * dataset.dtype.itemsize if dataset.shape is not None else 0
        stored = dataset.id.get_storage_size()
        limit = _ZLIB_LIMIT if dataset.chunks else 1
        if declared > max(limit * stored, _SMALL) or stored > os.path.getsize(self.path):
            raise FileProblem(f"{self.name}: {path} claims {declared} bytes but {stored} are there; refused")
        return dataset

    def array(self, path: str) -> np.ndarray:
        """Values of a dataset, compared with its checksum."""
        kept = self._kept(path) if self._kept is not None else None
        if kept is not None:
            return kept
        with self._open() as file:
            dataset = self._dataset(file, path)
            kind = dataset.dtype.kind
            if kind == "O" and dataset.ndim == 1:
                return np.array([text.decode() for text in dataset[()]], dtype=object)
            if kind not in "fiuV":
                raise FileProblem(f"{self.name} is damaged: {path} has the type {dataset.dtype}")
            values = np.asarray(dataset[()])
            if "crc32" not in dataset.attrs:
                raise FileProblem(f"{self.name} is damaged: {path} has no checksum")
            plain = np.ascontiguousarray(values).reshape(-1).view(np.uint8)
            if zlib.crc32(plain.data) != int(dataset.attrs["crc32"]):
                raise FileProblem(f"{self.name} is damaged: the values of {path} do not fit their checksum")
            return values.astype(bool) if "truth" in dataset.attrs else values

    def forget(self) -> None:
        """Give up the arrays that the writer keeps in memory; they are read from the file from now on."""
        self._kept = None

    def __getstate__(self) -> dict[str, Any]:
        """State for another process: without the arrays in memory, for it reads the file."""
        return {**self.__dict__, "_kept": None}

    def rows(self, path: str, step: int) -> Iterator[np.ndarray]:
        """Rows of a float64 dataset, `step` at a time; the checksum is compared after the last."""
        start, total, crc, expected = 0, 1, 0, 0
        while start < total:
            with self._open() as file:
                dataset = self._dataset(file, path)
                if dataset.dtype != np.float64 or "crc32" not in dataset.attrs:
                    raise FileProblem(f"{self.name} is damaged: {path} is not an array with a checksum")
                total, expected = dataset.shape[0], int(dataset.attrs["crc32"])
                values = dataset[start : start + step]
            crc = zlib.crc32(values.reshape(-1).view(np.uint8).data, crc)
            start += step
            if start >= total and crc != expected:
                raise FileProblem(f"{self.name} is damaged: the values of {path} do not fit their checksum")
            if len(values):
                yield values

    def describe(self, path: str) -> Field:
        """Dimensions, unit and description of a dataset."""
        with self._open() as file:
            dataset = self._dataset(file, path)
            name = path.rpartition("/")[2]
            scales = [list(axis.values()) for axis in dataset.dims]
            dimensions = tuple(found[0].name.rpartition("/")[2] if found else name for found in scales)
            units, long_name = (str(dataset.attrs.get(key, "")) for key in ("units", "long_name"))
            return Field(path, dimensions, units, long_name)

    def state_names(self) -> list[str]:
        """Names of the arrays of the solver's state."""
        with self._open() as file:
            if "state" not in file:
                return []
            return [name for name in file["state"] if "crc32" in file["state"][name].attrs]


def _identity(path: Path | int) -> tuple[int, int, int, int]:
    status = os.stat(path)
    return status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns


def _attributes(file: h5py.File) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in file.attrs.items():
        if isinstance(value, np.ndarray):
            found[name] = value.tolist()
        else:
            found[name] = value.item() if isinstance(value, np.generic) else value
    return found


def _names(file: h5py.File, name: str) -> Iterator[str]:
    """Paths of all datasets with data; links that leave their group are refused before they are followed."""
    import h5py
    from h5py import h5l

    for group in ("", "history/", "probes/", "deck/", "state/"):
        if group and group[:-1] not in file:
            continue
        where = file[group] if group else file
        if not isinstance(where, h5py.Group):
            raise FileProblem(f"{name} is damaged: {group[:-1]} is not a group")
        for link in where:
            if where.id.links.get_info(link.encode()).type != h5l.TYPE_HARD:
                raise FileProblem(f"{name}: {group}{link} is a link to elsewhere, which is refused")
            if group in ("deck/", "state/") or (group == "" and link in ("history", "probes", "deck", "state")):
                continue
            yield group + link
