"""Where a chain's outcome changes again and again as the pulse grows longer: a band and not a boundary.

The masses of reversible springs scatter each other like balls. Ten equal ones swap velocities, and little else: their
boundary stays one line. With half a mass at the loaded end, as in the solver's chain, every meeting sends some of it back,
and above 6 MPa, where springs are so hard that a meeting takes no time, the outcome hangs on every one of them.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.boundary import CRITERIA, evaluate_at
from hydro1d.studies.harrigan2010.colors import BLUE, GREY, RED
from hydro1d.studies.harrigan2010.rooms import Band, Chain, answers
from hydro1d.studies.harrigan2010.springs import chain
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, new_figure, plain

CHAINS = {"half mass": Chain(end_mass=0.5), "equal masses": Chain()}
LOW, HIGH = 0.3, 0.55  # durations over Eq. 30: no there and yes here, at every pressure
HARDEST = 8e6  # Pa: where the solver is asked too
FINE_CHAIN = ("time.cfl=0.02",)

Outcomes = dict[str, np.ndarray]  # chain and criterion -> answers (pressures, durations)


def outcomes(work: Workshop, pressures: Sequence[float]) -> tuple[np.ndarray, Outcomes]:
    """Durations over Eq. 30, and what every one of them does to both chains at these pressures (Pa)."""
    shares = np.linspace(LOW, HIGH, work.size.band_points)
    tasks = {name: [work.pool.submit(answers, own, p, shares) for p in pressures] for name, own in CHAINS.items()}
    rows = {name: np.array([task.result() for task in many]) for name, many in tasks.items()}
    return shares, {f"{name} {criterion}": rows[name][:, k] for name in CHAINS for k, criterion in enumerate(CRITERIA)}


def bands(shares: np.ndarray, said: np.ndarray) -> Band:
    """Shortest duration over Eq. 30 with a yes, and the one from which on it is always yes, at every pressure (pressures,)."""
    half = 0.5 * (shares[1] - shares[0])
    first = shares[np.argmax(said, axis=1)] - half
    last = shares[::-1][np.argmin(said[:, ::-1], axis=1)] + half
    return Band(first, last)


def draw(work: Workshop, pressures: Sequence[float], shares: np.ndarray, found: Outcomes) -> None:
    """The outcomes as maps, and how the solver's own chain fares."""
    from matplotlib.colors import ListedColormap

    figure, axes = new_figure(12.5, 4.8, ncols=2, sharey=True)
    shades = {"nothing": "#f4f4f4", "fully crushed only": "#8fb4dc", "enhanced only": RED, "both": BLUE}
    colors = ListedColormap(list(shades.values()))
    for ax, name in zip(axes, CHAINS, strict=True):
        crushed, enhanced = (found[f"{name} {criterion}"] for criterion in CRITERIA)
        image = crushed.astype(int) + 2 * enhanced.astype(int)
        ax.pcolormesh(shares, np.array(pressures) / 1e6, image, cmap=colors, vmin=0, vmax=3, shading="nearest")
        title = f"ten masses, {name}" + (" at the loaded end" if "half" in name else "")
        ax.set(title=title, xlabel="T over Eq. 30")
        ax.grid(False)
    axes[0].set_ylabel("P (MPa)")
    for label, color in shades.items():
        axes[1].plot([], [], "s", color=color, mec=GREY, label=label)
    figure.legend(*axes[1].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False)
    data = {"T over Eq. 30": shares}
    for name, said in found.items():
        data |= {f"{name}, {p / 1e6:.3g} MPa": row.astype(float) for p, row in zip(pressures, said, strict=True)}
    work.picture("new9_bands", figure, columns(**data))
    _numbers(work, pressures, shares, found)
    _solver_numbers(work)


def _numbers(work: Workshop, pressures: Sequence[float], shares: np.ndarray, found: Mapping[str, np.ndarray]) -> None:
    for k in sorted({int(np.argmin(np.abs(np.array(pressures) - p))) for p in (3.6e6, HARDEST, 10e6)}):
        for name, said in found.items():
            first, last = bands(shares, said[k : k + 1])
            changes = int(np.count_nonzero(np.diff(said[k])))
            note = f"at P = {pressures[k] / 1e6:.3g} MPa; first yes at {first[0]:.3f}; {changes} changes in {len(shares)} pulses"
            chain_name, criterion = name.rsplit(" ", 1)
            label = f"T over Eq. 30 from which on always {plain(criterion)}, ten masses, {chain_name}"
            work.number("new 9", label, "1", solver=last[0], note=note)


def _solver_numbers(work: Workshop) -> None:
    """How often the solver's chain says the same as the one of `rooms`, through the whole band."""
    shares = np.linspace(LOW, HIGH, work.size.strip_points)
    own, said = chain("reversible", 10, *FINE_CHAIN), answers(CHAINS["half mass"], HARDEST, shares)

    def ask(share: float) -> dict[str, Any]:
        return evaluate_at(own, HARDEST, float(share) * foam.eq30(HARDEST), (), CRITERIA)

    rows = list(work.pool.map(ask, shares))
    for criterion, expected in zip(CRITERIA, said, strict=True):
        same = np.mean([row[criterion] == float(yes) for row, yes in zip(rows, expected, strict=True)])
        note = f"of {len(shares)} pulses at P = {HARDEST / 1e6:g} MPa, {LOW:g} to {HIGH:g} of Eq. 30"
        label = f"share in which the solver's chain and the integrator of its own agree, {plain(criterion)}"
        work.number("new 9", label, "1", equations=1.0, solver=float(same), note=note)
