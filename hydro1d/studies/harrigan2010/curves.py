"""Figs. 1, 8 and 9: the curves, and the compaction Hugoniot that they imply."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from hydro1d import analytic
from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.colors import BLUE, GREEN, RED
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, new_figure

MEGA = 1e6


def figure_1(work: Workshop) -> None:
    """Fig. 1: the quasi-static curves of R-P-P-L and E-P-P-H."""
    strain = np.concatenate([[0.0], np.linspace(foam.PLATEAU / foam.MODULUS, foam.LOCKING, 30)])
    over = np.linspace(foam.LOCKING, 1.0, 200)[:-1]
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
    data = columns(strain=strains, eq39__MPa=linear, eq38__MPa=tangent, rppl_strain=rigid[0], rppl__MPa=rigid[1])
    work.picture("fig01", figure, data)
    work.number("1", "yield strain", "1", paper=0.0364, equations=foam.LINEAR.yield_strain)
    work.number("1", "stress where Eq. 39 ends", "MPa", equations=float(foam.LINEAR.stress(1.0)) / MEGA)


class _Relation(NamedTuple):
    """A hardening curve as Figs. 8 and 9 show it: by Eqs. 35 and 37, and points (runs, 3) of [v], strain, cS."""

    curve: analytic.Curve
    exact: analytic.Hugoniot
    points: np.ndarray
    color: str
    mark: str


def figures_8_9(work: Workshop) -> None:
    """Strain and front speed against the velocity jump."""
    velocities, pressures = np.linspace(10.0, 250.0, 49), np.linspace(1.0e6, 4.3e6, work.size.steps)

    def relation(curve: analytic.Curve, deck: str, color: str, mark: str) -> _Relation:
        return _Relation(
            curve, analytic.compaction_hugoniot(curve, velocities), _measured(work, deck, pressures), color, mark
        )

    relations = {
        "Eq. 39": relation(foam.LINEAR, "step.toml", RED, "o"),
        "Eq. 38": relation(foam.TANGENT, "step_tangent.toml", GREEN, "s"),
    }
    _draw(work, "fig08", "strain behind the front", "strain", 1, velocities, relations)
    _draw(work, "fig09", "cS (m/s)", "shock_speed", 2, velocities, relations)
    _fit_numbers(work, velocities)
    for key, (curve, _, points, _, _) in relations.items():
        velocity, strain, speed = points[-1]
        theory, note = analytic.compaction_hugoniot(curve, velocity), f"at [v] = {velocity:.1f} m/s"
        work.number("8", f"strain behind the front, {key}", "1", equations=theory.strain, solver=strain, note=note)
        work.number("9", f"cS, {key}", "m/s", equations=theory.shock_speed, solver=speed, note=note)


def _draw(
    work: Workshop,
    name: str,
    label: str,
    quantity: str,
    column: int,
    velocities: np.ndarray,
    relations: Mapping[str, _Relation],
) -> None:
    figure, ax = new_figure()
    data: dict[str, np.ndarray] = {"v__m_s": velocities}
    for key, (_, exact, points, color, mark) in relations.items():
        ax.plot(velocities, getattr(exact, quantity), color=color, lw=1.6, label=f"{key}, equations")
        ax.plot(points[:, 0], points[:, column], mark, color=color, mfc="none", ms=6, label=f"{key}, solver")
        data |= {f"{key} {quantity}": getattr(exact, quantity), f"solver {key} v__m_s": points[:, 0]}
        data[f"solver {key} {quantity}"] = points[:, column]
    ax.set(xlabel="[v] (m/s)", ylabel=label, xlim=(0, 260), ylim=(0.4, 1.0) if name == "fig08" else (0, 300))
    ax.legend(frameon=False)
    work.picture(name, figure, columns(**data))


def _fit_numbers(work: Workshop, velocities: np.ndarray) -> None:
    beta, gamma, residual = foam.fit_tangent(velocities)
    used, note = (
        foam.misfit(velocities, foam.BETA, foam.GAMMA),
        "not printed in the paper; least squares over 10-250 m/s",
    )
    work.number("8", "β, fit of Eq. 38 to Eq. 39", "1", equations=beta, note=f"{note}; used here: {foam.BETA}")
    work.number("8", "γ, fit of Eq. 38 to Eq. 39", "1", equations=gamma, note=f"{note}; used here: {foam.GAMMA}")
    note = f"{used:.4f} with the β and γ used here: the minimum is flat"
    work.number("8", "rms strain difference of the fit", "1", equations=residual, note=note)


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
