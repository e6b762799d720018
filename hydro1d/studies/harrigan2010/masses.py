"""Fig. 12: ten masses without viscosity, and the same foam and load at many zones with it."""

from typing import Any

import numpy as np

from hydro1d.store import Run
from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.chain import Trajectories, equal_masses, potential
from hydro1d.studies.harrigan2010.colors import GREY
from hydro1d.studies.harrigan2010.measure import crushed_at, support_share
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, new_figure

HARD = (5.0, 0.8)  # β, γ of a foam that hardens earlier and keeps springs away from their pole


def figure_12(work: Workshop) -> None:
    """Fig. 12: positions of ten masses, and of as many points of the continuum, against τ."""
    chain = work.run("mass_spring_li_meng.toml", "fig12_ten_masses")
    hardening = [f"material.foam.beta={HARD[0]}", f"material.foam.gamma={HARD[1]}"]
    hard = work.run("mass_spring_li_meng.toml", "fig12_ten_masses_hard", hardening)
    texts = [f"layer[0].zones={work.size.fine_zones}", "left.duration=1.53148e-3", "time.end=7.6574e-3"]
    fine = work.run("pulse_tangent.toml", "fig12_continuum", texts)
    own = equal_masses(10, foam.PRESSURE, 1.0 / foam.RATE, 5.0 / foam.RATE, foam.BETA, foam.GAMMA)
    _draw(work, chain, own, fine)
    _energy_numbers(work, chain, own)
    _outcome_numbers(work, chain, hard, own, fine)


def _draw(work: Workshop, chain: Run, own: Trajectories, fine: Run) -> None:
    figure, axes = new_figure(13.5, 4.8, ncols=3, sharey=True)
    every = (fine["position"].shape[1] - 1) // 10
    _trajectories(axes[0], chain.time, chain["position"], "ten masses, end mass half, viscosity off")
    _trajectories(axes[1], own.time, own.position, "ten equal masses, independent integrator")
    _trajectories(axes[2], fine.time, fine["position"][:, ::every], f"{work.size.fine_zones} zones, viscosity on")
    axes[0].set_ylabel("distance from the support over L")
    axes[2].legend(frameon=False, loc="lower left")
    places = {f"y{k}": 1.0 - chain["position"][:, k] / foam.LENGTH for k in range(11)}
    data = columns(tau=chain.time * foam.RATE, **places)
    work.picture("fig12", figure, data)


def _trajectories(ax: Any, time: np.ndarray, position: np.ndarray, title: str) -> None:
    import matplotlib

    colors = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, 10))
    for k, color in enumerate(colors):
        ax.plot(time * foam.RATE, 1.0 - position[:, k] / foam.LENGTH, color=color, lw=1.1)
    ax.plot([0, 1], [1, 0], color=GREY, lw=0.8, ls=":", label="elastic wave")
    ax.set_title(title, fontsize=10)
    ax.set(xlabel="τ", xlim=(0, 5), ylim=(-0.02, 1.12))


def _energy_numbers(work: Workshop, chain: Run, own: Trajectories) -> None:
    error, note = np.max(np.abs(chain.history["energy_error"])), "kinetic + internal - work, over the work"
    work.number("12", "energy error of ten masses", "1", equations=0.0, solver=error, note=note)
    error = potential_error(chain, foam.BETA, foam.GAMMA)
    note = f"at the end; at most {own.energy_error:.1e} for equal masses, independent integrator"
    label = "energy error against the potential of the springs"
    work.number("12", label, "1", equations=0.0, solver=error, note=note)


def _outcome_numbers(work: Workshop, chain: Run, hard: Run, own: Trajectories, fine: Run) -> None:
    harder = f"with β = {HARD[0]}, γ = {HARD[1]}"
    note = f"{own.support / foam.PRESSURE:.3g} with ten equal masses; {support_share(hard):.3g} {harder}"
    note += ": the height is that of the pole"
    work.number("12", "peak support stress over P, ten masses", "1", solver=support_share(chain), note=note)
    work.number("12", "peak support stress over P, continuum", "1", solver=support_share(fine))
    note = f"{crushed_at(hard) * foam.RATE:.4g} {harder}"
    work.number("12", "every spring past εD, ten masses", "τ", solver=crushed_at(chain) * foam.RATE, note=note)
    work.number("12", "fully crushed, continuum", "τ", solver=crushed_at(fine) * foam.RATE)


def potential_error(chain: Run, beta: float, gamma: float) -> float:
    """Summed work on the springs against the area under their curve, at the last profile."""
    sizes = np.diff(chain["node_coordinate"])
    stored = float(np.sum(sizes * potential(1.0 - chain["strain"][-1], beta, gamma)))
    summed = float(np.sum(chain["zone_mass"] * chain["internal_energy"][-1]))
    return abs(stored - summed) / float(chain.history["boundary_work"].max())
