"""Classes as users wrote them for version 0.1 run, and give what they gave: a law with `point` and `history`, a foam with `room`,
a boundary with `memory`, boundary and pulse with `corners`."""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import ClassVar

import numpy as np
import pytest

import hydro1d
from hydro1d import End
from hydro1d.laws.base import Point
from hydro1d.laws.check import check_law
from hydro1d.laws.elastic import Elastic

OLD = '''
import math

from hydro1d import Boundary, Foam, Law, Pulse, derived, not_negative, positive


class Sticky(Law):
    """Elastic, softened by damage, with a viscous stress and a share of its energy as pressure."""

    modulus: float = positive("Pa")
    critical_strain: float = positive("1")
    viscosity: float = not_negative("Pa", "stress per strain rate, times a second")
    gruneisen: float = not_negative("1")
    history = {"damage": 0.0, "strain_path": 0.0}

    def point(self, strain, largest, rate, energy, history):
        damage, path = history
        damage = max(damage, min(largest / self.critical_strain, 0.5))
        stress = self.modulus * (1.0 - damage) * strain + self.viscosity * rate + self.gruneisen * self.density * energy
        return stress, self.modulus, self.modulus * self.margin, damage < 0.1, (damage, max(path, math.sqrt(abs(strain))))

    @derived
    def margin(self):
        return 1.0 + self.gruneisen

    @derived
    def crushed_strain(self):
        return 0.3 * self.critical_strain


class Roomy(Foam):
    """A cubic foam that says itself when it locks."""

    modulus: float = positive("Pa")
    stiffening: float = positive("Pa")

    def loading(self, strain):
        over = strain - 0.04
        if over <= 0.0:
            return self.modulus * strain, self.modulus
        return 0.04 * self.modulus + self.stiffening * over**3, 3.0 * self.stiffening * over**2

    def room(self, strain, closing):
        return max(0.8 - strain, 0.01 + 1e-4 * closing)


class Prop(Boundary):
    """A spring behind the end, which is twice as stiff from some time on; it remembers what it has taken."""

    stiffness: float = positive("Pa/m")
    later: float = positive("s")
    memory = {"prop_position": "m", "taken": "Pa s"}

    def kick(self, end, memory):
        position, taken = memory
        step = 0.5 * (end.step_before + end.step_after)
        stiffness = self.stiffness * (2.0 if end.time >= self.later else 1.0)
        force = -stiffness * end.displacement
        velocity = end.velocity + step * (force - end.stress) / end.mass
        return velocity, force, (end.displacement + velocity * end.step_after, taken - force * step)

    def start(self, velocity, mass, side):
        return velocity, (0.0, 0.0)

    def report(self, memory, coordinate, side):
        shown = memory.copy()
        shown[:, 0] = coordinate + side * memory[:, 0]
        return shown

    def corners(self):
        return (self.later,)


class Ramp(Pulse):
    """Rises linearly to its peak within `rise`, holds until `duration`, then 0."""

    peak: float = positive("Pa", "pressure")
    rise: float = positive("s", "time of the rise")
    duration: float = positive("s", "duration")

    def pressure(self, time):
        if time >= self.duration:
            return 0.0
        return self.peak * min(time / self.rise, 1.0)

    def corners(self):
        return (self.rise, self.duration)
'''
RESPOND = """
    state_variables = {"largest_strain": 0.0, "damage": 0.0, "strain_path": 0.0}

    def respond(self, point, old):
        largest = max(old[0], point.strain)
        rate = point.strain_increment / point.time_step if point.time_step > 0.0 else 0.0
        damage = max(old[1], min(largest / self.critical_strain, 0.5))
        stress = self.modulus * (1.0 - damage) * point.strain + self.viscosity * rate
        stress += self.gruneisen * self.density * point.energy
        state = (largest, damage, max(old[2], math.sqrt(abs(point.strain))))
        return Response(stress, stress, self.modulus, self.modulus * self.margin, 0.0, damage < 0.1, state)

"""
DECK = """
[material.sticky]
law = "old.py:Sticky"
density = 80.0
modulus = 20e6
critical_strain = 0.8
viscosity = 40.0
gruneisen = 0.3
[material.roomy]
law = "old.py:Roomy"
density = 60.0
modulus = 15e6
stiffening = 30e6
[[layer]]
material = "sticky"
thickness = 0.2
zones = 40
[[layer]]
material = "roomy"
thickness = 0.3
zones = 60
[left]
type = "pressure"
pulse = "old.py:Ramp"
peak = 2e6
rise = 0.1e-3
duration = 0.7e-3
[right]
type = "old.py:Prop"
stiffness = 1e8
later = 1.1e-3
[time]
end = 2e-3
[output]
profiles = 5
history = 1
"""
STICKY = {"density": 80.0, "modulus": 20e6, "critical_strain": 0.8, "viscosity": 40.0, "gruneisen": 0.3}
ROOMY = {"density": 60.0, "modulus": 15e6, "stiffening": 30e6}

