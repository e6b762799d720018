"""Two bonded elastic bars: reflection, transmission, arrival, and a pulse that must not disperse."""

import math

import numpy as np

from hydro1d.analytic import ElasticLayer, ElasticLayers, reflection, transmission
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.components.parameters import positive
from hydro1d.deck import Layer
from hydro1d.laws.elastic import Elastic
from hydro1d.loads.base import Pulse
from hydro1d.loads.constant import Constant
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table

NEAR, FAR = ElasticLayer(1000.0, 4e9, 0.5), ElasticLayer(4000.0, 4e9, 0.5)  # 2000 and 1000 m/s; impedances 2 and 4
PEAK = 1e6
PLATEAU = "plateaus between the fronts: exact but for the front's own oscillation, which the limited q damps"
SMOOTH = "second order: the pulse is some six hundred zones long"


class RaisedCosine(Pulse):
    """peak (1 − cos(2π t/duration))²/4: three continuous derivatives at both ends."""

    peak: float = positive("Pa", "largest pressure")
    duration: float = positive("s", "duration")

    def pressure(self, time: float) -> float:
        """Pressure at a time (s), Pa: zero after the duration."""
        swing = 0.5 * (1.0 - math.cos(2.0 * math.pi * min(time / self.duration, 1.0)))
        return self.peak * swing * swing


