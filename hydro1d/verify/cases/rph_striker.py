"""A striker on R-PH foam: a decaying shock with hardening, at finite moduli and in the rigid limit."""

import numpy as np

from hydro1d import analytic
from hydro1d.analytic import CompactionStriker, RPHFoam, RPHStriker
from hydro1d.boundaries.striker import Striker
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.laws.rph import RPH
from hydro1d.verify.cases.materials import DENSITY, PLATEAU
from hydro1d.verify.convergence import crossing
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

HARDENING, MASS, VELOCITY = 0.1e6, 20.0, 120.0
MODULI = (0.4e9, 1.6e9, 6.4e9)
TIMES = (0.2, 0.4, 0.6, 0.8)  # of the stopping time
RAW = "the precursor's velocity σP/√(E ρ0) is left out by the rigid theory"
LIMIT = "the line through three moduli in E^(−½), at zero"
DECAYS = "a front that decays within its own width leaves less strain than a sharp one: the error falls as that width"
FINITE = "theory of the same modulus: what is left is the numerical front and elastic recovery"


def _run(modulus: float, length: float, zones: int, end: float) -> Recording:
    law = RPH(density=DENSITY, modulus=modulus, plateau_stress=PLATEAU, hardening=HARDENING)
    layer = Layer(law=law, thickness=length, zones=zones)
    profiles = (0.7 * MASS * VELOCITY / PLATEAU, end)
    return simulate(layer, Striker(mass=MASS, velocity=VELOCITY), Wall(), end=end, profiles=profiles, history=10)


def _study(table: Table, effort: Effort) -> None:
    """20 kg/m² at 120 m/s on foam that hardens from the first (R-PH). The rigid theory has closed forms; the solver's
    foam is elastic below yield, so the case shows the softest run against the theory of its modulus, the stiffest, 6.4
    GPa, against the rigid formulas, and the limit in E^(−½).
    """
    foam = RPHFoam(DENSITY, PLATEAU, HARDENING)
    free = RPHStriker(foam, MASS, VELOCITY)
    exact = RPHStriker(foam, MASS, VELOCITY, 1.4 * free.stop_front)
    zones = 1600 if effort.full else 800
    runs = [_run(modulus, exact.length, zones, 1.15 * exact.stop_time) for modulus in MODULI]
    _finite(table, effort, exact, runs[0])
    stops = np.array([crossing(run["time"], run["left_striker_velocity"]) for run in runs])
    distances = np.array([run["left_striker_position"].max() for run in runs])
    errors = _rigid(table, exact, runs, stops, distances)
    table.bound("energy balance", max(run.energy_error for run in runs), 1e-12, "compatible differencing")
    _figures(table, exact, runs[-1], errors, np.abs(stops / exact.stop_time - 1.0))


def _rigid(
    table: Table, exact: RPHStriker, runs: list[Recording], stops: np.ndarray, distances: np.ndarray
) -> np.ndarray:
    """Stop and path at the stiffest, and extrapolated, against the rigid formulas; errors of the stop distance."""
    times = np.array(TIMES) * exact.stop_time
    paths = np.array([np.interp(times, run["time"], run["left_striker_position"]) for run in runs])
    found = [
        ("stop time, s", stops),
        ("stop distance, m", distances),
        *((f"u at {share:g} of the stopping time, m", paths[:, k]) for k, share in enumerate(TIMES)),
    ]
    theory = [exact.stop_time, exact.stop_distance, *exact.history(times).displacement]
    for (quantity, values), value in zip(found, theory, strict=True):
        table.rigid_limit(quantity, value, MODULI, values, ("E = 6.4 GPa", 1e-2, RAW), (1e-2, LIMIT))
    errors, name = np.abs(distances / exact.stop_distance - 1.0), "stop distance, approach to the limit, order in √E"
    table.converges(name, np.sqrt(MODULI), errors, 1e-2, LIMIT, least_order=0.8)
    return errors


def _finite(table: Table, effort: Effort, exact: RPHStriker, run: Recording) -> None:
    """The softest foam against the theory of its modulus, which ends when the block has slowed down to VY."""
    theory = CompactionStriker(analytic.RPH(DENSITY, MODULI[0], PLATEAU, HARDENING), exact.length, MASS, VELOCITY)
    t = np.linspace(0.05, 0.95, 40) * theory.end_time
    history = theory.history(t)
    for name, column, values, scale in (
        ("v over v0", "left_striker_velocity", history.velocity, VELOCITY),
        ("u over the stop distance", "left_striker_position", history.displacement, exact.stop_distance),
    ):
        gap = np.abs(np.interp(t, run["time"], run[column]) - values).max() / scale
        table.bound(f"E = 0.4 GPa: {name}, against finite-E theory", float(gap), 1e-2, FINITE)
    # Not the history's front: without a densification strain it is where half of the strongest strain is, and this
    # front decays.
    levels, gaps = effort.zones(200), []
    for zones in levels:
        run = _run(MODULI[0], exact.length, zones, 0.75 * exact.stop_time)
        x, frame = run.column.zone_coordinate, run.frames[0]
        strain = theory(x, frame.time).strain
        gaps.append(float(np.sum(np.abs(frame.fields["strain"] - strain)) / np.sum(strain)))
    name = "E = 0.4 GPa: ∫|Δε|dX over ∫ε dX, finite-E theory"
    table.converges(name, levels, gaps, 5e-2, DECAYS, least_order=0.6)
    table.convergence(levels, {"strain": gaps}, "∫|Δε|dX over ∫ε dX")
    title, profiles = f"strain at {1e3 * frame.time:.2f} ms, E = 0.4 GPa", ((x, strain), (x, frame.fields["strain"]))
    table.beside(title, "X, m", "ε", *profiles, "run", "theory")


def _figures(table: Table, exact: RPHStriker, run: Recording, distances: np.ndarray, times: np.ndarray) -> None:
    t = np.linspace(0.0, exact.stop_time, 200)
    names = "E = 6.4 GPa", "rigid theory"
    velocities = (1e3 * t, exact.history(t).velocity), (1e3 * run["time"], run["left_striker_velocity"])
    table.beside("velocity of the striker", "t, ms", "v, m/s", *velocities, *names)
    x = run.column.zone_coordinate
    strains = (x, exact(x, exact.stop_time).strain), (x, run.last["strain"])
    table.beside("strain at rest", "X, m", "ε", *strains, *names)
    errors = [line(MODULI, distances, "stop distance"), line(MODULI, times, "stop time")]
    table.panel("convergence", "E, Pa", "relative error", errors, log=True)


CASES = [Case.of("rph-striker", "Striker on R-PH", 17, _study)]
