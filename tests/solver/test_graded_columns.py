"""Layers whose zones differ: a law and a size for each zone, as `build_column` takes them."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from columns import FOAM, PULSE, ROHACELL, layer, run
from scipy.integrate import quad

import hydro1d
from hydro1d.boundaries.free import Free
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.striker import Striker
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.boundaries.wall import Wall
from hydro1d.laws.elastic import Elastic
from hydro1d.laws.epph import EPPH
from hydro1d.laws.epph_tangent import EPPHTangent
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.laws.rph import RPH
from hydro1d.laws.rppl import RPPL
from hydro1d.loads.rectangular import Rectangular
from hydro1d.solver.column import build_column
from hydro1d.solver.program import Program

TANGENT = {**ROHACELL, "beta": 1.22, "gamma": 0.603}
LAWS = {
    "epph": FOAM,
    "epph-tangent": EPPHTangent(**TANGENT),
    "reversible": EPPHTangent(**TANGENT, unloading="reversible", tension=True),
    "rppl": RPPL(density=51.6, plateau_stress=0.8e6, densification_strain=0.689, stiffness=400),
    "rph": RPH(density=51.6, modulus=22e6, plateau_stress=0.8e6, hardening=0.1e6),
    "elastic": Elastic(density=51.6, modulus=22e6),
    "ideal-gas": IdealGas(density=1.2, gamma=1.4, pressure=1e5),
}
ZONES = 64  # of 1 m: their size is a power of two, so that its inverse is exact and both ways round alike
OUTPUT = {"end": 2e-3, "profile_times": np.linspace(0.0, 2e-3, 5), "history": 9, "probes": [0.1, 0.77]}


def graded(laws, sizes, velocity=0.0):
    """A layer with a law and a size for each zone; ``sizes`` may be None for equal zones on 1 m."""
    thickness = 1.0 if sizes is None else float(np.sum(sizes))
    return SimpleNamespace(
        material="graded", law=laws[0], laws=laws, thickness=thickness, zones=len(laws), velocity=velocity, sizes=sizes
    )


def assert_same(one, other, tolerance=1e-12):
    """Profiles, histories and probes agree, each to ``tolerance`` of its largest value."""
    names = [variable.name for variable in one.variables]
    pairs = [
        (a.fields[name], b.fields[name], name)
        for a, b in zip(one.frames, other.frames, strict=True)
        for name in a.fields
    ]
    rows, others = np.concatenate(one.rows), np.concatenate(other.rows)
    assert rows.shape == others.shape
    pairs += [(rows[:, k], others[:, k], name) for k, name in enumerate(names)]
    pairs.append((np.concatenate(one.probes), np.concatenate(other.probes), "probes"))
    for values, expected, name in pairs:
        scale = 1.0 if name == "energy_error" else np.nanmax(np.abs(expected), initial=0.0)
        np.testing.assert_allclose(values, expected, rtol=0.0, atol=tolerance * scale, err_msg=name)


def check_equal_zones(law, zones=ZONES, **output):
    """Zones that are all alike, given one by one, give what the uniform layer gives."""
    _, uniform = run([layer(law, zones=zones)], PULSE, Wall(), **{**OUTPUT, **output})
    for laws, sizes in (
        ([law] * zones, np.full(zones, 1.0 / zones)),
        ([law], np.full(zones, 1.0 / zones)),
        ([law] * zones, None),
    ):
        zone_by_zone = graded(laws, sizes)
        zone_by_zone.zones = zones
        _, found = run([zone_by_zone], PULSE, Wall(), **{**OUTPUT, **output})
        assert_same(found, uniform)


def check_laws_that_differ_where_it_does_not_matter(kind, parameters, zones=ZONES, **output):
    """How the zones unload that are not crushed yet makes no difference to what happens before they are."""
    output = {"end": 0.8e-3, "profile_times": [0.0, 0.8e-3], **output}
    soft, stiff = (kind(**parameters, unloading_modulus=modulus) for modulus in (22e6, 66e6))
    laws = [soft] * (3 * zones // 4) + [stiff] * (zones // 4)
    _, uniform = run([layer(soft, zones=zones)], PULSE, Wall(), **{**OUTPUT, **output})
    largest = uniform.zone_maxima["largest_strain"]
    assert largest[3 * zones // 4] < soft.yield_strain < largest[0]
    for sizes in (None, np.full(zones, 1.0 / zones)):
        _, found = run([graded(laws, sizes)], PULSE, Wall(), **{**OUTPUT, **output})
        assert_same(found, uniform)


@pytest.mark.parametrize("law", LAWS)
def test_equal_zones_given_one_by_one_are_the_uniform_layer(law):
    check_equal_zones(LAWS[law])


DIFFERING = {
    "epph": (EPPH, {**ROHACELL, "shock_slope": 0.00105}),
    "rph": (RPH, {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "hardening": 0.1e6}),
    "reversible": (EPPHTangent, {**TANGENT, "unloading": "reversible"}),
}


@pytest.mark.parametrize("law", DIFFERING)
def test_laws_that_differ_where_it_does_not_matter_give_what_one_law_gives(law):
    check_laws_that_differ_where_it_does_not_matter(*DIFFERING[law])


def unlike(zones):
    """Foam whose zones differ in every respect: two layers, of which one keeps its curve and one does not."""
    scale = np.linspace(0.7, 1.6, zones)
    foam = [EPPH(**{**ROHACELL, "density": 51.6 * k, "plateau_stress": 0.8e6 * k}, shock_slope=0.00105) for k in scale]
    springy = [EPPHTangent(**{**TANGENT, "modulus": 22e6 * k, "beta": k}, unloading="reversible") for k in scale[::-1]]
    sizes = np.geomspace(0.5, 1.0, zones)
    return [graded(foam, sizes / sizes.sum()), graded(springy, sizes[::-1] / sizes.sum(), velocity=-3.0)]


def unlike_zones(zones=12, end=1.5e-3):
    """Rows, probes and last profile of a run of `unlike`, as plain lists."""
    _, kept = run(unlike(zones), PULSE, Wall(), end=end, profile_times=[end], history=5, probes=[0.1, 1.2])
    rows = np.delete(np.concatenate(kept.rows), [variable.name for variable in kept.variables].index("energy_error"), 1)
    return [rows.tolist(), np.concatenate(kept.probes).tolist(), *(a.tolist() for a in kept.frames[-1].fields.values())]


INTERPRETED = """
import json, sys
sys.path.insert(0, sys.argv[1])
import test_graded_columns as graded
from hydro1d.jit import build
assert build.interpreted()
for name in ("epph", "reversible", "ideal-gas"):
    graded.check_equal_zones(graded.LAWS[name], zones=16)
