"""Planar Noh: cold gas against a wall."""

from __future__ import annotations

import numpy as np

from hydro1d.analytic import Noh
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.verify.case import Case, Effort
from hydro1d.verify.cases.riemann import GAS_VISCOSITY
from hydro1d.verify.measure import Recording, order, simulate
from hydro1d.verify.rows import Line, Table, line

END, PRESSURE = 0.6, 1e-9
FROM, TO = 0.05, 0.35  # where the norm is taken: wall heating and far field left out
ROWS = 9


def _run(exact: Noh, zones: int) -> Recording:
    law = IdealGas(density=exact.density, gamma=exact.gamma, pressure=exact.pressure)
    layer = Layer(law=law, thickness=1.0, zones=zones, velocity=-exact.speed)
    return simulate(layer, Wall(), Piston(velocity=-exact.speed), end=END, history=10, viscosity=GAS_VISCOSITY)


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
    exact = Noh(pressure=PRESSURE)
    zones = (100, 200, 400, 800)
    runs = [_run(exact, n) for n in zones]
    errors = [_mean_error(exact, run.last) for run in runs]
    at_400 = zones.index(400)
    table.bound(
        "mean |Δρ|, x = 0.05–0.35, 400 zones, kg/m³",
        errors[at_400],
        0.0075,
        "asked for at 400 zones: the front's own width, wall left out",
    )
    table.bound(
        "mean |Δρ|, finest",
        errors[-1],
        0.0075,
        "first order: one captured front",
        order=order(zones, errors),
        least_order=0.9,
    )
    fields = runs[-1].last
    plateau = slice(zones[-1] // 10, int(0.8 * exact.front_speed * END * zones[-1]))
    behind = exact.behind
    reason = "median over the plateau, wall heating left out"
    table.compare("ρ behind, kg/m³", behind.density, float(np.median(fields["density"][plateau])), 1e-3, reason)
    table.compare("p behind, Pa", behind.stress, float(np.median(fields["stress"][plateau])), 1e-3, reason)
    table.compare(
        "e behind, J/kg", behind.internal_energy, float(np.median(fields["internal_energy"][plateau])), 1e-3, reason
    )
    table.bound("v behind, m/s", float(np.median(np.abs(fields["velocity"][plateau]))), 1e-3, reason)
    place = _front(exact, fields)
    table.compare(
        "front, m",
        exact.wall_speed * END,
        place,
        5e-3,
        "the mass that wall heating lacks shifts it by less than a zone or two",
    )
    table.report(
        "wall heating: ρ of the first zone, kg/m³",
        behind.density,
        float(fields["density"][0]),
        "known error of every shock-capturing scheme, reported",
    )
    energy = float(np.max(np.abs(runs[-1]["energy_error"])))
    table.bound("energy balance", energy, 1e-12, "compatible differencing balances to round-off")
    x = np.linspace(0.0, 0.4, 2001)
    lines = [line(x, exact.laboratory(x, END).density, "exact", "exact")]
    for run, n in ((runs[-1], zones[-1]), (runs[0], zones[0])):
        position = run.last["position"]
        lines.append(
            line(
                0.5 * (position[1:] + position[:-1]), run.last["density"], f"{n} zones", "run" if n > 100 else "points"
            )
        )
    table.panel("density at t = 0.6 s", "x, m", "ρ, kg/m³", [lines[0], *(_near(item) for item in lines[1:])])
    table.convergence(zones, {"mean |Δρ|": errors}, "mean |Δρ|, kg/m³")


def _near(item: Line) -> Line:
    inside = item.x < 0.4
    return line(item.x[inside], item.y[inside], item.label, item.style)


def cases() -> list[Case]:
    """One case."""
    about = (
        "Gas of γ = 5/3 and next to no pressure runs against a wall at 1 m/s and is stopped by one shock; t = 0.6 s. "
        "[viscosity] as in the Riemann problems."
    )
    return [Case("noh", "Planar Noh", about, ROWS, _study)]
