"""A striker on R-PH foam: a decaying shock with hardening, at finite moduli and in the rigid limit."""

from __future__ import annotations

import numpy as np

from hydro1d import analytic
from hydro1d.analytic import CompactionStriker, RPHFoam, RPHStriker
from hydro1d.boundaries.striker import Striker
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.laws.rph import RPH
from hydro1d.verify.case import Case, Effort
from hydro1d.verify.cases.materials import DENSITY, PLATEAU
from hydro1d.verify.measure import Recording, crossing, extrapolate, order, simulate
from hydro1d.verify.rows import Table, line

HARDENING, MASS, VELOCITY = 0.1e6, 20.0, 120.0
MODULI = (0.4e9, 1.6e9, 6.4e9)
TIMES = (0.2, 0.4, 0.6, 0.8)  # of the stopping time
ROWS = 17
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
    foam = RPHFoam(DENSITY, PLATEAU, HARDENING)
    free = RPHStriker(foam, MASS, VELOCITY)
    exact = RPHStriker(foam, MASS, VELOCITY, 1.4 * free.stop_front)
    zones = 1600 if effort.full else 800
    runs = [_run(modulus, exact.length, zones, 1.15 * exact.stop_time) for modulus in MODULI]
    _finite(table, effort, exact, runs[0])
    stops = np.array([crossing(run["time"], run["left_striker_velocity"]) for run in runs])
    distances = np.array([run["left_striker_position"].max() for run in runs])
    errors = _rigid(table, exact, runs, stops, distances)
    energy = max(float(np.abs(run["energy_error"]).max()) for run in runs)
    table.bound("energy balance", energy, 1e-12, "compatible differencing")
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
        table.compare(f"{quantity}, E = 6.4 GPa", value, values[-1], 1e-2, RAW)
        table.compare(f"{quantity}, limit", value, extrapolate(MODULI, values, 0.5), 1e-2, LIMIT)
    errors = np.abs(distances / exact.stop_distance - 1.0)
    found_order = order(np.sqrt(MODULI), errors)
    table.bound(
        "stop distance, approach to the limit, order in √E", errors[-1], 1e-2, LIMIT, order=found_order, least_order=0.8
    )
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
    table.bound(
        "E = 0.4 GPa: ∫|Δε|dX over ∫ε dX, finite-E theory",
        gaps[-1],
        5e-2,
        DECAYS,
        order=order(levels, gaps),
        least_order=0.6,
    )
    table.convergence(levels, {"strain": gaps}, "∫|Δε|dX over ∫ε dX")
    table.panel(
        f"strain at {1e3 * frame.time:.2f} ms, E = 0.4 GPa",
        "X, m",
        "ε",
        [line(x, strain, "theory", "exact"), line(x, frame.fields["strain"], "run")],
    )


def _figures(table: Table, exact: RPHStriker, run: Recording, distances: np.ndarray, times: np.ndarray) -> None:
    t = np.linspace(0.0, exact.stop_time, 200)
    lines = [
        line(1e3 * t, exact.history(t).velocity, "rigid theory", "exact"),
        line(1e3 * run["time"], run["left_striker_velocity"], "E = 6.4 GPa"),
    ]
    table.panel("velocity of the striker", "t, ms", "v, m/s", lines)
    fields, x = run.last, run.column.zone_coordinate
    strain = exact(x, exact.stop_time).strain
    table.panel(
        "strain at rest",
        "X, m",
        "ε",
        [line(x, strain, "rigid theory", "exact"), line(x, fields["strain"], "E = 6.4 GPa")],
    )
    table.panel(
        "convergence",
        "E, Pa",
        "relative error",
        [line(MODULI, distances, "stop distance"), line(MODULI, times, "stop time")],
        log=True,
    )


def cases() -> list[Case]:
    """One case."""
    about = (
        "20 kg/m² at 120 m/s on foam that hardens from the first (R-PH). The rigid theory has closed forms; the "
        "solver's foam is elastic below yield, so the case shows the softest run against the theory of its modulus, "
        "the stiffest, 6.4 GPa, against the rigid formulas, and the limit in E^(−½)."
    )
    return [Case("rph-striker", "Striker on R-PH", about, ROWS, _study)]
