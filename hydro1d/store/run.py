"""The result of a run, the same whether it is read from a file or was kept in memory."""

from __future__ import annotations

import difflib
import html
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from hydro1d.errors import FileProblem, Hydro1dError
from hydro1d.store.layout import Field
from hydro1d.store.source import FileSource

if TYPE_CHECKING:
    import xarray


class Source(Protocol):
    """Where arrays come from: a file or memory. `names` are paths such as "stress" and "history/right_stress"."""

    name: str
    names: tuple[str, ...]
    attributes: dict[str, Any]
    deck_text: str
    deck: dict[str, Any]

    def array(self, path: str) -> np.ndarray:
        """Values of a quantity, SI."""

    def forget(self) -> None:
        """Keep no array that can be read again."""

    def describe(self, path: str) -> Field:
        """Dimensions, unit and description of a quantity."""


class RunLayer(NamedTuple):
    """A layer of the column: its material and its zones, ``run["strain"][:, layer.zones]``."""

    name: str
    zones: slice


class Quantities:
    """Arrays by name: ``quantities["stress"]``. Read once, when first asked for; read-only."""

    def __init__(self, source: Source, group: str) -> None:
        self._source = source
        self._prefix = f"{group}/" if group else ""
        self._arrays: dict[str, np.ndarray] = {}

    def keys(self) -> list[str]:
        """Names of the group's quantities."""
        start = len(self._prefix)
        inside = [name[start:] for name in self._source.names if name.startswith(self._prefix)]
        return inside if self._prefix else [name for name in inside if "/" not in name]

    def _resolve(self, name: str) -> str:
        keys = self.keys()
        if name == "time" and name not in keys and "history_time" in keys:
            name = "history_time"
        if name in keys:
            return name
        close = difflib.get_close_matches(str(name), keys, 1)
        hint = f"; did you mean {close[0]!r}?" if close else "."
        where = f"/{self._prefix[:-1]} of " if self._prefix else ""
        there = ", ".join(keys) or "nothing"
        raise FileProblem(f"no quantity {name!r} in {where}{self._source.name}{hint} There is: {there}")

    def __getitem__(self, name: str) -> np.ndarray:
        name = self._resolve(name)
        if name not in self._arrays:
            array = self._source.array(self._prefix + name)
            array.setflags(write=False)
            self._arrays[name] = array
        return self._arrays[name]

    def describe(self, name: str) -> Field:
        """Dimensions, unit and description of a quantity."""
        return self._source.describe(self._prefix + self._resolve(name))

    def __contains__(self, name: object) -> bool:
        return name in self.keys() or (name == "time" and "history_time" in self.keys())

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    def __len__(self) -> int:
        return len(self.keys())

    def __repr__(self) -> str:
        return f"<{len(self)} quantities: {', '.join(self.keys())}>"