# Regression values: what version 0.1.0 gave for the deck at its end, on these 100 zones.
HISTORY_OF_0_1 = {
    "left_position": 0.07025461044403689,
    "right_position": 0.5036695829583075,
    "right_prop_position": 0.5036695829583075,
    "right_taken": -679.4467251339278,
    "momentum": 620.5532748660713,
    "boundary_work": 66201.49767290211,
    "internal_energy": 57514.05821082384,
}
PROFILE_OF_0_1 = {  # means over the zones or nodes that have the quantity
    "strain_path": 0.3237871100738957,
    "damage": 0.13165835756766117,
    "largest_strain": 0.19720027651321548,
    "displacement": 0.05036886171792298,
}


def today(text: str) -> str:
    """The same classes as one writes them now."""
    names = {"memory": "state_variables", "corners": "breakpoints", "room": "strain_to_lockup"}
    start, end = text.index("    history = "), text.index("    @derived\n    def margin")
    text = text[:start] + RESPOND.lstrip("\n") + text[end:]
    for old, new in (
        *((f"def {old}(", f"def {new}(") for old, new in names.items()),
        ("    memory = ", "    state_variables = "),
    ):
        text = text.replace(old, new)
    return text.replace("import math\n", "import math\n\nfrom hydro1d.laws.base import Response\n", 1)


def run_of(folder, text: str) -> hydro1d.Run:
    folder.mkdir()
    (folder / "old.py").write_text(text)
    (folder / "deck.toml").write_text(DECK)
    return hydro1d.run(folder / "deck.toml")


@pytest.fixture(scope="module")
def classes() -> ModuleType:
    module = ModuleType("classes_of_0_1")
    exec(OLD, module.__dict__)
    return module


@pytest.fixture(scope="module")
def run(tmp_path_factory) -> hydro1d.Run:
    return run_of(tmp_path_factory.mktemp("old") / "old", OLD)


def test_a_law_answers_as_it_did(classes):
    law = classes.Sticky(**STICKY)
    check_law(law)
    answer = law.point(0.03, 0.05, 20.0, 100.0, (0.1, 0.05))
    assert answer == (543200.0, 20000000.0, 26000000.0, False, (0.1, 0.17320508075688773))  # regression values of 0.1.0
    response = law.respond(Point(0.03, 20.0 * 1e-6, 1e-6, 100.0, 0.0), (0.05, 0.1, 0.05))
    assert response.stress == response.lateral_stress == pytest.approx(answer[0], rel=1e-14)
    assert (response.tangent, response.stiffness, response.limit_viscosity, response.viscosity) == (*answer[1:4], 0.0)
    assert response.state == (0.05, *answer[4])
    assert classes.Sticky.state_variables == {"largest_strain": 0.0, "damage": 0.0, "strain_path": 0.0}
    assert law.crushed_strain == pytest.approx(0.24)


