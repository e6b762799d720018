"""A striker on R-P-P-L: Eqs. 8, 9, 12, 13, at a finite stiffness K and in the limit K → ∞."""

from typing import NamedTuple

import numpy as np

from hydro1d.analytic import RPPL, CompactionStriker, RPPLStriker
from hydro1d.analytic.rppl import energy_ratio
from hydro1d.boundaries.striker import Striker
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.verify.cases.materials import rppl
from hydro1d.verify.convergence import extrapolate
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

FOAM = RPPL(155.0, 0.3e6, 0.67)  # Fig. 3 of the paper
MASS, VELOCITY = 40.0, 100.0
STIFFNESSES = (1000.0, 4000.0, 16000.0)  # in plateau stresses: the law's default, and what 1 % of the rigid limit takes
SHARES = (0.1, 0.3, 0.5, 0.7)  # of the stopping displacement
HALVINGS = 8
FINITE = "theory of the same finite stiffness (precursor, two fronts): what is left is the numerical front"
RIGID = "the precursor's velocity √(σP/(K ρ0)) is left out by the rigid theory: 0.35 m/s, 0.35 % of v0, at this K"
STIFFEST = "K = 16000 σP", 1e-2, RIGID
LIMIT = "the line through three stiffnesses in K^(−½), at zero"
SEARCH = "bisection to 0.1 % of the length; the rigid limit by extrapolation in K^(−½)"


class Passage(NamedTuple):
    """v/v0 and σD at the SHARES of displacement."""

    velocity: np.ndarray
    stress: np.ndarray


def _run(stiffness: float, length: float, zones: int, end: float) -> Recording:
    material = rppl(stiffness, FOAM.density, FOAM.plateau_stress, FOAM.densification_strain)
    layer = Layer(law=material.law, thickness=length, zones=zones)
    return simulate(layer, Striker(mass=MASS, velocity=VELOCITY), Wall(), end=end, history=10)


def _front_stress(run: Recording, t: float, window: float) -> float:
    """σD: what slows down striker and crushed block, their mass times deceleration, by a parabola through v(t)."""
    near = np.abs(run["time"] - t) < window
    times, velocity = run["time"][near] - t, run["left_striker_velocity"][near]
    slope = float(np.polyfit(times / window, velocity, 2)[1]) / window
    front = float(np.interp(t, run["time"], run["front_position"]))
    return -slope * (MASS + FOAM.density * front)


def _passage(stiffness: float, exact: RPPLStriker, zones: int) -> tuple[Passage, Recording]:
    displacements = np.array(SHARES) * exact.critical_length * FOAM.densification_strain
    times = np.linspace(0.0, exact.stop_time, 4001)
    moments = np.interp(displacements, exact.history(times).displacement, times)
    run = _run(stiffness, exact.length, zones, exact.stop_time)
    velocity = np.interp(displacements, run["left_striker_position"], run["left_striker_velocity"])
    stress = np.array([_front_stress(run, float(t), 0.12 * float(t)) for t in moments])
    moved = np.interp(moments, run["time"], run["left_striker_position"])
    return Passage(velocity / VELOCITY, stress / exact.stress_at(moved)), run


def _finite(table: Table, exact: RPPLStriker, run: Recording) -> None:
    """The default stiffness against the theory of that stiffness."""
    curve = rppl(STIFFNESSES[0], FOAM.density, FOAM.plateau_stress, FOAM.densification_strain).curve
    theory = CompactionStriker(curve, exact.length, MASS, VELOCITY)
    t = np.linspace(0.05, 0.95, 40) * min(theory.end_time, exact.stop_time)
    history = theory.history(t)
    gap = np.abs(np.interp(t, run["time"], run["left_striker_velocity"]) - history.velocity).max() / VELOCITY
    table.bound("K = 1000 σP: v(t) over v0, against finite-K theory", float(gap), 5e-3, FINITE)
    front = np.abs(np.interp(t, run["time"], run["front_position"]) - history.front).max() / exact.critical_length
    table.bound("K = 1000 σP: front over lCR, against finite-K theory", float(front), 5e-3, FINITE)
    velocities = (1e3 * t, history.velocity), (1e3 * run["time"], run["left_striker_velocity"])
    table.beside("striker at the default stiffness", "t, ms", "v, m/s", *velocities, "run", "theory, K = 1000 σP")


