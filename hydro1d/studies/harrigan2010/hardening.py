"""What β and γ of Eq. 38, which the paper does not print, could be, and what that does to the boundaries."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.boundaries import foam_curve
from hydro1d.studies.harrigan2010.boundary import CRITERIA, Curve, trace_curves
from hydro1d.studies.harrigan2010.colors import BLUE, GREEN, RED
from hydro1d.studies.harrigan2010.rooms import Chain, ask
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, new_figure, plain
from hydro1d.sweep import Table

FITTED = np.linspace(10.0, 250.0, 25)  # [v], m/s
USED = (foam.BETA, foam.GAMMA)
# Each γ from 0.3 to 0.9 has a β that fits Eq. 39 as well as any; beyond, γ alone, to where the misfit doubles.
CREDIBLE = ((0.677, 0.3), (1.512, 0.9), (1.22, 0.4), (1.22, 0.8))
FAR = ((0.6, 0.603), (2.44, 0.603), (5.0, 0.8))  # no fit of Eq. 39
TARGETS = (2.4e6, 3.6e6, 10e6)  # Pa


class _Range(NamedTuple):
    lowest: np.ndarray
    highest: np.ndarray


def hardening(work: Workshop) -> None:
    """Boundaries of the continuum and of ten equal masses, reversible, over a credible range of β and γ and over a wide one."""
    pressures = sorted({*np.geomspace(1.5e6, 10e6, work.size.energy_pressures).tolist(), *TARGETS})
    found = {**_continuum(work, pressures), **_chains(work, pressures)}
    data: dict[str, Sequence[float] | np.ndarray] = {"pressure__Pa": pressures}
    for (model, pair, criterion), shares in found.items():
        data[f"{model}, β = {pair[0]:g}, γ = {pair[1]:g}, {plain(criterion)}"] = shares
    table = work.table("new10_hardening", columns(**data))
    ranges = {
        (model, criterion): (_range(found, model, criterion, CREDIBLE), _range(found, model, criterion, CREDIBLE + FAR))
        for model in ("E-P-P-H", "chain")
        for criterion in CRITERIA
    }
    _draw(work, np.array(pressures) / 1e6, ranges, table)
    _numbers(work, pressures, ranges)


Found = dict[tuple[str, tuple[float, float], str], np.ndarray]  # model, (β, γ), criterion -> durations over Eq. 30


def _continuum(work: Workshop, pressures: Sequence[float]) -> Found:
    def own(beta: float, gamma: float) -> Curve:
        texts = (f"material.foam.beta={beta}", f"material.foam.gamma={gamma}")
        return foam_curve(f"{(beta, gamma)}", "pulse_tangent.toml", work.size.zones, *texts, bracket=(0.6, 2.4))

    curves = {pair: own(*pair) for pair in (USED, *CREDIBLE, *FAR)}
    traced = trace_curves(list(curves.values()), pressures, foam.eq30, max(work.size.tolerance, 2e-3), work.pool)
    unit = np.array([foam.eq30(p) for p in pressures])
    return {
        ("E-P-P-H", pair, criterion): np.array([point.durations[criterion] for point in traced[curve.name]]) / unit
        for pair, curve in curves.items()
        for criterion in CRITERIA
    }


def _chains(work: Workshop, pressures: Sequence[float]) -> Found:
    asked = {
        pair: ask(work.pool, Chain(beta=pair[0], gamma=pair[1]), pressures, (0.3, 0.6))
        for pair in (USED, *CREDIBLE, *FAR)
    }
    return {
        ("chain", pair, criterion): np.array([task.result().last for task in tasks])
        for pair, by_criterion in asked.items()
        for criterion, tasks in by_criterion.items()
    }


def _range(found: Found, model: str, criterion: str, pairs: Sequence[tuple[float, float]]) -> _Range:
    rows = np.array([found[model, pair, criterion] for pair in (USED, *pairs)])
    return _Range(np.nanmin(rows, axis=0), np.nanmax(rows, axis=0))


def _draw(
    work: Workshop, pressure: np.ndarray, ranges: Mapping[tuple[str, str], tuple[_Range, _Range]], table: Table
) -> None:
    figure, ax = new_figure(8.0, 5.4)
    looks = {("E-P-P-H", "fully_crushed"): RED, ("E-P-P-H", "enhanced"): GREEN, ("chain", "fully_crushed"): BLUE}
    for (model, criterion), color in looks.items():
        credible, wide = ranges[model, criterion]
        name = "ten equal masses, reversible" if model == "chain" else model
        label = f"{name}: {plain(criterion)}"
        ax.fill_betweenx(pressure, *credible, color=color, alpha=0.55, lw=0, label=f"{label}, credible β and γ")
        ax.fill_betweenx(pressure, *wide, color=color, alpha=0.18, lw=0, label=f"{label}, all")
    ax.axvline(1.0, color="black", lw=2.0, label="Eq. 30")
    ax.set(xlabel="T over Eq. 30", ylabel="P (MPa)", xlim=(0.3, 1.7), ylim=(0, 10.5))
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=2, frameon=False, fontsize=8)
    pairs = ", ".join(f"β = {beta:g}, γ = {gamma:g}" for beta, gamma in FAR)
    work.picture("new10_hardening", figure, table, pairs=pairs, zones=work.size.zones)


def _numbers(
    work: Workshop, pressures: Sequence[float], ranges: Mapping[tuple[str, str], tuple[_Range, _Range]]
) -> None:
    least = foam.fit_tangent(FITTED)[2]
    for beta, gamma in (*CREDIBLE, *FAR):
        misfit, note = foam.misfit(FITTED, beta, gamma), f"least: {least:.4f}"
        label = f"rms strain difference to Eq. 39, β = {beta:g}, γ = {gamma:g}"
        work.number("new 10", label, "1", equations=misfit, note=note)
    for (model, criterion), pair in ranges.items():
        for kind, found in zip(("credible", "wide"), pair, strict=True):
            for p in TARGETS:
                k = pressures.index(p)
                low, high = found.lowest[k], found.highest[k]
                if not math.isnan(low):
                    note = f"at P = {p / 1e6:g} MPa; from {low:.3f} to {high:.3f}"
                    label = f"T over Eq. 30, {model}, {plain(criterion)}, middle over the {kind} range of β and γ"
                    work.number("new 10", label, "1", solver=0.5 * (low + high), note=note)
