"""Energy across a front: what a shock absorbs, what the curve alone would, and that q makes up the difference."""

from __future__ import annotations

from functools import partial

import numpy as np

from hydro1d.analytic import pressure_step
from hydro1d.analytic.jumps import absorbed_energy
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.pulses.constant import Constant
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.deck import Layer
from hydro1d.verify.case import Case, Effort
from hydro1d.verify.cases import materials
from hydro1d.verify.cases.materials import PLATEAU, Material
from hydro1d.verify.measure import measure_front, order, simulate
from hydro1d.verify.rows import Table, line

LOAD = 4.5
ROWS = 5
# The history's viscous_work takes q and the velocities half a step apart, an error of first order: 0.8 % at 0.9.
CFL = 0.4
REASON = (
    "plateau states are right to 1e-3 and better; 5e-3 is what the comparison of two integrals over the front needs"
)


def _study(table: Table, effort: Effort, material: Material) -> None:
    exact = pressure_step(material.curve, LOAD * PLATEAU)
    jump = exact.jumps()[-1]
    ahead, behind = jump.ahead, jump.behind
    shock = float(absorbed_energy(ahead.stress, behind.stress, jump.strain))
    quasi_static = material.curve.area(behind.strain) - material.curve.area(ahead.strain)
    end = 1.0 / 3.0 / jump.front_speed
    zones, errors = effort.zones(120), []
    for n in zones:
        layer = Layer(law=material.law, thickness=1.0, zones=n)
        run = simulate(
            layer,
            Pressure(pulse=Constant(peak=LOAD * PLATEAU)),
            Transmitting(),
            end=end,
            profiles=(end / 1.5, end),
            history=1,
            cfl=CFL,
        )
        later = run.frames[1]
        front = measure_front(
            run.column, later.fields, jump, 1.0 / 3.0, min(1.0, material.curve.elastic_speed * end - 30.0 / n)
        )
        absorbed = material.law.density * (front.behind.internal_energy - front.ahead.internal_energy)
        errors.append(absorbed / shock - 1.0)
    table.compare("ρ0[e], J/m³, against Eq. 22", shock, absorbed, 5e-3, REASON)
    states = float(absorbed_energy(front.ahead.stress, front.behind.stress, front.behind.strain - front.ahead.strain))
    table.compare("ρ0[e], J/m³, against ½(σB + σA)[ε] as measured", states, absorbed, 5e-3, REASON)
    crossed = jump.front_speed * end / 3.0
    work = np.interp([end / 1.5, end], run["time"], run["viscous_work"])
    table.compare(
        "work of q over the volume passed, J/m³", shock - quasi_static, (work[1] - work[0]) / crossed, 5e-3, REASON
    )
    plateau = slice(5, front.plateau)
    area = np.array([material.curve.area(float(e)) for e in later.fields["strain"][plateau]])
    excess = float(np.median(material.law.density * later.fields["internal_energy"][plateau] - area))
    table.compare("e − area under the curve, behind, J/m³", shock - quasi_static, excess, 5e-3, REASON)
    table.bound(
        "ρ0[e], finest",
        abs(errors[-1]),
        5e-3,
        "converges, or is there already",
        order=None if errors[-1] < 1e-4 else order(zones, errors),
    )
    x, strain = run.column.zone_coordinate, np.linspace(0.0, behind.strain, 300)
    table.panel(
        "the front in the stress–strain plane",
        "ε",
        "σ, MPa",
        [
            line(strain, material.curve.stress(strain) / 1e6, "curve", "exact"),
            line([ahead.strain, behind.strain], [ahead.stress / 1e6, behind.stress / 1e6], "Rayleigh line", "run"),
            line(later.fields["strain"], (later.fields["stress"] + later.fields["viscosity"]) / 1e6, "σ + q", "points"),
        ],
    )
    table.panel(
        "energy",
        "X, m",
        "ρ0 e, MJ/m³",
        [
            line(x, material.law.density * exact(x, end).internal_energy / 1e6, "exact", "exact"),
            line(x, material.law.density * later.fields["internal_energy"] / 1e6, f"{zones[-1]} zones"),
        ],
    )


def cases() -> list[Case]:
    """A case for some laws."""
    about = (
        "A pressure of 4.5 plateau stresses. What the front absorbs per volume against ½(σB + σA)[ε]; its excess "
        "over the area under the "
        "curve against the work of the viscosity over the volume passed."
    )
    chosen = (materials.epph(), materials.epph_tangent(), materials.rph(), materials.trilinear(50.0), materials.rppl())
    return [
        Case(f"front-energy {m.name}", f"Energy across the front, {m.name}", about, ROWS, partial(_study, material=m))
        for m in chosen
    ]
