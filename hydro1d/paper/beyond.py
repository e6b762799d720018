"""What the paper does not show: the support stress for growing P, its map, and where the energy goes."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydro1d.deck import Deck, load_deck
from hydro1d.paper import foam
from hydro1d.paper.masses import BETA, GAMMA
from hydro1d.paper.workshop import Workshop, columns, deck_data, deck_path, new_figure
from hydro1d.store import Run
from hydro1d.sweep import Parameter, Sweep, Table, run_sweep
from hydro1d.sweep.energy import elastic_energy

PRESSURES = (2.0, 3.0, 3.6, 4.5, 6.0, 8.0, 10.0)


def support_histories(work: Workshop) -> None:
    """Stress at the support against time, the same duration, growing P."""
    import matplotlib

    figure, ax = new_figure(8.0, 4.6)
    colors = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, len(PRESSURES)))
    data: dict[str, np.ndarray] = {}
    for value, color in zip(PRESSURES, colors, strict=True):
        run = work.run(
            "pulse_tangent.toml",
            f"new1_support_{value:g}MPa",
            [f"left.peak={value * 1e6}", f"layer[0].zones={work.size.fine_zones // 2}", "time.end=8e-3"],
        )
        time, stress = run.history["time"] * 1e3, run.history["right_stress"] / (value * 1e6)
        peak = float(run.history["peak_right_stress"][-1]) / (value * 1e6)
        ax.plot(time, stress, color=color, lw=1.2, label=f"{value:g} MPa: peak {peak:.2f} P")
        data |= {f"t_{value:g}MPa__ms": time, f"support_over_P_{value:g}MPa": stress}
        work.number("new 1", f"peak support stress over P, P = {value:g} MPa, T = 1.53 ms", "1", solver=peak)
    ax.axhline(1.0, color="black", lw=0.8, ls=":")
    ax.set(xlabel="t (ms)", ylabel="support stress over P", xlim=(0, 8), ylim=(0, None), yscale="symlog")
    ax.set_yscale("symlog", linthresh=1.0)
    ax.set_yticks([0, 0.5, 1, 2, 5, 10, 20], ["0", "0.5", "1", "2", "5", "10", "20"])
    ax.legend(frameon=False, fontsize=8)
    caption = (
        "E-P-P-H by Eq. 38, T = 1.53 ms. The plateau arrives at L/c0; only a front that gets through lifts "
        "it. Above 1 the scale is logarithmic."
    )
    work.picture(
        "new1_support_stress", "New: stress history at the support for growing P", caption, figure, columns(**data)
    )


MAPS = (
    ("R-P-P-L", "pulse_rppl.toml", ("material.foam.stiffness=1000", "output.history=100"), 6.0),
    ("E-P-P-H, Eq. 38", "pulse_tangent.toml", ("output.history=20",), 6.0),
    ("mass–spring, reversible", "mass_spring.toml", ("layer[0].zones=10", "time.cfl=0.05"), 6.0),
)


def peak_map(work: Workshop) -> None:
    """Peak support stress over P in (τd, p), by sweeps."""
    count = work.size.map_points
    tau, p = np.linspace(0.25, 2.5, count), np.linspace(1.5, 6.0, count)
    pairs = [(float(a), float(b)) for b in p for a in tau]
    figure, axes = new_figure(12.5, 4.2, ncols=3, sharey=True)
    image: Any = None
    columns_of: dict[str, Table] = {}
    for ax, (name, deck, overrides, _) in zip(axes, MAPS, strict=True):
        zones = () if "mass" in deck else (f"layer[0].zones={work.size.zones // 2}",)
        table = work.table(
            f"new2_map_{deck[:-5]}", run_sweep(_sweep(deck, (*zones, *overrides), pairs), threads=work.threads)
        )
        ratio = table["enhancement"].reshape(count, count)
        columns_of[name] = table
        image = ax.pcolormesh(
            tau, p, np.log10(np.maximum(ratio, 0.05)), vmin=-1, vmax=1, cmap="RdBu_r", shading="nearest"
        )
        if np.nanmax(ratio) > 1.0 > np.nanmin(ratio):
            ax.contour(
                tau,
                p,
                np.nan_to_num(np.log10(np.maximum(ratio, 0.05)), nan=2.0),
                levels=[0.0],
                colors="black",
                linewidths=1.2,
            )
        left = table["uncrushed_fraction"].reshape(count, count)
        ax.contour(tau, p, np.nan_to_num(left, nan=0.0), levels=[1e-9], colors="black", linewidths=1.2, linestyles="--")
        limit = [foam.eq30(x * foam.PLATEAU) * foam.RATE for x in p]
        ax.plot(limit, p, color="limegreen", lw=1.4)
        ax.set(title=name, xlabel="τd", xlim=(0.25, 2.5), ylim=(1.5, 6.0))
    axes[0].set_ylabel("p")
    bar = figure.colorbar(image, ax=axes, ticks=[-1, -0.5, 0, 0.5, 1])
    bar.ax.set_yticklabels(["≤ 0.1", "0.32", "1", "3.2", "≥ 10"])
    bar.set_label("peak support stress over P")
    caption = (
        "Black line: support stress = P; dashed: fully crushed; green: Eq. 30. White: a spring came within "
        "1e-6 of its pole and the run ended."
    )
    first = next(iter(columns_of.values()))
    data = columns(
        pressure__Pa=first["pressure"],
        duration__s=first["duration"],
        **{name: table["enhancement"] for name, table in columns_of.items()},
    )
    work.picture("new2_peak_map", "New: peak support stress over P", caption, figure, data)


def _sweep(deck: str, overrides: tuple[str, ...], pairs: list[tuple[float, float]]) -> Sweep:
    durations = tuple(tau / foam.RATE for tau, _ in pairs)
    pressures = tuple(p * foam.PLATEAU for _, p in pairs)
    ends = tuple(1.25 * (t * q / foam.PLATEAU + 1.0 / foam.RATE) for t, q in zip(durations, pressures, strict=True))
    parameters = [
        Parameter(key="left.duration", column="duration", values=durations),
        Parameter(key="left.peak", column="pressure", values=pressures),
        Parameter(key="time.end", column="end", values=ends),
    ]
    return Sweep.of(deck_data(deck), parameters, ["enhancement", "uncrushed_fraction"], overrides, plan="zip")


def energy_shares(work: Workshop) -> None:
    """Where the energy goes in both schools, against time."""
    zones = min(work.size.fine_zones // 2, 300)
    same = (f"material.foam.beta={BETA}", f"material.foam.gamma={GAMMA}")
    schools = (
        ("shocks resolved", "pulse_tangent.toml", [f"layer[0].zones={zones}", *same]),
        (
            "ten masses, plastic springs",
            "mass_spring_li_meng.toml",
            ['material.foam.unloading="elastic"', "output.profiles=101", "time.cfl=0.1"],
        ),
        ("ten masses, reversible springs", "mass_spring_li_meng.toml", ["output.profiles=101"]),
    )
    figure, axes = new_figure(12.5, 4.2, ncols=3, sharey=True)
    data: dict[str, np.ndarray] = {}
    for k, (ax, (title, deck, overrides)) in enumerate(zip(axes, schools, strict=True)):
        run = work.run(deck, f"new3_energy_{k}", overrides)
        time, shares = _shares(run, load_deck(deck_path(deck), overrides))
        labels, colors = (
            ("kinetic", "elastic", "crushing", "dissipation in fronts"),
            ("#9ecae1", "#fdd0a2", "#74a57f", "#c0392b"),
        )
        ax.stackplot(time * 1e3, shares, labels=labels, colors=colors)
        ax.set(title=title, xlabel="t (ms)", xlim=(0, time[-1] * 1e3), ylim=(0, 1.0))
        data |= {
            f"t_{k}__s": time,
            **{f"{label.replace(' ', '_')}_{k}": share for label, share in zip(labels, shares, strict=True)},
        }
        for label, share in zip(labels, shares, strict=True):
            work.number(
                "new 3",
                f"{label}, {title}",
                "1",
                solver=float(share[-1]),
                note=f"share of the work done, at {time[-1] * 1e3:.3g} ms",
            )
    axes[0].set_ylabel("share of the energy put in")
    axes[0].legend(frameon=True, fontsize=8, loc="lower right")
    caption = (
        f"P = 3.6 MPa, T = 1.53 ms, β = {BETA}, γ = {GAMMA}. Crushing is the area under the quasi-static "
        "curve less what unloading gives back; the excess that a front absorbs, ½(σB + σA)[ε] less that "
        "area, is its dissipation. The springs have none."
    )
    work.picture("new3_energy", "New: where the energy goes", caption, figure, columns(**data))


def _shares(run: Run, deck: Deck) -> tuple[np.ndarray, np.ndarray]:
    """Kinetic, elastic, crushing, front dissipation over the largest work so far at each profile, (4, "
    "times)."""
    history, times = run.history, np.asarray(run.time)[1:]

    def at(name: str) -> np.ndarray:
        return np.interp(times, history["time"], history[name])

    total = np.maximum.accumulate(at("boundary_work"))
    elastic = np.array([elastic_energy(run, deck, k + 1) for k in range(len(times))])
    kinetic, viscous = at("kinetic_energy"), at("viscous_work")
    crushing = at("internal_energy") - viscous - elastic
    return times, np.array([kinetic, elastic, crushing, viscous]) / total


__all__ = ["Table", "energy_shares", "peak_map", "support_histories"]
