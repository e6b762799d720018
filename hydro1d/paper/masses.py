"""Fig. 12: ten masses without viscosity, and the same foam and load at many zones with it."""

from __future__ import annotations

import numpy as np

from hydro1d.paper import foam
from hydro1d.paper.chain import equal_masses, potential
from hydro1d.paper.workshop import BLUE, GREY, RED, Workshop, columns, new_figure
from hydro1d.store import Run

BETA, GAMMA = 5.0, 0.8  # of the case's deck: with the fit to Eq. 39 the last spring comes within 1e-9 of its pole


def figure_12(work: Workshop) -> None:
    """Trajectories against τ."""
    chain = work.run("mass_spring_li_meng.toml", "fig12_ten_masses")
    fine = work.run(
        "pulse_tangent.toml",
        "fig12_continuum",
        [
            f"layer[0].zones={work.size.fine_zones}",
            "left.duration=1.53148e-3",
            "time.end=7.6574e-3",
            f"material.foam.beta={BETA}",
            f"material.foam.gamma={GAMMA}",
        ],
    )
    own = equal_masses(10, foam.PRESSURE, 1.0 / foam.RATE, 5.0 / foam.RATE, BETA, GAMMA)
    figure, axes = new_figure(10.5, 4.8, ncols=2, sharey=True)
    panels = (
        (chain, range(11), "ten masses, viscosity off"),
        (fine, None, f"{work.size.fine_zones} zones, viscosity on"),
    )
    for ax, (run, nodes, title) in zip(axes, panels, strict=True):
        chosen = nodes or np.linspace(0, run["position"].shape[1] - 1, 11).astype(int)
        for node in chosen:
            ax.plot(run.time * foam.RATE, run["position"][:, node] / foam.LENGTH, color=BLUE, lw=1.1)
        ax.set(xlabel="τ", title=title, xlim=(0, 5), ylim=(-0.1, 1.02))
    for k in range(10):
        axes[0].plot(
            own.time * foam.RATE, own.position[:, k], color=RED, lw=0.7, ls="--", label=None if k else "equal masses"
        )
    axes[0].plot([0, 1], [0, 1], color=GREY, lw=0.8, ls=":")
    axes[1].plot([0, 1], [0, 1], color=GREY, lw=0.8, ls=":", label="elastic wave")
    axes[0].set_ylabel("position over L")
    for ax in axes:
        ax.legend(frameon=False, loc="lower right")
    places = {f"y{k}": chain["position"][:, k] for k in range(11)}
    caption = (
        "p = 4.5, τd = 1, β = 5, γ = 0.8. Left: reversible springs on Eq. 38, the mass at the loaded end "
        "half as heavy (blue), and ten equal masses "
        "by an independent integrator (red). Right: the same foam with its shocks resolved."
    )
    work.picture(
        "fig12",
        "Fig. 12: ten masses, and the continuum",
        caption,
        figure,
        columns(tau=chain.time * foam.RATE, **places),
    )
    _numbers(work, chain, fine, own.support / foam.PRESSURE, own.energy_error)


def _numbers(work: Workshop, chain: Run, fine: Run, own_support: float, own_error: float) -> None:
    error = float(np.max(np.abs(chain.history["energy_error"])))
    work.number(
        "12",
        "energy error of ten masses",
        "1",
        equations=0.0,
        solver=error,
        note="kinetic + internal - work, over the work",
    )
    work.number(
        "12",
        "energy error against the potential of the springs",
        "1",
        equations=0.0,
        solver=_potential_error(chain),
        note=f"at the end; at most {own_error:.1e} for equal masses, independent integrator",
    )
    support = float(chain.history["peak_right_stress"][-1]) / foam.PRESSURE
    work.number(
        "12",
        "peak support stress over P, ten masses",
        "1",
        solver=support,
        note=f"{own_support:.3g} with ten equal masses",
    )
    continuum = float(fine.history["peak_right_stress"][-1]) / foam.PRESSURE
    work.number("12", "peak support stress over P, continuum", "1", solver=continuum)
    first = _arrival(chain)
    work.number("12", "compaction wave at the far end, ten masses", "tau", solver=first * foam.RATE)
    work.number("12", "fully crushed, continuum", "tau", solver=_arrival(fine) * foam.RATE)


def _arrival(run: Run) -> float:
    done = run.history["uncrushed_fraction"] <= 0.0
    return float(run.history["time"][np.argmax(done)]) if done.any() else float("nan")


def _potential_error(chain: Run) -> float:
    """Stored internal energy (summed work on the springs) against the area under their curve, at the "
    "last profile."""
    sizes = np.diff(chain["node_coordinate"])
    stored = float(np.sum(sizes * potential(chain["strain"][-1], BETA, GAMMA)))
    summed = float(np.sum(chain["zone_mass"] * chain["internal_energy"][-1]))
    return abs(stored - summed) / float(chain.history["boundary_work"].max())
