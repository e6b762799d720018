"""Opening a result file."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from hydro1d.store.run import Run


def open_run(path: str | os.PathLike[str], kept: Callable[[str], np.ndarray | None] | None = None) -> Run:
    """Open a result, a partial result (its status says `running`) or a checkpoint for reading.

    Raises FileProblem: missing, not HDF5, not hydro1d's, truncated or damaged, of a newer schema version, or with links
    to other files. Everything but the arrays is compared with its checksum here, each array when it is read.
    kept: gives arrays by path that whoever wrote the file still has in memory, None for others.
    """
    from hydro1d.store.source import FileSource

    return Run(FileSource(path, kept=kept), Path(path))
