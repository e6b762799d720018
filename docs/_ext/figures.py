"""Figures of the documentation, drawn at build time from the program itself."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

ROHACELL = {
    "density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689,
}  # fmt: skip
GREY = "#777777"
# The values that a law's curve is drawn with: those of the cases where there are some.
EXAMPLES = {
    "elastic": {"density": 51.6, "modulus": 22e6},
    "rppl": {"density": 51.6, "plateau_stress": 0.8e6, "densification_strain": 0.689, "stiffness": 400.0},
    "eppr": {**ROHACELL, "stiffness": 400.0},
    "epph": {**ROHACELL, "shock_slope": 0.00105},
    "epph-tangent": {**ROHACELL, "beta": 1.22, "gamma": 0.603},
    "eph": {"density": 51.6, "modulus": 22e6, "yield_stress": 0.8e6, "hardening_modulus": 3e6},
    "trilinear": {**ROHACELL, "locking_modulus": 40e6},
    "rph": {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "hardening": 0.15e6},
    "table": {
        "density": 51.6, "modulus": 22e6,
        "curve": [(0.04, 0.82e6), (0.5, 0.9e6), (0.65, 1.2e6), (0.75, 2.0e6), (0.82, 3.4e6), (0.86, 5e6)],
    },
    "ideal-gas": {"density": 1.2, "gamma": 1.4, "pressure": 1e5},
}  # fmt: skip


def axes(size=(5.2, 3.1)) -> tuple[Figure, plt.Axes]:
    """A figure in the common look."""
    plt.rcParams.update({"font.size": 9, "svg.fonttype": "path"})
    figure, ax = plt.subplots(figsize=size, layout="constrained")
    ax.spines[["top", "right"]].set_visible(False)
    ax.grid(True, color="#e4e4e4", linewidth=0.6)
    return figure, ax


def answers(law, loads) -> np.ndarray:
    """Strain and stress along a list of strains, loaded slowly, at constant entropy for a gas."""
    from hydro1d import Point

    energy, stress, before, rows = law.initial_energy, 0.0, 0.0, []
    state = tuple(law.state_variables.values())
    for strain in loads:
        energy += stress * (strain - before) / law.density
        stress, *_, state = law.respond(Point(strain, strain - before, 1.0, energy, 0.0), state)
        rows.append((strain, stress))
        before = strain
    return np.array(rows)


def law(name: str, top: float | None = None, back: float = 0.55) -> None:
    """Loading curve of a law and one unloading, with the values of EXAMPLES."""
    from hydro1d.components.plugins import find

    made = find("law", name)(**EXAMPLES[name])
    if top is None:
        top = min(made.strain_at(6.0), 0.99) if hasattr(made, "strain_at") else 0.5
    _, ax = axes()
    rise = answers(made, np.linspace(0.0, top, 2000))
    ax.plot(rise[:, 0], rise[:, 1] / 1e6, color="#0072B2", label="loading")
    if hasattr(made, "unloading"):
        path = answers(made, [*np.linspace(0.0, back * top, 500), *np.linspace(back * top, 0.0, 4000)])
        down = path[500:]
        down = down[: int(np.argmax(down[:, 1] <= 0.0)) + 1] if (down[:, 1] <= 0.0).any() else down
        ax.plot(down[:, 0], down[:, 1] / 1e6, color="#D55E00", label='unloading = "elastic"')
    densified = made.crushed_strain
    if 0.0 < densified < 1.0:
        ax.axvline(densified, color=GREY, linewidth=0.8, linestyle=":")
        ax.text(densified - 0.005, 0.04, "εD", transform=ax.get_xaxis_transform(), ha="right", color=GREY)
    ax.set(xlabel="strain ε", ylabel="stress σ (MPa)", xlim=(0.0, None), ylim=(0.0, None))
    ax.legend(frameon=False)


def pulses() -> None:
    """The shapes of the pulses."""
    from hydro1d.components.plugins import find

    shapes = {
        "constant": {"peak": 1.0}, "rectangular": {"peak": 1.0, "duration": 1.0},
        "triangular": {"peak": 1.0, "duration": 1.0}, "exponential": {"peak": 1.0, "decay": 0.5},
        "friedlander": {"peak": 1.0, "duration": 1.0, "decay": 1.5, "negative_phase": True},
        "table": {"table": [(0.0, 0.2), (0.3, 0.9), (0.5, 0.6), (1.2, 0.1)]},
    }  # fmt: skip
    plt.rcParams.update({"font.size": 9, "svg.fonttype": "path"})
    _, grid = plt.subplots(2, 3, figsize=(6.6, 3.4), layout="constrained", sharex=True, sharey=True)
    time = np.linspace(0.0, 1.6, 801)[1:]
    for ax, (name, values) in zip(grid.flat, shapes.items(), strict=True):
        made = find("pulse", name)(**values)
        ax.plot(time, [made.pressure(float(t)) for t in time], color="#0072B2")
        ax.axhline(0.0, color=GREY, linewidth=0.6)
        ax.set_title(name, fontsize=9)
        ax.spines[["top", "right"]].set_visible(False)
    for ax in grid[1]:
        ax.set_xlabel("t / duration")
    for ax in grid[:, 0]:
        ax.set_ylabel("p / peak")


def mesh() -> None:
    """Where and when the quantities of the staggered scheme live."""
    plt.rcParams.update({"font.size": 9, "svg.fonttype": "path"})
    _, ax = plt.subplots(figsize=(6.4, 2.9), layout="constrained")
    ax.axis("off")
    for row, text in ((0.0, "$t^{n}$"), (1.0, "$t^{n+½}$"), (2.0, "$t^{n+1}$")):
        ax.text(-0.75, row, text, va="center")
        ax.plot([-0.25, 4.25], [row, row], color="#dddddd", zorder=0)
    for i in range(5):
        ax.plot([i], [1.0], "o", color="#D55E00", label="node velocity v" if i == 0 else None)
        for row in (0.0, 2.0):
            label = "node displacement u" if i == row == 0 else None
            ax.plot([i], [row], "o", mfc="white", color="#D55E00", label=label)
    for i in range(4):
        for row in (0.0, 2.0):
            label = "zone: ε, σ, q, e, state" if i == row == 0 else None
            ax.plot([i + 0.5], [row], "s", color="#0072B2", markersize=8, label=label)
    arrow = {"arrowstyle": "->", "color": GREY, "shrinkA": 6, "shrinkB": 6}
    ax.annotate("", (2, 1), (1.5, 0), arrowprops=arrow)
    ax.annotate("", (2, 1), (2.5, 0), arrowprops=arrow)
    ax.annotate("", (2, 2), (2, 1), arrowprops=arrow)
    ax.annotate("", (2.5, 2), (2, 2), arrowprops=arrow)
    ax.text(2.08, 0.42, "kick", color=GREY)
    ax.text(2.08, 1.42, "drift", color=GREY)
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    ax.set(xlim=(-0.9, 4.3), ylim=(-0.4, 2.4))


def front_times() -> None:
    """The x–t diagram of the extended theory for the E-P-P-H pulse (Figs. 10, 11 of the source)."""
    from hydro1d.analytic import EPPH, CompactionPulse

    pulse = CompactionPulse(EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105), 1.0, 3.6e6, 1.53e-3)
    time = np.linspace(0.0, pulse.end_time, 400)
    history = pulse.history(time)
    _, ax = axes((5.6, 3.8))
    ms = 1e3 * time
    ax.plot(history.front, ms, color="#0072B2", label="proximal compaction front")
    ax.plot(history.distal_front, ms, color="#D55E00", label="distal compaction front")
    ax.plot([0.0, 1.0], [0.0, 1e3 * pulse.wave_arrival], color=GREY, label="elastic precursor")
    ax.axhline(1.53, color=GREY, linewidth=0.8, linestyle=":")
    ax.text(0.01, 1.6, "end of the pulse", color=GREY)
    regions = ["I  untouched", "II  at yield, moves at $V_Y$", "III  crushed", "IV"]
    places = [(0.8, 0.4), (0.62, 1.9), (0.25, 3.6), (0.92, 5.1)]
    for (x, at), text in zip(places, regions, strict=True):
        ax.text(x, at, text)
    ax.set(xlabel="Lagrangian coordinate X (m)", ylabel="t (ms)", xlim=(0.0, 1.0), ylim=(0.0, 6.3))
    ax.legend(frameon=True, edgecolor="none", loc="upper left", fontsize=8)


def chord() -> None:
    """Curve, Rayleigh line, and the two energies of a shock."""
    from hydro1d.analytic import EPPH, pressure_step

    curve = EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105)
    behind = pressure_step(curve, 3.6e6).states[-1]
    strain = np.linspace(0.0, behind.strain, 800)
    stress = np.array([float(curve.stress(value)) for value in strain]) / 1e6
    start, end = (0.0364, 0.8), (behind.strain, 3.6)
    _, ax = axes((5.2, 3.2))
    ax.plot(strain, stress, color="black", label="quasi-static curve")
    ax.plot(*zip(start, end, strict=True), color="#D55E00", label="Rayleigh line, slope $ρ_0 C_S^2$")
    between = strain > start[0]
    line = np.interp(strain, *zip(start, end, strict=True))
    shaded = {"color": "#D55E00", "alpha": 0.15, "label": "dissipated in the front"}
    ax.fill_between(strain[between], stress[between], line[between], **shaded)
    ax.fill_between(strain, 0.0, stress, color="#0072B2", alpha=0.12, label="area under the curve")
    ax.plot(*start, "o", color="#D55E00")
    ax.plot(*end, "o", color="#D55E00")
    ax.annotate("A", start, (4, 6), textcoords="offset points")
    ax.annotate("B", end, (-12, 2), textcoords="offset points")
    ax.set(xlabel="strain ε", ylabel="stress σ (MPa)", xlim=(0.0, 1.0), ylim=(0.0, 4.0))
    ax.legend(frameon=False, loc="upper left", fontsize=8)
