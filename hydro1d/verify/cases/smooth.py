"""A smooth isentropic compression: the order of the scheme itself, in space and time."""

import numpy as np

from hydro1d.analytic import SimpleWave
from hydro1d.boundaries.base import Boundary, End, reaction
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.components.parameters import number, positive
from hydro1d.deck import Layer
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.loads.base import Pulse
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Table, line

GAMMA, END, RISE, SPEED = 1.4, 0.7, 0.6, 0.15
SECOND = (
    "leapfrog and the slope limiter are of second order where the flow is smooth; 1.95 leaves room for the "
    "limiter's clipping"
)


class SmoothPiston(Boundary):
    """A piston whose velocity is a polynomial step of degree 7: a smooth flow needs a smooth piston."""

    velocity: float = number("m/s", "velocity at last")
    rise_time: float = positive("s", "time over which it rises")

    def kick(self, end: End, memory: tuple[float, ...]) -> tuple[float, float, tuple[float, ...]]:
        """The velocity of the middle of the step that follows."""
        s = min(max((end.time + 0.5 * end.step_after) / self.rise_time, 0.0), 1.0)
        velocity = self.velocity * s**4 * (35.0 + s * (-84.0 + s * (70.0 - 20.0 * s)))
        return velocity, reaction(end, velocity), memory


class SmoothPressure(Pulse):
    """The pressure that the very same piston feels: p = p0 (1 + (γ − 1) v/(2 c))^(2γ/(γ − 1)) on gas at rest."""

    velocity: float = number("m/s", "velocity at last")
    rise_time: float = positive("s", "time over which it rises")
    rest: float = positive("Pa", "pressure at rest")
    sound: float = positive("m/s", "sound speed at rest")
    gamma: float = positive("1", "ratio of specific heats")

    def pressure(self, time: float) -> float:
        """Pressure on a gas at rest ahead of a simple wave."""
        s = min(max(time / self.rise_time, 0.0), 1.0)
        velocity = self.velocity * s**4 * (35.0 + s * (-84.0 + s * (70.0 - 20.0 * s)))
        relative = 1.0 + 0.5 * (self.gamma - 1.0) * velocity / self.sound
        return self.rest * relative ** (2.0 * self.gamma / (self.gamma - 1.0))


def _run(zones: int, boundary: Boundary, cfl: float | None = None) -> Recording:
    law = IdealGas(density=1.0, gamma=GAMMA, pressure=1.0)
    return simulate(Layer(law=law, thickness=1.0, zones=zones), boundary, Wall(), end=END, cfl=cfl)


def _errors(exact: SimpleWave, run: Recording) -> tuple[float, float, float]:
    """Mean errors of density, velocity and energy over the column."""
    column, fields = run.column, run.last
    at_zones, at_nodes = exact(column.zone_coordinate, END), exact(column.node_coordinate, END)
    return (
        float(np.mean(np.abs(fields["density"] - at_zones.density))),
        float(np.mean(np.abs(fields["velocity"] - at_nodes.velocity))),
        float(np.mean(np.abs(fields["internal_energy"] - at_zones.internal_energy))),
    )


def _study(table: Table, effort: Effort) -> None:
    """A gas at rest, compressed by a piston whose velocity has three continuous derivatives, and by the pressure that
    this piston feels; compared with the simple wave before a shock forms.
    """
    exact = SimpleWave(density=1.0, pressure=1.0, velocity=SPEED, rise_time=RISE, gamma=GAMMA, length=1.0)
    pulse = SmoothPressure(velocity=SPEED, rise_time=RISE, rest=1.0, sound=exact.sound_speed, gamma=GAMMA)
    driven = {"piston": SmoothPiston(velocity=SPEED, rise_time=RISE), "pressure": Pressure(pulse=pulse)}
    zones = effort.zones(100, 4)
    curves = {}
    for name, boundary in driven.items():
        runs = [_run(n, boundary) for n in zones]
        errors = np.array([_errors(exact, run) for run in runs])
        for k, quantity in enumerate(("ρ, kg/m³", "v, m/s", "e, J/kg")):
            table.converges(f"{name}: mean error of {quantity}", zones, errors[:, k], 2e-6, SECOND, least_order=1.95)
            curves[f"{name}, {quantity}"] = errors[:, k]
    _time_alone(table, driven["pressure"])
    table.bound("energy balance", runs[-1].energy_error, 1e-12, "compatible differencing")
    x = np.linspace(0.0, 1.0, 1001)
    lines = [line(x, exact(x, END).density, "exact", "exact")]
    lines.append(line(runs[0].column.zone_coordinate, runs[0].last["density"], f"{zones[0]} zones", "points"))
    table.panel(f"density at t = {END:g} s", "X, m", "ρ, kg/m³", lines)
    table.convergence(zones, curves, "mean error")


def _time_alone(table: Table, boundary: Boundary) -> None:
    """Order in time at a fixed number of zones, against a run of much smaller steps."""
    cfls = (0.8, 0.4, 0.2)
    reference = _run(100, boundary, 0.02).last["velocity"]
    errors = [float(np.mean(np.abs(_run(100, boundary, cfl).last["velocity"] - reference))) for cfl in cfls]
    steps = [1.0 / cfl for cfl in cfls]
    table.converges("steps alone: mean change of v, m/s", steps, errors, 2e-6, SECOND, least_order=1.95)


CASES = [Case.of("smooth", "Smooth compression", 8, _study)]
