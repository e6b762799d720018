"""How sure we are: resolution, viscosity, hardening, and the mass-spring chain's own dependences."""

import math
from collections.abc import Sequence
from typing import Any

from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.boundaries import foam_curve
from hydro1d.studies.harrigan2010.boundary import Curve, trace_curves, twice_as_long, with_the_pulse
from hydro1d.studies.harrigan2010.colors import BLUE, RED
from hydro1d.studies.harrigan2010.springs import PLASTIC, REVERSIBLE, chain
from hydro1d.studies.harrigan2010.workshop import Workshop, new_figure
from hydro1d.sweep import Column, Table

PRESSURES = (2.4e6, 3.6e6, 10e6)
CHAIN_PRESSURES = (1.6e6, 2.4e6, 4.0e6)


def _continuum(zones: int) -> list[Curve]:
    def own(name: str, *texts: str, count: int = zones, **more: Any) -> Curve:
        return foam_curve(name, "pulse_tangent.toml", count, *texts, **more)

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
    rows.append(own("duration of a run: twice as long", end=twice_as_long))
    return rows


def _chains() -> list[Curve]:
    def own(name: str, *texts: str, count: int = 10, **more: Any) -> Curve:
        return chain(name, count, *texts, **more)

    rows = [own(f"number of masses, reversible: {n}", *REVERSIBLE, count=n) for n in (10, 20, 50)]
    rows += [own(f"number of masses, plastic: {n}", *PLASTIC, count=n) for n in (10, 20, 40)]
    rows += [own(f"time step: CFL = {cfl}", f"time.cfl={cfl}") for cfl in (0.2, 0.05, 0.01)]
    for kind, texts in (("reversible", REVERSIBLE), ("plastic", PLASTIC)):
        for c in (0.0, 0.05, 0.2, 1.0, 2.0):
            strength = (f"viscosity.linear={c}", f"viscosity.quadratic={c}", f"viscosity.smooth_linear={0.25 * c}")
            viscous = ('viscosity.kind="standard"', *strength)
            rows.append(own(f"dissipation, 10 {kind}: c1 = c2 = {c}", *viscous, *texts))
    for beta, gamma in ((0.6, 0.603), (2.44, 0.603), (1.22, 0.4), (1.22, 0.8), (5.0, 0.8)):
        hardening = (f"material.foam.beta={beta}", f"material.foam.gamma={gamma}")
        rows.append(own(f"hardening, 10 reversible: β = {beta}, γ = {gamma}", *hardening, *REVERSIBLE))
    rows.append(own("tension: springs that cannot pull", *REVERSIBLE, "material.foam.tension=false"))
    rows.append(own("observation, reversible: twice as long", *REVERSIBLE, end=twice_as_long))
    sustained: dict[str, Any] = {"end": with_the_pulse, "bracket": (0.8, 3.0)}
    rows.append(own("observation, reversible: while the pulse acts", *REVERSIBLE, **sustained))
    rows.append(own("observation, plastic: while the pulse acts", *PLASTIC, **sustained))
    return rows


def studies(work: Workshop) -> None:
    """Critical durations over Eq. 30 in one table: variant by variant, at a few pressures, by both criteria."""
    table = work.table("new4_studies", Table(_columns(work)))
    figure, (left, right) = new_figure(13.5, 6.8, ncols=2)
    _draw(left, table, "E-P-P-H, Eq. 38, 3.6 MPa", "3.6 MPa", _continuum(work.size.zones))
    _draw(right, table, "mass–spring, 2.4 MPa", "2.4 MPa", _chains())
    work.picture("new4_studies", figure, table)


def _columns(work: Workshop) -> list[Column]:
    """A row a variant; NaN at the pressures of the other family."""
    names: list[str] = []
    numbers: dict[str, dict[str, float]] = {}
    for curves, pressures in ((_continuum(work.size.zones), PRESSURES), (_chains(), CHAIN_PRESSURES)):
        traced = trace_curves(curves, pressures, foam.eq30, 2e-3, work.pool)
        for name, points in traced.items():
            names.append(name)
            for point in points:
                for criterion, duration in point.durations.items():
                    column = numbers.setdefault(f"{criterion} at {point.pressure / 1e6:g} MPa", {})
                    column[name] = duration / foam.eq30(point.pressure)
    text = "critical duration over Eq. 30"
    shares = [
        Column(name, "1", text, [found.get(variant, math.nan) for variant in names]) for name, found in numbers.items()
    ]
    return [Column("variant", "", "what was changed", names), *shares]


def _draw(ax: Any, table: Table, title: str, pressure: str, curves: Sequence[Curve]) -> None:
    names = [curve.name for curve in curves]
    rows = [k for k, name in enumerate(table["variant"]) if name in names]
    for criterion, mark, color in (("fully_crushed", "s", BLUE), ("enhanced", "^", RED)):
        values = table[f"{criterion} at {pressure}"][rows]
        ax.plot(values, range(len(rows)), mark, color=color, ms=5, mfc="none" if mark == "^" else color)
    ax.set_yticks(range(len(rows)), [table["variant"][k] for k in rows], fontsize=7)
    ax.invert_yaxis()
    ax.axvline(1.0, color="black", lw=1.0, ls=":")
    ax.set(title=title, xlabel="critical duration over Eq. 30")
