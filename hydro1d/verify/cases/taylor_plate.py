"""Taylor's free plate: an exponential pulse in an elastic medium meets a plate that it accelerates and then leaves."""

import numpy as np

from hydro1d.analytic import TaylorPlate
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.striker import Striker
from hydro1d.deck import Layer
from hydro1d.laws.elastic import Elastic
from hydro1d.loads.exponential import Exponential
from hydro1d.verify.convergence import crossing
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table

WATER = {"density": 1000.0, "modulus": 2.25e9}
PEAK, DECAY, DEPTH = 10e6, 1e-4, 0.6
MASSES = (30.0, 150.0, 600.0)  # kg/m²; β = ρ c θ/M from 5 to 0.25
REST = -1e-9  # m/s: a striker must close on the end; this plate rests on it
REASON = (
    "the jump at the head of the pulse is captured over a few zones, which cost the plate a part of its first "
    "acceleration"
)


def _run(mass: float, zones: int, end: float) -> Recording:
    layer = Layer(law=Elastic(**WATER), thickness=DEPTH, zones=zones)
    load = Pressure(pulse=Exponential(peak=PEAK, decay=DECAY))
    return simulate(layer, load, Striker(mass=mass, velocity=REST), end=end, history=1)


def _study(table: Table, effort: Effort) -> None:
    """An exponential pulse in water, taken as linear elastic, meets plates of three masses at rest on it (a striker
    that pushes and never pulls): velocity, impulse and displacement until the water cavitates at the plate, and when it
    does.
    """
    zones, curves = effort.zones(300), {}
    for mass in MASSES:
        exact = TaylorPlate(**WATER, mass=mass, peak=PEAK, decay=DECAY, thickness=DEPTH)
        end = min(1.15 * exact.cavitation_time, 2.9 * exact.arrival_time)
        runs = [_run(mass, n, end) for n in zones]
        name = f"β = {exact.beta:.3g}"
        curves[name] = _velocities(table, name, exact, runs, zones)
        _at_cavitation(table, name, exact, runs[-1])
    table.bound("energy balance", runs[-1].energy_error, 1e-12, "compatible differencing")
    table.convergence(zones, curves, "mean |Δv| over the largest v")


def _velocities(
    table: Table, name: str, exact: TaylorPlate, runs: list[Recording], zones: tuple[int, ...]
) -> np.ndarray:
    """Velocity of the plate until cavitation; its errors."""
    t = np.linspace(exact.arrival_time, exact.cavitation_time, 200)
    theory = exact.history(t).velocity
    gaps = [np.abs(np.interp(t, run["time"], run["right_striker_velocity"]) - theory).mean() for run in runs]
    errors = np.array(gaps) / float(theory.max())
    table.converges(f"{name}: mean |Δv| over the largest v", zones, errors, 1e-2, REASON, least_order=0.9)
    found = 1e3 * runs[-1]["time"], runs[-1]["right_striker_velocity"]
    table.beside(f"plate, {name}", "t, ms", "v, m/s", (1e3 * t, theory), found, f"{zones[-1]} zones")
    return errors


def _at_cavitation(table: Table, name: str, exact: TaylorPlate, run: Recording) -> None:
    """When the water lets go of the plate, with what impulse and where; then the plate flies on."""
    since = exact.cavitation_time - exact.arrival_time
    later = run["time"] > 1.02 * exact.arrival_time
    found = crossing(run["time"][later], run["right_stress"][later]) - exact.arrival_time
    table.compare(f"{name}: cavitation time after arrival, s", since, found, 1e-2, REASON)
    largest = float(run["right_striker_velocity"].max())
    table.compare(f"{name}: impulse of the plate, Pa s", exact.impulse, exact.mass * largest, 1e-2, REASON)
    u = float(np.interp(exact.cavitation_time, run["time"], run["right_striker_position"])) - DEPTH
    path = float(exact.history(exact.cavitation_time).displacement)
    table.compare(f"{name}: u at cavitation, m", path, u, 1e-2, REASON)
    last = float(run["right_striker_velocity"][-1])
    free = "nothing holds the plate"
    table.compare(f"{name}: v after cavitation over the largest v", 1.0, last / largest, 1e-3, free)


CASES = [Case.of("taylor-plate", "Taylor's free plate", 16, _study)]
