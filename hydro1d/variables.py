"""The quantities a run stores: one word each, the same in code, HDF5 and plots."""

from __future__ import annotations

from typing import NamedTuple


class Variable(NamedTuple):
    """Name, SI unit and description of a stored quantity."""

    name: str
    units: str
    long_name: str


NODE = (
    Variable("position", "m", "position of the node in the laboratory"),
    Variable("velocity", "m s-1", "velocity, centred to the time of the stresses"),
    Variable("displacement", "m", "displacement from the initial position"),
)
ZONE = (
    Variable("strain", "1", "engineering strain, compression positive"),
    Variable("stress", "Pa", "axial stress, compression positive, without viscosity"),
    Variable("viscosity", "Pa", "artificial viscosity q"),
    Variable("density", "kg m-3", "current density"),
    Variable("internal_energy", "J kg-1", "specific internal energy"),
)
HISTORY = (
    Variable("time", "s", "time"),
    Variable("time_step", "s", "step that led to this time"),
    Variable("left_stress", "Pa", "stress plus viscosity on the left end node"),
    Variable("right_stress", "Pa", "stress plus viscosity on the right end node"),
    Variable("left_velocity", "m s-1", "velocity of the left end"),
    Variable("right_velocity", "m s-1", "velocity of the right end"),
    Variable("left_position", "m", "position of the left end"),
    Variable("right_position", "m", "position of the right end"),
    Variable("kinetic_energy", "J m-2", "kinetic energy per area"),
    Variable("internal_energy", "J m-2", "internal energy per area"),
    Variable("boundary_work", "J m-2", "work done on the column by both ends, per area"),
    Variable("viscous_work", "J m-2", "part of the internal energy put in by the artificial viscosity, per area"),
    Variable("energy_error", "1", "energy imbalance over the energy put in"),
    Variable("momentum", "kg m-1 s-1", "momentum per area"),
    Variable("boundary_impulse", "Pa s", "impulse given by both ends, positive to the right"),
    Variable("peak_stress", "Pa", "largest stress anywhere up to now, every cycle counted"),
    Variable("peak_left_stress", "Pa", "largest left_stress up to now, every cycle counted"),
    Variable("peak_right_stress", "Pa", "largest right_stress up to now, every cycle counted"),
    Variable("front_position", "m", "Lagrangian position of the proximal compaction front"),
    Variable("distal_front_position", "m", "Lagrangian position of the distal compaction front"),
    Variable("uncrushed_fraction", "1", "share of the crushable length that is not crushed"),
)
PROBE = (
    Variable("position", "m", "position of the probe in the laboratory"),
    Variable("velocity", "m s-1", "velocity at the probe"),
    Variable("strain", "1", "engineering strain at the probe"),
    Variable("stress", "Pa", "stress at the probe"),
)
