"""Results on disk and in memory: writing, checkpoints, reading. Modules are loaded when a name is first used."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hydro1d.store.checkpoint import Checkpoint, read_checkpoint, verify_checkpoint
    from hydro1d.store.files import check_target
    from hydro1d.store.layout import SCHEMA_VERSION, Layout
    from hydro1d.store.memory import MemorySink
    from hydro1d.store.run import Run, open_run
    from hydro1d.store.writer import Hdf5Sink

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
