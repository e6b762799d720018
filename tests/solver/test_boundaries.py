"""Boundaries against what they stand for, on either end."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest
from columns import FOAM, Kept, layer, run, step

from hydro1d.boundaries.base import Boundary
from hydro1d.boundaries.free import Free
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.striker import Striker
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.boundaries.wall import Wall
from hydro1d.errors import DeckError
from hydro1d.laws.elastic import Elastic
from hydro1d.loads.exponential import Exponential
from hydro1d.loads.friedlander import Friedlander
from hydro1d.loads.rectangular import Rectangular
from hydro1d.loads.table import Table
from hydro1d.loads.triangular import Triangular
from hydro1d.solver.column import build_column
from hydro1d.solver.driver import solve
from hydro1d.solver.sink import Sink

BAR = Elastic(density=1000.0, modulus=1e9)  # c = 1000 m/s, Z = 1e6 Pa s/m

IMPULSES = {
    "rectangular": (Rectangular(peak=1e5, duration=3e-4), 30.0),
    "triangular": (Triangular(peak=1e5, duration=3e-4), 15.0),
    "exponential": (Exponential(peak=1e5, decay=1e-4), 1e5 * 1e-4 * (1 - np.exp(-9.0))),
    "friedlander": (Friedlander(peak=1e5, duration=3e-4, decay=1.0), 1e5 * 3e-4 * np.exp(-1.0)),
    "table": (Table(table=((0.0, 0.0), (1e-4, 1e5), (1.5e-4, 1e5), (4e-4, 0.0))), 1e5 * (0.5e-4 + 0.5e-4 + 1.25e-4)),
}


@pytest.mark.parametrize("pulse", IMPULSES)
def test_a_pulse_gives_its_impulse(pulse):
    shape, impulse = IMPULSES[pulse]
    for zones in (50, 100):
        _, kept = run([layer(BAR, 1.0, zones)], Pressure(pulse=shape), Free(), end=9e-4)
        # second order in the step, exact for pieces of constant pressure
        assert kept.column("boundary_impulse")[-1] == pytest.approx(impulse, rel=1e-3 / (zones / 50) ** 2)


def test_a_transmitting_end_takes_the_wave_out():
    # three transits: what a wall or a free end had reflected would be back
    _, kept = run([layer(BAR, 1.0, 200)], Pressure(pulse=Exponential(peak=1e5, decay=5e-5)), Transmitting(), end=3e-3)
    # the kinetic energy alone: what the viscosity turned into heat at the pulse's sharp front stays, rightly
    assert kept.column("kinetic_energy")[-1] < 1e-5 * kept.column("kinetic_energy").max()


@pytest.mark.parametrize("bonded, pulls", [(True, True), (False, False)])
def test_a_wall_holds_in_tension_only_if_bonded(bonded, pulls):
    _, kept = run([layer(BAR, 1.0, 100)], Piston(velocity=-1.0), Wall(bonded=bonded), end=1.8e-3)
    stress = kept.column("right_stress")
    assert (stress.min() < -1e6) == pulls
    assert (kept.column("right_position")[-1] < 1.0 - 1e-4) != pulls


def test_a_bar_leaves_an_unbonded_wall_and_comes_back():
    # A bar at 1 m/s hits the wall, stands for two transits, and flies off with -1 m/s, but for what the viscosity takes
    # at its sharp waves, which falls with the zone size.
    lost = []
    for zones in (100, 400):
        _, kept = run([layer(BAR, 1.0, zones, velocity=1.0)], Free(), Wall(bonded=False), end=4e-3)
        lost.append(1000.0 + kept.column("momentum")[-1])
        assert kept.column("right_stress").max() == pytest.approx(1e6, rel=0.05)
    assert 0.0 < lost[1] < 0.5 * lost[0] < 50.0


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_striker_hands_over_its_momentum_and_leaves(side):
    # A light striker on an elastic bar: momentum 2 m v comes back from a bar that is stopped by nothing.
    sign = 1.0 if side == "left" else -1.0
    ends = [Striker(mass=50.0, velocity=sign * 2.0), Free()]
    _, kept = run([layer(BAR, 1.0, 400)], *(ends if side == "left" else ends[::-1]), end=1e-2)
    speed = sign * kept.column(f"{side}_striker_velocity")[-1]
    momentum = sign * kept.column("momentum")
    assert momentum[-1] + 50.0 * speed == pytest.approx(100.0, rel=1e-9)
    assert speed < 0.2  # Z t/m = 40 at the first reflection: nearly all handed over, none pulled back
    position = sign * (kept.column(f"{side}_striker_position") - kept.column(f"{side}_position"))
    assert position.max() < 1e-7  # it never stands inside the column, but for what a step of 0.5 us closes
    decay = (kept.column("time") > 1e-5) & (kept.column("time") < 1.9e-3)  # past the sharing with half a zone
    expected = 2.0 * np.exp(-1e6 * kept.column("time")[decay] / 50.0)
    found = sign * kept.column(f"{side}_striker_velocity")[decay]
    assert np.abs(found - expected).max() < 0.02


def test_a_striker_that_flies_away_is_refused():
    with pytest.raises(DeckError, match=r"left: velocity -5 m/s does not close"):
        run([layer(FOAM, zones=20)], Striker(mass=1.0, velocity=-5.0), Wall(), end=1e-3)


def test_a_piston_follows_its_table():
    table = ((0.0, 0.0), (1e-3, 10.0), (2e-3, 10.0), (3e-3, -5.0))
    _, kept = run([layer(FOAM, 1.0, 100)], Piston(table=table), Wall(), end=3e-3)
    time, position = kept.column("time"), kept.column("left_position")
    velocity = np.interp(time, *np.transpose(table))
    assert np.allclose(kept.column("left_velocity")[1:], velocity[1:], atol=0.05)
    area = np.concatenate([[0.0], np.cumsum(np.diff(time) * 0.5 * (velocity[1:] + velocity[:-1]))])
    assert np.allclose(position, area, atol=1e-6)


def test_a_probe_sits_between_nodes():
    kept = Kept()
    _, kept = run([layer(BAR, 1.0, 101)], step(1e5), Transmitting(), end=5e-4, probes=[0.25, 0.999])
    probes = np.concatenate(kept.probes)
    assert probes.shape[1:] == (2, 4)
    assert probes[0, :, 0] == pytest.approx([0.25, 0.999])
    late = probes[-1, 0]
    assert late[1] == pytest.approx(0.1, rel=0.05) and late[3] == pytest.approx(1e5, rel=0.05)
    assert late[3] == pytest.approx(1e9 * late[2], rel=1e-9)


def test_an_open_gap_that_closes_feels_nothing():
    # The piston pulls the foam's end 10 mm away and brings it back; nothing touches before 1.015 ms.
    table = ((0.0, 0.0), (1e-5, -20.0), (5e-4, -20.0), (5.2e-4, 20.0), (3e-3, 20.0))
    for zones in (50, 100):
        _, kept = run([layer(FOAM, 0.1, zones)], Piston(table=table), Wall(), end=1.3e-3)
        time, stress = kept.column("time"), kept.column("left_stress")
        assert np.abs(stress[(time > 1e-4) & (time < 1.01e-3)]).max() < 1e3
        assert stress[-1] > 1e5


def miscounting(started, kicked):
    class Miscounting(Boundary):
        """Declares one state variable and gives what it is told."""

        state_variables: ClassVar[dict[str, str]] = {"gap": "m"}

        def start(self, velocity, mass, side):
            return velocity, started

        def kick(self, end, state):
            return end.velocity, 0.0, kicked

    return Miscounting()


@pytest.mark.parametrize("started, kicked, method", [
    ((0.0, 0.0, 0.0), (0.0,), "start"), ((), (0.0,), "start"), ((0.0,), (0.0,) * 6, "kick"),
])  # fmt: skip
def test_a_boundary_that_keeps_more_or_less_than_it_declares(started, kicked, method):
    column = build_column([layer(FOAM, 0.1, 10)], miscounting(started, kicked), Wall(), end=1e-4)
    with pytest.raises(DeckError, match=rf"left: Miscounting\.{method} returns \d state variables; .* declares 1: gap"):
        solve(column, Sink())
