"""What the paper does not show: the support stress for growing P, its map, and where the energy goes."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from hydro1d.analysis.energy import elastic_energy
from hydro1d.deck import Deck, load_deck
from hydro1d.store import Run
from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.boundary import Curve, evaluate_at
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, deck_data, deck_path, new_figure
from hydro1d.sweep import Table

PRESSURES = (2.0, 3.0, 3.6, 4.5, 6.0, 8.0, 10.0)


def support_histories(work: Workshop) -> None:
    """Stress at the support against time, the same duration, growing P."""
    import matplotlib

    figure, ax = new_figure(8.0, 4.6)
    colors = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, len(PRESSURES)))
    data: dict[str, np.ndarray] = {}
    for value, color in zip(PRESSURES, colors, strict=True):
        load, texts = value * 1e6, [f"layer[0].zones={work.size.fine_zones // 2}", "time.end=8e-3"]
        run = work.run("pulse_tangent.toml", f"new1_support_{value:g}MPa", [f"left.peak={load}", *texts])
        time, stress = run.history["time"] * 1e3, run.history["right_stress"] / load
        peak = float(run.history["peak_right_stress"][-1]) / load
        ax.plot(time, stress, color=color, lw=1.2, label=f"{value:g} MPa: peak {peak:.2f} P")
        data |= {f"t_{value:g}MPa__ms": time, f"support_over_P_{value:g}MPa": stress}
        _stress_numbers(work, run, value, peak)
    ax.axhline(1.0, color="black", lw=0.8, ls=":")
    ax.set(xlabel="t (ms)", ylabel="support stress over P", xlim=(0, 8), ylim=(0, None), yscale="symlog")
    ax.set_yscale("symlog", linthresh=1.0)
    ax.set_yticks([0, 0.5, 1, 2, 5, 10, 20], ["0", "0.5", "1", "2", "5", "10", "20"])
    ax.legend(frameon=False, fontsize=8)
    work.picture("new1_support_stress", figure, columns(**data))


def _stress_numbers(work: Workshop, run: Run, value: float, peak: float) -> None:
    """The support's peak, and the largest stress anywhere before the column is fully crushed."""
    done = run.history["uncrushed_fraction"] <= 0.0
    last = int(np.argmax(done)) - 1 if done.any() else -1
    inside = float(run.history["peak_stress"][last]) / (value * 1e6)
    at = f"P = {value:g} MPa, T = 1.53 ms"
    crushed = "fully crushed" if done.any() else "never fully crushed"
    work.number("new 1", f"peak support stress over P, {at}", "1", solver=peak, note=crushed)
    label, note = f"largest stress anywhere over P until fully crushed, {at}", "shock theory: P itself"
    work.number("new 1", label, "1", equations=1.0, solver=inside, note=note)


MAPS = (
    ("R-P-P-L", "pulse_rppl.toml", ("material.foam.stiffness=1000", "output.history=100")),
    ("E-P-P-H, Eq. 38", "pulse_tangent.toml", ("output.history=20",)),
    ("ten masses, reversible", "mass_spring.toml", ("layer[0].zones=10", "output.history=20", "time.cfl=0.02")),
)
TOP = 10.0  # peak over P at which the colours end and a run may


def peak_map(work: Workshop) -> None:
    """Peak support stress over P in (τd, p)."""
    count = work.size.map_points
    tau, p = np.linspace(0.25, 2.5, count), np.linspace(1.5, 6.0, count)
    loads = [(float(b) * foam.PLATEAU, float(a) / foam.RATE) for b in p for a in tau]
    figure, axes = new_figure(12.5, 4.2, ncols=3, sharey=True)
    tables = {}
    for ax, (name, deck, overrides) in zip(axes, MAPS, strict=True):
        zones = () if "mass" in deck else (f"layer[0].zones={work.size.zones // 2}",)
        tables[name] = work.table(
            f"new2_map_{deck[:-5]}", _peaks(work, Curve(name, deck_data(deck), (*zones, *overrides)), loads)
        )
        image = _draw_map(ax, tau, p, tables[name])
        ax.set(title=name, xlabel="τd", xlim=(0.25, 2.5), ylim=(1.5, 6.0))
        _counts(work, name, tables[name])
    axes[0].set_ylabel("p")
    bar = figure.colorbar(image, ax=axes, ticks=[-1, -0.5, 0, 0.5, 1])
    bar.ax.set_yticklabels(["≤ 0.1", "0.32", "1", "3.2", "≥ 10"])
    bar.set_label("peak support stress over P")
    named = {name: table["enhancement"] for name, table in tables.items()}
    data = columns(pressure__Pa=[p for p, _ in loads], duration__s=[t for _, t in loads], **named)
    work.picture("new2_peak_map", figure, data, most=TOP)


