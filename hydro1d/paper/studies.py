"""How sure we are: resolution, viscosity, hardening, and the mass-spring chain's own dependences."""

from __future__ import annotations

import math
from typing import Any

from hydro1d.paper import foam
from hydro1d.paper.boundaries import PLASTIC, REVERSIBLE, chain, foam_curve
from hydro1d.paper.boundary import Curve, trace_curves
from hydro1d.paper.workshop import Workshop, new_figure
from hydro1d.sweep import Column, Table

PRESSURES = (2.4e6, 3.6e6, 10e6)
CHAIN_PRESSURES = (1.6e6, 2.4e6, 4.0e6)


def _continuum(zones: int) -> list[tuple[str, Curve]]:
    def own(name: str, *texts: str, count: int = zones, **more: Any) -> tuple[str, Curve]:
        return name.split(":")[0], foam_curve(name, "pulse_tangent.toml", count, *texts, **more)

    def material(**values: float) -> tuple[str, ...]:
        return tuple(f"material.foam.{key}={value}" for key, value in values.items())

    rows = [own(f"zones: {n}", count=n) for n in (zones // 2, zones, 2 * zones, 4 * zones)]
    for linear, quadratic in ((1, 2), (2, 1), (2, 2), (3, 1), (4, 4)):
        name = f"viscosity: c1 = {linear}, c2 = {quadratic}"
        rows.append(own(name, f"viscosity.linear={linear}", f"viscosity.quadratic={quadratic}"))
    rows += [
        own(f"unloading: H = {h:g} E", *material(unloading_modulus=h * foam.MODULUS))
        for h in (1.0, 1.5, 5.0, 20.0, 100.0)
    ]
    for beta, gamma in ((0.6, 0.603), (1.0, 0.5), (1.22, 0.603), (2.44, 0.603), (1.22, 0.4), (1.22, 0.8), (5.0, 0.8)):
        rows.append(own(f"hardening: β = {beta}, γ = {gamma}", *material(beta=beta, gamma=gamma), bracket=(0.5, 2.6)))
    rows += [own(f"modulus: E = {e:g} x 22 MPa", *material(modulus=e * foam.MODULUS)) for e in (0.5, 1.0, 4.0, 16.0)]
    rows.append(own("unloading: reversible", 'material.foam.unloading="reversible"', bracket=(0.3, 1.8)))
    rows.append(
        ("duration of a run", foam_curve("duration of a run: twice as long", "pulse_tangent.toml", zones, later=2.5))
    )
    return rows


def _chains() -> list[tuple[str, Curve]]:
    rows = []
    for n in (10, 20, 50):
        rows.append(("number of masses, reversible", chain(f"number of masses, reversible: {n}", n, "time.cfl=0.05")))
    for n in (10, 20, 40):
        rows.append(("number of masses, plastic", chain(f"number of masses, plastic: {n}", n, *PLASTIC)))
    for cfl in (0.2, 0.05, 0.01):
        rows.append(("time step", chain(f"time step: CFL = {cfl}", 10, f"time.cfl={cfl}")))
    for c in (0.0, 0.05, 0.2, 1.0, 2.0):
        viscous = ('viscosity.kind="standard"', f"viscosity.linear={c}", f"viscosity.quadratic={c}")
        rows.append(
            (
                "dissipation, 10 reversible",
                chain(f"dissipation, 10 reversible: c1 = c2 = {c}", 10, *viscous, *REVERSIBLE),
            )
        )
        rows.append(
            ("dissipation, 10 plastic", chain(f"dissipation, 10 plastic: c1 = c2 = {c}", 10, *viscous, *PLASTIC))
        )
    for beta, gamma in ((0.6, 0.603), (2.44, 0.603), (1.22, 0.4), (1.22, 0.8), (5.0, 0.8)):
        texts = (f"material.foam.beta={beta}", f"material.foam.gamma={gamma}", "time.cfl=0.05")
        rows.append(
            ("hardening, 10 reversible", chain(f"hardening, 10 reversible: β = {beta}, γ = {gamma}", 10, *texts))
        )
    rows.append(
        ("tension", chain("tension: springs that cannot pull", 10, "time.cfl=0.05", "material.foam.tension=false"))
    )
    later = chain("observation: twice as long", 10, "time.cfl=0.05")
    rows.append(("observation", Curve(later.name, later.data, later.overrides, later.bracket, later=2.5)))
    return rows


def studies(work: Workshop) -> None:
    """Critical durations over Eq. 30 in one table: variant by variant, at a few pressures, by both criteria."""
    names: list[str] = []
    numbers: dict[str, list[float]] = {}
    for rows, pressures in ((_continuum(work.size.zones), PRESSURES), (_chains(), CHAIN_PRESSURES)):
        traced = trace_curves([curve for _, curve in rows], pressures, foam.eq30, 2e-3, work.threads)
        for name, points in traced.items():
            names.append(name)
            for point in points:
                for criterion, duration in point.durations.items():
                    column = f"{criterion} at {point.pressure / 1e6:g} MPa"
                    numbers.setdefault(column, [math.nan] * (len(names) - 1)).append(
                        duration / foam.eq30(point.pressure)
                    )
            for values in numbers.values():
                values += [math.nan] * (len(names) - len(values))
    table = Table(
        [
            Column("variant", "", "what was changed", names),
            *(Column(name, "1", "critical duration over Eq. 30", values) for name, values in numbers.items()),
        ]
    )
    table = work.table("new4_studies", table)
    figure, (left, right) = new_figure(12.0, 6.6, ncols=2)
    _draw(left, table, "E-P-P-H, Eq. 38, 3.6 MPa", "3.6 MPa", chained=False)
    _draw(right, table, "mass–spring, 2.4 MPa", "2.4 MPa", chained=True)
    caption = "Critical duration over Eq. 30 when one thing is changed. Squares: fully crushed; triangles: enhanced."
    work.picture("new4_studies", "New: how sure we are", caption, figure, table)


def _draw(ax: Any, table: Table, title: str, pressure: str, chained: bool) -> None:
    marks = ("number of masses", "time step", "dissipation", "hardening, 10", "tension", "observation")
    rows = [k for k, name in enumerate(table["variant"]) if name.startswith(marks) == chained]
    for criterion, mark, color in (("fully_crushed", "s", "#1f5fa8"), ("enhanced", "^", "#c0392b")):
        values = table[f"{criterion} at {pressure}"][rows]
        ax.plot(values, range(len(rows)), mark, color=color, ms=5, mfc="none" if mark == "^" else color)
    ax.set_yticks(range(len(rows)), [table["variant"][k] for k in rows], fontsize=7)
    ax.invert_yaxis()
    ax.axvline(1.0, color="black", lw=1.0, ls=":")
    ax.set(title=title, xlabel="critical duration over Eq. 30")
