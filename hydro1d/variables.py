"""The quantities a run stores: one word each, the same in code, HDF5 and plots."""

from __future__ import annotations

from typing import NamedTuple

from hydro1d.scheme import outputs


class Variable(NamedTuple):
    """Name, SI unit and description of a stored quantity."""

    name: str
    units: str
    long_name: str


NODE, ZONE, HISTORY, PROBE = (
    tuple(Variable(output.name, output.units, output.long_name) for output in declared)
    for declared in (outputs.NODE, outputs.ZONE, outputs.HISTORY, outputs.PROBE)
)
