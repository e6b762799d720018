"""A cladding plate on R-P-P-L under pulses: u(t) in closed form."""

from __future__ import annotations

import numpy as np

from hydro1d.analytic import RPPL, CladColumn, ExponentialPulse, Pulse, TriangularPulse
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.pulses.exponential import Exponential
from hydro1d.boundaries.pulses.triangular import Triangular
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.laws.elastic import Elastic
from hydro1d.verify.case import Case, Effort
from hydro1d.verify.cases.materials import DENSIFICATION, DENSITY, PLATEAU, rppl
from hydro1d.verify.measure import Recording, crossing, extrapolate, order, simulate
from hydro1d.verify.rows import Table, line

STEEL_DENSITY, STEEL_MODULUS, PLATE = 7800.0, 200e9, 2e-3  # a plate of 15.6 kg/m²
PEAK = 8e6
STIFFNESSES = (1000.0, 4000.0, 16000.0)
TIMES = (0.25, 0.5, 0.75)  # of the stopping time
ROWS = 14
RAW = "the precursor's velocity is left out by the rigid theory"
LIMIT = "the line through three stiffnesses in K^(−½), at zero"
PULSES = {
    "exponential": (ExponentialPulse(PEAK, 1e-3), Exponential(peak=PEAK, decay=1e-3)),
    "triangular": (TriangularPulse(PEAK, 2e-3), Triangular(peak=PEAK, duration=2e-3)),
}


def _theory(pulse: Pulse) -> CladColumn:
    free = CladColumn(RPPL(DENSITY, PLATEAU, DENSIFICATION), STEEL_DENSITY * PLATE, pulse)
    return CladColumn(free.material, free.mass, pulse, 1.4 * free.critical_length)


def _run(stiffness: float, load: object, length: float, zones: int, end: float) -> Recording:
    plate = Layer(material="plate", law=Elastic(density=STEEL_DENSITY, modulus=STEEL_MODULUS), thickness=PLATE, zones=2)
    foam = Layer(material="foam", law=rppl(stiffness).law, thickness=length, zones=zones)
    return simulate([plate, foam], Pressure(pulse=load), Wall(), end=end, history=20)


def _study(table: Table, effort: Effort) -> None:
    zones = 600 if effort.full else 300
    for name, (pulse, load) in PULSES.items():
        exact = _theory(pulse)
        runs = [_run(k, load, exact.length, zones, 1.15 * exact.stop_time) for k in STIFFNESSES]
        times = np.array(TIMES) * exact.stop_time
        theory = exact.history(times).displacement
        found = np.array([np.interp(times, run["time"], run["left_position"]) for run in runs])
        for k, share in enumerate(TIMES):
            limit = extrapolate(STIFFNESSES, found[:, k], 0.5)
            table.compare(f"{name}: u at {share:g} of the stopping time, m, limit", theory[k], limit, 1e-2, LIMIT)
        largest = np.array([run["left_position"].max() for run in runs])
        last = float(exact.history(exact.stop_time).displacement)
        table.compare(f"{name}: largest u, m, K = 16000 σP", last, largest[-1], 2e-2, RAW)
        table.compare(f"{name}: largest u, m, limit", last, extrapolate(STIFFNESSES, largest, 0.5), 1e-2, LIMIT)
        stops = [crossing(run["time"][5:], run["left_velocity"][5:]) for run in runs]
        table.compare(
            f"{name}: stop time, s, limit", exact.stop_time, extrapolate(STIFFNESSES, stops, 0.5), 1e-2, LIMIT
        )
        errors = np.abs(largest / last - 1.0)
        found_order = order(np.sqrt(STIFFNESSES), errors)
        table.bound(f"{name}: largest u, order in √K", errors[-1], 2e-2, LIMIT, order=found_order, least_order=0.8)
        t = np.linspace(0.0, exact.stop_time, 300)
        lines = [line(1e3 * t, exact.history(t).displacement, "rigid theory", "exact")]
        for run, stiffness in ((runs[0], 1000), (runs[-1], 16000)):
            lines.append(line(1e3 * run["time"], run["left_position"], f"K = {stiffness} σP"))
        table.panel(f"{name} pulse", "t, ms", "u, m", lines)
        table.panel(
            f"{name}: convergence", "K/σP", "relative error of u", [line(STIFFNESSES, errors, "largest u")], log=True
        )


def cases() -> list[Case]:
    """One case."""
    about = (
        "A steel plate of 15.6 kg/m² on R-P-P-L foam with a fixed back, loaded by an exponential and by a "
        "triangular pulse of 8 MPa; the "
        "plate is an elastic layer of two zones. In the rigid limit u(t) is the root of a quadratic."
    )
    return [Case("clad-plate", "Plate on R-P-P-L under a pulse", about, ROWS, _study)]
