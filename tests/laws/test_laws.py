"""The laws against their formulas, and what they share."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from hydro1d.components.plugins import available, find
from hydro1d.laws.base import RIGID
from hydro1d.laws.check import check_law
from hydro1d.laws.elastic import Elastic
from hydro1d.laws.eph import EPH
from hydro1d.laws.epph import EPPH
from hydro1d.laws.epph_tangent import EPPHTangent
from hydro1d.laws.eppr import EPPR
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.laws.rph import RPH
from hydro1d.laws.rppl import RPPL
from hydro1d.laws.table import Table
from hydro1d.laws.trilinear import Trilinear

FOAM = {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689}
FOAMS = {
    "epph": EPPH(**FOAM, shock_slope=0.00105),
    "epph-tangent": EPPHTangent(**FOAM, beta=1.22, gamma=0.603),
    "trilinear": Trilinear(**FOAM, locking_modulus=40e6),
    "eppr": EPPR(**FOAM, stiffness=500),
    "rppl": RPPL(density=51.6, plateau_stress=0.8e6, densification_strain=0.689, stiffness=500),
    "rph": RPH(density=51.6, modulus=22e6, plateau_stress=0.8e6, hardening=0.1e6),
    "eph": EPH(density=51.6, modulus=22e6, yield_stress=0.8e6, hardening_modulus=2e6),
    "table": Table(density=51.6, modulus=22e6, curve=((0.0, 0.0), (0.05, 0.8e6), (0.6, 1.0e6), (0.8, 4e6))),
}


def at(law, strain, largest=None):
    """Stress, tangent, stiffness, smooth."""
    return law.point(strain, strain if largest is None else largest, 0.0, law.initial_energy, ())[:4]


def test_every_law_of_the_design_is_there():
    expected = {"elastic", "rppl", "eppr", "epph", "epph-tangent", "eph", "trilinear", "rph", "table", "ideal-gas"}
    assert expected <= set(available("law"))


@pytest.mark.parametrize("name", FOAMS)
def test_the_tangent_is_the_slope_of_the_curve(name):
    law = FOAMS[name]
    for strain in np.linspace(0.003, 0.9, 60):
        step = 1e-6
        slope = (law.loading(strain + step)[0] - law.loading(strain - step)[0]) / (2 * step)
        corner = min(abs(strain - corner) for corner in (law.yield_strain, 0.689, 0.6, 0.8))
        if corner > 2e-6:
            assert law.loading(strain)[1] == pytest.approx(slope, rel=1e-4, abs=1.0)


@pytest.mark.parametrize("name", FOAMS)
def test_unloading_is_a_steep_line_without_tension(name):
    law = FOAMS[name]
    top = 0.75
    loaded, tangent, stiffness, smooth = at(law, top)
    assert not smooth and stiffness >= max(law.modulus, tangent)
    below = top - 1e-4 * loaded / stiffness
    assert at(law, below, top)[0] == pytest.approx(loaded - stiffness * (top - below), rel=1e-12)
    assert at(law, -0.5, top)[0] == 0.0
    in_tension = law.model_copy(update={"tension": True})
    assert type(law).model_validate({**law.model_dump(exclude_none=True), "tension": True}).point(
        top - 2 * loaded / stiffness, top, 0.0, 0.0, ()
    )[0] == pytest.approx(-loaded, rel=1e-9)
    assert in_tension.tension


@pytest.mark.parametrize("name", FOAMS)
def test_the_first_loading_is_elastic_and_reversible(name):
    law = FOAMS[name]
    half = 0.5 * law.yield_strain
    stress, _, stiffness, smooth = at(law, half)
    assert smooth and stiffness == law.modulus and stress == pytest.approx(law.modulus * half, rel=1e-12)
    assert at(law, 0.3 * law.yield_strain, half)[0] == pytest.approx(law.modulus * 0.3 * law.yield_strain, rel=1e-9)


def test_reversible_foam_retraces_its_curve():
    law = EPPHTangent(**FOAM, beta=1.22, gamma=0.603, unloading="reversible", tension=True)
    for strain in (-0.1, 0.01, 0.3, 0.8):
        assert at(law, strain, 0.9)[0] == law.loading(strain)[0]


@pytest.mark.parametrize("value, modulus", [("rigid", RIGID * 22e6), ("220 MPa", 220e6), (44e6, 44e6), (None, 22e6)])
def test_unloading_modulus(value, modulus):
    law = EPPH(**FOAM, shock_slope=0.00105, **({} if value is None else {"unloading_modulus": value}))
    assert law.unloading_stiffness == modulus
    assert at(law, 0.5)[2] == modulus


@pytest.mark.parametrize("value", [1e6, -1.0, math.nan, math.inf, "soft", "3 m"])
def test_an_unloading_modulus_that_makes_no_sense_is_refused(value):
    with pytest.raises(ValidationError):
        EPPH(**FOAM, shock_slope=0.00105, unloading_modulus=value)


@settings(derandomize=True, deadline=None)
@given(jump=st.floats(1.0, 290.0))
def test_eq_39_follows_from_the_curve_by_eq_37(jump):
    # [σ] = ρ0 [v]²/[ε] at ε = εD + s [v]
    law = FOAMS["epph"]
    strain = 0.689 + 0.00105 * jump
    rise = 51.6 * jump**2 / (strain - law.yield_strain)
    assert law.loading(strain)[0] - 0.8e6 == pytest.approx(rise, rel=1e-9)


def test_eq_38_at_its_landmarks():
    law = FOAMS["epph-tangent"]
    assert law.loading(0.689)[0] == pytest.approx(0.8e6)
    middle = 0.5 * (1 + 0.689)
    angle = (1 - 0.603 + 0.603 * 0.5) * math.pi / 2
    expected = 0.8e6 * (1 + 1.22 * (math.tan(angle) - math.tan(0.397 * math.pi / 2)))
    assert law.loading(middle)[0] == pytest.approx(expected, rel=1e-12)
    assert law.loading(1 - 1e-9)[0] > 1e12


def test_rph_yields_where_line_and_curve_meet():
    law = FOAMS["rph"]
    strain = law.yield_strain
    assert 22e6 * strain == pytest.approx(0.8e6 + 0.1e6 * strain / (1 - strain) ** 2, rel=1e-12)
    assert law.loading(0.95)[0] == pytest.approx(0.8e6 + 0.1e6 * 0.95 / 0.05**2)


def test_a_table_passes_through_its_points():
    law = FOAMS["table"]
    # the elastic line meets the first segment, extended to the left
    slope = 0.2e6 / 0.55
    assert law.yield_strain == pytest.approx((0.8e6 - slope * 0.05) / (22e6 - slope), rel=1e-12)
    for strain, stress in ((0.05, 0.8e6), (0.3, 0.8e6 + 0.2e6 * 0.25 / 0.55), (0.8, 4e6), (0.9, 5.5e6)):
        assert law.loading(strain)[0] == pytest.approx(stress, rel=1e-12)


@pytest.mark.parametrize(
    "curve",
    [((0.1, 1e6),), ((0.1, 1e6), (0.1, 2e6)), ((0.1, 1e6), (0.5, 0.9e6)), ((0.1, math.nan), (0.5, 1e6)), ((0.1, 1e6), (1.2, 2e6)),
     ((0.01, 1e6), (0.02, 2e6)), ((0.0, 0.0), (0.1, 1e6)), ((0.1, 1e6), (0.2, 8e6), (0.5, 9e6))],
)  # fmt: skip
def test_a_curve_that_is_none_is_refused(curve):
    with pytest.raises(ValidationError):
        Table(density=51.6, modulus=22e6, curve=curve)


def test_where_a_measured_curve_falls_is_named():
    curve = ((0.05, 0.8e6), (0.1, 0.82e6), (0.2, 0.81e6), (0.3, 0.83e6), (0.4, 0.8e6), (0.8, 3e6))
    with pytest.raises(
        ValidationError, match=r"behind strain 0.1 they fall from 820000 to 810000 Pa, the first of 2 falls"
    ):
        Table(density=51.6, modulus=22e6, curve=curve)
    with pytest.raises(ValidationError, match=r"not from 5 to 80"):
        Table(density=51.6, modulus=22e6, curve=((5.0, 0.8e6), (80.0, 3e6)))


def test_gas():
    law = IdealGas(density=2.0, gamma=1.4, pressure=3e5)
    assert law.initial_energy == pytest.approx(3e5 / (0.4 * 2.0))
    stress, tangent, stiffness, smooth = at(law, 0.0)
    assert stress == pytest.approx(3e5) and tangent == stiffness == pytest.approx(1.4 * 3e5) and smooth
    # isentropic: de = p dε/ρ0 reproduces p ∝ ρ^γ
    energy, strain, step = law.initial_energy, 0.0, 1e-5
    for _ in range(30000):
        middle = law.point(strain + step / 2, 0.0, 0.0, energy + step / 2 * at_energy(law, strain, energy) / 2.0, ())[0]
        energy, strain = energy + step * middle / 2.0, strain + step
    assert at_energy(law, strain, energy) == pytest.approx(3e5 * (1 / (1 - strain)) ** 1.4, rel=1e-8)


def at_energy(law, strain, energy):
    return law.point(strain, strain, 0.0, energy, ())[0]


@pytest.mark.parametrize("cls, change", [
    (EPPH, {"plateau_stress": 22e6}), (EPPH, {"density": 0}), (EPPH, {"modulus": -1}), (EPPH, {"shock_slope": math.nan}),
    (EPPH, {"densification_strain": 1.0}), (EPPH, {"densification_strain": 0.0}), (EPPH, {"colour": 1}),
    (EPPH, {"density": True}),
])  # fmt: skip
def test_parameters_outside_their_range_are_refused(cls, change):
    with pytest.raises(ValidationError):
        cls(**{**FOAM, "shock_slope": 0.00105, **change})


def test_more_refusals():
    with pytest.raises(ValidationError, match="hardening_modulus must be below"):
        EPH(density=1.0, modulus=1e6, yield_stress=1e4, hardening_modulus=1e6)
    with pytest.raises(ValidationError):
        IdealGas(density=1.0, gamma=1.0, pressure=1.0)
    with pytest.raises(ValidationError):
        RPPL(density=1.0, plateau_stress=1e6, densification_strain=0.5, stiffness=1.5)


@pytest.mark.parametrize("name", FOAMS)
def test_every_foam_passes_its_check(name):
    check_law(FOAMS[name])
    check_law(Elastic(density=1.0, modulus=1e6))


@pytest.mark.parametrize("name", FOAMS)
def test_room_shrinks_and_stays_positive(name):
    law = FOAMS[name]
    for closing in (0.0, 1e-3, 10.0, 1e3):
        rooms = [law.strain_to_lockup(strain, closing) for strain in np.linspace(0.0, 0.95, 50)]
        assert all(later <= earlier + 1e-15 for earlier, later in itertools.pairwise(rooms))
        assert min(rooms) > 0.0


def test_a_name_that_nobody_has_is_answered_with_those_there_are():
    with pytest.raises(ValueError, match=r"no law is called 'eppph'; there are .*epph-tangent"):
        find("law", "eppph")


@pytest.mark.parametrize("modulus", [25e6, 26e6, 100e6])
@pytest.mark.parametrize(
    "start", [[(0.01, 0.25e6), (0.02, 0.5e6)], [(0.01, 0.1e6), (0.02, 0.3e6), (0.03, 0.5e6)]], ids=["line", "toe"]
)
def test_a_measured_curve_may_be_straight_from_the_origin_or_have_a_toe(start, modulus):
    law = Table(density=50.0, modulus=modulus, curve=((0.0, 0.0), *start, (0.3, 0.8e6), (0.7, 2e6)))
    for strain, stress in (*start, (0.3, 0.8e6), (0.7, 2e6)):
        assert law.loading(strain)[0] == pytest.approx(stress)
    assert law.loading(0.005)[0] == pytest.approx(0.5 * start[0][1])
