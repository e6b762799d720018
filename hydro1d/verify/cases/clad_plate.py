"""A cladding plate on R-P-P-L under pulses: u(t) in closed form."""

import numpy as np

from hydro1d.analytic import RPPL, CladColumn, ExponentialPulse, Pulse, TriangularPulse
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.laws.elastic import Elastic
from hydro1d.loads.exponential import Exponential
from hydro1d.loads.triangular import Triangular
from hydro1d.verify.cases.materials import DENSIFICATION, DENSITY, PLATEAU, rppl
from hydro1d.verify.convergence import crossing
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

STEEL_DENSITY, STEEL_MODULUS, PLATE = 7800.0, 200e9, 2e-3  # a plate of 15.6 kg/m²
PEAK = 8e6
STIFFNESSES = (4000.0, 16000.0, 64000.0)  # in plateau stresses; the last one is within 1 % of the rigid limit
TIMES = (0.25, 0.5, 0.75)  # of the stopping time
RAW = "the precursor's velocity √(σP/(K ρ0)), 0.5 m/s at this K, is left out by the rigid theory"
STIFFEST = f"K = {STIFFNESSES[-1]:g} σP", 1e-2, RAW
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
    """A steel plate of 15.6 kg/m² on R-P-P-L foam with a fixed back, loaded by an exponential and by a triangular pulse
    of 8 MPa; the plate is an elastic layer of two zones. In the rigid limit u(t) is the root of a quadratic; rows at K
    = 64000 σP, and the limit in K^(−½) of three stiffnesses.
    """
    zones = 600 if effort.full else 300
    for name, (pulse, load) in PULSES.items():
        exact = _theory(pulse)
        runs = [_run(k, load, exact.length, zones, 1.15 * exact.stop_time) for k in STIFFNESSES]
        _rigid(table, name, exact, runs)
        _figures(table, name, exact, runs)


def _rigid(table: Table, name: str, exact: CladColumn, runs: list[Recording]) -> None:
    """Path, largest displacement and stop time at the stiffest, and extrapolated, against the rigid formulas."""
    times = np.array(TIMES) * exact.stop_time
    paths = np.array([np.interp(times, run["time"], run["left_position"]) for run in runs])
    largest = np.array([run["left_position"].max() for run in runs])
    stops = np.array([crossing(run["time"][5:], run["left_velocity"][5:]) for run in runs])
    last = float(exact.history(exact.stop_time).displacement)
    found = [
        *((f"u at {share:g} of the stopping time, m", paths[:, k]) for k, share in enumerate(TIMES)),
        ("largest u, m", largest),
        ("stop time, s", stops),
    ]
    theory = [*exact.history(times).displacement, last, exact.stop_time]
    for (quantity, values), value in zip(found, theory, strict=True):
        table.rigid_limit(f"{name}: {quantity}", value, STIFFNESSES, values, STIFFEST, (3e-3, LIMIT))
    errors = np.abs(largest / last - 1.0)
    roots = np.sqrt(STIFFNESSES)
    table.converges(f"{name}: largest u, order in √K", roots, errors, 1e-2, LIMIT, least_order=0.8)


def _figures(table: Table, name: str, exact: CladColumn, runs: list[Recording]) -> None:
    t = np.linspace(0.0, exact.stop_time, 300)
    path = exact.history(t).displacement
    lines = [line(1e3 * t, path, "rigid theory", "exact")]
    for run, stiffness in ((runs[0], STIFFNESSES[0]), (runs[-1], STIFFNESSES[-1])):
        lines.append(line(1e3 * run["time"], run["left_position"], f"K = {stiffness:g} σP"))
    table.panel(f"{name} pulse", "t, ms", "u, m", lines)
    errors = np.abs([run["left_position"].max() / path[-1] - 1.0 for run in runs])
    convergence = [line(STIFFNESSES, errors, "largest u")]
    table.panel(f"{name}: convergence", "K/σP", "relative error of u", convergence, log=True)


CASES = [Case.of("clad-plate", "Plate on R-P-P-L under a pulse", 22, _study)]