def test_a_subclass_may_begin_with_other_values(classes):
    class Worn(classes.Sticky):
        history: ClassVar = {"damage": 0.2, "strain_path": 0.1}

    class Plain(classes.Sticky):
        pass

    assert Worn.state_variables == {"largest_strain": 0.0, "damage": 0.2, "strain_path": 0.1}
    assert Plain.state_variables == classes.Sticky.state_variables
    assert Worn(**STICKY).at(0.1).state == pytest.approx((0.1, 0.2, 0.1**0.5))
    assert Plain(**STICKY).at(0.1).state == pytest.approx((0.1, 0.125, 0.1**0.5))
    assert Elastic.state_variables == {}


def test_a_foam_answers_as_it_did(classes):
    foam = classes.Roomy(**ROOMY)
    check_law(foam)
    assert foam.point(0.3, 0.35, 0.0, 0.0, ()) == (743730.0000000001, 8649000.0, 15000000.0, False, ())  # of 0.1.0
    assert foam.strain_to_lockup(0.5, 3.0) == foam.room(0.5, 3.0) == 0.30000000000000004
    assert foam.strain_to_lockup(0.795, 30.0) == foam.room(0.795, 30.0) == 0.013000000000000001
    assert foam.yield_strain == pytest.approx(0.04, rel=1e-8)


def test_a_boundary_and_a_pulse_answer_as_they_did(classes):
    prop, ramp = classes.Prop(stiffness=1e8, later=1.1e-3), classes.Ramp(peak=2e6, rise=1e-4, duration=7e-4)
    end = End(1.2e-3, 1e-6, 2e-6, 3.0, -1e-3, 0.2, 5e5, 3e4, 0.0, -1.0)
    assert prop.kick(end, (-1e-3, -700.0)) == (0.75, 200000.0, (-0.0009985, -700.3))  # regression values of 0.1.0
    assert prop.state_variables == {"prop_position": "m", "taken": "Pa s"}
    assert (prop.breakpoints(), ramp.breakpoints()) == ((1.1e-3,), (1e-4, 7e-4))
    assert [ramp.pressure(time) for time in (5e-5, 3e-4, 8e-4)] == [1e6, 2e6, 0.0]


def test_a_run_gives_what_it_gave(run):
    assert run.status == "complete"
    for name, value in HISTORY_OF_0_1.items():
        assert run.history[name][-1] == pytest.approx(value, rel=1e-9), name
    for name, value in PROFILE_OF_0_1.items():
        assert np.nanmean(run[name][-1]) == pytest.approx(value, rel=1e-9), name
    assert np.isnan(run["damage"][:, 40:]).all()  # the foam has none
    assert np.abs(run.history["energy_error"]).max() < 1e-12


def test_a_step_lands_on_every_corner(run):
    for corner in (1e-4, 7e-4, 1.1e-3):
        assert corner in run.history["time"]


def test_classes_written_today_give_the_same(run, tmp_path):
    now = run_of(tmp_path / "now", today(OLD))
    assert now.history.keys() == run.history.keys()
    for name in run.history:
        scale = 1.0 if name == "energy_error" else np.nanmax(np.abs(run.history[name]), initial=0.0)
        np.testing.assert_allclose(now.history[name], run.history[name], rtol=0.0, atol=1e-12 * scale, err_msg=name)
    for name in (
        "position",
        "velocity",
        "strain",
        "stress",
        "internal_energy",
        "damage",
        "strain_path",
        "largest_strain",
    ):
        scale = np.nanmax(np.abs(run[name]))
        np.testing.assert_allclose(now[name], run[name], rtol=0.0, atol=1e-12 * scale, err_msg=name)


@pytest.mark.parametrize(
    "name", ["constant", "exponential", "friedlander", "rectangular", "table", "triangular", "base"]
)
def test_pulses_are_found_where_they_were(name):
    assert importlib.import_module(f"hydro1d.boundaries.pulses.{name}") is importlib.import_module(
        f"hydro1d.loads.{name}"
    )
