"""Planar Noh: cold gas against a wall."""

import numpy as np

from hydro1d.analytic import Noh
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

END, PRESSURE = 0.6, 1e-9
FROM, TO = 0.05, 0.35  # where the norm is taken: wall heating and far field left out
ZONES = (100, 200, 400, 800)
PLATEAU = "median over the plateau, wall heating left out"


def _run(exact: Noh, zones: int) -> Recording:
    law = IdealGas(density=exact.density, gamma=exact.gamma, pressure=exact.pressure)
    layer = Layer(law=law, thickness=1.0, zones=zones, velocity=-exact.speed)
    return simulate(layer, Wall(), Piston(velocity=-exact.speed), end=END, history=10)


def _mean_error(exact: Noh, fields: dict[str, np.ndarray]) -> float:
    """Mean |Δρ| over FROM..TO in the laboratory."""
    x = np.linspace(FROM, TO, 6001)[:-1] + 0.5 * (TO - FROM) / 6000
    zone = np.searchsorted(fields["position"], x, side="right") - 1
    return float(np.mean(np.abs(fields["density"][zone] - exact.laboratory(x, END).density)))


def _front(exact: Noh, fields: dict[str, np.ndarray]) -> float:
    """Where the front is in the laboratory, by the mass that it has passed."""
    strain = fields["strain"]
    passed = float(strain[len(strain) // 20 :].sum()) / exact.behind.strain + len(strain) // 20
    return passed / len(strain) * exact.wall_speed / exact.front_speed


def _study(table: Table, _: Effort) -> None:
    """Gas of γ = 5/3 and next to no pressure runs against a wall at 1 m/s and is stopped by one shock; t = 0.6 s."""
    exact = Noh(pressure=PRESSURE)
    runs = [_run(exact, n) for n in ZONES]
    errors = [_mean_error(exact, run.last) for run in runs]
    width = "asked for at 400 zones: the front's own width, wall left out"
    table.bound("mean |Δρ|, x = 0.05–0.35, 400 zones, kg/m³", errors[ZONES.index(400)], 0.0075, width)
    table.converges("mean |Δρ|, finest", ZONES, errors, 0.0075, "first order: one captured front", least_order=0.9)
    _plateau(table, exact, runs[-1].last)
    table.bound("energy balance", runs[-1].energy_error, 1e-12, "compatible differencing balances to round-off")
    _figures(table, exact, runs, errors)


def _plateau(table: Table, exact: Noh, fields: dict[str, np.ndarray]) -> None:
    """The state behind the front, where the front is, and what the wall heats."""
    zones, behind = len(fields["strain"]), exact.behind
    plateau = slice(zones // 10, int(0.8 * exact.front_speed * END * zones))
    for name, key, value in (
        ("ρ behind, kg/m³", "density", behind.density),
        ("p behind, Pa", "stress", behind.stress),
        ("e behind, J/kg", "internal_energy", behind.internal_energy),
    ):
        table.compare(name, value, float(np.median(fields[key][plateau])), 1e-3, PLATEAU)
    table.bound("v behind, m/s", float(np.median(np.abs(fields["velocity"][plateau]))), 1e-3, PLATEAU)
    late = "the mass that wall heating lacks shifts it by less than a zone or two"
    table.compare("front, m", exact.wall_speed * END, _front(exact, fields), 5e-3, late)
    heating = "known error of every shock-capturing scheme, reported"
    table.report("wall heating: ρ of the first zone, kg/m³", behind.density, float(fields["density"][0]), heating)


def _figures(table: Table, exact: Noh, runs: list[Recording], errors: list[float]) -> None:
    x = np.linspace(0.0, 0.4, 2001)
    lines = [line(x, exact.laboratory(x, END).density, "exact", "exact")]
    for run, zones in ((runs[-1], ZONES[-1]), (runs[0], ZONES[0])):
        position = run.last["position"]
        centre = 0.5 * (position[1:] + position[:-1])
        near = centre < 0.4
        shown = centre[near], run.last["density"][near], f"{zones} zones"
        lines.append(line(*shown, "run" if zones > ZONES[0] else "points"))
    table.panel("density at t = 0.6 s", "x, m", "ρ, kg/m³", lines)
    table.convergence(ZONES, {"mean |Δρ|": errors}, "mean |Δρ|, kg/m³")


CASES = [Case.of("noh", "Planar Noh", 9, _study)]
