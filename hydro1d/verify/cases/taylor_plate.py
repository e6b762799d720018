"""Taylor's free plate: an exponential pulse in an elastic medium meets a plate that it accelerates and then leaves."""

from __future__ import annotations

import numpy as np

from hydro1d.analytic import TaylorPlate
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.pulses.exponential import Exponential
from hydro1d.boundaries.striker import Striker
from hydro1d.deck import Layer
from hydro1d.laws.elastic import Elastic
from hydro1d.verify.case import Case, Effort
from hydro1d.verify.measure import Recording, order, simulate
from hydro1d.verify.rows import Table, line

WATER = {"density": 1000.0, "modulus": 2.25e9}
PEAK, DECAY, DEPTH = 10e6, 1e-4, 0.6
MASSES = (30.0, 150.0, 600.0)  # kg/m²; β = ρ c θ/M from 5 to 0.25
REST = -1e-9  # m/s: a striker must close on the end; this plate rests on it
ROWS = 13
REASON = (
    "the jump at the head of the pulse is captured over a few zones, which cost the plate a part of its first "
    "acceleration"
)


def _run(mass: float, zones: int, end: float) -> Recording:
    layer = Layer(law=Elastic(**WATER), thickness=DEPTH, zones=zones)
    load = Pressure(pulse=Exponential(peak=PEAK, decay=DECAY))
    return simulate(layer, load, Striker(mass=mass, velocity=REST), end=end, history=1)


def _separation(run: Recording) -> float:
    """When plate and medium part: the first time after the arrival that the medium no longer pushes, s."""
    position, velocity = run["right_striker_position"], run["right_striker_velocity"]
    apart = position - run["right_position"] > 1e-9 * DEPTH
    moving = velocity > 0.05 * velocity.max()
    gone = np.flatnonzero(apart & moving)
    return float(run["time"][gone[0]]) if len(gone) else float("nan")


def _study(table: Table, effort: Effort) -> None:
    zones = effort.zones(300)
    curves = {}
    for mass in MASSES:
        exact = TaylorPlate(**WATER, mass=mass, peak=PEAK, decay=DECAY, thickness=DEPTH)
        runs = [_run(mass, n, min(1.15 * exact.cavitation_time, 2.9 * exact.arrival_time)) for n in zones]
        t = np.linspace(exact.arrival_time, exact.cavitation_time, 200)
        theory = exact.history(t)
        gaps = [
            np.abs(np.interp(t, run["time"], run["right_striker_velocity"]) - theory.velocity).mean() for run in runs
        ]
        errors = np.array(gaps) / float(theory.velocity.max())
        finest = runs[-1]
        name = f"β = {exact.beta:.3g}"
        table.bound(
            f"{name}: mean |Δv| over the largest v",
            errors[-1],
            1e-2,
            REASON,
            order=order(zones, errors),
            least_order=0.9,
        )
        table.compare(
            f"{name}: cavitation time after arrival, s",
            exact.cavitation_time,
            _separation(finest),
            1e-2,
            REASON,
            scale=exact.cavitation_time - exact.arrival_time,
        )
        largest = finest["right_striker_velocity"].max()
        table.compare(f"{name}: impulse of the plate, Pa s", exact.impulse, mass * float(largest), 1e-2, REASON)
        u = float(np.interp(exact.cavitation_time, finest["time"], finest["right_striker_position"])) - DEPTH
        table.compare(
            f"{name}: u at cavitation, m", float(exact.history(exact.cavitation_time).displacement), u, 1e-2, REASON
        )
        curves[name] = errors
        lines = [
            line(1e3 * t, theory.velocity, "exact", "exact"),
            line(1e3 * finest["time"], finest["right_striker_velocity"], f"{zones[-1]} zones"),
        ]
        table.panel(f"plate, {name}", "t, ms", "v, m/s", lines)
    table.bound("energy balance", float(np.abs(finest["energy_error"]).max()), 1e-12, "compatible differencing")
    table.convergence(zones, curves, "mean |Δv| over the largest v")


def cases() -> list[Case]:
    """One case."""
    about = (
        "An exponential pulse in water, taken as linear elastic, meets plates of three masses at rest on it (a "
        "striker that pushes and never "
        "pulls): velocity, impulse and displacement until the water cavitates at the plate, and when it does."
    )
    return [Case("taylor-plate", "Taylor's free plate", about, ROWS, _study)]