def _run(
    zones: int, pulse: Pulse, end: float, profiles: tuple[float, ...] = (), history: int = 0, probes: tuple = ()
) -> Recording:
    def layer(bar: ElasticLayer, share: int) -> Layer:
        law = Elastic(density=bar.density, modulus=bar.modulus)
        return Layer(law=law, thickness=bar.thickness, zones=share)

    # Twice the zones where waves run at half the speed: the same number a transit time.
    layers = [layer(NEAR, zones // 3), layer(FAR, 2 * (zones // 3))]
    return simulate(layers, Pressure(pulse=pulse), Wall(), end=end, profiles=profiles, history=history, probes=probes)


def _step(table: Table, zones: tuple[int, ...]) -> None:
    """A pressure step: what the interface and the wall make of it."""
    transit = NEAR.transit_time
    met, late = 1.7 * transit, transit + 1.5 * FAR.transit_time  # after the interface; after the wall
    exact = ElasticLayers(NEAR, FAR, lambda t: PEAK * np.ones_like(t))
    finest = [_run(n, Constant(peak=PEAK), late, (met, late)) for n in zones][-1]
    n = zones[-1] // 3
    first, second = finest.frames[0].fields, finest.frames[1].fields
    middle = slice(n - n // 3, n - n // 10), slice(n + n // 10, n + n // 3)
    back, on = reflection(NEAR, FAR), transmission(NEAR, FAR)
    for name, part, stress in (("reflected", middle[0], 1.0 + back), ("transmitted", middle[1], on)):
        table.compare(f"{name}: σ/peak", stress, float(np.median(first["stress"][part])) / PEAK, 1e-3, PLATEAU)
        velocity = on * PEAK / FAR.impedance
        table.compare(f"{name}: v, m/s", velocity, float(np.median(first["velocity"][part])), 1e-3, PLATEAU)
    table.compare("at the wall: σ/peak", 2.0 * on, float(np.median(second["stress"][-n // 3 :])) / PEAK, 1e-3, PLATEAU)
    x = finest.column.zone_coordinate
    theory, found = exact(x, met).stress / PEAK, first["stress"] / PEAK
    table.beside("stress after the interface", "X, m", "σ/peak", (x, theory), (x, found), f"{zones[-1]} zones")


def _pulse(table: Table, zones: tuple[int, ...]) -> None:
    """A smooth pulse: through the interface, to the wall and back."""
    duration = 1.6 * NEAR.transit_time
    pulse = RaisedCosine(peak=PEAK, duration=duration)
    near, far = NEAR.transit_time, FAR.transit_time
    times = (1.5 * near, near + 1.9 * far, near + 6.0 * far)

    def pressure(t: np.ndarray) -> np.ndarray:
        swing = 0.5 * (1.0 - np.cos(2.0 * np.pi * np.minimum(t / duration, 1.0)))
        return PEAK * swing * swing

    exact = ElasticLayers(NEAR, FAR, pressure)
    probe = 0.75
    runs = [_run(n, pulse, times[-1], times, history=1, probes=(probe,)) for n in zones]
    names = ("through the interface", "back from the wall", "after three reflections")
    errors = np.empty((3, len(zones)))
    for j, run in enumerate(runs):
        x = run.column.zone_coordinate
        for k, frame in enumerate(run.frames):
            errors[k, j] = np.mean(np.abs(frame.fields["stress"] - exact(x, frame.time).stress)) / PEAK
    for k, name in enumerate(names):
        table.converges(f"pulse {name}: mean |Δσ|/peak", zones, errors[k], 1e-3, SMOOTH, least_order=1.9)
    finest = runs[-1]
    t, stress = finest["time"], finest.probes[:, 0, 3]
    arrival = NEAR.transit_time + (probe - NEAR.thickness) / FAR.wave_speed + 0.5 * duration
    first = t < arrival + 0.5 * duration
    there = transmission(NEAR, FAR)
    table.compare("peak at X = 0.75 m, σ/peak", there, float(stress[first].max()) / PEAK, 1e-3, SMOOTH)
    table.compare("its arrival, s", arrival, _centre(t[first], stress[first]), 1e-3, SMOOTH)
    _dispersion(table, finest, exact, times)
    table.bound("energy balance", finest.energy_error, 1e-12, "compatible differencing")
    _bound_of_step(table, finest)
    x = finest.column.zone_coordinate
    frame = finest.frames[-1]
    theory, found = exact(x, frame.time).stress / PEAK, frame.fields["stress"] / PEAK
    table.beside("pulse after three reflections", "X, m", "σ/peak", (x, theory), (x, found), f"{zones[-1]} zones")
    table.convergence(zones, dict(zip(names, errors, strict=True)), "mean |Δσ|/peak")


def _centre(t: np.ndarray, stress: np.ndarray) -> float:
    """Centre of mass of a pulse in time (the pulse is symmetric)."""
    return float(np.trapezoid(t * stress, t) / np.trapezoid(stress, t))


def _dispersion(table: Table, run: Recording, exact: ElasticLayers, times: tuple[float, ...]) -> None:
    """Width of the pulse in space, root of its second moment, over the exact one, early and late."""
    x = run.column.zone_coordinate
    late = x > NEAR.thickness

    def width(stress: np.ndarray) -> float:
        weight = np.maximum(stress[late], 0.0)
        centre = np.average(x[late], weights=weight)
        return float(np.sqrt(np.average((x[late] - centre) ** 2, weights=weight)))

    theory, found = width(exact(x, times[1]).stress), width(run.frames[1].fields["stress"])
    table.compare("width after the wall, m", theory, found, 1e-3, SMOOTH)


def _bound_of_step(table: Table, run: Recording) -> None:
    """The longest step against the bound of the linear scheme, Δx/(√(c² + D²) + D), D = c₁ c, worked out here anew."""
    linear = run.column.viscosity.coefficients()[1]
    bounds = [
        block.size / (bar.wave_speed * (math.sqrt(1.0 + linear**2) + linear))
        for block, bar in zip(run.column.layers, (NEAR, FAR), strict=True)
    ]
    share, reason = float(run["time_step"].max()) / min(bounds), "cfl times the bound; above 1 the scheme is unstable"
    table.compare("longest step over its bound", run.column.cfl, share, 0.1, reason)


def _study(table: Table, effort: Effort) -> None:
    """Two bonded bars of impedance 1 : 2 on a wall. A pressure step gives the plateaus of reflection and transmission;
    a smooth pulse, some six hundred zones long, must keep peak, place and width through an interface and the wall
    (d'Alembert).
    """
    zones = tuple(3 * n for n in effort.zones(200))
    _step(table, zones)
    _pulse(table, zones)


CASES = [Case.of("elastic-bar", "Elastic bars", 13, _study)]
