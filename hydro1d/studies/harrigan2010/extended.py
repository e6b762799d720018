"""What is left when the extended theory ends: does the kinetic energy left decide on full crushing?

The theory (Eqs. 40-47) ends where its fronts meet, or where the block has slowed down to VY. In the second case all but
the distal block still moves at VY, and the paper sets this kinetic energy against what the uncrushed rest can absorb
along the quasi-static curve, σP (εD - εY). Here that comparison is made at every pressure, as a boundary.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from hydro1d import analytic
from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.boundaries import LINEAR_TOP, foam_curve
from hydro1d.studies.harrigan2010.boundary import trace_curves
from hydro1d.studies.harrigan2010.colors import GREEN, RED
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, new_figure
from hydro1d.sweep import Table

CURVES = (("Eq. 38", foam.TANGENT, "pulse_tangent.toml", GREEN), ("Eq. 39", foam.LINEAR, "pulse_epph.toml", RED))
RIGIDITY = 20.0  # unloading modulus over E: the theory unloads rigidly; 100 gives the same to 0.1 %


class Critical(NamedTuple):
    """Critical durations, s: the fronts just meet when the block comes to VY; the energy left just suffices."""

    fronts_meet: float
    energy_suffices: float


def critical_durations(curve: analytic.Curve, pressure: float) -> Critical:
    """Both for a column of `foam.LENGTH` under a rectangular pulse of this pressure (Pa).

    The decay of Eqs. 36 and 46 has no length of its own: where the block comes to VY, at t = T P/σP, its front lies at
    X = T x(P), and the distal front at L - D (t - L/c0). So one solution of the equations gives every duration.
    """
    pulse = analytic.CompactionPulse(curve, foam.LENGTH, pressure, 0.1 * foam.eq30(pressure))
    front = float(pulse.history(pulse.arrest_time).front) / pulse.duration
    speed = -pulse.distal_jump.front_speed
    start = foam.LENGTH + speed * pulse.wave_arrival
    retreat = speed * pressure / curve.yield_stress
    capacity = curve.yield_stress * (foam.LOCKING - curve.yield_strain)
    kinetic = 0.5 * curve.density * curve.yield_velocity**2
    share = 1.0 - kinetic / capacity
    return Critical(start / (front + retreat), share * start / (front + share * retreat))


def energy_left(work: Workshop) -> None:
    """Both boundaries of the theory, and full crushing by the solver."""
    pressures = [float(p) for p in np.geomspace(1.5e6, 10e6, work.size.energy_pressures)]
    data: dict[str, Sequence[float]] = {"pressure__Pa": pressures}
    for name, curve, deck, _ in CURVES:
        own = [p for p in pressures if name == "Eq. 38" or p <= LINEAR_TOP]
        theory = [critical_durations(curve, p) for p in own]
        data[f"{name} fronts meet"] = [item.fronts_meet / foam.eq30(p) for item, p in zip(theory, own, strict=True)]
        data[f"{name} energy suffices"] = [
            item.energy_suffices / foam.eq30(p) for item, p in zip(theory, own, strict=True)
        ]
        for label, shares in _solver(work, deck, own).items():
            data[f"{name} solver, {label}"] = shares
    table = work.table("new6_energy_left", columns(**data))
    _draw(work, table)
    _numbers(work, table)


def _solver(work: Workshop, deck: str, pressures: Sequence[float]) -> dict[str, list[float]]:
    """Durations of full crushing over Eq. 30, by unloading."""
    stiff = f"material.foam.unloading_modulus={RIGIDITY * foam.MODULUS}"
    curves = [
        foam_curve(label, deck, 2 * work.size.zones, *texts, criteria=("fully_crushed",))
        for label, texts in (("H = E", ()), (f"H = {RIGIDITY:g} E", (stiff,)))
    ]
    traced = trace_curves(curves, pressures, foam.eq30, work.size.tolerance, work.pool, scan=3)
    return {
        label: [point.durations["fully_crushed"] / foam.eq30(point.pressure) for point in points]
        for label, points in traced.items()
    }


def _draw(work: Workshop, table: Table) -> None:
    figure, axes = new_figure(10.5, 4.4, ncols=2, sharey=True)
    pressure = table["pressure (Pa)"] / 1e6
    for ax, (name, _, _, color) in zip(axes, CURVES, strict=True):
        ax.plot(table[f"{name} fronts meet"], pressure, color=color, ls=":", label="theory: fronts just meet at rest")
        ax.plot(table[f"{name} energy suffices"], pressure, color=color, label="theory: energy left = capacity left")
        for label, mark in ((f"H = {RIGIDITY:g} E", "o"), ("H = E", "s")):
            ax.plot(table[f"{name} solver, {label}"], pressure, mark, color=color, mfc="none", label=f"solver, {label}")
        ax.set(xlabel="T over Eq. 30", title=f"E-P-P-H, {name}", xlim=(0.74, 0.94), ylim=(0, 10.5))
        ax.legend(frameon=False, fontsize=8, loc="upper left")
    axes[0].set_ylabel("P (MPa)")
    work.picture("new6_energy_left", figure, table)


def _numbers(work: Workshop, table: Table) -> None:
    pressure = table["pressure (Pa)"] / 1e6
    for name, *_ in CURVES:
        solver = table[f"{name} solver, H = {RIGIDITY:g} E"]
        for label in ("energy suffices", "fronts meet"):
            theory = table[f"{name} {label}"]
            worst = int(np.nanargmax(np.abs(solver / theory - 1.0)))
            quantity = f"T over Eq. 30, fully crushed, {name}: {label}"
            note = f"at P = {pressure[worst]:.3g} MPa, where they differ most; solver at H = {RIGIDITY:g} E"
            work.number("new 6", quantity, "1", equations=theory[worst], solver=solver[worst], note=note)
