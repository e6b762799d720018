"""Results on disk and in memory: writing, checkpoints, reading. Modules are loaded when a name is first used."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hydro1d.store.checkpoint import Checkpoint, read_checkpoint, verify_checkpoint  # noqa: F401
    from hydro1d.store.files import check_target  # noqa: F401
    from hydro1d.store.layout import SCHEMA_VERSION, Layout  # noqa: F401
    from hydro1d.store.memory import MemorySink  # noqa: F401
    from hydro1d.store.run import Run, open_run  # noqa: F401
    from hydro1d.store.writer import Hdf5Sink  # noqa: F401

_HOME = {
    "SCHEMA_VERSION": "layout",
    "Checkpoint": "checkpoint",
    "Hdf5Sink": "writer",
    "Layout": "layout",
    "MemorySink": "memory",
    "Run": "run",
    "check_target": "files",
    "open_run": "run",
    "read_checkpoint": "checkpoint",
    "verify_checkpoint": "checkpoint",
}

__all__ = [*_HOME]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"hydro1d.store.{_HOME[name]}"), name)