for name in ("epph", "reversible"):
    graded.check_laws_that_differ_where_it_does_not_matter(*graded.DIFFERING[name], zones=16)
print(json.dumps(graded.unlike_zones()))
"""


def test_plain_python_gives_the_same():
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(Path(hydro1d.__file__).parents[1])}
    command = [sys.executable, "-P", "-c", INTERPRETED, str(Path(__file__).parent)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for interpreted, compiled in zip(json.loads(done.stdout), unlike_zones(), strict=True):
        scale = np.max(np.abs(np.nan_to_num(compiled)), axis=0, keepdims=True)
        assert np.array_equal(np.isnan(interpreted), np.isnan(compiled))
        assert np.nanmax(np.abs(np.subtract(interpreted, compiled)) / np.where(scale > 0.0, scale, 1.0)) < 1e-10


SIZES = {"equal": None, "finer to the right": np.geomspace(2.0, 1.0, 400) / np.geomspace(2.0, 1.0, 400).sum()}


@pytest.mark.parametrize("sizes", SIZES)
def test_a_pulse_arrives_when_the_wave_speed_says(sizes):
    """Modulus and density are linear in X: c = √(E/ρ), and a front that is sharp grows as the root of the impedance."""

    def modulus(x):
        return 1e9 * (1.0 + 8.0 * x)

    def density(x):
        return 1000.0 * (1.0 + 2.0 * x)

    def impedance(x):
        return math.sqrt(modulus(x) * density(x))

    each = np.full(400, 1.0 / 400) if SIZES[sizes] is None else SIZES[sizes]
    centres = np.cumsum(each) - 0.5 * each
    bar = graded([Elastic(density=density(x), modulus=modulus(x)) for x in centres], SIZES[sizes])
    arrival = quad(lambda x: math.sqrt(density(x) / modulus(x)), 0.0, 1.0)[0]
    pressure = 1e6
    _, kept = run([bar], Pressure(pulse=Rectangular(peak=pressure, duration=0.3 * arrival)), Free(), end=1.6 * arrival)
    front = (
        2.0 * pressure * math.sqrt(impedance(1.0) / impedance(0.0)) / impedance(1.0)
    )  # a free end doubles the velocity
    time, velocity = kept.column("time"), kept.column("right_velocity")
    passed = int(np.argmax(velocity > 0.5 * front))
    found = np.interp(0.5 * front, velocity[passed - 1 : passed + 1], time[passed - 1 : passed + 1])
    assert found == pytest.approx(arrival, rel=1e-2)
    assert velocity.max() == pytest.approx(front, rel=0.05)


ENDS = {
    "pulse-wall": (PULSE, Wall()),
    "piston-transmitting": (Piston(velocity=40.0), Transmitting()),
    "striker-wall": (Striker(mass=5.0, velocity=80.0), Wall(bonded=False)),
    "free-free": (Free(), Free()),
}


@pytest.mark.parametrize("ends", ENDS)
def test_energy_and_momentum_close_where_every_zone_differs(ends):
    left, right = ENDS[ends]
    outcome, kept = run(unlike(50), left, right, end=4e-3)
    assert outcome.status == "complete", outcome.message
    assert np.abs(kept.column("energy_error")).max() < 1e-12
    momentum, impulse = kept.column("momentum"), kept.column("boundary_impulse")
    scale = np.abs(impulse).max() + np.abs(momentum).max()
    assert np.abs(momentum - momentum[0] - impulse).max() < 1e-12 * scale


def test_profiles_show_each_zones_own_density_and_size():
    layers = unlike(20)
    _, kept = run(layers, PULSE, Wall(), end=1e-3, profile_times=[0.0, 1e-3])
    density = np.array([law.density for one in layers for law in one.laws])
    sizes = np.concatenate([one.sizes for one in layers])
    first, last = (frame.fields for frame in kept.frames)
    np.testing.assert_allclose(first["density"], density, rtol=1e-14)
    np.testing.assert_allclose(np.diff(first["position"]), sizes, rtol=1e-12)
    np.testing.assert_allclose(last["density"] * np.diff(last["position"]), density * sizes, rtol=1e-12)
    np.testing.assert_allclose(last["strain"], 1.0 - np.diff(last["position"]) / sizes, atol=1e-12)


def test_a_uniform_layer_pays_nothing_for_those_that_are_not():
    """It has neither parameters nor sizes by the zone, and its pass is made for zones that are all alike."""
    plain = Program(build_column([layer(FOAM)], PULSE, Wall(), end=1.0))
    same = Program(build_column([graded([FOAM] * 100, None)], PULSE, Wall(), end=1.0))
    for program in (plain, same):
        assert program.own["layers"].is_uniform.all()
        assert [program.own[name].size for name in ("size", "inverse_size", "inverse_zone_mass")] == [0, 0, 0]
    np.testing.assert_array_equal(same.own["parameters"], plain.own["parameters"])
