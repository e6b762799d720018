"""Where everything stands in the arrays that Python and compiled code share."""

from __future__ import annotations

from typing import Any, NamedTuple

from hydro1d.kernels import ends as end_places
from hydro1d.kernels import zones as zone_places

# Places in the ledger: the scalars of the state, then what a call is to do, then what it answers.
TIME, LAST_STEP, FREE_STEP, NEXT_STEP, CYCLE = range(5)
WORK, IMPULSE, VISCOUS_WORK, LARGEST_INPUT = range(5, 9)
PEAK_STRESS, PEAK_LEFT, PEAK_RIGHT, FIRST_ENERGY = range(9, 13)
LEFT_FRONT, RIGHT_FRONT, FIRST_STEP, PACE_TIME = range(13, 17)
STOP, STEPS, CADENCE, ROW_AT_STOP, CFL = range(17, 22)
STATUS, ROWS, LIMITING_LAYER = range(22, 25)
WORK_LOST, IMPULSE_LOST = range(25, 27)  # what rounding took off their sums
STOPS, ENOUGH, PASSED, PROFILES = range(27, 31)  # of a call: how many are given, end it, were passed; profiles taken
LEDGER = 31

# A run that breaks down is tried again from the start of a block of so many cycles, wherever calls have cut the run.
CYCLE_BLOCK = 32

# What a call answers as its status
REACHED, PAUSED, NOT_FINITE, INVERTED, COLLAPSED = range(5)

# Places in the layer table (integers) and in the layers' numbers behind the zone kernel's own.
FIRST_ZONE, ZONES, PARAMETERS = range(3)
LAYER = 3
CRUSHED_STRAIN, YIELD_STRAIN, TOP_STRAIN, SIZE, ZONE_MASS, SETTLED = range(
    zone_places.NUMBERS + 1, zone_places.NUMBERS + 7
)
NUMBERS = zone_places.NUMBERS + 7

END = 10  # numbers of a `boundaries.base.End`

SCRATCH = zone_places.RESULTS  # where `out` goes on after the answers of a kernel
REMEMBERED = SCRATCH + end_places.MEMORY  # of both boundaries
OUT = REMEMBERED + 2 * end_places.MEMORY


class Arrays(NamedTuple):
    """What the time loop works on.

    Over nodes: displacement, mass, inverse_mass, coordinate; velocity and spare (velocities at another time), with a ghost
    at each end, so node i stands at i + 1. Over zones: energy (specific, at the last settling), gained (since then), force
    (σ + q), viscosity (q), state (largest strain, then the laws' history, `zones` apart: so many `variables`), and what
    `zones.foam_kernel` remembers. rows and probe_rows: history as it is recorded. stops: times at which to arrive, each
    followed by 1 if a profile is to be taken there; profiles: one after the other.
    """

    ledger: Any
    layers: Any
    addresses: Any
    parameters: Any
    numbers: Any
    end_numbers: Any
    memory: Any
    out: Any
    velocity: Any
    spare: Any
    displacement: Any
    energy: Any
    gained: Any
    force: Any
    viscosity: Any
    state: Any
    curve: Any
    tangents: Any
    stiffnesses: Any
    speeds: Any
    mass: Any
    inverse_mass: Any
    coordinate: Any
    rows: Any
    probes: Any
    probe_weights: Any
    probe_rows: Any
    stops: Any
    profiles: Any
    layer_count: int
    zones: int
    columns: int
    variables: int


SIGNATURE = "pqq" + 21 * "p" + "qpppp" + "iiii"  # of `Arrays`; p: pointer to double, q: to integers, i: integer
