"""What the scheme works on: records with named numbers, and arrays over nodes and zones."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np


def record(floats: str = "", integers: str = "", flags: str = "") -> np.dtype:
    """A record of named numbers, names separated by blanks; numpy, numba and C agree on where each stands."""
    kinds = {"f8": floats, "i8": integers, "?": flags}
    return np.dtype([(name, kind) for kind, names in kinds.items() for name in names.split()], align=True)


# Clock, totals and maxima of a run: part of its state. Sums have a remainder, which rounding took off them.
CLOCK = record(
    "time last_step free_step next_step first_step pace_time cfl "
    "boundary_work boundary_work_remainder boundary_impulse boundary_impulse_remainder "
    "viscous_work max_boundary_work initial_energy peak_stress peak_left_stress peak_right_stress",
    "cycle left_front right_front limiting_layer",
)

# What one call of the time loop is to do, and what it answers; the present step and kick. Stops are times at which a step
# ends.
CALL = record(
    "stop step kick",
    "steps history_every row_capacity stops enough_stops status rows passed_stops profiles",
    "row_at_stop is_fresh",
)

# A layer: its zones [first, end), and where the parameters of its law begin. Size (m), zone mass (kg/m²) and what follows
# from them are those of every zone where the layer is uniform; elsewhere the arrays over zones have them.
LAYER = record(
    "zone_size min_size inverse_size density zone_mass inverse_zone_mass crushed_strain yield_strain "
    "linear limited_linear quadratic",
    "first end parameters",
    "is_uniform",
)

# What of a layer changes with time and counts for its history.
LAYER_STATE = record("max_strain folded_energy")

# What a pass over zones answers: largest stiffness/ρ0, largest viscous speed, largest stress and strain, and Σ q (Δv before
# and after the kick), twice the power of the viscosity that acted in it.
ANSWER = record("stiffness viscous_speed stress strain viscous_power")

# An end node as `boundaries.base.End` has it, in the frame of the end, then what its boundary answers.
END = record(
    "time step_before step_after velocity displacement mass stress impedance initial_stress side "
    "new_velocity force centred_velocity",
    "parameters",
)

# A probe: the zone and layer in which it lies, and its share of the way through the zone.
PROBE = record("share", "zone layer")

# What the passes of the scheme answer as the status of a call.
REACHED, PAUSED, NOT_FINITE, INVERTED, COLLAPSED = range(5)


class Grid(NamedTuple):
    """The column as the scheme sees it.

    Over nodes: displacement, node_mass, inverse_mass, coordinate; velocity (node i at i + 1, a ghost at each end);
    velocity_before, what it was before the kick over one block of zones at a time.
    Over zones: size, inverse_size and inverse_zone_mass; energy (specific, when it was last folded) and increment (since
    then); force (σ + q) and viscosity (q); state (variables, zones), the largest strain first; seen_energy and seen_stress of
    zones that are observed; curve, tangents, stiffnesses, speeds: what `foam_pass` remembers of each zone's loading curve.
    boundary_state: left, right, and both again half a kick on, `boundary_width` each. stops: pairs of a time and 1 where a
    profile is wanted. rows, probe_rows, profiles: what is recorded, one after the other. passes: the compiled or plain
    passes that the scheme calls by number: zones of each layer, both ends, nodes.
    """

    clock: Any
    call: Any
    layers: Any
    layer_state: Any
    answer: Any
    ends: Any
    probes: Any
    velocity: Any
    velocity_before: Any
    displacement: Any
    node_mass: Any
    inverse_mass: Any
    coordinate: Any
    size: Any
    inverse_size: Any
    inverse_zone_mass: Any
    energy: Any
    increment: Any
    force: Any
    viscosity: Any
    state: Any
    seen_energy: Any
    seen_stress: Any
    curve: Any
    tangents: Any
    stiffnesses: Any
    speeds: Any
    parameters: Any
    boundary_state: Any
    stops: Any
    rows: Any
    probe_rows: Any
    profiles: Any
    passes: Any
    layer_count: int
    zones: int
    variables: int
    boundary_width: int
    probe_count: int


RECORDS = {
    "clock": CLOCK, "call": CALL, "layers": LAYER, "layer_state": LAYER_STATE, "answer": ANSWER, "ends": END, "probes": PROBE,
}  # fmt: skip
SINGLE = ("clock", "call", "answer")  # one record and not a row of them
COUNTS = ("layer_count", "zones", "variables", "boundary_width", "probe_count")
