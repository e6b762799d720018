"""Riemann problems of ideal gases: Sod, two gases, and Toro's second and third tests."""

from functools import partial
from typing import NamedTuple

import numpy as np

from hydro1d.analytic import Gas, RiemannProblem
from hydro1d.boundaries.piston import Piston
from hydro1d.deck import Layer
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

ZONES = (100, 200, 400, 800)
SAMPLES = 200  # a zone, for the exact mean over it
GRADED_ZONES = 200  # of each layer of a graded tube
STAR = "medians between contact and wave: 1e-3 leaves room for the start-up at the diaphragm"
NORM = (
    "what a good staggered scheme reaches on Sod at 100 zones (4.9e-3), here for the finest of the runs in proportion"
)
ORDER = "discontinuities are captured: first order in the integral, a contact costs nothing on a Lagrangian mesh"


class Tube(NamedTuple):
    """A shock tube on [0, 1], its diaphragm in the middle.

    coarse_limit: of ∫|Δρ|dx at the coarsest. halvings: of the zones towards the diaphragm for the star states, where
    equal zones leave less than one of them between the fans.
    """

    name: str
    title: str
    left: Gas
    right: Gas
    end: float
    coarse_limit: float
    halvings: int = 0


TUBES = (
    Tube("sod", "Sod's shock tube", Gas(1.0, 0.0, 1.0), Gas(0.125, 0.0, 0.1), 0.2, 5e-3),
    Tube("two-gas", "Two gases of different γ", Gas(1.0, 0.0, 2.0, 1.4), Gas(0.5, 0.0, 0.2, 5.0 / 3.0), 0.15, 1e-2),
    Tube("toro-3", "Toro's third test", Gas(1.0, 0.0, 1000.0), Gas(1.0, 0.0, 0.01), 0.012, 2e-2),
    Tube(
        "double-rarefaction",
        "Double rarefaction (Toro's second test)",
        Gas(1.0, -2.0, 0.4),
        Gas(1.0, 2.0, 0.4),
        0.15,
        1.5e-2,
        halvings=7,
    ),
)


def _graded(tube: Tube) -> list[float]:
    """Thicknesses of layers that are halved towards the diaphragm."""
    thicknesses = [0.5 / 2**k for k in range(1, tube.halvings + 1)]
    return [*thicknesses, thicknesses[-1]]


def _run(tube: Tube, thicknesses: list[float], zones: int) -> Recording:
    """The tube in layers, from each end to the diaphragm, of so many zones each."""
    halves = [
        [
            Layer(
                material=f"{side} {k}",
                law=IdealGas(density=gas.density, gamma=gas.gamma, pressure=gas.pressure),
                thickness=thickness,
                zones=zones,
                velocity=gas.velocity,
            )
            for k, thickness in enumerate(thicknesses)
        ]
        for side, gas in (("left", tube.left), ("right", tube.right))
    ]
    ends = Piston(velocity=tube.left.velocity), Piston(velocity=tube.right.velocity)
    return simulate(halves[0] + halves[1][::-1], *ends, end=tube.end, history=10)


def density_error(exact: RiemannProblem, fields: dict[str, np.ndarray], t: float) -> float:
    """∫|Δρ|dx over the laboratory, kg/m²: zone densities are means, compared with the exact mean over the zone."""
    edges = fields["position"]
    share = (np.arange(SAMPLES) + 0.5) / SAMPLES
    widths = np.diff(edges)
    x = edges[:-1, None] + widths[:, None] * share
    error = exact.laboratory(x, t).density.mean(axis=1) - fields["density"]
    return float((np.abs(error) * widths).sum())


def _star(exact: RiemannProblem, run: Recording, t: float, side: int) -> dict[str, float]:
    """Medians over the middle three fifths between contact and the slowest part of the wave on one side (−1 or 1)."""
    tail = exact.inner_speeds[(side + 1) // 2] * t

    def between(coordinate: np.ndarray) -> np.ndarray:
        share = side * (coordinate - exact.interface) / tail
        return (share > 0.2) & (share < 0.8)

    zones, nodes = between(run.column.zone_coordinate), between(run.column.node_coordinate)
    return {
        name: float(np.median(run.last[name][nodes if name == "velocity" else zones]))
        for name in ("velocity", "stress", "density")
    }


def _study(table: Table, _: Effort, tube: Tube) -> None:
    """Two gases at a diaphragm, equal zones. Error: the integral of |Δρ| over the laboratory, ρ a mean over the zone;
    star states: medians over the middle three fifths between contact and wave. Toro's second test leaves a near-vacuum
    with 0.2 % of the mass between the fans; its star states are those of zones that are halved seven times towards the
    diaphragm.
    """
    exact = RiemannProblem(tube.left, tube.right, 0.5)
    runs = [_run(tube, [0.5], n // 2) for n in ZONES]
    errors = [density_error(exact, run.last, tube.end) for run in runs]
    _norms(table, tube, errors)
    _star_states(table, tube, exact, _run(tube, _graded(tube), GRADED_ZONES) if tube.halvings else runs[-1])
    table.bound(
        "energy balance", max(run.energy_error for run in runs), 1e-12, "compatible differencing balances to round-off"
    )
    _figures(table, tube, exact, runs, errors)


def _norms(table: Table, tube: Tube, errors: list[float]) -> None:
    table.bound(f"∫|Δρ|dx, {ZONES[0]} zones", errors[0], tube.coarse_limit, NORM)
    for k in range(1, len(ZONES)):
        pair = slice(k - 1, k + 1)
        table.converges(f"∫|Δρ|dx, {ZONES[k]} zones", ZONES[pair], errors[pair], tube.coarse_limit * 0.6**k, NORM)
    table.converges("∫|Δρ|dx, order of all", ZONES, errors, tube.coarse_limit, ORDER, least_order=0.9)


def _star_states(table: Table, tube: Tube, exact: RiemannProblem, run: Recording) -> None:
    remark = ", graded zones" if tube.halvings else ""
    scale = max(abs(exact.star_velocity), tube.left.sound_speed)
    for side, name, state in zip((-1, 1), ("left", "right"), exact.star_states, strict=True):
        found = _star(exact, run, tube.end, side)
        where = f"{name} of the contact{remark}"
        table.compare(f"p*, {where}, Pa", state.stress, found["stress"], 1e-3, STAR)
        table.compare(f"v*, {where}, m/s (over c)", state.velocity, found["velocity"], 1e-3, STAR, scale=scale)
        table.compare(f"ρ*, {where}, kg/m³", state.density, found["density"], 1e-3, STAR)


def _figures(table: Table, tube: Tube, exact: RiemannProblem, runs: list[Recording], errors: list[float]) -> None:
    x = np.linspace(0.0, 1.0, 2001)
    lines = [line(x, exact.laboratory(x, tube.end).density, "exact", "exact")]
    for run, zones in ((runs[-1], ZONES[-1]), (runs[0], ZONES[0])):
        position = run.last["position"]
        centre = 0.5 * (position[1:] + position[:-1])
        lines.append(line(centre, run.last["density"], f"{zones} zones", "run" if zones > ZONES[0] else "points"))
    table.panel(f"density at t = {tube.end:g} s", "x, m", "ρ, kg/m³", lines)
    table.convergence(ZONES, {"density": errors}, "∫|Δρ|dx, kg/m²")


CASES = [Case.of(f"riemann {tube.name}", tube.title, 12, partial(_study, tube=tube)) for tube in TUBES]
