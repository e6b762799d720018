"""Energy across a front: what a shock absorbs, what the curve alone would, and that q makes up the difference."""

from functools import partial
from typing import NamedTuple

import numpy as np

from hydro1d.analytic import Jump, StepLoading, pressure_step
from hydro1d.analytic.jumps import absorbed_energy
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.deck import Layer
from hydro1d.loads.constant import Constant
from hydro1d.verify.cases import materials
from hydro1d.verify.cases.materials import PLATEAU, Material
from hydro1d.verify.convergence import order
from hydro1d.verify.measure import START_UP, Front, Recording, measure_front, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

LOAD = 4.5
REASON = (
    "plateau states are right to 1e-3 and better; 5e-3 is what the comparison of two integrals over the front needs"
)


class Passage(NamedTuple):
    """A run whose front has crossed a third of the column, and the states that it leaves."""

    run: Recording
    front: Front
    absorbed: float  # ρ0[e], J/m³
    viscous_work: float  # over the volume that the front passed in the last third of the run, J/m³


def _passage(material: Material, jump: Jump, zones: int) -> Passage:
    end = 1.0 / 3.0 / jump.front_speed
    run = simulate(
        Layer(law=material.law, thickness=1.0, zones=zones),
        Pressure(pulse=Constant(peak=LOAD * PLATEAU)),
        Transmitting(),
        end=end,
        history=1,
    )
    clear = min(1.0, material.curve.elastic_speed * end - 30.0 / zones)
    front = measure_front(run.column, run.last, jump, 1.0 / 3.0, clear)
    absorbed = material.law.density * (front.behind.internal_energy - front.ahead.internal_energy)
    work = np.interp([end / 1.5, end], run["time"], run["viscous_work"])
    return Passage(run, front, absorbed, float(work[1] - work[0]) / (jump.front_speed * end / 3.0))


def _study(table: Table, effort: Effort, material: Material) -> None:
    """A pressure of 4.5 plateau stresses. What the front absorbs per volume against ½(σB + σA)[ε]; its excess over the
    area under the curve against the work of the viscosity over the volume passed.
    """
    exact = pressure_step(material.curve, LOAD * PLATEAU)
    jump = exact.jumps()[-1]
    zones = effort.zones(120)
    passages = [_passage(material, jump, n) for n in zones]
    _absorbed(table, jump, passages[-1])
    _excess(table, material, jump, passages[-1])
    errors = [passage.absorbed / jump.absorbed_energy - 1.0 for passage in passages]
    observed = None if abs(errors[-1]) < 1e-4 else order(zones, errors)
    table.bound("ρ0[e], finest", abs(errors[-1]), 5e-3, "converges, or is there already", order=observed)
    _figures(table, material, exact, passages[-1])


def _absorbed(table: Table, jump: Jump, passage: Passage) -> None:
    """What the front absorbs against the Rayleigh line, exact and as measured."""
    ahead, behind = passage.front.ahead, passage.front.behind
    table.compare("ρ0[e], J/m³, against Eq. 22", jump.absorbed_energy, passage.absorbed, 5e-3, REASON)
    states = float(absorbed_energy(ahead.stress, behind.stress, behind.strain - ahead.strain))
    table.compare("ρ0[e], J/m³, against ½(σB + σA)[ε] as measured", states, passage.absorbed, 5e-3, REASON)


def _excess(table: Table, material: Material, jump: Jump, passage: Passage) -> None:
    """What it absorbs beyond the area under the curve, against the work of q and in the zones behind."""
    area = material.curve.area
    excess = jump.absorbed_energy - area(jump.behind.strain) + area(jump.ahead.strain)
    table.compare("work of q over the volume passed, J/m³", excess, passage.viscous_work, 5e-3, REASON)
    fields, plateau = passage.run.last, slice(START_UP, passage.front.plateau)
    areas = np.array([area(float(strain)) for strain in fields["strain"][plateau]])
    stored = material.law.density * fields["internal_energy"][plateau]
    table.compare("e − area under the curve, behind, J/m³", excess, float(np.median(stored - areas)), 5e-3, REASON)


def _figures(table: Table, material: Material, exact: StepLoading, passage: Passage) -> None:
    jump, fields, column = exact.jumps()[-1], passage.run.last, passage.run.column
    ahead, behind, x = jump.ahead, jump.behind, column.zone_coordinate
    strain = np.linspace(0.0, behind.strain, 300)
    lines = [
        line(strain, material.curve.stress(strain) / 1e6, "curve", "exact"),
        line([ahead.strain, behind.strain], [ahead.stress / 1e6, behind.stress / 1e6], "Rayleigh line", "run"),
        line(fields["strain"], (fields["stress"] + fields["viscosity"]) / 1e6, "σ + q", "points"),
    ]
    table.panel("the front in the stress–strain plane", "ε", "σ, MPa", lines)
    end, density = passage.run.frames[-1].time, material.law.density
    theory, found = (density * energy / 1e6 for energy in (exact(x, end).internal_energy, fields["internal_energy"]))
    table.beside("energy", "X, m", "ρ0 e, MJ/m³", (x, theory), (x, found), f"{column.zones} zones")


LAWS = (materials.epph(), materials.epph_tangent(), materials.rph(), materials.trilinear(50.0), materials.rppl())
CASES = [
    Case.of(f"front-energy {m.name}", f"Energy across the front, {m.name}", 5, partial(_study, material=m))
    for m in LAWS
]