class Run:
    """Results of a run.

    ``run["stress"]`` is an array (time, zone) in SI, ``run.history["right_stress"]`` (history_time,),
    ``run.probes["stress"]`` (history_time, probe), ``run.time`` the times of the profiles, ``run.history.["time"]``
    those of the history. Arrays are read when first asked for and are read-only. Raises FileProblem for a quantity that
    is not there or whose values do not fit their checksum.
    """

    def __init__(self, source: Source, path: Path | None = None) -> None:
        self._source = source
        self.path = path
        self.attributes = source.attributes
        self.deck = source.deck
        self.deck_text = source.deck_text
        self._root = Quantities(source, "")
        self.history = Quantities(source, "history")
        self.probes = Quantities(source, "probes")

    def __getitem__(self, name: str) -> np.ndarray:
        group, _, rest = str(name).rpartition("/")
        return {"history": self.history, "probes": self.probes}.get(group, self._root)[rest if group else name]

    def __contains__(self, name: object) -> bool:
        return name in self._source.names

    def __iter__(self) -> Iterator[str]:
        return iter(self._root)

    def keys(self) -> list[str]:
        """Names of the quantities of the root."""
        return self._root.keys()

    def describe(self, name: str) -> Field:
        """Dimensions, unit and description of a quantity."""
        group, _, rest = name.rpartition("/")
        return {"history": self.history, "probes": self.probes}.get(group, self._root).describe(rest if group else name)

    @property
    def title(self) -> str:
        """Title of the deck."""
        return str(self.attributes.get("title", ""))

    @property
    def status(self) -> str:
        """`running`, `complete`, `failed` or `interrupted`."""
        return str(self.attributes.get("status", "running"))

    @property
    def time(self) -> np.ndarray:
        """Times of the profiles, s."""
        return self["time"]

    @property
    def layers(self) -> tuple[RunLayer, ...]:
        """Layers from left to right."""
        number = self["zone_layer"]
        edges = np.searchsorted(number, np.arange(len(self["layer_name"]) + 1))
        return tuple(
            RunLayer(str(name), slice(int(edges[i]), int(edges[i + 1]))) for i, name in enumerate(self["layer_name"])
        )

    def to_xarray(self) -> xarray.DataTree:
        """All of it as an xarray DataTree with the groups `history` and `probes`, in memory."""
        try:
            import xarray
        except ImportError as error:
            raise Hydro1dError("to_xarray needs xarray: pip install 'hydro1d[xarray]'") from error
        tree = {"/": xarray.Dataset(*self._variables(self._root), attrs=self.attributes)}
        for name, group in (("history", self.history), ("probes", self.probes)):
            if len(group):
                tree[f"/{name}"] = xarray.Dataset(*self._variables(group))
        return xarray.DataTree.from_dict(tree)

    def _variables(self, group: Quantities) -> tuple[dict[str, Any], dict[str, Any]]:
        data: dict[str, Any] = {}
        coordinates: dict[str, Any] = {}
        for name in group:
            field = group.describe(name)
            entry = (field.dimensions, group[name].copy(), {"units": field.units, "long_name": field.long_name})
            static = name.endswith(("_coordinate", "_layer", "_name"))
            (coordinates if field.dimensions == (name,) or static else data)[name] = entry
        return data, coordinates

    def close(self) -> None:
        """Give up the arrays in memory, read or kept since they were written. The file is not held open between reads."""
        self._source.forget()
        for group in (self._root, self.history, self.probes):
            group._arrays.clear()

    def __enter__(self) -> Run:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _summary(self) -> list[tuple[str, str]]:
        rows = [("title", self.title), ("status", self.status), ("file", str(self.path) if self.path else "in memory")]
        time, layers = self.time, self.layers
        if len(time):
            rows.append(("profiles", f"{len(time)}, {time[0]:.6g} … {time[-1]:.6g} s"))
        rows.append(("zones", f"{len(self['zone'])} in {len(layers)} layer(s): {', '.join(x.name for x in layers)}"))
        rows.append(("quantities", ", ".join(self.keys())))
        if len(self.history):
            rows.append(("history", f"{len(self.history['time'])} rows: {', '.join(self.history)}"))
        if len(self.probes):
            rows.append(("probes", f"{len(self.probes['probe'])}: {', '.join(self.probes)}"))
        return rows

    def __repr__(self) -> str:
        return "<hydro1d.Run>\n" + "\n".join(f"  {name:<11} {text}" for name, text in self._summary())

    def _repr_html_(self) -> str:
        cells = "".join(
            f"<tr><th style='text-align:left'>{name}</th><td style='text-align:left'>{html.escape(text)}</td></tr>"
            for name, text in self._summary()
        )
        return f"<table><caption>hydro1d run</caption>{cells}</table>"


def open_run(path: str | os.PathLike[str], kept: Callable[[str], np.ndarray | None] | None = None) -> Run:
    """Open a result, a partial result (its status says `running`) or a checkpoint for reading.

    Raises FileProblem: missing, not HDF5, not hydro1d's, truncated or damaged, of a newer schema version, or with links
    to other files. Everything but the arrays is compared with its checksum here, each array when it is read.
    kept: gives the arrays, by path, that the writer of the file still has in memory, None for others.
    """
    return Run(FileSource(path, kept=kept), Path(path))
