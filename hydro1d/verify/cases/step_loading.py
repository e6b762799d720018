"""Pressure step and piston on every foam law with a shock: Eqs. 31–37 behind a steady compaction front."""

import math
from functools import partial
from typing import NamedTuple

import numpy as np

from hydro1d import analytic
from hydro1d.analytic import Jump, State
from hydro1d.boundaries.base import Boundary
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.deck import Layer
from hydro1d.loads.constant import Constant
from hydro1d.solver.sink import Frame
from hydro1d.verify.cases import materials
from hydro1d.verify.cases.materials import PLATEAU, Material
from hydro1d.verify.convergence import mean_over
from hydro1d.verify.measure import Front, Recording, measure_front, simulate
from hydro1d.verify.rows import Case, Effort, Line, Table, line

VELOCITIES = (30.0, 80.0, 160.0, 300.0)
CROSSED = 1.0 / 3.0  # share of the column that the front has crossed at the end: on a zone boundary at every resolution
INSTANTS = 9  # profiles over the last third, for the mean behind a weak front
SHOCK_ROWS, WAVE_ROWS = 13, 14  # a load
SHARP = "a steady front keeps what it leaves: start-up and over-compaction decide, both below 1e-3 by the choice of q"
STIFF = "locking of slope K turns a strain error into K times as much stress"
WORST = "the zones of the start-up at the loaded end, five times the plateau's tolerance"
FRONT = "a captured front is a fixed number of zones wide, so its integral error is of first order"
CENTRE = "the front starts late by some zones, the same number at every resolution"
SPREAD = (
    "a linear wave under the linear q, c₁ ρ0 c Δv, is diffusion: an error function of that width, at any resolution"
)


class Found(NamedTuple):
    """What a run shows: the front at the end, its Lagrangian speed over the last third, the state that it leaves."""

    front: Front
    speed: float
    behind: State
    run: Recording


def _loads(material: Material, kind: str) -> list[tuple[str, analytic.StepLoading, Boundary]]:
    if kind == "piston":
        return [(f"{v:g} m/s", analytic.piston(material.curve, v), Piston(velocity=v)) for v in VELOCITIES]
    return [
        (f"p = {p:g}", analytic.pressure_step(material.curve, p * PLATEAU), Pressure(pulse=Constant(peak=p * PLATEAU)))
        for p in material.pressures
    ]


def _weak(jump: Jump) -> bool:
    """Whether the stress jump is so small a part of the stress that the ringing of the crushed block hides it.

    Crushed foam is stiff: at one instant its zones' stresses are off by up to half of a weak jump, while their mean
    over time, all that momentum sees, is not. Then σB is the mean on the loaded end over the last third, vB the mean
    of the medians of several profiles.
    """
    return jump.stress < 0.1 * jump.behind.stress


def _run(material: Material, jump: Jump, boundary: Boundary, zones: int) -> Found:
    end = CROSSED / jump.front_speed
    weak = _weak(jump)
    run = simulate(
        Layer(law=material.law, thickness=1.0, zones=zones),
        boundary,
        Transmitting(),
        end=end,
        profiles=tuple(np.linspace(end / 1.5, end, INSTANTS if weak else 2)),
        history=5 if weak else 0,
    )
    fronts = [_front_of(material, jump, run, frame) for frame in run.frames]
    speed = (fronts[-1].coordinate - fronts[0].coordinate) / (end / 3.0)
    behind = fronts[-1].behind
    if weak:
        velocity = float(np.mean([front.behind.velocity for front in fronts]))
        stress = mean_over(run["time"], run["left_stress"], end / 1.5, end)
        behind = behind._replace(velocity=velocity, stress=stress)
    return Found(fronts[-1], speed, behind, run)


def _front_of(material: Material, jump: Jump, run: Recording, frame: Frame) -> Front:
    """The front of a profile; the precursor is left out with its own width."""
    size = run.column.layers[0].size
    at = jump.front_speed * frame.time
    clear = min(1.0, max(material.curve.elastic_speed * frame.time - 30.0 * size, at + 12.0 * size))
    return measure_front(run.column, frame.fields, jump, at, clear)