def _critical_length(stiffness: float, guess: float, zones: int) -> tuple[float, float]:
    """Longest column that is fully crushed, and its internal energy then over σP εD l."""
    low, high, energy = 0.9 * guess, 1.15 * guess, float("nan")
    for _ in range(HALVINGS):
        length = 0.5 * (low + high)
        run = _run(stiffness, length, zones, 1.05 * MASS * VELOCITY / FOAM.plateau_stress)
        if run["uncrushed_fraction"][-1] <= 0.0:
            low = length
            # Striker and end node start as one: what that impact dissipates is absorbed by the end's half zone.
            node = run.column.node_mass[0]
            lost = 0.5 * MASS * VELOCITY**2 * node / (MASS + node)
            work = FOAM.plateau_stress * FOAM.densification_strain * length
            energy = (float(run["internal_energy"].max()) + lost) / work
        else:
            high = length
    return 0.5 * (low + high), energy


def _study(table: Table, effort: Effort) -> None:
    """40 kg/m² at 100 m/s on R-P-P-L (Fig. 3's foam). A rigid material is regularised by lines of slope K; the case
    shows the run at the default K against the theory of that K, the run at 16000 σP against the rigid formulas, and the
    limit in K^(−½). lCR is found by bisection on the length of the column; ψ is the internal energy of the column that
    is just fully crushed.
    """
    free = RPPLStriker(FOAM, MASS, VELOCITY)
    exact = RPPLStriker(FOAM, MASS, VELOCITY, 1.3 * free.critical_length)
    zones = effort.zones(250)[-2] if effort.full else 250
    passages, runs = zip(*[_passage(k, exact, zones) for k in STIFFNESSES], strict=True)
    _finite(table, exact, runs[0])
    displacements = np.array(SHARES) * free.critical_length * FOAM.densification_strain
    theory = exact.velocity_at(displacements) / VELOCITY
    velocities = np.array([p.velocity for p in passages])
    stresses = np.array([p.stress for p in passages])
    for k, share in enumerate(SHARES):
        name, limit = f"v/v0 at {share:g} of the way (Eq. 8)", (3e-3, LIMIT)
        table.rigid_limit(name, theory[k], STIFFNESSES, velocities[:, k], STIFFEST, limit, scale=1.0)
    for k, share in enumerate(SHARES[1:], start=1):
        name, limit = f"σD over Eq. 9 at {share:g} of the way", (1e-2, LIMIT)
        table.rigid_limit(name, 1.0, STIFFNESSES, stresses[:, k], STIFFEST, limit)
    errors, name = np.abs(velocities - theory).max(axis=1), "v/v0, approach to the limit, order in √K"
    table.converges(name, np.sqrt(STIFFNESSES), errors, 1e-2, LIMIT, least_order=0.8)
    lengths = _searched(table, free.critical_length, zones // 2)
    _figures(table, exact, runs[-1], errors, np.abs(lengths / free.critical_length - 1.0))


def _searched(table: Table, exact: float, zones: int) -> np.ndarray:
    """The critical length (m) and ψ by bisection at every stiffness; returns the lengths."""
    found = [_critical_length(k, exact, zones) for k in STIFFNESSES]
    lengths, ratios = (np.array(values) for values in zip(*found, strict=True))
    limit = extrapolate(STIFFNESSES, lengths, 0.5)
    table.compare("lCR by search (Eq. 13), K = 16000 σP, m", exact, lengths[-1], 1e-2, SEARCH)
    table.compare("lCR by search (Eq. 13), limit, m", exact, limit, 1e-2, SEARCH)
    psi, stiffest = float(energy_ratio(FOAM, MASS, exact)), ("K = 16000 σP", 1e-2, SEARCH)
    table.rigid_limit("ψ (Eq. 12)", psi, STIFFNESSES, ratios, stiffest, (1e-2, SEARCH))
    both = "the precursor crushes the far end too"
    table.report("lCR by search at the default stiffness, m", exact, lengths[0], both)
    table.report("ψ at the default stiffness", psi, ratios[0], "reported")
    return lengths


def _figures(table: Table, exact: RPPLStriker, run: Recording, errors: np.ndarray, lengths: np.ndarray) -> None:
    u = np.linspace(0.0, 0.999 * exact.critical_length * FOAM.densification_strain, 300)
    velocities = (u, exact.velocity_at(u)), (run["left_striker_position"], run["left_striker_velocity"])
    table.beside("velocity of the striker", "u, m", "v, m/s", *velocities, "K = 16000 σP", "Eq. 8")
    lines = [line(STIFFNESSES, errors, "v/v0"), line(STIFFNESSES, lengths, "lCR")]
    table.panel("convergence", "K/σP", "error", lines, log=True)


CASES = [Case.of("rppl-striker", "Striker on R-P-P-L", 23, _study)]
