"""Fig. 11: fronts and ends in time, theory and solver over one another, and beyond the time where the theory ends.

As in the paper, positions are measured from the support: the loaded end starts at 1 m.
"""

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from hydro1d import analytic
from hydro1d.store import Run
from hydro1d.studies.harrigan2010 import foam, measure
from hydro1d.studies.harrigan2010.colors import BLUE, GREY, RED
from hydro1d.studies.harrigan2010.workshop import Workshop, columns, new_figure

RIGIDITY = 20  # unloading modulus over E that stands for the rigid unloading of the theory
STEADY = (0.5e-3, 1.5e-3)  # s: within the pulse, when the front has formed


def figure_11a(work: Workshop) -> None:
    """Fig. 11a: R-P-P-L under a pulse."""
    zones, stiff = (work.size.fine_zones // 2, 10000.0) if work.size.studies else (200, 4000.0)
    runs = [
        work.run("pulse_rppl.toml", f"fig11a_rppl_{k:g}", [f"layer[0].zones={zones}", f"material.foam.stiffness={k}"])
        for k in (stiff, 0.25 * stiff)
    ]
    theory = analytic.RPPLPulse(foam.RIGID, foam.PRESSURE, foam.DURATION, foam.LENGTH)
    _draw_11a(work, theory, runs[0], stiff)
    _numbers_11a(work, theory, runs, stiff)


def _draw_11a(work: Workshop, theory: analytic.RPPLPulse, run: Run, stiffness: float) -> None:
    t = np.linspace(0.0, 8e-3, 161)
    path, front, end = theory.history(t), measure.laboratory_path(run, "front_position"), run["position"][:, 0]
    figure, ax = new_figure()
    _line(ax, t, path.front, BLUE, "front, Eqs. 2 and 7")
    _line(ax, t, path.displacement, RED, "proximal end, Eq. 7")
    _dots(ax, run.time, front, BLUE, ".", "front, solver")
    _dots(ax, run.time, end, RED, ".", "proximal end, solver")
    ax.axvline(foam.DURATION * 1e3, color=GREY, lw=0.8, ls=":", label="end of the pulse")
    _finish(ax)
    theoretical = {"t__s": t, "front__m": path.front, "proximal_end__m": path.displacement}
    data = columns(**theoretical, solver_t__s=run.time, solver_front__m=front, solver_proximal_end__m=end)
    work.picture("fig11a", figure, data, stiffness=stiffness)


def _line(ax: Any, t: np.ndarray, x: np.ndarray, color: str, label: str) -> None:
    ax.plot(t * 1e3, foam.LENGTH - x, color=color, lw=1.6, label=label)


def _dots(ax: Any, t: np.ndarray, x: np.ndarray, color: str, mark: str, label: str | None = None) -> None:
    ax.plot(np.asarray(t) * 1e3, foam.LENGTH - x, mark, color=color, ms=3.5, label=label)


def _finish(ax: Any) -> None:
    ax.set(xlabel="t (ms)", ylabel="distance from the support (m)", xlim=(0, 8), ylim=(-0.02, 1.02))
    ax.legend(frameon=False, fontsize=8)


def _numbers_11a(work: Workshop, theory: analytic.RPPLPulse, runs: list[Run], stiffness: float) -> None:
    """The solver's numbers extrapolated as stiffness^(-1/2); the second run has a quarter of the stiffness."""

    def row(quantity: str, unit: str, exact: float, pair: list[float], paper: float = math.nan, note: str = "") -> None:
        text = f"extrapolated to rigid; {pair[0]:.4g} at stiffness {stiffness:g} σP{note}"
        work.number("11a", quantity, unit, paper=paper, equations=exact, solver=2.0 * pair[0] - pair[1], note=text)

    speeds = [measure.mean_during(run, "left_velocity", *STEADY) for run in runs]
    yields = foam.PLATEAU / math.sqrt(stiffness * foam.PLATEAU * foam.DENSITY)
    note = f", of which the precursor {yields:.2f} m/s"
    row("vI, velocity in stage 1 (Eq. 25)", "m/s", theory.pulse_velocity, speeds, note=note)
    fronts = [measure.at_time(run, "front_position", measure.rest_time(run)) for run in runs]
    row("lCR2, length crushed by the front (Eq. 29)", "m", theory.critical_length, fronts)
    left = [1.0 - front / foam.LENGTH for front in fronts]
    row("share never crushed", "1", 1.0 - theory.critical_length, left, paper=0.10, note="; paper: 'nearly 10 %'")
    rest = [measure.rest_time(run) * 1e3 for run in runs]
    row("time of rest, T P/σP", "ms", theory.stop_time * 1e3, rest, paper=6.9)
    critical = foam.eq30(foam.PRESSURE) * 1e3
    work.number("11a", "TCR at P = 3.6 MPa (Eq. 30)", "ms", equations=critical, note="solver: Fig. 6")


def figure_11b(work: Workshop) -> None:
    """Fig. 11b: E-P-P-H under a pulse."""
    run = work.run("pulse_epph.toml", "fig11b_epph", [f"layer[0].zones={work.size.fine_zones}"])
    stiff = [f"layer[0].zones={work.size.fine_zones}", f"material.foam.unloading_modulus={RIGIDITY * foam.MODULUS}"]
    rigid = work.run("pulse_epph.toml", "fig11b_epph_rigid_unloading", stiff)
    theory = analytic.CompactionPulse(foam.LINEAR, foam.LENGTH, foam.PRESSURE, foam.DURATION)
    _draw_11b(work, theory, run, rigid)
    _stage_1_numbers(work, theory, run)
    _end_numbers(work, theory, run, rigid)


def _draw_11b(work: Workshop, theory: analytic.CompactionPulse, run: Run, rigid: Run) -> None:
    t = np.linspace(0.0, theory.end_time, 181)
    path, distal = theory.history(t), _distal_laboratory(theory, t)
    figure, ax = new_figure(7.0, 4.8)
    _line(ax, t, path.laboratory_front, BLUE, "proximal front, Eq. 47")
    _line(ax, t, path.displacement, RED, "proximal end")
    _line(ax, t, distal, "black", "distal front")
    ax.plot([0, theory.wave_arrival * 1e3], [1, 0], color=GREY, lw=1.0, label="elastic precursor")
    data: dict[str, Any] = {"t__s": t, "proximal_front__m": path.laboratory_front}
    data |= {"proximal_end__m": path.displacement, "distal_front__m": distal, "solver_t__s": run.time}
    for result, mark, label in ((rigid, ".", f"H = {RIGIDITY} E"), (run, "+", "H = E")):
        for name, color in (("front_position", BLUE), ("distal_front_position", "black")):
            front = np.where(_nearly_met(result), np.nan, measure.laboratory_path(result, name))
            _dots(ax, result.time, front, color, mark)
            data[f"solver {name.replace('_position', '')}, {label}__m"] = front
        end = result["position"][:, 0]
        _dots(ax, result.time, end, RED, mark, f"solver, {label}")
        data[f"solver proximal end, {label}__m"] = end
    ax.axvline(theory.end_time * 1e3, color=GREY, lw=0.8, ls=":", label="end of the theory")
    _finish(ax)
    work.picture("fig11b", figure, columns(**data))


def _nearly_met(run: Run) -> np.ndarray:
    """Profiles at which the fronts are so close that the integral of each takes in the other."""
    left = np.interp(run.time, run.history["time"], run.history["uncrushed_fraction"])
    return left < 0.01 + 24.0 / len(run["zone_coordinate"])


def _distal_laboratory(theory: analytic.CompactionPulse, t: np.ndarray) -> np.ndarray:
    """The distal front in the laboratory: between it and the wall all is at rest, shortened by its strain."""
    return foam.LENGTH - (foam.LENGTH - theory.history(t).distal_front) * (1.0 - theory.distal_jump.behind.strain)


def _stage_1_numbers(work: Workshop, theory: analytic.CompactionPulse, run: Run) -> None:
    final, shock = theory.loading.states[-1], theory.loading.jumps()[-1]
    curve, zone, k = foam.LINEAR, run["zone_coordinate"], int(np.argmin(np.abs(run.time - STEADY[1])))
    centred = 0.5 * (run["velocity"][k][1:] + run["velocity"][k][:-1])
    carried = float(np.median(centred[(zone > 0.6) & (zone < 0.9)]))
    jump = measure.mean_during(run, "left_velocity", *STEADY) - carried
    x1 = foam.DURATION * (curve.yield_velocity + (1.0 - curve.yield_strain) * shock.front_speed)
    at_end = float(np.interp(foam.DURATION, run.time, measure.laboratory_path(run, "front_position")))
    u1 = measure.at_time(run, "left_position", foam.DURATION)
    m1 = foam.DENSITY * measure.at_time(run, "front_position", foam.DURATION)
    exact_m1 = foam.DENSITY * foam.DURATION * shock.front_speed
    strain = float(np.median(run["strain"][k][zone < 0.25]))
    work.number("11b", "c0 (Eq. 40)", "m/s", equations=curve.elastic_speed)
    work.number("11b", "VY (Eq. 41)", "m/s", equations=curve.yield_velocity, solver=carried)
    work.number("11b", "[v] in stage 1", "m/s", equations=final.velocity - curve.yield_velocity, solver=jump)
    work.number("11b", "strain behind the front in stage 1", "1", equations=final.strain, solver=strain)
    note = "read off a front that is some zones wide; its mass is m1"
    _absorbed_number(work, final.strain, float(np.median(run["internal_energy"][k][zone < 0.25])))
    work.number("11b", "X1 (Eq. 42)", "m", equations=x1, solver=at_end, note=note)
    work.number("11b", "u1 (Eq. 43)", "m", equations=final.velocity * foam.DURATION, solver=u1)
    work.number("11b", "m1 (Eq. 44)", "kg", equations=exact_m1, solver=m1)


def _absorbed_number(work: Workshop, strain: float, energy: float) -> None:
    """Energy that the front of stage 1 absorbs, from the internal energy (J/kg) behind it."""
    curve = foam.LINEAR
    exact = 0.5 * (foam.PRESSURE + foam.PLATEAU) * (strain - curve.yield_strain) / 1e6
    absorbed = (curve.density * energy - 0.5 * foam.PLATEAU * curve.yield_strain) / 1e6
    path = np.linspace(curve.yield_strain, strain, 2001)
    area = float(np.trapezoid(curve.stress(path), path)) / 1e6
    note = f"the area under the curve is {area:.4g}: the front dissipates the rest"
    work.number("11b", "energy absorbed, ½(σB + σA)[ε]", "MJ/m³", equations=exact, solver=absorbed, note=note)


def _end_numbers(work: Workshop, theory: analytic.CompactionPulse, run: Run, rigid: Run) -> None:
    """Stage 2 and after; the theory unloads rigidly, so the solver's column is that of nearly rigid unloading."""
    end, share = printed_variant()
    stress = foam.PRESSURE * support_share_before(rigid, 0.9 * measure.crushed_at(rigid)) / 1e6
    behind, at = theory.distal_jump.behind.stress / 1e6, f"solver at H = {RIGIDITY} E"
    work.number("11b", "stress behind the distal front", "MPa", equations=behind, solver=stress, note=at)
    ends = {"paper": 6.1, "equations": theory.end_time * 1e3, "solver": measure.crushed_at(rigid) * 1e3}
    crushed = (
        f"all crushed, H = {RIGIDITY} E; {measure.crushed_at(run) * 1e3:.3f} ms at H = E, where the block springs back"
    )
    note = f"solver: {crushed}. "
    note += f"6.1 ms comes out ({end * 1e3:.2f} ms) if stage 2 starts at v = [v] with m1 = A0 ρ0 cS T"
    work.number("11b", "end of the theory", "ms", **ends, note=note)
    left = float(rigid.history["uncrushed_fraction"][-1])
    note = f"printed 8 % comes out ({100 * share:.1f} %) by the same slip"
    work.number("11b", "share not crushed then", "1", paper=0.08, equations=0.0, solver=left, note=note)
    arrest, note = theory.arrest_time * 1e3, "after the fronts have met"
    work.number("11b", "v falls to VY, T P/σP (Eq. 45 integrated)", "ms", equations=arrest, note=note)
    exact, left = float(theory.uncrushed_share(5e-3)), measure.at_time(rigid, "uncrushed_fraction", 5e-3)
    note = f"{at}, in which the fronts, some zones wide, have not yet crushed all of what they cover; "
    note += f"{measure.at_time(run, 'uncrushed_fraction', 5e-3):.4f} at H = E"
    work.number("11b", "share not crushed at 5.0 ms", "1", equations=exact, solver=left, note=note)
    note = f"{at}; {measure.support_share(run):.3f} at H = E: fully crushed, not enhanced"
    work.number("11b", "peak support stress over P", "1", solver=measure.support_share(rigid), note=note)


def support_share_before(run: Run, time: float) -> float:
    """Median support stress over P from the arrival of the precursor to that time (s)."""
    seen = (run.history["time"] > 1.5 / foam.RATE) & (run.history["time"] < time)
    return float(np.median(run.history["right_stress"][seen])) / foam.PRESSURE


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
