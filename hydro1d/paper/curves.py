"""Figs. 1, 8 and 9: the curves, and the compaction Hugoniot that they imply."""

from __future__ import annotations

import numpy as np

from hydro1d import analytic
from hydro1d.paper import foam
from hydro1d.paper.workshop import BLUE, GREEN, ORANGE, RED, Workshop, columns, new_figure

MEGA = 1e6


def figure_1(work: Workshop) -> None:
    """Quasi-static curves."""
    strain = np.concatenate([[0.0], np.linspace(foam.PLATEAU / foam.MODULUS, foam.LOCKING, 30)])
    over = np.linspace(foam.LOCKING, 0.995, 200)
    ends = np.minimum(over, foam.LINEAR.strain_limit)
    linear = np.concatenate([foam.LINEAR.stress(strain), foam.LINEAR.stress(ends)]) / MEGA
    tangent = np.concatenate([foam.TANGENT.stress(strain), foam.TANGENT.stress(over)]) / MEGA
    strains = np.concatenate([strain, over])
    rigid = (np.array([0.0, 0.0, foam.LOCKING, foam.LOCKING]), np.array([0.0, foam.PLATEAU, foam.PLATEAU, 10e6]) / MEGA)
    figure, ax = new_figure()
    ax.plot(*rigid, color=BLUE, lw=1.8, label="R-P-P-L")
    ax.plot(strains, linear, color=RED, lw=1.8, label="E-P-P-H, Eq. 39")
    ax.plot(strains, tangent, color=GREEN, lw=1.8, ls="--", label=f"E-P-P-H, Eq. 38, β = {foam.BETA}, γ = {foam.GAMMA}")
    ax.plot(strains[-1], linear[-1], "o", color=RED, ms=4)
    ax.set(xlabel="strain", ylabel="stress (MPa)", ylim=(0, 8), xlim=(-0.01, 1.01))
    ax.legend(frameon=False)
    caption = "Rohacell-51 WF. Eq. 39 ends at ε = 1 (5.5 MPa, dot); Eq. 38 hardens without bound."
    data = columns(strain=strains, eq39__MPa=linear, eq38__MPa=tangent, rppl_strain=rigid[0], rppl__MPa=rigid[1])
    work.picture("fig01", "Fig. 1: quasi-static curves", caption, figure, data)
    work.number("1", "yield strain", "1", paper=0.0364, equations=foam.LINEAR.yield_strain)
    work.number("1", "stress where Eq. 39 ends", "MPa", equations=float(foam.LINEAR.stress(1.0)) / MEGA)


def figures_8_9(work: Workshop) -> None:
    """Strain and front speed against the velocity jump."""
    velocities = np.linspace(10.0, 250.0, 49)
    beta, gamma, residual = foam.fit_tangent(velocities)
    used = foam.misfit(velocities, foam.BETA, foam.GAMMA)
    exact = {
        "Eq. 39": analytic.compaction_hugoniot(foam.LINEAR, velocities),
        "Eq. 38": analytic.compaction_hugoniot(foam.TANGENT, velocities),
    }
    points = {
        "Eq. 39": _measured(work, "step.toml", np.linspace(1.0e6, 4.3e6, work.size.steps)),
        "Eq. 38": _measured(work, "step_tangent.toml", np.linspace(1.0e6, 4.3e6, work.size.steps)),
    }
    for name, label, quantity, column in (
        ("fig08", "strain behind the front", "strain", 1),
        ("fig09", "cS (m/s)", "shock_speed", 2),
    ):
        figure, ax = new_figure()
        for (key, hugoniot), color, mark in zip(exact.items(), (RED, GREEN), "os", strict=True):
            ax.plot(velocities, getattr(hugoniot, quantity), color=color, lw=1.6, label=key)
            ax.plot(
                points[key][:, 0], points[key][:, column], mark, color=color, mfc="none", ms=6, label=f"{key}, solver"
            )
        ax.set(xlabel="[v] (m/s)", ylabel=label, xlim=(0, 260))
        if name == "fig08":
            ax.set_ylim(0.4, 1.0)
        ax.legend(frameon=False)
        data = columns(
            v__m_s=velocities,
            **{f"eq39_{quantity}": getattr(exact["Eq. 39"], quantity)},
            **{f"eq38_{quantity}": getattr(exact["Eq. 38"], quantity)},
            **{
                f"solver_{key[-2:]}_{what}": points[key][:, k]
                for key in points
                for k, what in ((0, "v__m_s"), (column, quantity))
            },
        )
        caption = (
            f"Lines: Eqs. 35 and 37. Fit of Eq. 38 to Eq. 39 over 10–250 m/s: β = {beta:.3f}, γ = {gamma:.3f}, "
            f"rms strain {residual:.3f}."
        )
        work.picture(name, f"Fig. {int(name[3:])}: {label} against [v]", caption, figure, data)
    work.number("8", "beta, fit of Eq. 38 to Eq. 39", "1", equations=beta, note="not printed in the paper")
    work.number("8", "gamma, fit of Eq. 38 to Eq. 39", "1", equations=gamma, note="not printed in the paper")
    work.number(
        "8",
        "rms strain difference of the fit",
        "1",
        equations=residual,
        note=f"{used:.4f} with the beta = {foam.BETA}, gamma = {foam.GAMMA} used here: the minimum is flat",
    )
    for key, curve in (("Eq. 39", foam.LINEAR), ("Eq. 38", foam.TANGENT)):
        row = points[key][-1]
        theory = analytic.compaction_hugoniot(curve, row[0])
        note = f"at [v] = {row[0]:.1f} m/s"
        work.number("8", f"strain behind the front, {key}", "1", equations=theory.strain, solver=row[1], note=note)
        work.number("9", f"cS, {key}", "m/s", equations=theory.shock_speed, solver=row[2], note=note)


def _measured(work: Workshop, deck: str, pressures: np.ndarray) -> np.ndarray:
    """[v], strain, cS of steady fronts (runs, 3): states from a profile, speed from the front's path."""
    rows = []
    for pressure in pressures:
        label = f"{deck[:-5]}_{pressure / 1e6:.3g}MPa"
        result = work.run(deck, label, [f"left.peak={float(pressure)}", f"layer[0].zones={work.size.fine_zones // 2}"])
        front, time = result.history["front_position"], result.history["time"]
        late = (time > 0.5 * time[-1]) & np.isfinite(front)
        speed = np.polyfit(time[late], front[late], 1)[0]
        zone, node = result["zone_coordinate"], result["node_coordinate"]
        behind, ahead = zone < 0.7 * front[-1], (zone > front[-1] + 0.05) & (zone < front[-1] + 0.15)
        strain = np.median(result["strain"][-1][behind])
        velocity = result["velocity"][-1]
        moving = np.median(velocity[node < 0.7 * front[-1]])
        carried = np.median(velocity[(node > front[-1] + 0.05) & (node < front[-1] + 0.15)])
        rows.append((moving - carried, strain, (1.0 - np.median(result["strain"][-1][ahead])) * speed))
    return np.array(rows)


__all__ = ["BLUE", "ORANGE", "figure_1", "figures_8_9"]
