"""A law by itself, without a run: loading, moduli, Hugoniot, energy."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hydro1d.errors import DeckError
from hydro1d.laws.base import Law
from hydro1d.plot._base import GREY, PALETTE, legend, new_figure
from hydro1d.plot._materials import Hugoniot, curve, hugoniot_of, loads_by_strain, strain_grid, top_strain
from hydro1d.plot._units import scale_for

UNLOADINGS = 4


def law(law: Law, name: str = "", top: float | None = None) -> tuple[Figure, np.ndarray]:
    """Loading and unloading, tangent and stiffness, Hugoniot, energy: a figure with Axes (2, 2).

    top: the largest strain drawn; without, where the stress is twelve times that of the knee. Raises DeckError for a
    law that is no curve of the strain (gases).
    """
    if not loads_by_strain(law):
        raise DeckError(
            f"{name or type(law).__name__} has no loading curve: its stress depends on more than the strain"
        )
    end = top_strain(law) if top is None else top
    if not 0.0 < end < 1.0:
        raise DeckError(f"the largest strain must lie between 0 and 1, not {end:g}")
    strains = strain_grid(law, end)
    stresses, tangents = curve(law, strains)
    figure, axes = new_figure(2, 2, (11.0, 8.0))
    _draw_loading(axes[0, 0], law, strains, stresses)
    _draw_moduli(axes[0, 1], law, strains, tangents)
    shock = hugoniot_of(law, end)
    _draw_hugoniot(axes[1, 0], law, shock)
    _draw_energy(axes[1, 1], shock)
    figure.suptitle((name or type(law).__name__).replace("$", r"\$"), fontsize=12)
    return figure, axes


def _draw_loading(axes: Axes, law: Law, strains: np.ndarray, stresses: np.ndarray) -> None:
    scale, top = scale_for("Pa", stresses), float(strains[-1])
    axes.plot(strains, stresses / scale.size, color="#000000", linewidth=1.5, label="loading")
    yielded = float(getattr(law, "yield_strain", 0.0))
    for k, start in enumerate(np.linspace(yielded, top, UNLOADINGS + 1)[1:]):
        down = np.linspace(start, max(start - 1.2 * _give(law, start), -0.02), 120)
        path = np.array([law.at(strain, start).stress for strain in down])
        axes.plot(down, path / scale.size, color=PALETTE[0], linewidth=1.0, label="unloading" if k == 0 else None)
    for strain, text in _marks(law):
        if 0.0 < strain < top:
            axes.axvline(strain, color=GREY, linestyle=":", linewidth=1.0)
            axes.annotate(
                text, (strain, 1.0), (2, -10), ("data", "axes fraction"), "offset points", fontsize=8, color=GREY
            )
    axes.set_xlabel("strain ε")
    axes.set_ylabel(scale.label("stress σ"))
    axes.set_title("loading and unloading", fontsize=10)
    legend(axes)


def _give(law: Law, start: float) -> float:
    """Strain that unloading from `start` gives back."""
    response = law.at(start, start)
    is_reversible = getattr(law, "unloading", "") == "reversible"
    return start if is_reversible else float(response.stress) / float(response.stiffness)


def _marks(law: Law) -> list[tuple[float, str]]:
    crushed = float(law.crushed_strain)
    marks = [(float(getattr(law, "yield_strain", np.nan)), "εY")]
    return [*marks, (crushed, "εD")] if np.isfinite(crushed) else marks


def _draw_moduli(axes: Axes, law: Law, strains: np.ndarray, tangents: np.ndarray) -> None:
    stiff = [law.at(e, e).stiffness for e in strains]
    scale = scale_for("Pa", tangents)
    positive = np.where(tangents > 0.0, tangents, np.nan)
    axes.plot(strains, positive / scale.size, color="#000000", linewidth=1.5, label="tangent of loading")
    axes.plot(strains, np.array(stiff) / scale.size, color=PALETTE[0], linewidth=1.2, linestyle="--", label="unloading")
    axes.set_yscale("log")
    axes.set_xlabel("strain ε")
    axes.set_ylabel(scale.label("modulus dσ/dε"))
    axes.set_title("tangent (none where it is zero) and unloading stiffness", fontsize=10)
    legend(axes)


def _draw_hugoniot(axes: Axes, law: Law, shock: Hugoniot) -> None:
    axes.set_title("compaction shock of a column at rest (Eqs. 35, 37)", fontsize=10)
    axes.set_xlabel("velocity jump [v] over the shock (m/s)")
    if not len(shock.strain):
        _say(axes, "no shock on this curve")
        return
    # On a serrated plateau every step up is a small shock; drawn are those that are stronger than all to lower strains.
    strong = shock.velocity_jump >= np.maximum.accumulate(shock.velocity_jump)
    velocity_jump, front_speed = shock.velocity_jump[strong], shock.front_speed[strong]
    axes.plot(velocity_jump, shock.strain[strong], color=PALETTE[0], label="strain behind, left")
    axes.plot(velocity_jump, shock.foot[strong], color=PALETTE[0], linewidth=0.9, alpha=0.6, label="strain ahead, left")
    axes.set_ylabel("strain ε on both sides of the front")
    axes.set_ylim(0.0, 1.0)
    other = axes.twinx()
    other.plot(velocity_jump, front_speed, color=PALETTE[1], linestyle="--", label="front speed, right")
    wave = float(np.sqrt(curve(law, np.zeros(1))[1][0] / law.density))
    if wave < 3.0 * float(front_speed.max()):
        other.axhline(wave, color=GREY, linestyle=":", linewidth=1.0, label="elastic wave, right")
    other.set_ylim(bottom=0.0)
    other.set_ylabel("Lagrangian speed [v]/[ε] (m/s)")
    other.spines["top"].set_visible(False)
    lines = [*axes.get_lines(), *other.get_lines()]
    axes.legend(lines, [str(line.get_label()) for line in lines], fontsize=8, frameon=False, loc="lower right")


def _draw_energy(axes: Axes, shock: Hugoniot) -> None:
    axes.set_title("absorbed beyond yield: in a shock and quasi-statically (Eq. 22)", fontsize=10)
    axes.set_xlabel("strain ε behind the front")
    if not len(shock.strain):
        _say(axes, "no shock on this curve")
        return
    scale = scale_for("J m-3", shock.shock_energy)
    axes.plot(shock.strain, shock.shock_energy / scale.size, color=PALETTE[1], label="with the shock, ½(σA + σB)[ε]")
    axes.plot(shock.strain, shock.curve_energy / scale.size, color="#000000", label="under the curve")
    between = (shock.curve_energy / scale.size, shock.shock_energy / scale.size)
    axes.fill_between(shock.strain, *between, color=PALETTE[1], alpha=0.15, label="dissipated by the front alone")
    axes.set_ylabel(scale.label("energy per initial volume"))
    legend(axes, loc="upper left")


def _say(axes: Axes, text: str) -> None:
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=GREY, fontsize=9)
