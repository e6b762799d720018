"""Fig. 3: the length of column that a striker just fully crushes."""

import math

import numpy as np

from hydro1d import analytic
from hydro1d.analytic import rppl, rppl_energy_balance
from hydro1d.studies.harrigan2010.colors import BLUE, GREY, RED
from hydro1d.studies.harrigan2010.workshop import Size, Workshop, columns, deck_data, new_figure
from hydro1d.sweep import Job, Table, evaluate, find_flip
from hydro1d.sweep.job import override

MATERIAL, MASS = analytic.RPPL(155.0, 0.3e6, 0.67), 40.0


def figure_3(work: Workshop) -> None:
    """Eqs. 13 and 19, and the solver's critical lengths in the rigid limit."""
    speeds = np.linspace(400.0 / work.size.striker_points, 400.0, work.size.striker_points)
    soft, stiff = work.size.stiffness
    tasks = [work.pool.submit(_critical_length, work.size, float(v), k) for k in (stiff, soft) for v in speeds]
    stiffer, softer = np.array([task.result() for task in tasks]).reshape(2, -1)
    ratio = math.sqrt(stiff / soft)
    limit = (ratio * stiffer - softer) / (ratio - 1.0)  # the error goes as stiffness^(-1/2)
    _draw(work, columns(v0__m_s=speeds, stiff__m=stiffer, soft__m=softer, rigid_limit__m=limit))
    exact, wrong = (float(scheme.critical_length(MATERIAL, MASS, 400.0)) for scheme in (rppl, rppl_energy_balance))
    label, note = "critical length at 400 m/s", f"extrapolated to rigid; {stiffer[-1]:.4g} m at stiffness {stiff:g} σP"
    work.number("3", f"{label}, Eq. 13", "m", paper=2.62, equations=exact, solver=limit[-1], note=note)
    note = "Scheme 2, which the solver does not follow"
    work.number("3", f"{label}, Eq. 19", "m", paper=15.9, equations=wrong, note=note)
    worst = 100.0 * float(np.max(np.abs(limit / rppl.critical_length(MATERIAL, MASS, speeds) - 1.0)))
    work.number("3", "largest deviation of the solver from Eq. 13", "%", solver=worst, note="extrapolated, all v0")


def _draw(work: Workshop, lengths: Table) -> None:
    velocity = np.linspace(0.0, 400.0, 81)
    shock, energy = (scheme.critical_length(MATERIAL, MASS, velocity) for scheme in (rppl, rppl_energy_balance))
    lengths = work.table("fig03_lengths", lengths)
    speeds, stiffer, limit = (lengths[name] for name in ("v0 (m s-1)", "stiff (m)", "rigid_limit (m)"))
    figure, ax = new_figure()
    ax.plot(velocity, shock, color=BLUE, lw=1.8, label="Eq. 13, mass and momentum")
    ax.plot(velocity, energy, color=GREY, lw=1.8, ls="--", label="Eq. 19, energy balance")
    ax.plot(speeds, stiffer, "o", mfc="none", color=RED, label=f"solver, stiffness {work.size.stiffness[1]:g} σP")
    ax.plot(speeds, limit, "x", color=RED, label="solver, extrapolated to rigid")
    ax.set(xlabel="v0 (m/s)", ylabel="critical length (m)", xlim=(0, 410), ylim=(0, 16.5))
    ax.legend(frameon=False)
    solver = {f"solver {name}": lengths[name] for name in lengths}
    data = columns(v0__m_s=velocity, eq13__m=shock, eq19__m=energy, **solver)
    work.picture("fig03", figure, data)


def _critical_length(size: Size, speed: float, stiffness: float) -> float:
    data = deck_data("striker.toml")
    guess = float(rppl.critical_length(MATERIAL, MASS, speed))
    end = 1.2 * MASS * speed / MATERIAL.plateau_stress
    values = {"left.velocity": speed, "material.foam.stiffness": stiffness, "time.end": end}
    fixed = [override(key, value) for key, value in {**values, "layer[0].zones": size.zones}.items()]

    def crushed(length: float) -> bool:
        texts = (*fixed, override("layer[0].thickness", length))
        row = evaluate(Job(data, ".", texts, (), ("fully_crushed",), stop_early=True))
        if row["status"] == "failed":
            raise RuntimeError(row["error"])
        return bool(row["fully_crushed"])

    return find_flip(crushed, 0.8 * guess, 1.25 * guess, tolerance=size.tolerance, scan=3).value
