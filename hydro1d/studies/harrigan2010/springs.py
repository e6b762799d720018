"""Fig. 5: the mass-spring boundary in (τd, p), and what the number of masses does to it."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.boundary import CRITERIA, Curve, boundary_table, evaluate_at, trace_curves
from hydro1d.studies.harrigan2010.colors import BLUE, GREEN, GREY, ORANGE, PURPLE, RED
from hydro1d.studies.harrigan2010.rooms import Chain, ask
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, deck_data, new_figure, plain
from hydro1d.sweep import Column, Table

REVERSIBLE = ("time.cfl=0.05",)
COARSE = ("time.cfl=0.1",)  # hundreds of masses
PLASTIC = ('material.foam.unloading="elastic"',)
MANY = 200  # masses; from here on a run takes tens of seconds
COLORS = (BLUE, GREEN, PURPLE, ORANGE, RED)
STRIP = 2.4e6  # Pa


def chain(name: str, masses: int, *overrides: str, **more: Any) -> Curve:
    """The boundary of a chain of `masses` equal zones on springs, from the deck mass_spring.toml."""
    texts = (f"layer[0].zones={masses}", "output.history=20", *overrides)
    return Curve(name, deck_data("mass_spring.toml"), texts, **{"bracket": (0.12, 1.6), **more})


def figure_5(work: Workshop) -> None:
    """Mass-spring boundary by both criteria, and for growing numbers of masses."""
    size = work.size
    pressures = [float(p) * foam.PLATEAU for p in np.linspace(2.0, 5.0, size.mass_pressures)]
    first, few = size.masses[0], [n for n in size.masses if n < MANY]
    curves = [chain(f"{n} reversible", n, *REVERSIBLE) for n in few]
    curves.append(chain(f"{first} plastic", first, *PLASTIC))
    traced = trace_curves(curves, pressures, foam.eq30, max(size.tolerance, 2e-3), work.pool, scan=7)
    made = [*boundary_table(traced, pressures).columns.values(), *_many(work, pressures)]
    made += [*_equal(work, few, pressures), Column("Eq. 30", "s", "Eq. 30", [foam.eq30(p) for p in pressures])]
    table = work.table("fig05_masses", Table(made))
    _draw_5(work, table)
    for kind, name in (("reversible", "half mass at the loaded end"), ("equal", "equal masses")):
        for criterion in CRITERIA:
            shares = table[f"{first} {kind} {criterion}"] / table["Eq. 30"]
            note = f"{shares[0]:.3f} at p = 2, {shares[-1]:.3f} at p = 5; {first} masses, reversible springs, {name}"
            label = f"T over Eq. 30, mean over p = 2-5, {plain(criterion)}"
            work.number("5", label, "1", solver=float(np.nanmean(shares)), note=note)


def _equal(work: Workshop, counts: Sequence[int], pressures: Sequence[float]) -> list[Column]:
    """Boundaries of equal masses and reversible springs, by the integrator of `rooms`; of many masses at every third pressure."""
    few = counts[0]
    some = {n: pressures if n == few else pressures[::3] for n in counts}
    chains = {n: Chain(n, cfl=0.02) for n in counts}
    asked = {n: ask(work.pool, chains[n], some[n], (0.12, 0.6), scan=12 if n == few else 24) for n in counts}
    made = []
    for masses, by_criterion in asked.items():
        for criterion, tasks in by_criterion.items():
            found = {p: task.result().last * foam.eq30(p) for p, task in zip(some[masses], tasks, strict=True)}
            values = [found.get(p, math.nan) for p in pressures]
            text = f"duration from which on every pulse does it, {masses} equal masses, reversible springs, {plain(criterion)}"
            made.append(Column(f"{masses} equal {criterion}", "s", text, values))
    return made


def _many(work: Workshop, pressures: Sequence[float]) -> list[Column]:
    """Boundaries of many masses, at every third pressure."""
    made, some = [], pressures[::3]
    for n in (n for n in work.size.masses if n >= MANY):
        curve = chain(f"{n} reversible", n, *COARSE, bracket=(0.15, 0.6))
        traced = trace_curves([curve], some, foam.eq30, 1e-2, work.pool, scan=4)
        for column in list(boundary_table(traced, some).columns.values())[1:]:
            found = dict(zip(some, column.values, strict=True))
            made.append(column._replace(values=[found.get(p, math.nan) for p in pressures]))
    return made


def _draw_5(work: Workshop, table: Table) -> None:
    figure, (left, right) = new_figure(10.5, 4.6, ncols=2, sharey=True)
    p, first = table["pressure"] / foam.PLATEAU, work.size.masses[0]
    for kind, color in (("reversible", BLUE), ("plastic", ORANGE)):
        for criterion, mark in (("fully_crushed", "s"), ("enhanced", "^")):
            label, tau = f"{kind} springs, {plain(criterion)}", table[f"{first} {kind} {criterion}"] * foam.RATE
            left.plot(tau, p, mark + "-", color=color, ms=5, mfc="none", lw=0.8, label=label)
    for criterion, style in zip(CRITERIA, ("-", "--"), strict=True):
        tau, label = table[f"{first} equal {criterion}"] * foam.RATE, f"equal masses, {plain(criterion)}"
        left.plot(tau, p, style, color="black", lw=0.9, label=label)
    for n, color in zip(work.size.masses, COLORS, strict=False):
        tau = table[f"{n} reversible fully_crushed"] * foam.RATE
        seen = np.isfinite(tau)
        right.plot(tau[seen], p[seen], "-s", ms=3, color=color, lw=1.2, label=f"{n} masses")
        right.plot(table[f"{n} reversible enhanced"] * foam.RATE, p, "^", ms=5, mfc="none", color=color)
        if n < MANY:
            right.plot(table[f"{n} equal fully_crushed"] * foam.RATE, p, "x", ms=5, color=color)
    left.set(xlabel="τd", ylabel="p", title=f"{first} masses", xlim=(0.2, 3.2))
    right.set(xlabel="τd", title="reversible springs, number of masses", xlim=(0.2, 1.8))
    for ax in (left, right):
        duration, pressure = foam.eq30_line(2.0 * foam.PLATEAU, 5.0 * foam.PLATEAU)
        ax.plot(duration * foam.RATE, pressure / foam.PLATEAU, color=GREY, lw=1.6, ls="--", label="Eq. 30")
        ax.legend(frameon=False, fontsize=8)
    work.picture("fig05", figure, table)


def peaks_of_many_masses(work: Workshop) -> None:
    """Peak support stress against duration, by number of masses: is there a boundary at all?"""
    counts = (10, 50, 500) if 500 in work.size.masses else (10, 50)
    shares = np.geomspace(0.1, 0.8, work.size.strip_points)
    peaks = {f"{n} masses": _peaks(work, n, shares) for n in counts}
    table = work.table("new5_many_masses", columns(T_over_eq30=shares, **peaks))
    figure, ax = new_figure(7.5, 4.2)
    for label, color in zip(peaks, COLORS[::2], strict=False):
        ax.plot(shares, np.minimum(table[label], 10.0), "-o", ms=3, lw=1.0, color=color, label=label)
    ax.axhline(1.0, color="black", lw=0.8, ls=":")
    ax.set(xlabel="T over Eq. 30", ylabel="peak support stress over P", xscale="log", yscale="log", ylim=(0.2, 12))
    ax.set_xticks([0.1, 0.2, 0.4, 0.8], ["0.1", "0.2", "0.4", "0.8"])
    ax.set_yticks([0.2, 0.5, 1, 2, 5, 10], ["0.2", "0.5", "1", "2", "5", "≥ 10"])
    ax.minorticks_off()
    ax.legend(frameon=False)
    work.picture("new5_many_masses", figure, table)


def _peaks(work: Workshop, masses: int, shares: np.ndarray) -> list[float]:
    """Peak support stress over P at durations over Eq. 30; a run ends when it is ten."""
    curve = chain(f"{masses}", masses, *(REVERSIBLE if masses < MANY else COARSE))
    durations = [float(share) * foam.eq30(STRIP) for share in shares]
    wanted, enough = ("enhancement",), ("enhancement > 10",)
    runs = [work.pool.submit(evaluate_at, curve, STRIP, duration, wanted, enough) for duration in reversed(durations)]
    return [run.result()["enhancement"] for run in reversed(runs)]
