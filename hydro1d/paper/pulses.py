"""Fig. 11: fronts and ends in time, theory and solver over one another, and beyond the time where "
"the theory ends."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from hydro1d import analytic
from hydro1d.paper import foam
from hydro1d.paper.workshop import BLUE, GREY, RED, Workshop, columns, new_figure
from hydro1d.store import Run

RIGIDITY = 20  # unloading modulus over E that stands for the rigid unloading of the theory


def _lab(run: Run, lagrangian: str) -> tuple[np.ndarray, np.ndarray]:
    """Times of the profiles and where a front then is in the laboratory (m); NaN where there is none."""
    history = run.history
    seen = np.isfinite(history[lagrangian])
    times = np.asarray(run.time)
    if seen.sum() < 2:
        return times, np.full(times.shape, np.nan)
    at = np.interp(times, history["time"][seen], history[lagrangian][seen], left=np.nan, right=np.nan)
    node = run["node_coordinate"]
    return times, np.array([np.interp(x, node, run["position"][k]) if x == x else np.nan for k, x in enumerate(at)])


def figure_11a(work: Workshop) -> None:
    """R-P-P-L."""
    zones, stiffness = (work.size.fine_zones // 2, 10000) if work.size.studies else (100, 4000)
    run = work.run(
        "pulse_rppl.toml", "fig11a_rppl", [f"layer[0].zones={zones}", f"material.foam.stiffness={stiffness}"]
    )
    theory = analytic.RPPLPulse(foam.RIGID, foam.PRESSURE, foam.DURATION, foam.LENGTH)
    t = np.linspace(0.0, 8e-3, 161)
    path = theory.history(t)
    times, front = _lab(run, "front_position")
    figure, ax = new_figure()
    ax.plot(path.front, t * 1e3, color=BLUE, lw=1.6, label="front, Eqs. 2 and 7")
    ax.plot(path.displacement, t * 1e3, color=RED, lw=1.6, label="proximal end")
    ax.plot(front, times * 1e3, ".", color=BLUE, ms=4, label="front, solver")
    ax.plot(run["position"][:, 0], times * 1e3, ".", color=RED, ms=4, label="proximal end, solver")
    ax.axhline(foam.DURATION * 1e3, color=GREY, lw=0.8, ls=":")
    ax.set(xlabel="x (m)", ylabel="t (ms)", xlim=(-0.02, 1.02), ylim=(0, 8))
    ax.legend(frameon=False)
    data = columns(
        t__s=t,
        front__m=path.front,
        proximal_end__m=path.displacement,
        solver_t__s=times,
        solver_front__m=front,
        solver_proximal_end__m=run["position"][:, 0],
    )
    caption = (
        f"R-P-P-L, P = 3.6 MPa, T = 1.53 ms. The solver's stiffness is {stiffness} σP: its far end is "
        "crushed a little from the wall."
    )
    work.picture("fig11a", "Fig. 11a: R-P-P-L", caption, figure, data)
    history = run.history
    during = (history["time"] > 0.5e-3) & (history["time"] < 1.5e-3)
    work.number(
        "11a",
        "vI, velocity in stage 1 (Eq. 25)",
        "m/s",
        equations=theory.pulse_velocity,
        solver=float(np.mean(history["left_velocity"][during])),
    )
    work.number("11a", "lCR2 (Eq. 29)", "m", equations=theory.critical_length)
    crushed = 1.0 - float(history["uncrushed_fraction"][-1])
    work.number(
        "11a",
        "share never crushed",
        "1",
        paper=0.10,
        equations=1.0 - theory.critical_length,
        solver=1.0 - crushed,
        note="the paper says 'nearly 10 %'; the solver at finite stiffness crushes a little from the wall as well",
    )
    stop = _time_of_rest(run)
    work.number("11a", "time of rest, T P/σP", "ms", paper=6.9, equations=theory.stop_time * 1e3, solver=stop * 1e3)
    work.number(
        "11a", "TCR at P = 3.6 MPa (Eq. 30)", "ms", equations=foam.eq30(foam.PRESSURE) * 1e3, note="solver: Fig. 6"
    )


def _time_of_rest(run: Run) -> float:
    """When the momentum of the column first comes to zero after the pulse, s."""
    time, momentum = run.history["time"], run.history["momentum"]
    after = np.flatnonzero((time > 2e-3) & (momentum <= 1e-3 * momentum.max()))
    return float(time[after[0]]) if len(after) else float("nan")


def figure_11b(work: Workshop) -> None:
    """E-P-P-H."""
    run = work.run("pulse_epph.toml", "fig11b_epph", [f"layer[0].zones={work.size.fine_zones}"])
    rigid = work.run(
        "pulse_epph.toml",
        "fig11b_epph_rigid_unloading",
        [f"layer[0].zones={work.size.fine_zones // 2}", f"material.foam.unloading_modulus={RIGIDITY * foam.MODULUS}"],
    )
    theory = analytic.CompactionPulse(foam.LINEAR, foam.LENGTH, foam.PRESSURE, foam.DURATION)
    t = np.linspace(0.0, theory.end_time, 181)
    path = theory.history(t)
    figure, ax = new_figure()
    ax.plot(path.laboratory_front, t * 1e3, color=BLUE, lw=1.6, label="proximal front, Eq. 47")
    ax.plot(path.displacement, t * 1e3, color=RED, lw=1.6, label="proximal end")
    distal_time, distal = t[np.isfinite(path.distal_front)], _distal_lab(theory, t)
    ax.plot(distal, distal_time * 1e3, color="black", lw=1.6, label="distal front")
    ax.plot([0, 1], [0, theory.wave_arrival * 1e3], color=GREY, lw=1.0, label="elastic precursor")
    for result, mark, label in ((rigid, ".", f"solver, H = {RIGIDITY} E"), (run, "+", "solver, H = E")):
        for name, color in (("front_position", BLUE), ("distal_front_position", "black")):
            times, front = _lab(result, name)
            left = np.interp(times, result.history["time"], result.history["uncrushed_fraction"])
            near = left < 0.01 + 24.0 / len(
                result["zone_coordinate"]
            )  # closer, each front's integral takes in the other
            ax.plot(np.where(near, np.nan, front), times * 1e3, mark, color=color, ms=3.5)
        ax.plot(result["position"][:, 0], result.time * 1e3, mark, color=RED, ms=3.5, label=label)
    ax.axhline(theory.end_time * 1e3, color=GREY, lw=0.8, ls=":")
    ax.set(xlabel="x (m)", ylabel="t (ms)", xlim=(-0.02, 1.02), ylim=(0, 8))
    ax.legend(frameon=False)
    times, front = _lab(rigid, "front_position")
    data = columns(
        t__s=t,
        proximal_front__m=path.laboratory_front,
        proximal_end__m=path.displacement,
        distal_t__s=distal_time,
        distal_front__m=distal,
        solver_t__s=times,
        solver_front__m=front,
        solver_proximal_end__m=rigid["position"][:, 0],
        solver_distal_front__m=_lab(rigid, "distal_front_position")[1],
        solver_HE_front__m=_lab(run, "front_position")[1],
        solver_HE_proximal_end__m=run["position"][:, 0],
    )
    caption = (
        "E-P-P-H by Eq. 39, P = 3.6 MPa, T = 1.53 ms. The theory unloads rigidly and ends (dotted) where "
        "its fronts meet; the solver goes on. With H = E the crushed block springs back when the pulse is "
        "over."
    )
    work.picture("fig11b", "Fig. 11b: E-P-P-H", caption, figure, data)
    _numbers_11b(work, run, rigid, theory)


def _distal_lab(theory: analytic.CompactionPulse, t: np.ndarray) -> np.ndarray:
    """The distal front in the laboratory: between it and the wall all is at rest, shortened by its strain."""
    front = theory.history(t).distal_front
    return foam.LENGTH - (foam.LENGTH - front[np.isfinite(front)]) * (1.0 - theory.distal_jump.behind.strain)


def _numbers_11b(work: Workshop, run: Run, rigid: Run, theory: analytic.CompactionPulse) -> None:
    final, shock = theory.loading.states[-1], theory.loading.jumps()[-1]
    history, time = run.history, run.history["time"]
    during = (time > 0.5e-3) & (time < 1.5e-3)
    jump = final.velocity - foam.LINEAR.yield_velocity
    zone = run["zone_coordinate"]
    k = int(np.argmin(np.abs(run.time - 1.5e-3)))
    behind = zone < 0.25
    work.number("11b", "c0 (Eq. 40)", "m/s", equations=foam.LINEAR.elastic_speed)
    ahead = (zone > 0.6) & (zone < 0.9)
    solver_vy = float(np.median(0.5 * (run["velocity"][k][1:] + run["velocity"][k][:-1])[ahead]))
    work.number("11b", "VY (Eq. 41)", "m/s", equations=foam.LINEAR.yield_velocity, solver=solver_vy)
    work.number(
        "11b",
        "[v] in stage 1",
        "m/s",
        equations=jump,
        solver=float(np.mean(history["left_velocity"][during])) - solver_vy,
    )
    work.number(
        "11b",
        "strain behind the front in stage 1",
        "1",
        equations=final.strain,
        solver=float(np.median(run["strain"][k][behind])),
    )
    x1 = foam.DURATION * (foam.LINEAR.yield_velocity + (1.0 - foam.LINEAR.yield_strain) * shock.front_speed)
    at_end = float(np.interp(foam.DURATION, *_lab(run, "front_position")))
    work.number("11b", "X1 (Eq. 42)", "m", equations=x1, solver=at_end)
    u1 = float(np.interp(foam.DURATION, time, history["left_position"]))
    work.number("11b", "u1 (Eq. 43)", "m", equations=final.velocity * foam.DURATION, solver=u1)
    m1 = foam.DENSITY * float(
        np.interp(
            foam.DURATION,
            time[np.isfinite(history["front_position"])],
            history["front_position"][np.isfinite(history["front_position"])],
        )
    )
    work.number("11b", "m1 (Eq. 44)", "kg", equations=foam.DENSITY * foam.DURATION * shock.front_speed, solver=m1)
    work.number("11b", "stress behind the distal front", "MPa", equations=theory.distal_jump.behind.stress / 1e6)
    printed = printed_variant()
    work.number(
        "11b",
        "end of the theory",
        "ms",
        paper=6.1,
        equations=theory.end_time * 1e3,
        solver=_crushed_at(run) * 1e3,
        note=f"solver: all crushed, H = E; {_crushed_at(rigid) * 1e3:.3f} ms at H = {RIGIDITY} E. 6.1 ms comes out "
        f"({printed[0] * 1e3:.2f} ms) if stage 2 starts at v = [v] with m1 = A0 ρ0 cS T",
    )
    work.number(
        "11b",
        "share not crushed then",
        "1",
        paper=0.08,
        equations=0.0,
        solver=float(history["uncrushed_fraction"][-1]),
        note=f"printed 8 % comes out ({100 * printed[1]:.1f} %) by the same slip",
    )
    work.number(
        "11b",
        "v falls to VY, T P/σP (Eq. 45 integrated)",
        "ms",
        equations=theory.arrest_time * 1e3,
        note="after the fronts have met",
    )
    left = float(np.interp(5e-3, time, history["uncrushed_fraction"]))
    left_rigid = float(np.interp(5e-3, rigid.history["time"], rigid.history["uncrushed_fraction"]))
    work.number(
        "11b",
        "share not crushed at 5.0 ms",
        "1",
        equations=float(theory.uncrushed_share(5e-3)),
        solver=left_rigid,
        note=f"solver at H = {RIGIDITY} E; {left:.4f} at H = E",
    )
    work.number(
        "11b",
        "peak support stress over P",
        "1",
        solver=_peak(run),
        note=f"H = E; {_peak(rigid):.3f} at H = {RIGIDITY} E: fully crushed, not enhanced",
    )


def _peak(run: Run) -> float:
    return float(run.history["peak_right_stress"][-1]) / foam.PRESSURE


def _crushed_at(run: Run) -> float:
    done = run.history["uncrushed_fraction"] <= 0.0
    return float(run.history["time"][np.argmax(done)]) if done.any() else float("nan")


def printed_variant() -> tuple[float, float]:
    """Time (s) and share left when v = VY, if stage 2 starts at v = [v] with m1 = ρ0 cS T, as printed, it seems."""
    curve = foam.LINEAR
    theory = analytic.CompactionPulse(curve, foam.LENGTH, foam.PRESSURE, foam.DURATION)
    jump = theory.loading.states[-1].velocity - curve.yield_velocity
    shock = float(analytic.compaction_hugoniot(curve, jump).shock_speed)
    mass = foam.DENSITY * shock * foam.DURATION

    def rates(t: float, state: np.ndarray) -> list[float]:
        relative, crushed = max(state[0], 0.0), state[1]
        change = foam.LOCKING - curve.yield_strain + foam.SLOPE * relative
        force = foam.PLATEAU + foam.DENSITY * relative**2 / change
        return [-force / (mass + foam.DENSITY * crushed), relative / change]

    def at_rest(t: float, state: np.ndarray) -> float:
        return float(state[0])

    at_rest.terminal = True  # type: ignore[attr-defined]
    start = [jump - curve.yield_velocity, 0.0]
    found = solve_ivp(rates, (foam.DURATION, 0.02), start, events=at_rest, rtol=1e-10, atol=1e-12)
    end = float(found.t[-1])
    distal = -theory.distal_jump.front_speed * (end - theory.wave_arrival)
    return end, foam.LENGTH - mass / foam.DENSITY - float(found.y[1][-1]) - distal
