"""Opening a result file."""

from __future__ import annotations

import os
from pathlib import Path

from hydro1d.store.run import Run


def open_run(path: str | os.PathLike[str]) -> Run:
    """Open a result, a partial result (its status says `running`) or a checkpoint for reading.

    Raises FileProblem: missing, not HDF5, not hydro1d's, truncated or damaged, of a newer schema version, or with links
    to other files. Everything but the arrays is compared with its checksum here, each array when it is read.
    """
    from hydro1d.store.source import FileSource

    return Run(FileSource(path), Path(path))
