"""A rectangular pulse on R-P-P-L (p = 4.5, T = 1.53 ms): Eqs. 25–30, at finite stiffness and in the rigid limit."""

from typing import NamedTuple

import numpy as np

from hydro1d.analytic import RPPL, CompactionPulse, RPPLPulse
from hydro1d.analytic.rppl_pulse import critical_duration
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.loads.rectangular import Rectangular
from hydro1d.verify.cases.materials import DENSIFICATION, DENSITY, PLATEAU, rppl
from hydro1d.verify.convergence import crossing
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

FOAM = RPPL(DENSITY, PLATEAU, DENSIFICATION)
PRESSURE, DURATION, LENGTH = 3.6e6, 1.53e-3, 1.0
STIFFNESSES = (1000.0, 4000.0, 16000.0)
HALVINGS = 8
RAW = "the precursor's velocity √(σP/(K ρ0)), left out by the rigid theory, is 0.6 % of vI at 16000 σP"
LIMIT = "the line through three stiffnesses in K^(−½), at zero"
FINITE = "theory of the same finite stiffness: what is left is the numerical front and the ringing of the block"


class Found(NamedTuple):
    """vI, lI, stop time, lCR2 as a run shows them."""

    velocity: float
    pulse_length: float
    stop_time: float
    length: float


def _run(stiffness: float, duration: float, length: float, zones: int, end: float) -> Recording:
    load = Pressure(pulse=Rectangular(peak=PRESSURE, duration=duration))
    layer = Layer(law=rppl(stiffness).law, thickness=length, zones=zones)
    return simulate(layer, load, Wall(), end=end, profiles=(duration, end), history=10)


def _found(run: Recording) -> Found:
    t, front = run["time"], run["front_position"]
    at_end = float(np.interp(DURATION, t, front))
    fields = run.frames[0].fields
    node = int(at_end / run.column.layers[0].size) - 12
    velocity = float(np.median(fields["velocity"][5:node]))
    stop = crossing(t, run["momentum"])
    return Found(velocity, at_end, stop, float(np.nanmax(front)))


def _critical_duration(stiffness: float, guess: float, zones: int) -> float:
    """Shortest pulse that crushes every zone, by bisection, s."""
    low, high = 0.85 * guess, 1.1 * guess
    for _ in range(HALVINGS):
        duration = 0.5 * (low + high)
        run = _run(stiffness, duration, LENGTH, zones, 1.05 * duration * PRESSURE / PLATEAU)
        crushed = run["uncrushed_fraction"][-1] <= 0.0
        low, high = (low, duration) if crushed else (duration, high)
    return 0.5 * (low + high)


def _finite(table: Table, run: Recording) -> None:
    """The default stiffness against the theory of that stiffness, both fronts."""
    theory = CompactionPulse(rppl(STIFFNESSES[0]).curve, 1.2 * LENGTH, PRESSURE, DURATION)
    t = np.linspace(0.1, 0.95, 40) * theory.end_time
    history = theory.history(t)
    gap = np.abs(np.interp(t, run["time"], run["front_position"]) - history.front).max() / LENGTH
    table.bound("K = 1000 σP: front over L, against finite-K theory", float(gap), 5e-3, FINITE)
    moved = np.abs(np.interp(t, run["time"], run["left_position"]) - history.displacement).max() / LENGTH
    table.bound("K = 1000 σP: u of the loaded end over L, against finite-K theory", float(moved), 5e-3, FINITE)
    fronts = (1e3 * t, history.front), (1e3 * run["time"], run["front_position"])
    table.beside("fronts at the default stiffness", "t, ms", "X, m", *fronts, "run", "theory, K = 1000 σP")


def _study(table: Table, effort: Effort) -> None:
    """3.6 MPa for 1.53 ms on R-P-P-L with a fixed back, at three stiffnesses K of the regularised rigid lines: velocity
    and crushed length at the end of the pulse, the time at which the momentum is used up, the crushed length at last,
    and, by bisection on the duration, the pulse that just crushes every zone of 1 m.
    """
    exact = RPPLPulse(FOAM, PRESSURE, DURATION)
    zones = 600 if effort.full else 300
    end = 1.1 * exact.stop_time
    runs = [_run(k, DURATION, 1.2 * LENGTH, zones, end) for k in STIFFNESSES]
    found = np.array([_found(run) for run in runs])
    _finite(table, runs[0])
    theory = (exact.pulse_velocity, exact.pulse_length, exact.stop_time, exact.critical_length)
    names = ("vI, m/s (Eq. 25)", "lI, m (Eq. 27)", "stop time T P/σP, s", "lCR2, m (Eq. 29)")
    for k, (name, value) in enumerate(zip(names, theory, strict=True)):
        table.rigid_limit(name, value, STIFFNESSES, found[:, k], ("K = 16000 σP", 2e-2, RAW), (1e-2, LIMIT))
    errors = np.abs(found / theory - 1.0)
    name = "lCR2, approach to the limit, order in √K"
    table.converges(name, np.sqrt(STIFFNESSES), errors[:, 3], 2e-2, LIMIT, least_order=0.8)
    critical = float(critical_duration(FOAM, PRESSURE, LENGTH))
    durations = np.array([_critical_duration(k, critical, zones // 2) for k in STIFFNESSES])
    reason = "bisection to 0.1 %; both ends of the column crush at finite K, a shortfall as K^(−½)"
    name, stiffest = "TCR by search, s (Eq. 30)", ("K = 16000 σP", 2e-2, reason)
    table.rigid_limit(name, critical, STIFFNESSES, durations, stiffest, (1e-2, LIMIT))
    table.report("TCR by search, s, at the default stiffness", critical, durations[0], "reported")
    panels = [
        line(STIFFNESSES, np.maximum(errors[:, k], 1e-9), name.split(",")[0]) for k, name in enumerate(names) if k != 2
    ]
    panels.append(line(STIFFNESSES, np.abs(durations / critical - 1.0), "TCR"))
    table.panel("convergence", "K/σP", "relative error", panels, log=True)


CASES = [Case.of("rppl-pulse", "Pressure pulse on R-P-P-L", 14, _study)]
