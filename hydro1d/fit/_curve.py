"""Reading a measured quasi-static curve from a file, and checking it."""

import os
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hydro1d.errors import DeckError, FileProblem

MAX_AT_REST = 0.02  # of the largest stress, at strain 0: more is a curve drawn without its elastic part
MIN_POINTS = 8  # three more than the parameters of any law
MIN_PASCALS = 1e3  # the softest foams bear more than this before they densify


class MeasuredCurve(NamedTuple):
    """Strain and stress (Pa), compression positive, strain rising from 0 or above to below 1."""

    strain: np.ndarray
    stress: np.ndarray


class Measured(NamedTuple):
    """A curve from a file, and in sentences what was assumed or left out in reading it."""

    curve: MeasuredCurve
    notes: tuple[str, ...]


def read_curve(path: str | os.PathLike[str], largest_strain: float = 1.0) -> MeasuredCurve:
    """Read a CSV of two columns, strain and stress, header and units optional, up to `largest_strain`.

    Raises FileProblem if it cannot be read, DeckError if it is no such curve.
    """
    return read_measured(path, largest_strain).curve


def read_measured(
    path: str | os.PathLike[str], largest_strain: float = 1.0, strain_unit: str = "", stress_unit: str = ""
) -> Measured:
    """Read a measured curve as testing machines write it, and say what was made of it.

    Units are those given here, else those of the header, else 1 and Pa. Points at which the strain does not rise (noise,
    unloading at the end) are left out; a file in which compression is negative is turned. Raises FileProblem if the file
    cannot be read, DeckError if it holds no curve, or stresses without a unit that cannot be Pa.
    """
    from hydro1d.components.tables import read_rows

    source = Path(path)
    if source.is_dir():
        raise FileProblem(f"cannot read {source}: it is a folder")
    if not source.is_file():
        raise FileProblem(f"cannot read {source}: no such file")
    try:
        rows, given = read_rows(source.name, ("1", "Pa"), source.parent, (strain_unit, stress_unit))
    except ValueError as error:
        raise DeckError(f"{error}") from error
    table = np.array([pair for _, pair in rows], dtype=float)
    strain, stress, notes = _turned(table[:, 0], table[:, 1])
    rising = strain > np.concatenate([[-np.inf], np.maximum.accumulate(strain)[:-1]])
    kept = rising & (strain >= 0.0)
    if not kept.all():
        count = int((~kept).sum())
        if count > 0.5 * len(kept):
            raise DeckError(
                f"{source}: the strain does not rise at {count} of {len(kept)} points; it must be the first column, of a "
                "single loading"
            )
        notes.append(f"left out: {count} of {len(kept)} points, at which the strain does not rise or is negative")
    if kept.any() and strain[kept][0] == 0.0 and stress[kept][0] > MAX_AT_REST * stress[kept].max():
        notes.append(
            f"left out: the stress of {stress[kept][0] / 1e6:.4g} MPa at strain 0, where every law begins with none"
        )
        kept &= strain > 0.0
    curve = checked(strain[kept], stress[kept], largest_strain)
    if not given[1]:
        notes.append(_about_pascals(source, curve))
    return Measured(curve, tuple(notes))


def measured(
    curve: MeasuredCurve | str | os.PathLike[str], largest_strain: float, strain_unit: str, stress_unit: str
) -> Measured:
    """The curve itself, checked, or that of a file (`read_measured`). Raises DeckError and FileProblem."""
    if isinstance(curve, str | os.PathLike):
        return read_measured(curve, largest_strain, strain_unit, stress_unit)
    return Measured(checked(curve.strain, curve.stress, largest_strain), ())


def density_line(density: float | None) -> str:
    """The density in a deck; without one, that line is left for the user to fill in."""
    return f'density = "{density:.6g} kg/m^3"' if density is not None else '# density = "... kg/m^3"   # required'


def _turned(strain: np.ndarray, stress: np.ndarray) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Compression positive, whatever the file's sign."""
    if strain[-1] < 0.0 and np.median(strain) < 0.0 and np.median(stress) < 0.0:
        return -strain, -stress, ["compression is negative in the file; both signs are turned"]
    return strain, stress, []


def _about_pascals(source: Path, curve: MeasuredCurve) -> str:
    """A remark on stresses without a unit. Raises DeckError where they cannot be pascals."""
    largest = float(curve.stress.max())
    if largest < MIN_PASCALS:
        raise DeckError(
            f"{source}: the stress has no unit, and its largest value, {largest:g}, is too small for Pa; is it MPa? "
            "Write the unit into the header, stress [MPa], or give it with --stress-unit MPa"
        )
    return f"the stress has no unit in {source.name} and is taken as Pa (largest: {largest / 1e6:.4g} MPa)"


def checked(strain: np.ndarray, stress: np.ndarray, largest_strain: float = 1.0) -> MeasuredCurve:
    """The curve, if it can be fitted. Raises DeckError in one sentence."""
    kept = strain <= (largest_strain if largest_strain < 1.0 else np.inf)
    strain, stress = np.asarray(strain, dtype=float)[kept], np.asarray(stress, dtype=float)[kept]
    if len(strain) < MIN_POINTS:
        raise DeckError(
            f"the curve has {len(strain)} points up to strain {largest_strain:g}; a fit needs {MIN_POINTS} at least"
        )
    if strain[0] < 0.0 or strain[-1] >= 1.0:
        raise DeckError(
            f"strains run from {strain[0] + 0.0:g} to {strain[-1]:g}; they must be engineering strains between 0 and 1, "
            "compression positive (percent needs the unit %, in the header or with --strain-unit %; logarithmic strain e is "
            "1 − exp(−e) as an engineering strain)"
        )
    if not stress.max() > 0.0:
        raise DeckError("no stress above zero; compression must be positive")
    return MeasuredCurve(strain, stress)