def _peaks(work: Workshop, curve: Curve, loads: Sequence[tuple[float, float]]) -> Table:
    """Peak over P and whether all is crushed, at every load (Pa, s)."""
    outcomes = (f"enhancement > {TOP:g}", "fully_crushed")
    runs = [work.pool.submit(evaluate_at, curve, p, t, ("enhancement",), outcomes) for p, t in loads]
    rows = [run.result() for run in runs]
    return columns(
        enhancement=[row["enhancement"] for row in rows], fully_crushed=[row["fully_crushed"] for row in rows]
    )


def _counts(work: Workshop, name: str, table: Table) -> None:
    enhanced, crushed = table["enhancement"] > 1.0, table["fully_crushed"] > 0.5
    for label, which in (
        ("fully crushed and not enhanced", crushed & ~enhanced),
        ("enhanced and not fully crushed", enhanced & ~crushed),
    ):
        note = f"of {len(table)}; {int(np.sum(enhanced))} enhanced, {int(np.sum(crushed))} fully crushed"
        work.number("new 2", f"loads {label}, {name}", "1", solver=float(np.sum(which)), note=note)


def _draw_map(ax: Any, tau: np.ndarray, p: np.ndarray, table: Table) -> Any:
    shape = (len(p), len(tau))
    ratio, crushed = table["enhancement"].reshape(shape), table["fully_crushed"].reshape(shape)
    colors = np.log10(np.maximum(ratio, 0.05))
    image = ax.pcolormesh(tau, p, colors, vmin=-1, vmax=1, cmap="RdBu_r", shading="nearest")
    for answer, style in ((ratio > 1.0, "-"), (crushed > 0.5, "--")):
        if answer.any() and not answer.all():
            ax.contour(tau, p, answer.astype(float), levels=[0.5], colors="black", linewidths=1.2, linestyles=style)
    duration, pressure = foam.eq30_line(p[0] * foam.PLATEAU, p[-1] * foam.PLATEAU)
    ax.plot(duration * foam.RATE, pressure / foam.PLATEAU, color="limegreen", lw=1.4)
    return image


SHARES = {"kinetic": "#9ecae1", "elastic": "#fdd0a2", "crushing": "#74a57f", "dissipation in fronts": "#c0392b"}
TEN = "mass_spring_li_meng.toml"


def energy_shares(work: Workshop) -> None:
    """Where the energy goes in both schools, against time."""
    zones, often = min(work.size.fine_zones // 2, 300), "output.profiles=101"
    plastic = ['material.foam.unloading="elastic"', often, "time.cfl=0.1"]
    schools = (
        ("shocks resolved", "pulse_tangent.toml", [f"layer[0].zones={zones}"]),
        ("ten masses, plastic springs", TEN, plastic),
        ("ten masses, reversible springs", TEN, [often]),
    )
    figure, axes = new_figure(12.5, 4.6, ncols=3, sharey=True)
    data: dict[str, np.ndarray] = {}
    for k, (ax, (title, deck, overrides)) in enumerate(zip(axes, schools, strict=True)):
        run = work.run(deck, f"new3_energy_{k}", overrides)
        time, shares = _shares(run, load_deck(deck_path(deck), overrides))
        ax.stackplot(time * 1e3, shares, labels=list(SHARES), colors=list(SHARES.values()))
        ax.set(title=title, xlabel="t (ms)", xlim=(0, time[-1] * 1e3), ylim=(0, 1.0))
        data[f"t, {title}__s"] = time
        for label, share in zip(SHARES, shares, strict=True):
            data[f"{label}, {title}"] = share
            note = f"share of the work done, at {time[-1] * 1e3:.3g} ms"
            work.number("new 3", f"{label}, {title}", "1", solver=float(share[-1]), note=note)
    axes[0].set_ylabel("share of the energy put in")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False)
    work.picture("new3_energy", figure, columns(**data))


def _shares(run: Run, deck: Deck) -> tuple[np.ndarray, np.ndarray]:
    """Kinetic, elastic, crushing, front dissipation over the largest work so far at each profile, (4, times)."""
    history, times = run.history, np.asarray(run.time)[1:]

    def at(name: str) -> np.ndarray:
        return np.interp(times, history["time"], history[name])

    total = np.maximum.accumulate(at("boundary_work"))
    elastic = np.array([elastic_energy(run, deck, k + 1) for k in range(len(times))])
    kinetic, viscous = at("kinetic_energy"), at("viscous_work")
    crushing = at("internal_energy") - viscous - elastic
    return times, np.array([kinetic, elastic, crushing, viscous]) / total
