"""Fronts of both schools: their speeds, and the stresses in them while nothing but the front has reached the support."""

from collections.abc import Sequence

import numpy as np

from hydro1d import analytic
from hydro1d.store import Run
from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.colors import BLUE, ORANGE, RED
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, new_figure

LOADS = (2.4e6, 3.6e6)  # Pa
PUSHED = 1.5e-3  # s: the pulse still acts
FORMED = 0.3e-3  # s: the front has left the loaded end behind
SCHOOLS = {
    "shocks resolved": ("pulse_tangent.toml", ["layer[0].zones=400", "left.duration=1.53148e-3"], RED),
    "50 masses, plastic springs": ("mass_spring.toml", ["time.cfl=0.05", 'material.foam.unloading="elastic"'], ORANGE),
    "50 masses, reversible springs": ("mass_spring.toml", ["time.cfl=0.05"], BLUE),
}


def fronts(work: Workshop) -> None:
    """Crushed length against time in stage 1, and the largest stress in it."""
    figure, axes = new_figure(10.5, 4.2, ncols=2, sharey=True)
    data: dict[str, np.ndarray] = {}
    for ax, load in zip(axes, LOADS, strict=True):
        exact = analytic.pressure_step(foam.TANGENT, load).jumps()[-1].front_speed
        for name, (deck, texts, color) in SCHOOLS.items():
            time, crushed, run = crushed_length(work, deck, name, load, texts)
            ax.plot(time * 1e3, crushed, color=color, lw=1.2, label=name)
            data |= {f"t, {name}, {load / 1e6:g} MPa__s": time, f"crushed, {name}, {load / 1e6:g} MPa__m": crushed}
            _numbers(work, name, load, exact, np.polyfit(time, crushed, 1)[0], run)
        ax.plot([0, PUSHED * 1e3], [0, PUSHED * exact], color="black", ls=":", lw=1.4, label="Eqs. 35 and 37")
        ax.set(xlabel="t (ms)", title=f"P = {load / 1e6:g} MPa", xlim=(0, PUSHED * 1e3), ylim=(0, 0.5))
        ax.legend(frameon=False, fontsize=8)
    axes[0].set_ylabel("crushed length, undeformed (m)")
    work.picture("new7_fronts", figure, columns(**data))


def crushed_length(
    work: Workshop, deck: str, name: str, load: float, texts: Sequence[str]
) -> tuple[np.ndarray, np.ndarray, Run]:
    """Times (s) from `FORMED` on, crushed length (m) at them, and the run."""
    label = f"new7_{name.replace(',', '').replace(' ', '_')}_{load / 1e6:g}MPa"
    end = [f"left.peak={load}", f"time.end={PUSHED}", "output.profiles=2", "output.history=5"]
    run = work.run(deck, label, [*texts, *end])
    time, left = run.history["time"], run.history["uncrushed_fraction"]
    formed = time > FORMED
    return time[formed], foam.LENGTH * (1.0 - left[formed]), run


def _numbers(work: Workshop, name: str, load: float, exact: float, speed: float, run: Run) -> None:
    at, highest = f"P = {load / 1e6:g} MPa", float(run.history["peak_stress"][-1]) / load
    label = f"speed of the front (undeformed length), {name}, {at}"
    work.number("new 7", label, "m/s", equations=exact, solver=speed, note="Eqs. 35 and 37 with Eq. 38")
    note = "shock theory: P behind the front"
    work.number("new 7", f"largest stress anywhere over P, {name}, {at}", "1", equations=1.0, solver=highest, note=note)
