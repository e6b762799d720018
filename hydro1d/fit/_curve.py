"""A measured curve."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hydro1d.errors import DeckError, FileProblem


class MeasuredCurve(NamedTuple):
    """Strain and stress (Pa), compression positive, strain rising from 0 or above to below 1."""

    strain: np.ndarray
    stress: np.ndarray


def read_curve(path: str | os.PathLike[str], largest_strain: float = 1.0) -> MeasuredCurve:
    """Read a CSV of two columns, strain and stress, header and units optional, up to `largest_strain`.

    Raises FileProblem if it cannot be read, DeckError if it is no such curve.
    """
    from hydro1d.tables import read_table

    source = Path(path)
    if not source.is_file():
        raise FileProblem(f"cannot read {source}: no such file")
    try:
        rows = read_table(source.name, ("1", "Pa"), source.parent)
    except OSError as error:
        raise FileProblem(f"cannot read {source}: {error.strerror or error}") from error
    except ValueError as error:
        raise DeckError(f"{error}") from error
    table = np.array(rows, dtype=float)
    return checked(table[:, 0], table[:, 1], largest_strain)


def checked(strain: np.ndarray, stress: np.ndarray, largest_strain: float = 1.0) -> MeasuredCurve:
    """The curve, if it can be fitted. Raises DeckError in one sentence."""
    kept = strain <= (largest_strain if largest_strain < 1.0 else np.inf)
    strain, stress = np.asarray(strain, dtype=float)[kept], np.asarray(stress, dtype=float)[kept]
    if len(strain) < 10:
        raise DeckError(f"the curve has {len(strain)} points up to strain {largest_strain:g}; a fit needs 10 at least")
    if strain[0] < 0.0 or strain[-1] >= 1.0:
        raise DeckError(
            f"strains run from {strain[0]:g} to {strain[-1]:g}; they must lie between 0 and 1, compression positive "
            "(percent needs the unit % in the header)"
        )
    if not stress.max() > 0.0:
        raise DeckError("no stress above zero; compression must be positive")
    return MeasuredCurve(strain, stress)
