"""Pressure step and piston on every foam law with a shock: Eqs. 31–37 behind a steady compaction front."""

from __future__ import annotations

from functools import partial

import numpy as np

from hydro1d import analytic
from hydro1d.analytic import Jump
from hydro1d.boundaries.base import Boundary
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.pulses.constant import Constant
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.deck import Layer
from hydro1d.verify.case import Case, Effort
from hydro1d.verify.cases import materials
from hydro1d.verify.cases.materials import PLATEAU, Material
from hydro1d.verify.measure import Front, measure_front, order, simulate
from hydro1d.verify.rows import Line, Table, line

VELOCITIES = (30.0, 80.0, 160.0, 300.0)
CROSSED = 1.0 / 3.0  # share of the column that the front has crossed at the end: on a zone boundary at every resolution
ROWS_PER_LOAD = 12
SHARP = "a steady front keeps what it leaves: start-up and over-compaction decide, both below 1e-3 by the choice of q"
STIFF = "locking of slope K turns a strain error into K times as much stress"
WORST = "the zones of the start-up at the loaded end, five times the plateau's tolerance"
FRONT = "a captured front is a fixed number of zones wide, so its integral error is of first order"


def _loads(material: Material, kind: str) -> list[tuple[str, analytic.StepLoading, Boundary]]:
    if kind == "piston":
        return [(f"{v:g} m/s", analytic.piston(material.curve, v), Piston(velocity=v)) for v in VELOCITIES]
    return [
        (f"p = {p:g}", analytic.pressure_step(material.curve, p * PLATEAU), Pressure(pulse=Constant(peak=p * PLATEAU)))
        for p in material.pressures
    ]


def _run(material: Material, exact: analytic.StepLoading, boundary: Boundary, zones: int) -> tuple[Front, float, dict]:
    """The front at the end, its Lagrangian speed over the last third, and the last profile."""
    front = exact.jumps()[-1]
    end = CROSSED / front.front_speed
    recording = simulate(
        Layer(law=material.law, thickness=1.0, zones=zones),
        boundary,
        Transmitting(),
        end=end,
        profiles=(end / 1.5, end),
    )
    found = []
    for frame in recording.frames:
        precursor = material.curve.elastic_speed * frame.time - 30.0 / zones  # stay behind its own width
        at = front.front_speed * frame.time
        found.append(
            measure_front(recording.column, frame.fields, front, at, min(1.0, max(precursor, at + 12.0 / zones)))
        )
    earlier, later = found
    return later, (later.coordinate - earlier.coordinate) / (end / 3.0), recording.last


def _rows(table: Table, material: Material, load: str, exact: Jump, front: Front, speed: float) -> None:
    """Jumps, speeds, residuals of one load; a jump that is small beside the state behind it is judged by that state."""
    tolerance, reason = 1e-3, SHARP
    stiff, stiff_reason = (5e-3, STIFF) if material.stiff else (1e-3, SHARP)
    found = Jump(front.ahead, front.behind, exact.initial_density, speed)
    a, b = front.ahead, front.behind
    velocity, of_velocity = _scale(exact.velocity, exact.behind.velocity, " (over vB)")
    stress, of_stress = _scale(exact.stress, exact.behind.stress, " (over σB)")
    table.compare(f"{load}: [v], m/s{of_velocity}", exact.velocity, found.velocity, tolerance, reason, scale=velocity)
    table.compare(f"{load}: [ε]", exact.strain, found.strain, tolerance, reason)
    table.compare(f"{load}: [σ], Pa{of_stress}", exact.stress, found.stress, stiff, stiff_reason, scale=stress)
    table.compare(f"{load}: cS, m/s", exact.shock_speed, found.shock_speed, tolerance, reason)
    table.compare(f"{load}: VS, m/s", exact.laboratory_speed, found.laboratory_speed, tolerance, reason)
    rise = found.velocity - found.shock_speed * (1.0 - a.density / b.density)
    table.bound(f"{load}: Eq. 31{of_velocity or ' (over [v])'}", rise / velocity, tolerance, reason)
    push = found.stress - found.shock_speed * a.density * found.velocity
    table.bound(f"{load}: Eq. 32{of_stress or ' (over [σ])'}", push / stress, stiff, stiff_reason)
    pace = found.shock_speed - (1.0 - a.strain) * found.velocity / found.strain
    share = exact.velocity / velocity  # [v] over what it is judged by
    table.bound(f"{load}: Eq. 35{of_velocity or ' (over cS)'}", pace / exact.shock_speed * share, tolerance, reason)
    square = found.stress - exact.initial_density * found.velocity**2 / found.strain
    table.bound(f"{load}: Eq. 37{of_stress or ' (over [σ])'}", square / stress, stiff, stiff_reason)
    table.compare(f"{load}: plateau median ε", exact.behind.strain, b.strain, tolerance, reason)
    table.compare(f"{load}: plateau worst zone ε", exact.behind.strain, front.worst, 5.0 * tolerance, WORST)


def _scale(jump: float, behind: float, remark: str) -> tuple[float, str]:
    """What a jump's error is divided by: the jump, or, for a weak front, the state behind it."""
    return (jump, "") if jump > 0.3 * behind else (behind, remark)


def _study(table: Table, effort: Effort, material: Material, kind: str) -> None:
    zones = effort.zones(material.zones)
    profiles: list[Line] = []
    spreads: dict[str, list[float]] = {}
    for load, exact, boundary in _loads(material, kind):
        runs = [_run(material, exact, boundary, n) for n in zones]
        jump = exact.jumps()[-1]
        front, speed, fields = runs[-1]
        _rows(table, material, load, jump, front, speed)
        spreads[load] = [run[0].spread for run in runs]
        width = 5.0 if jump.stress > 0.3 * jump.behind.stress else 15.0  # zones; a weak front is wider
        table.bound(
            f"{load}: ∫|Δε|dX/[ε], m, front",
            spreads[load][-1],
            width / zones[-1],
            FRONT,
            order=order(zones[-2:], spreads[load][-2:]),
            least_order=0.9,
        )
        x = (np.arange(zones[-1]) + 0.5) / zones[-1]
        sharp = exact(x, CROSSED / jump.front_speed)
        profiles += [line(x, sharp.strain, "exact" if not profiles else "", "exact"), line(x, fields["strain"], load)]
    table.panel(f"strain, {zones[-1]} zones", "X, m", "ε", profiles)
    table.convergence(zones, spreads, "∫|Δε|dX/[ε] over the front, m")


ABOUT = {
    "pressure-step": (
        "A constant pressure on a column at rest. The states ahead of and behind the compaction front are medians over "
        "their plateaus (behind: where q has fallen below 1e-4 of [σ]); the front's place is the integral of strain, "
        "its speed that of the last third of the run."
    ),
    "piston": "A piston of constant velocity against a column at rest; measured as the pressure step.",
}


def cases() -> list[Case]:
    """A case a law and kind of load, four loads each."""
    return [
        Case(
            f"{kind} {material.name}",
            f"{kind.replace('-', ' ').capitalize()}, {material.name}",
            ABOUT[kind],
            4 * ROWS_PER_LOAD,
            partial(_study, material=material, kind=kind),
        )
        for kind in ABOUT
        for material in materials.with_a_shock()
    ]
