"""A table of results: one HDF5 file and one CSV file, the same bytes for the same rows."""

import csv
import io
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from hydro1d.errors import FileProblem, file_problems

SCHEMA_VERSION = 1
_MARK = "run"


class Column(NamedTuple):
    """A column: name, SI unit ("" for text), description, and a value for each row."""

    name: str
    units: str
    long_name: str
    values: list


class Table:
    """Columns of one length. ``table["peak_stress"]`` is an array."""

    def __init__(self, columns: Sequence[Column], attributes: dict[str, Any] | None = None) -> None:
        self.columns = {column.name: column for column in columns}
        self.attributes = attributes or {}

    def __getitem__(self, name: str) -> np.ndarray:
        values = self.columns[name].values
        is_text = any(isinstance(value, str) for value in values)
        return np.array([str(value) for value in values], dtype=object) if is_text else np.array(values, dtype=float)

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __len__(self) -> int:
        return max((len(column.values) for column in self.columns.values()), default=0)

    def rows(self) -> list[dict[str, Any]]:
        """Every row as a dict."""
        return [{name: column.values[k] for name, column in self.columns.items()} for k in range(len(self))]

    def csv(self) -> str:
        """The table as CSV text: a line of names, the number of the row first; floats in full."""
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow([_MARK, *self.columns])
        for k, row in enumerate(zip(*(column.values for column in self.columns.values()), strict=True)):
            writer.writerow([k, *(_cell(value) for value in row)])
        return out.getvalue()

    def write_csv(self, path: str | Path) -> Path:
        """Write or replace a CSV file in one step. Raises FileProblem for a file that is not such a table."""
        return write_text(Path(path), self.csv())

    def write_hdf5(self, path: str | Path) -> Path:
        """Write or replace an HDF5 file in one step: a dataset a column over the dimension ``run``."""
        import h5py

        import hydro1d
        from hydro1d.store.files import Temporary, check_target, explained

        target = check_target(path)
        with explained("write", path):
            image = io.BytesIO()
            with h5py.File(image, "w", libver=("v108", "v110"), track_order=True) as file:
                attributes = {
                    "Conventions": "CF-1.8",
                    "hydro1d_version": hydro1d.__version__,
                    "schema_version": SCHEMA_VERSION,
                }
                for name, value in {**attributes, "content": "table", **self.attributes}.items():
                    file.attrs[name] = value
                self._datasets(file)
            with Temporary(target.parent) as temporary:
                temporary.append(image.getbuffer())
                temporary.commit(target)
        return target

    def _datasets(self, file: Any) -> None:
        import h5py

        runs = file.create_dataset("run", data=np.arange(len(self), dtype=np.int32))
        runs.make_scale("run")
        runs.attrs["long_name"] = "number of the run"
        for column in self.columns.values():
            values = self[column.name]
            kind = h5py.string_dtype() if values.dtype == object else np.float64
            dataset = file.create_dataset(column.name.replace("/", "|"), data=values, dtype=kind)
            dataset.dims[0].attach_scale(runs)
            dataset.attrs["long_name"] = column.long_name
            if values.dtype != object:
                dataset.attrs["units"] = column.units or "1"


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return "" if math.isnan(value) else repr(value)
    return str(value)


def read_table(path: str | Path) -> Table:
    """Read a table from its HDF5 file. Raises FileProblem."""
    import h5py

    from hydro1d.store.files import explained

    with explained("read", path), h5py.File(path, "r", locking=False) as file:
        if "content" not in file.attrs or file.attrs["content"] != "table":
            raise FileProblem(f"{path} holds no table of hydro1d's")
        columns = []
        for name, dataset in file.items():
            if name == "run":
                continue
            text = h5py.check_string_dtype(dataset.dtype) is not None
            values = list(dataset.asstr()[()]) if text else dataset[()].tolist()
            units = str(dataset.attrs.get("units", ""))
            columns.append(Column(name.replace("|", "/"), units, str(dataset.attrs["long_name"]), values))
        return Table(columns, dict(file.attrs))


def check_text_target(path: Path, mark: str = _MARK) -> None:
    """Raise FileProblem if a file that is not hydro1d's stands where a table is to go, or nothing can be written."""
    with file_problems("write", path):
        if path.is_dir():
            raise FileProblem(f"cannot write {path}: it is a folder")
        if path.exists():
            with open(path, encoding="utf-8", errors="replace") as file:
                head = file.readline(len(mark) + 1)
            if head and not head.startswith(f"{mark},"):
                raise FileProblem(
                    f"cannot write {path}: a file that hydro1d did not write is there; move it away first"
                )
        elif not path.parent.is_dir():
            raise FileProblem(f"cannot write {path}: the folder {path.parent} does not exist")


def write_text(path: Path, text: str) -> Path:
    """Write or replace a table of text in one step."""
    from hydro1d.store.files import Temporary, explained

    check_text_target(path)
    with explained("write", path), Temporary(path.resolve().parent) as temporary:
        temporary.append(text.encode())
        temporary.commit(path, over_any=True)
    return path
