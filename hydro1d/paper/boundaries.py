"""Figs. 5 and 6: boundaries in (duration, pressure), by both criteria."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydro1d.paper import foam
from hydro1d.paper.boundary import CRITERIA, Curve, boundary_table, trace_curves
from hydro1d.paper.workshop import (
    BLUE,
    BROWN,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    Workshop,
    deck_data,
    new_figure,
)
from hydro1d.sweep import Column, Table

REVERSIBLE = ("time.cfl=0.05",)
PLASTIC = ('material.foam.unloading="elastic"',)
CHAIN_TOP = 5e6  # Pa: above, springs without damping run into the pole of Eq. 38 at ε = 1
LINEAR_TOP = 5.4e6  # Pa: Eq. 39 ends at 5.5 MPa


def chain(name: str, masses: int, *overrides: str) -> Curve:
    """A mass-spring boundary."""
    texts = (f"layer[0].zones={masses}", "output.history=20", *overrides)
    return Curve(name, deck_data("mass_spring.toml"), texts, bracket=(0.12, 1.6))


def foam_curve(name: str, deck: str, zones: int, *overrides: str, **more: Any) -> Curve:
    """A boundary of the continuum."""
    texts = (f"layer[0].zones={zones}", "output.history=20", *overrides)
    return Curve(name, deck_data(deck), texts, **{"bracket": (0.55, 1.8), **more})  # type: ignore[arg-type]


def figure_5(work: Workshop) -> None:
    """Mass-spring boundary in (τd, p), and how it depends on the number of masses."""
    size = work.size
    pressures = [float(p) * foam.PLATEAU for p in np.linspace(2.0, 5.0, size.mass_pressures)]
    curves = [chain(f"{n} reversible", n, *REVERSIBLE) for n in size.masses if n < 200]
    curves.append(chain(f"{size.masses[0]} plastic", size.masses[0], *PLASTIC))
    traced = trace_curves(curves, pressures, foam.eq30, max(size.tolerance, 2e-3), work.threads, scan=7)
    table = work.table("fig05_masses", boundary_table(traced, pressures))
    big = [n for n in size.masses if n >= 200]
    extra = None
    if big:  # fewer pressures: a run takes N² steps times springs
        few = pressures[:: max(len(pressures) // 4, 1)]
        far = trace_curves([chain(f"{n} reversible", n, *REVERSIBLE) for n in big], few, foam.eq30, 1e-2, work.threads)
        extra = work.table("fig05_many_masses", boundary_table(far, few))
    figure, (left, right) = new_figure(10.5, 4.6, ncols=2, sharey=True)
    p = table["pressure"] / foam.PLATEAU
    first = size.masses[0]
    for kind, color in (("reversible", BLUE), ("plastic", ORANGE)):
        for criterion, mark in (("fully_crushed", "s"), ("enhanced", "^")):
            name = f"{first} {kind} {criterion}"
            label = f"{first} masses, {kind} springs, {criterion.replace('_', ' ')}"
            left.plot(table[name] * foam.RATE, p, mark + "-", color=color, ms=5, mfc="none", lw=0.8, label=label)
    left.plot([foam.eq30(x) * foam.RATE for x in table["pressure"]], p, color=GREY, lw=1.6, ls="--", label="Eq. 30")
    right.plot([foam.eq30(x) * foam.RATE for x in table["pressure"]], p, color=GREY, lw=1.6, ls="--", label="Eq. 30")
    colors = (BLUE, GREEN, PURPLE, ORANGE, RED)
    for n, color in zip(size.masses, colors, strict=False):
        source = table if f"{n} reversible enhanced" in table else extra
        if source is None:
            continue
        q = source["pressure"] / foam.PLATEAU
        right.plot(
            source[f"{n} reversible fully_crushed"] * foam.RATE, q, "-s", ms=3, color=color, lw=1.2, label=f"{n} masses"
        )
        right.plot(source[f"{n} reversible enhanced"] * foam.RATE, q, ":^", ms=3, mfc="none", color=color, lw=1.0)
    left.set(xlabel="τd", ylabel="p", title="both criteria", xlim=(0.2, 3.2))
    right.set(
        xlabel="τd",
        title="number of masses, reversible springs (squares: crushed, triangles: enhanced)",
        xlim=(0.2, 3.2),
    )
    right.title.set_fontsize(9)
    for ax in (left, right):
        ax.legend(frameon=False, fontsize=8)
    caption = (
        "Mass–spring chain on Eq. 38, viscosity off. Reversible springs lie in the paper's window (τd "
        "0.25–1.75); both criteria "
        "nearly coincide. Plastic springs lie far to the right of them. Of many masses the support "
        "stress crosses P more than once as the pulse grows longer: the lowest crossing is shown."
    )
    work.picture("fig05", "Fig. 5: mass–spring boundary", caption, figure, table)
    for criterion in ("fully_crushed", "enhanced"):
        shares = table[f"{first} reversible {criterion}"] / [foam.eq30(x) for x in table["pressure"]]
        note = f"{shares[0]:.3f} at p = 2, {shares[-1]:.3f} at p = 5; {first} masses, reversible"
        work.number(
            "5", f"critical duration over Eq. 30, mean, {criterion}", "1", solver=float(np.nanmean(shares)), note=note
        )


def figure_6(work: Workshop) -> None:
    """The boundary in (T, P) by every model."""
    size = work.size
    pressures = [float(p) for p in np.linspace(1.5e6, 10e6, size.pressures)]
    soft, stiff = size.stiffness
    narrow = {"bracket": (0.85, 1.12), "criteria": ("fully_crushed",)}
    curves = [
        foam_curve(
            "R-P-P-L", "pulse_rppl.toml", size.zones, f"material.foam.stiffness={stiff}", "output.history=100", **narrow
        ),
        foam_curve(
            "R-P-P-L soft",
            "pulse_rppl.toml",
            size.zones,
            f"material.foam.stiffness={soft}",
            "output.history=100",
            **narrow,
        ),
        foam_curve("Eq. 38 fine", "pulse_tangent.toml", 2 * size.zones),
        foam_curve("Eq. 38", "pulse_tangent.toml", size.zones),
        *(
            foam_curve(
                f"Eq. 38 H={h:g}E",
                "pulse_tangent.toml",
                size.zones,
                f"material.foam.unloading_modulus={h * foam.MODULUS}",
            )
            for h in size.unloading
        ),
    ]
    traced = trace_curves(curves, pressures, foam.eq30, size.tolerance, work.threads)
    lower = [p for p in pressures if p <= LINEAR_TOP]
    linear = trace_curves(
        [foam_curve("Eq. 39", "pulse_epph.toml", size.zones)], lower, foam.eq30, size.tolerance, work.threads
    )
    springs = [p for p in pressures if p <= CHAIN_TOP]
    chains = trace_curves(
        [chain("reversible", 10, *REVERSIBLE), chain("plastic", 10, *PLASTIC)],
        springs,
        foam.eq30,
        size.tolerance,
        work.threads,
        scan=7,
    )
    for more in (linear, chains):
        traced |= {name: [*points, *_missing(points[0], len(pressures) - len(points))] for name, points in more.items()}
    table = boundary_table(traced, pressures)
    ratio = (stiff / soft) ** 0.5
    limit = (ratio * table["R-P-P-L fully_crushed"] - table["R-P-P-L soft fully_crushed"]) / (ratio - 1.0)
    exact = [foam.eq30(p) for p in pressures]
    made = [*table.columns.values(), Column("Eq. 30", "s", "Eq. 30", exact)]
    made.append(Column("R-P-P-L limit", "s", "extrapolated to infinite stiffness", limit.tolist()))
    for criterion in CRITERIA:  # first order in the zones
        finer = 2.0 * table[f"Eq. 38 fine {criterion}"] - table[f"Eq. 38 {criterion}"]
        made.append(Column(f"Eq. 38 limit {criterion}", "s", "extrapolated to infinitely many zones", finer.tolist()))
    table = work.table("fig06_boundaries", Table(made))
    _draw_6(work, table)
    _numbers_6(work, table, stiff)


def _missing(like: object, count: int) -> list:
    from hydro1d.paper.boundary import Point

    return [Point(float("nan"), dict.fromkeys(CRITERIA, float("nan"))) for _ in range(count)]


def _draw_6(work: Workshop, table: Table) -> None:
    figure, (left, right) = new_figure(11.5, 5.2, ncols=2)
    pressure, exact = table["pressure"] / 1e6, table["Eq. 30"]
    shown = [("Eq. 38", RED), ("Eq. 39", PURPLE), *((f"Eq. 38 H={h:g}E", BROWN) for h in work.size.unloading)]
    shown = [(name, color) for name, color in shown if f"{name} enhanced" in table]
    names = {"Eq. 38": "E-P-P-H, Eq. 38, H = E", "Eq. 39": "E-P-P-H, Eq. 39"}
    for ax, scale in ((left, None), (right, exact)):

        def at(name: str, scale: np.ndarray | None = scale) -> np.ndarray:
            return table[name] * 1e3 if scale is None else table[name] / scale

        ax.plot(at("Eq. 30"), pressure, color="black", lw=2.0, label="Eq. 30 (shock theory, R-P-P-L)")
        ax.plot(at("R-P-P-L limit"), pressure, "x", color="black", ms=5, label="R-P-P-L, solver, rigid limit")
        ax.plot(
            at("R-P-P-L fully_crushed"),
            pressure,
            "o",
            color=GREY,
            mfc="none",
            ms=4,
            label=f"R-P-P-L, solver, {work.size.stiffness[1]:g} σP",
        )
        for name, color in shown:
            style = ("-", "--") if "H=" not in name else ((0, (1, 1)), (0, (4, 1, 1, 1)))
            label = names.get(name, name.replace("Eq. 38 H=", "E-P-P-H, Eq. 38, H = "))
            ax.plot(
                at(f"{name} fully_crushed"), pressure, color=color, ls=style[0], lw=1.4, label=f"{label}: fully crushed"
            )
            ax.plot(at(f"{name} enhanced"), pressure, color=color, ls=style[1], lw=1.4, label=f"{label}: enhanced")
        ax.plot(
            at("Eq. 38 limit enhanced"),
            pressure,
            "+",
            color=RED,
            ms=5,
            label="E-P-P-H, Eq. 38, H = E, zones extrapolated: enhanced",
        )
        for kind, color in (("reversible", BLUE), ("plastic", ORANGE)):
            ax.plot(
                at(f"{kind} fully_crushed"),
                pressure,
                "s",
                color=color,
                ms=3.5,
                label=f"mass–spring, {kind}: fully crushed",
            )
            ax.plot(
                at(f"{kind} enhanced"),
                pressure,
                "^",
                color=color,
                ms=4,
                mfc="none",
                label=f"mass–spring, {kind}: enhanced",
            )
    left.set(xlabel="T (ms)", ylabel="P (MPa)", xlim=(0, 4), ylim=(0, 10.3))
    right.set(xlabel="T over Eq. 30", xlim=(0.2, 1.6), ylim=(0, 10.3))
    left.legend(frameon=False, fontsize=7)
    caption = (
        "1 m of Rohacell-51 WF. To the right of a line the column is fully crushed, or the support stress "
        "exceeds P. Right: over Eq. 30. "
        "E-P-P-H crushes fully sooner than Eq. 30 says, and enhances later at high pressure. Eq. 39 ends at "
        "5.5 MPa; springs above 5 MPa run into the pole of Eq. 38."
    )
    work.picture("fig06", "Fig. 6: enhancement/attenuation boundary", caption, figure, table)


def _numbers_6(work: Workshop, table: Table, stiff: float) -> None:
    exact, pressure = table["Eq. 30"], table["pressure"]
    limit = table["R-P-P-L limit"]
    direct = float(np.max(np.abs(table["R-P-P-L fully_crushed"] / exact - 1.0)))
    work.number(
        "6",
        "Eq. 30: largest deviation of R-P-P-L by the solver, P = 1.5-10 MPa",
        "1",
        solver=direct,
        note=f"stiffness {stiff:g} σP",
    )
    work.number(
        "6",
        "Eq. 30: largest deviation, extrapolated to rigid",
        "1",
        solver=float(np.max(np.abs(limit / exact - 1.0))),
        note="as stiffness^(-1/2)",
    )
    for target in (2.4e6, 3.6e6, 10e6):
        k = int(np.argmin(np.abs(pressure - target)))
        note = f"at P = {pressure[k] / 1e6:.3g} MPa"
        work.number("6", "critical duration, R-P-P-L", "ms", equations=exact[k] * 1e3, solver=limit[k] * 1e3, note=note)
        for name in (
            "Eq. 38",
            "Eq. 38 limit",
            "Eq. 39",
            *(f"Eq. 38 H={h:g}E" for h in work.size.unloading),
            "reversible",
            "plastic",
        ):
            for criterion in ("fully_crushed", "enhanced"):
                share = table[f"{name} {criterion}"][k] / exact[k]
                work.number("6", f"critical duration over Eq. 30, {name}, {criterion}", "1", solver=share, note=note)
