"""What a run records, each output declared once: its name, SI unit, meaning, and the function that yields it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from hydro1d.jit.primitives import at


class Output(NamedTuple):
    """Name, SI unit and description of a recorded quantity; `take` yields it from the grid and what is looked at."""

    name: str
    units: str
    long_name: str
    take: Callable[[Any, Any], float]


class Moment(NamedTuple):
    """Sums over the column at the time of the stresses: J/m², kg/(m s), Pa s, m."""

    kinetic_energy: float
    internal_energy: float
    energy_error: float
    momentum: float
    boundary_work: float
    boundary_impulse: float
    front_position: float
    distal_front_position: float
    uncrushed_fraction: float


class Seen(NamedTuple):
    """What a probe sees: m, m/s, strain, Pa."""

    position: float
    velocity: float
    strain: float
    stress: float


class Node(NamedTuple):
    """A node in a profile, with its velocity (m/s) at the time of the stresses."""

    number: int
    velocity: float


class Zone(NamedTuple):
    """A zone in a profile: its initial density (kg/m³), strain, and specific energy (J/kg) at the time of the stresses."""

    number: int
    initial_density: float
    strain: float
    energy: float


HISTORY = (
    Output("time", "s", "time", lambda g, now: g.clock.time),
    Output("time_step", "s", "step that led to this time", lambda g, now: g.clock.last_step),
    Output("left_stress", "Pa", "stress plus viscosity on the left end node", lambda g, now: g.force[0]),
    Output("right_stress", "Pa", "stress plus viscosity on the right end node", lambda g, now: g.force[g.zones - 1]),
    Output("left_velocity", "m s-1", "velocity of the left end", lambda g, now: at(g.ends, 0).centred_velocity),
    Output("right_velocity", "m s-1", "velocity of the right end", lambda g, now: at(g.ends, 1).centred_velocity),
    Output("left_position", "m", "position of the left end", lambda g, now: g.coordinate[0] + g.displacement[0]),
    Output(
        "right_position",
        "m",
        "position of the right end",
        lambda g, now: g.coordinate[g.zones] + g.displacement[g.zones],
    ),
    Output("kinetic_energy", "J m-2", "kinetic energy per area", lambda g, now: now.kinetic_energy),
    Output("internal_energy", "J m-2", "internal energy per area", lambda g, now: now.internal_energy),
    Output(
        "boundary_work", "J m-2", "work done on the column by both ends, per area", lambda g, now: now.boundary_work
    ),
    Output(
        "viscous_work",
        "J m-2",
        "part of the internal energy put in by the artificial viscosity, per area",
        lambda g, now: g.clock.viscous_work,
    ),
    Output("energy_error", "1", "energy imbalance over the energy put in", lambda g, now: now.energy_error),
    Output("momentum", "kg m-1 s-1", "momentum per area", lambda g, now: now.momentum),
    Output(
        "boundary_impulse",
        "Pa s",
        "impulse given by both ends, positive to the right",
        lambda g, now: now.boundary_impulse,
    ),
    Output(
        "peak_stress",
        "Pa",
        "largest stress anywhere up to now, every cycle counted",
        lambda g, now: g.clock.peak_stress,
    ),
    Output(
        "peak_left_stress",
        "Pa",
        "largest left_stress up to now, every cycle counted",
        lambda g, now: g.clock.peak_left_stress,
    ),
    Output(
        "peak_right_stress",
        "Pa",
        "largest right_stress up to now, every cycle counted",
        lambda g, now: g.clock.peak_right_stress,
    ),
    Output(
        "front_position",
        "m",
        "Lagrangian position of the proximal compaction front",
        lambda g, now: now.front_position,
    ),
    Output(
        "distal_front_position",
        "m",
        "Lagrangian position of the distal compaction front",
        lambda g, now: now.distal_front_position,
    ),
    Output(
        "uncrushed_fraction",
        "1",
        "share of the crushable length that is not crushed",
        lambda g, now: now.uncrushed_fraction,
    ),
)
PROBE = (
    Output("position", "m", "position of the probe in the laboratory", lambda g, seen: seen.position),
    Output("velocity", "m s-1", "velocity at the probe", lambda g, seen: seen.velocity),
    Output("strain", "1", "engineering strain at the probe", lambda g, seen: seen.strain),
    Output("stress", "Pa", "stress at the probe", lambda g, seen: seen.stress),
)
NODE = (
    Output(
        "position",
        "m",
        "position of the node in the laboratory",
        lambda g, node: g.coordinate[node.number] + g.displacement[node.number],
    ),
    Output("velocity", "m s-1", "velocity, centred to the time of the stresses", lambda g, node: node.velocity),
    Output(
        "displacement",
        "m",
        "displacement from the initial position",
        lambda g, node: g.displacement[node.number],
    ),
)
ZONE = (
    Output("strain", "1", "engineering strain, compression positive", lambda g, zone: zone.strain),
    Output(
        "stress",
        "Pa",
        "axial stress, compression positive, without viscosity",
        lambda g, zone: g.seen_stress[zone.number],
    ),
    Output(
        "viscosity",
        "Pa",
        "artificial viscosity q",
        lambda g, zone: g.force[zone.number] - g.seen_stress[zone.number],
    ),
    Output("density", "kg m-3", "current density", lambda g, zone: zone.initial_density / (1.0 - zone.strain)),
    Output("internal_energy", "J kg-1", "specific internal energy", lambda g, zone: zone.energy),
)


def writer_of(outputs: Sequence[Output]) -> Callable[[Any, Any, Any, int, int], None]:
    """A function (grid, looked at, values, start, stride) that writes every output in the order of its declaration.

    It is put together from text, one line an output: a chain of functions would take the compiler seconds.
    """
    lines = [f"    values[start + {k} * stride] = take_{k}(g, looked_at)" for k in range(len(outputs))]
    scope: dict[str, Any] = {f"take_{k}": output.take for k, output in enumerate(outputs)}
    exec("\n".join(["def write(g, looked_at, values, start, stride):", *lines]), scope)
    scope["write"].__module__ = __name__
    return scope["write"]
