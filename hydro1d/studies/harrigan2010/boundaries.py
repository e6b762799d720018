"""Fig. 6: the boundary in (duration, pressure) by every model, by both criteria."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.bands import FINE_CHAIN, Outcomes, bands, draw, outcomes
from hydro1d.studies.harrigan2010.boundary import CRITERIA, Curve, Point, boundary_table, trace_curves
from hydro1d.studies.harrigan2010.colors import BLUE, BROWN, GOLD, GREEN, GREY, LILAC, ORANGE, PINK, PURPLE, RED
from hydro1d.studies.harrigan2010.masses import HARD
from hydro1d.studies.harrigan2010.rooms import Chain, ask
from hydro1d.studies.harrigan2010.springs import PLASTIC, chain
from hydro1d.studies.harrigan2010.workshop import Workshop, deck_data, new_figure, plain
from hydro1d.sweep import Column, Table

LINEAR_TOP = 5.4e6  # Pa: Eq. 39 ends at 5.5 MPa
# Pa. The first spring takes up two thirds of (P - σP) L/N: its energy grows as σP β/rate ln(1/room), so its room falls by a
# factor of 7 a MPa, and with it every further step. Above, a run of ten masses would be 1e7 (6 MPa) to 1e10 steps (10 MPa).
PLASTIC_TOP = 5.1e6
LOCKING = Chain(end_mass=0.5, plastic=True, lock=1e-2, cfl=0.02)  # what plastic springs come to near their pole
TARGETS = (2.4e6, 3.6e6, 10e6)  # Pa


def foam_curve(name: str, deck: str, zones: int, *overrides: str, **more: Any) -> Curve:
    """A boundary of the continuum."""
    texts = (f"layer[0].zones={zones}", "output.history=20", *overrides)
    return Curve(name, deck_data(deck), texts, **{"bracket": (0.55, 1.8), **more})


def figure_6(work: Workshop) -> None:
    """The boundary in (T, P) by every model."""
    pressures = [float(p) for p in np.linspace(1.5e6, 10e6, work.size.pressures)]
    traced = _trace(work, _continuum(work) + _chains(), pressures)
    shares, found = outcomes(work, pressures)
    table = _with_limits(work, boundary_table(traced, pressures))
    made = [*table.columns.values(), *_band_columns(pressures, shares, found), *_locking_columns(work, pressures)]
    table = work.table("fig06_boundaries", Table(made))
    _draw_6(work, table)
    draw(work, pressures, shares, found)
    _eq30_numbers(work, table)
    _numbers_6(work, table)


class _Reach(NamedTuple):
    """A curve and the highest pressure (Pa) up to which it is traced, at every so many of the pressures."""

    curve: Curve
    highest: float = math.inf
    every: int = 1


def _continuum(work: Workshop) -> list[_Reach]:
    size = work.size

    def rigid(name: str, stiffness: float) -> _Reach:
        texts = (f"material.foam.stiffness={stiffness}", "output.history=100")
        narrow = {"bracket": (0.85, 1.12), "criteria": ("fully_crushed",)}
        return _Reach(foam_curve(name, "pulse_rppl.toml", size.zones, *texts, **narrow))

    def hardening(name: str, zones: int, *texts: str) -> _Reach:
        if name.startswith("Eq. 39"):
            return _Reach(foam_curve(name, "pulse_epph.toml", zones, *texts), highest=LINEAR_TOP)
        return _Reach(foam_curve(name, "pulse_tangent.toml", zones, *texts))

    def stiffer(name: str, h: float) -> _Reach:
        return hardening(f"{name} H={h:g}E", size.zones, f"material.foam.unloading_modulus={h * foam.MODULUS}")

    soft, stiff = size.stiffness
    return [
        rigid("R-P-P-L", stiff),
        rigid("R-P-P-L soft", soft),
        hardening("Eq. 38 fine", 2 * size.zones),
        *(hardening(name, size.zones) for name in ("Eq. 38", "Eq. 39")),
        *(stiffer("Eq. 38", h) for h in size.unloading),
        *(stiffer("Eq. 39", h) for h in size.unloading),
    ]


def _chains() -> list[_Reach]:
    beta, gamma = HARD
    hard = (f"material.foam.beta={beta}", f"material.foam.gamma={gamma}")
    near, far = {"bracket": (0.3, 0.7)}, {"bracket": (0.7, 1.3)}
    return [
        _Reach(chain("reversible", 10, *FINE_CHAIN, **near)),
        _Reach(chain("plastic", 10, *PLASTIC, **far), highest=PLASTIC_TOP),
        _Reach(chain("plastic hard", 10, *PLASTIC, *hard, **far), every=3),
    ]


def _trace(work: Workshop, reaches: Sequence[_Reach], pressures: Sequence[float]) -> dict[str, list[Point]]:
    """Every curve at the pressures that it reaches; points without durations elsewhere."""
    wanted: dict[tuple[float, ...], list[Curve]] = {}
    for curve, highest, every in reaches:
        own = tuple(p for p in pressures[::every] if p <= highest)
        wanted.setdefault(own, []).append(curve)
    traced: dict[str, list[Point]] = {}
    for own, curves in wanted.items():
        for name, points in trace_curves(curves, own, foam.eq30, work.size.tolerance, work.pool).items():
            nothing = dict.fromkeys(points[0].durations, math.nan)
            found = {point.pressure: point for point in points}
            traced[name] = [found.get(p, Point(p, dict(nothing))) for p in pressures]
    return traced


def _with_limits(work: Workshop, table: Table) -> Table:
    """The table with Eq. 30 and what rigid material and infinitely many zones would give."""
    soft, stiff = work.size.stiffness
    ratio = math.sqrt(stiff / soft)  # the error goes as stiffness^(-1/2)
    rigid = (ratio * table["R-P-P-L fully_crushed"] - table["R-P-P-L soft fully_crushed"]) / (ratio - 1.0)
    made = [
        *table.columns.values(),
        Column("Eq. 30", "s", "Eq. 30", [foam.eq30(p) for p in table["pressure"]]),
        Column("R-P-P-L limit", "s", "extrapolated to infinite stiffness", rigid.tolist()),
    ]
    for criterion in CRITERIA:  # first order in the zones
        finer = 2.0 * table[f"Eq. 38 fine {criterion}"] - table[f"Eq. 38 {criterion}"]
        made.append(Column(f"Eq. 38 limit {criterion}", "s", "extrapolated to infinitely many zones", finer.tolist()))
    return Table(made)


def _band_columns(pressures: Sequence[float], shares: np.ndarray, found: Outcomes) -> list[Column]:
    """First and last change of the reversible chains of `rooms`, s."""
    unit, made = np.array([foam.eq30(p) for p in pressures]), []
    for name, said in found.items():
        for edge, values in bands(shares, said)._asdict().items():
            text = f"{edge} change of the outcome, {plain(name)}"
            made.append(Column(f"{name} {edge}", "s", text, (unit * values).tolist()))
    return made


def _locking_columns(work: Workshop, pressures: Sequence[float]) -> list[Column]:
    """Plastic springs that become rigid links near their pole, s."""
    made = []
    for criterion, tasks in ask(work.pool, LOCKING, pressures, (0.7, 1.3)).items():
        values = [foam.eq30(p) * task.result().last for p, task in zip(pressures, tasks, strict=True)]
        text = f"critical duration, plastic springs that lock, {plain(criterion)}"
        made.append(Column(f"plastic locking {criterion}", "s", text, values))
    return made


def _draw_6(work: Workshop, table: Table) -> None:
    figure, (left, right) = new_figure(12.5, 7.2, ncols=2, sharey=True)
    duration, pressure = foam.eq30_line(1e6, 10e6)
    left.plot(duration * 1e3, pressure / 1e6, color="black", lw=2.0, label="Eq. 30 (shock theory, R-P-P-L)")
    right.axvline(1.0, color="black", lw=2.0)
    for ax, scale in ((left, np.full(len(table), 1e-3)), (right, table["Eq. 30"])):
        _draw_rigid(ax, table, scale, work.size.stiffness[1])
        _draw_continuum(ax, table, scale, work.size.unloading)
        _draw_chains(ax, table, scale)
    left.set(xlabel="T (ms)", ylabel="P (MPa)", xlim=(0, 4), ylim=(0, 10.3))
    right.set(xlabel="T over Eq. 30", xlim=(0.3, 1.5))
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False, fontsize=7)
    work.picture("fig06", figure, table, highest=PLASTIC_TOP / 1e6, hard=HARD)


def _draw_rigid(ax: Any, table: Table, scale: np.ndarray, stiffness: float) -> None:
    pressure, label = table["pressure"] / 1e6, f"R-P-P-L, solver, {stiffness:g} σP"
    ax.plot(table["R-P-P-L limit"] / scale, pressure, "x", color="black", ms=5, label="R-P-P-L, solver, rigid limit")
    ax.plot(table["R-P-P-L fully_crushed"] / scale, pressure, "o", color=GREY, mfc="none", ms=4, label=label)


def _draw_continuum(ax: Any, table: Table, scale: np.ndarray, unloading: Sequence[float]) -> None:
    pressure = table["pressure"] / 1e6
    colors = {"Eq. 38": RED, "Eq. 39": PURPLE}
    colors |= {f"Eq. 38 H={h:g}E": color for h, color in zip(unloading, (BROWN, GREEN), strict=False)}
    colors |= {f"Eq. 39 H={h:g}E": color for h, color in zip(unloading, (LILAC, PINK), strict=False)}
    for name, color in colors.items():
        label = _words(name) if "H=" in name else f"{_words(name)}, H = E"
        for criterion, style in zip(CRITERIA, ("-", "--"), strict=True):
            drawn = f"{label}: {plain(criterion)}"
            ax.plot(table[f"{name} {criterion}"] / scale, pressure, color=color, ls=style, lw=1.3, label=drawn)
    label = "E-P-P-H, Eq. 38, H = E, zones extrapolated: enhanced"
    ax.plot(table["Eq. 38 limit enhanced"] / scale, pressure, "+", color=RED, ms=5, label=label)


def _words(name: str) -> str:
    """Name of a column as the legend has it."""
    law, _, modulus = name.partition(" H=")
    return f"E-P-P-H, {law}" + (f", H = {modulus[:-1]} E" if modulus else "")


def _draw_chains(ax: Any, table: Table, scale: np.ndarray) -> None:
    pressure, hard = table["pressure"] / 1e6, f"plastic, β = {HARD[0]:g}, γ = {HARD[1]:g}"
    for name, label, color in (
        ("reversible", "reversible", BLUE),
        ("plastic", "plastic", ORANGE),
        ("plastic hard", hard, GOLD),
    ):
        for criterion, mark in zip(CRITERIA, "s^", strict=True):
            look = {"ms": 3.5, "mfc": color} if mark == "s" else {"ms": 4.5, "mfc": "none"}
            drawn = f"ten masses, {label}: {plain(criterion)}"
            ax.plot(table[f"{name} {criterion}"] / scale, pressure, mark, color=color, label=drawn, **look)
    _draw_rooms(ax, table, scale)


def _draw_rooms(ax: Any, table: Table, scale: np.ndarray) -> None:
    """Draw the chains of `rooms`: a band for half an end mass, lines for the others."""
    pressure = table["pressure"] / 1e6
    first = np.minimum(*(table[f"half mass {criterion} first"] for criterion in CRITERIA)) / scale
    last = np.maximum(*(table[f"half mass {criterion} last"] for criterion in CRITERIA)) / scale
    label = "ten masses, reversible: first to last change"
    ax.fill_betweenx(pressure, first, last, color=BLUE, alpha=0.2, lw=0, label=label)
    for criterion, style in zip(CRITERIA, ("-", "--"), strict=True):
        label = f"ten equal masses, reversible: {plain(criterion)}"
        ax.plot(table[f"equal masses {criterion} last"] / scale, pressure, style, color="navy", lw=1.0, label=label)
        label = f"ten masses, plastic, rigid near the pole: {plain(criterion)}"
        ax.plot(table[f"plastic locking {criterion}"] / scale, pressure, style, color=ORANGE, lw=1.0, label=label)


def _eq30_numbers(work: Workshop, table: Table) -> None:
    """How near R-P-P-L comes to Eq. 30, over all pressures."""
    for name, quantity, note in (
        ("R-P-P-L fully_crushed", "R-P-P-L", f"stiffness {work.size.stiffness[1]:g} σP"),
        ("R-P-P-L limit", "R-P-P-L extrapolated to rigid", "as stiffness^(-1/2)"),
    ):
        worst = float(np.max(np.abs(table[name] / table["Eq. 30"] - 1.0)))
        label = f"largest deviation from Eq. 30, {quantity}, P = 1.5-10 MPa"
        work.number("6", label, "%", solver=100.0 * worst, note=note)


def _numbers_6(work: Workshop, table: Table) -> None:
    """Critical durations over Eq. 30 by every model, at a few pressures."""
    exact, pressure, stiffer = table["Eq. 30"], table["pressure"], work.size.unloading
    names = {
        "Eq. 38": "E-P-P-H, Eq. 38",
        "Eq. 38 limit": "E-P-P-H, Eq. 38, zones extrapolated",
        "Eq. 39": "E-P-P-H, Eq. 39",
        **{f"{law} H={h:g}E": _words(f"{law} H={h:g}E") for law in ("Eq. 38", "Eq. 39") for h in stiffer},
        "reversible": "ten masses, reversible",
        "plastic": "ten masses, plastic",
        "plastic hard": f"ten masses, plastic, β = {HARD[0]:g}, γ = {HARD[1]:g}",
        "plastic locking": "ten masses, plastic, rigid links near the pole",
    }
    for k in dict.fromkeys(int(np.argmin(np.abs(pressure - target))) for target in TARGETS):
        note, limit = f"at P = {pressure[k] / 1e6:.3g} MPa", table["R-P-P-L limit"][k] * 1e3
        both = {"equations": exact[k] * 1e3, "solver": limit}
        work.number("6", "critical duration, R-P-P-L", "ms", **both, note=f"{note}; rigid limit")
        for name, label in names.items():
            for criterion in CRITERIA:
                share = table[f"{name} {criterion}"][k] / exact[k]
                work.number("6", f"T over Eq. 30, {label}: {plain(criterion)}", "1", solver=share, note=note)