def _rows(table: Table, material: Material, load: str, exact: Jump, found: Found) -> None:
    """Jumps, speeds and residuals of one load, each over its own jump; plateaus over their own state."""
    tolerance, reason = 1e-3, SHARP
    stiff, stiff_reason = (5e-3, STIFF) if material.stiff else (1e-3, SHARP)
    a, b, plateau = found.front.ahead, found.behind, found.front.behind
    remark = " (σB: mean on the piston)" if _weak(exact) else ""
    jump = Jump(a, b, exact.initial_density, found.speed)
    table.compare(f"{load}: [v], m/s", exact.velocity, jump.velocity, tolerance, reason)
    table.compare(f"{load}: [ε]", exact.strain, jump.strain, tolerance, reason)
    table.compare(f"{load}: [σ], Pa{remark}", exact.stress, jump.stress, stiff, stiff_reason)
    table.compare(f"{load}: cS, m/s", exact.shock_speed, jump.shock_speed, tolerance, reason)
    table.compare(f"{load}: VS, m/s", exact.laboratory_speed, jump.laboratory_speed, tolerance, reason)
    rise = jump.velocity - jump.shock_speed * (1.0 - a.density / b.density)
    table.bound(f"{load}: Eq. 31 (over [v])", rise / exact.velocity, tolerance, reason)
    push = jump.stress - jump.shock_speed * a.density * jump.velocity
    table.bound(f"{load}: Eq. 32 (over [σ])", push / exact.stress, stiff, stiff_reason)
    pace = jump.shock_speed - (1.0 - a.strain) * jump.velocity / jump.strain
    table.bound(f"{load}: Eq. 35 (over cS)", pace / exact.shock_speed, tolerance, reason)
    square = jump.stress - exact.initial_density * jump.velocity**2 / jump.strain
    table.bound(f"{load}: Eq. 37 (over [σ])", square / exact.stress, stiff, stiff_reason)
    table.compare(f"{load}: plateau median ε", exact.behind.strain, plateau.strain, tolerance, reason)
    table.compare(f"{load}: plateau median σ, Pa", exact.behind.stress, plateau.stress, stiff, stiff_reason)
    table.compare(f"{load}: plateau worst zone ε", exact.behind.strain, found.front.worst, 5.0 * tolerance, WORST)


def _front_row(table: Table, load: str, exact: Jump, runs: list[Found], zones: tuple[int, ...]) -> None:
    """A shock: as wide as some zones, at every resolution."""
    spreads = [run.front.spread for run in runs]
    width = 5.0 if exact.stress > 0.3 * exact.behind.stress else 15.0  # zones; a weak front is wider
    name, limit = f"{load}: ∫|Δε|dX/[ε], m, front", width / zones[-1]
    table.converges(name, zones[-2:], spreads[-2:], limit, FRONT, least_order=0.9)


def _wave_rows(table: Table, load: str, exact: Jump, runs: list[Found], zones: tuple[int, ...]) -> None:
    """A linear wave: where its centre is, and how wide diffusion by q has made it."""
    late = [abs(run.front.coordinate - CROSSED) for run in runs]
    table.converges(f"{load}: centre of the wave, m", zones, late, 3.0 / zones[-1], CENTRE, least_order=0.9)
    linear = runs[-1].run.column.viscosity.coefficients()[0]
    diffused = math.sqrt(2.0 * linear * CROSSED / (math.pi * zones[-1]))
    spreads = [run.front.spread for run in runs]
    table.compare(f"{load}: ∫|Δε|dX/[ε], m, √(2 c₁ ΔX X/π)", diffused, spreads[-1], 2e-2, SPREAD)


def _study(table: Table, effort: Effort, material: Material, kind: str) -> None:
    zones = effort.zones(material.zones)
    profiles: list[Line] = []
    spreads: dict[str, list[float]] = {}
    for load, exact, boundary in _loads(material, kind):
        jump = exact.jumps()[-1]
        runs = [_run(material, jump, boundary, n) for n in zones]
        _rows(table, material, load, jump, runs[-1])
        (_front_row if material.shock else _wave_rows)(table, load, jump, runs, zones)
        spreads[load] = [run.front.spread for run in runs]
        x = (np.arange(zones[-1]) + 0.5) / zones[-1]
        sharp = exact(x, CROSSED / jump.front_speed).strain
        strain = runs[-1].run.last["strain"]
        profiles += [line(x, sharp, "exact" if not profiles else "", "exact"), line(x, strain, load)]
    table.panel(f"strain, {zones[-1]} zones", "X, m", "ε", profiles)
    table.convergence(zones, spreads, "∫|Δε|dX/[ε] over the front, m")


ABOUT = {
    "pressure-step": (
        "A constant pressure on a column at rest. The states ahead of and behind the compaction front are medians over "
        "their plateaus (behind: where q has fallen below 1e-4 of [σ]); the front's place is the integral of strain, "
        "its speed that of the last third of the run."
    ),
    "piston": (
        "A piston of constant velocity against a column at rest; measured as the pressure step. At 30 m/s [σ] is down "
        "to 0.4 % of σB, less than the stress by which the crushed block rings at any one instant: there σB is the mean "
        "on the piston over the last third of the run, and vB that of nine profiles' medians."
    ),
    "pressure-step eph": (
        "A constant pressure on E-P-H, which hardens linearly: a linear plastic wave and no shock. Its plateau is "
        "measured as a shock's; q spreads the wave as diffusion does, whose width is known in closed form."
    ),
}


def _case(kind: str, material: Material) -> Case:
    name = f"{kind} {material.name}"
    title = f"{kind.replace('-', ' ').capitalize()}, {material.name}"
    rows = 4 * (SHOCK_ROWS if material.shock else WAVE_ROWS)
    return Case(name, title, ABOUT.get(name, ABOUT[kind]), rows, partial(_study, material=material, kind=kind))


SHOCKS = materials.with_a_shock()
CASES = [
    *(_case("pressure-step", material) for material in (*SHOCKS, materials.eph())),
    *(_case("piston", material) for material in SHOCKS),
]
