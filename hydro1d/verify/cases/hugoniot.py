"""Figs. 8 and 9 of the paper by many runs: strain and shock speed against the velocity jump."""

from functools import partial

import numpy as np

from hydro1d.analytic import compaction_hugoniot, piston
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.deck import Layer
from hydro1d.verify.cases import materials
from hydro1d.verify.cases.materials import Material
from hydro1d.verify.measure import measure_front, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

JUMPS = (10.0, 25.0, 50.0, 75.0, 100.0, 150.0, 200.0, 250.0)
REASON = "a point of the figures: two of a thousand is the width of their lines"
WORST = "the weakest fronts, whose plateau keeps 4e-4 of over-compaction at every resolution: no order to ask for"


def _point(material: Material, jump: float, zones: int) -> tuple[float, float]:
    """Strain and cS that the run with a piston of VY + [v] shows."""
    velocity = material.curve.yield_velocity + jump
    front = piston(material.curve, velocity).jumps()[-1]
    end = 1.0 / 3.0 / front.front_speed
    layer = Layer(law=material.law, thickness=1.0, zones=zones)
    run = simulate(layer, Piston(velocity=velocity), Transmitting(), end=end, profiles=(end / 1.5, end))
    places = []
    for frame in run.frames:
        at = front.front_speed * frame.time
        clear = min(1.0, max(material.curve.elastic_speed * frame.time - 30.0 / zones, at + 12.0 / zones))
        found = measure_front(run.column, frame.fields, front, at, clear)
        places.append(found.coordinate)
    speed = (places[1] - places[0]) / (end / 3.0)
    return found.behind.strain, (1.0 - found.ahead.strain) * speed


def _study(table: Table, effort: Effort, material: Material) -> None:
    """Pistons of VY + [v], [v] = 10–250 m/s, against E-P-P-H: Figs. 8 and 9 of the paper, a run a point."""
    zones = effort.zones(120)
    exact = compaction_hugoniot(material.curve, JUMPS)
    found = np.array([[_point(material, jump, n) for jump in JUMPS] for n in zones])  # (level, jump, quantity)
    theory = np.stack([exact.strain, exact.shock_speed], axis=1)
    for k, jump in enumerate(JUMPS):
        for quantity, name in enumerate(("ε", "cS, m/s")):
            table.compare(f"[v] = {jump:g} m/s: {name}", theory[k, quantity], found[-1, k, quantity], 2e-3, REASON)
    worst = np.abs(found / theory - 1.0).max(axis=1)
    for quantity, name in enumerate(("ε", "cS")):
        errors = worst[:, quantity]
        table.converges(f"worst {name} of all", zones, errors, 2e-3, WORST)
    smooth = np.linspace(5.0, 260.0, 200)
    curve = compaction_hugoniot(material.curve, smooth)
    for quantity, name, values in ((0, "ε", curve.strain), (1, "cS, m/s", curve.shock_speed)):
        points = line(JUMPS, found[-1, :, quantity], f"runs, {zones[-1]} zones", "points")
        figure = "Fig. 8" if quantity == 0 else "Fig. 9"
        table.panel(figure, "[v], m/s", name, [line(smooth, values, "exact", "exact"), points])
    table.convergence(zones, {"ε": worst[:, 0], "cS": worst[:, 1]}, "worst relative error")


CASES = [
    Case.of(f"hugoniot {m.name}", f"Hugoniot, {m.name}", 2 * len(JUMPS) + 2, partial(_study, material=m))
    for m in (materials.epph(), materials.epph_tangent())
]
