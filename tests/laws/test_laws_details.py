"""Details of the laws that only a small change of their code would touch."""

from __future__ import annotations

import math

import numpy as np
import pytest
from pydantic import ValidationError

from hydro1d.errors import DeckError
from hydro1d.laws._cotangent import cotangent
from hydro1d.laws._locking import LinearLocking
from hydro1d.laws.base import Foam, Law, PlateauFoam
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
from hydro1d.scheme.viscosity import Viscosity

FOAM = {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689}
EPPH_FOAM = EPPH(**FOAM, shock_slope=0.00105)
TRILINEAR = Trilinear(**FOAM, locking_modulus=40e6)


def test_the_cotangent_is_that_of_the_library():
    """To 4e-16 of the cosecant, over all angles that a law can ask for."""
    for angle in np.linspace(1e-6, 0.5 * math.pi, 4001)[:-1]:
        cot, csc2 = cotangent(angle)
        cosecant = 1.0 / math.sin(angle)
        assert abs(cot - math.cos(angle) / math.sin(angle)) <= 5e-16 * cosecant
        assert csc2 == pytest.approx(cosecant**2, rel=1.5e-15)


def test_what_a_bare_law_leaves_open_and_what_it_answers():
    law = Elastic(density=3.0, modulus=1e6)
    assert law.strain_to_lockup(0.3, 5.0) == 0.7 and law.initial_energy == 0.0 and law.crushed_strain == math.inf
    assert not law.is_open(-1e9) and not law.is_open(0.0)
    with pytest.raises(NotImplementedError):
        Law(density=1.0).point(0.0, 0.0, 0.0, 0.0, ())
    assert law.point(0.25, 0.25, 0.0, 0.0, ()) == (0.25e6, 1e6, 1e6, True, ())


def test_a_curve_must_be_given():
    class NoCurve(Foam):
        modulus: float = 1e6

    class NoHardening(PlateauFoam):
        modulus: float = 22e6

    class NoSlope(LinearLocking):
        modulus: float = 22e6

    with pytest.raises(NotImplementedError):
        NoCurve(density=1.0).loading(0.1)
    shape = {"density": 1.0, "plateau_stress": 1e5, "densification_strain": 0.5}
    with pytest.raises(NotImplementedError):
        NoHardening(**shape).hardening(0.1)
    with pytest.raises(NotImplementedError):
        NoSlope(**shape).locking_slope


def test_a_foam_is_open_where_it_bears_nothing():
    assert EPPH_FOAM.is_open(0.0) and EPPH_FOAM.is_open(-1.0) and not EPPH_FOAM.is_open(1e-9)
    assert not EPPH(**FOAM, shock_slope=0.00105, tension=True).is_open(-1e9)


def test_at_the_yield_strain_itself_nothing_has_yielded():
    law = TRILINEAR
    at_yield, beyond = law.yield_strain, math.nextafter(law.yield_strain, 1.0)
    assert law.never_yielded(at_yield) and not law.never_yielded(beyond)
    stiff = Trilinear(**FOAM, locking_modulus=40e6, unloading_modulus=44e6)
    assert stiff.slope_below(at_yield, 0.0) == 22e6 and stiff.slope_below(beyond, 0.0) == 44e6
    assert law.loading(at_yield)[1] == 22e6 and law.loading(beyond)[1] == 0.0
    assert EPH(density=1.0, modulus=1e6, yield_stress=1e4, hardening_modulus=1e5).loading(0.01) == (1e4, 1e6)


@pytest.mark.parametrize("modulus", [22e6, math.nextafter(22e6, 0.0)])
def test_the_softest_unloading_is_the_elastic_modulus(modulus):
    if modulus == 22e6:
        assert EPPH(**FOAM, shock_slope=0.00105, unloading_modulus=modulus).unloading_stiffness == modulus
    else:
        with pytest.raises(ValidationError, match="at least the modulus"):
            EPPH(**FOAM, shock_slope=0.00105, unloading_modulus=modulus)


def test_the_plateau_must_have_a_length():
    shortest = {**FOAM, "plateau_stress": 22e6 * 0.689}
    with pytest.raises(ValidationError, match="must be below densification_strain"):
        Trilinear(**shortest, locking_modulus=1e6)
    assert Trilinear(**{**FOAM, "plateau_stress": 22e6 * 0.688}, locking_modulus=1e6).yield_strain < 0.689


def test_room_of_a_locking_foam_by_hand():
    """εD − ε and what it takes to double the stress, or less for slow closing: √ of ρ0 hardening strain over σP a velocity."""
    law = TRILINEAR
    strain_to_double = 0.8e6 / 40e6
    slowness = math.sqrt(51.6 * strain_to_double / 0.8e6)
    assert law.hardening_strain == pytest.approx(strain_to_double, abs=2e-12)
    assert law.hardening_slowness == pytest.approx(slowness, rel=1e-9)
    for strain, closing in ((0.1, 1e-3), (0.1, 1e4), (0.68, 3.0), (0.689, 3.0), (0.75, 3.0), (0.75, 1e4)):
        expected = max(0.689 - strain, 0.0) + min(strain_to_double, closing * slowness)
        assert law.strain_to_lockup(strain, closing) == pytest.approx(min(1.0 - strain, expected), rel=1e-9)
    assert law.strain_to_lockup(0.9999, 1e9) == pytest.approx(1e-4), "never more than is left"
    assert 0.0 < law.strain_to_lockup(0.8, 0.0) <= 1e-29


def test_which_curves_lock():
    flat = Table(density=50.0, modulus=1e7, curve=((0.1, 1e5), (0.6, 1.02e5), (0.8, 1e6)))
    steep = Table(density=50.0, modulus=1e7, curve=((0.1, 1e5), (0.5, 2.5e5), (0.8, 1e6)))
    assert (flat.locks, steep.locks) == (1.0, 0.0)
    assert steep.strain_to_lockup(0.7, 1e-3) == pytest.approx(0.3) and steep.strain_to_lockup(-0.5, 1e-3) == 1.0
    assert (
        TRILINEAR.locks == 1.0 and EPH(density=1.0, modulus=1e6, yield_stress=1e4, hardening_modulus=1e5).locks == 0.0
    )


def test_the_locking_quarter_by_hand():
    """Bilinear: the stress has risen by a twentieth after a twentieth of the way to twice the yield stress, never a quarter."""
    for kink, locks in ((0.24, 0.0), (0.26, 1.0)):
        # from yield at 0.1: a line to 1.05 σY at `kink` of the way to where the stress is doubled, at 0.5
        curve = ((0.1, 1e5), (0.1 + 0.4 * kink, 1.05e5), (0.5, 2e5), (0.9, 3e5))
        assert Table(density=50.0, modulus=1e6, curve=curve).locks == locks


def test_strains_at_multiples_of_the_yield_stress():
    law = Table(density=50.0, modulus=1e6, curve=((0.1, 1e5), (0.5, 2e5), (0.9, 4e5)))
    assert law.yield_strain == pytest.approx(0.1, rel=1e-12)
    assert law.strain_at(1.5) == pytest.approx(0.3, abs=1e-11)
    assert law.strain_at(3.0) == pytest.approx(0.7, abs=1e-11)
    assert law.strain_at(100.0) == 1.0
    assert law.densification == pytest.approx(0.12, abs=1e-11)


def test_a_law_of_the_user_s_finds_its_own_yield_strain():
    class Bent(Foam):
        modulus: float = 1e6

        def loading(self, strain):
            return (1e6 * strain, 1e6) if strain < 0.25 else (0.25e6 + 1e5 * (strain - 0.25), 1e5)

    class Straight(Foam):
        modulus: float = 1e6

        def loading(self, strain):
            return 1e6 * strain, 1e6

    assert Bent(density=1.0).yield_strain == pytest.approx(0.25, rel=1e-8)
    assert Straight(density=1.0).yield_strain == 1.0
    assert math.isnan(Bent(density=1.0).crushed_strain) and TRILINEAR.crushed_strain == 0.689


def test_slopes_of_the_locked_branches():
    assert EPPR(**FOAM).locking_slope == 1000.0 * 0.8e6 and EPPR(**FOAM, stiffness=7.0).locking_slope == 7.0 * 0.8e6
    law = RPPL(density=1.0, plateau_stress=2e5, densification_strain=0.5)
    assert law.modulus == law.locking_slope == 2e8 and law.yield_strain == pytest.approx(1e-3)
    assert TRILINEAR.loading(0.789)[0] == pytest.approx(0.8e6 + 40e6 * 0.1) and TRILINEAR.loading(0.789)[1] == 40e6
    assert TRILINEAR.loading(0.689) == (0.8e6, 0.0), "the corner belongs to the plateau"


def test_the_tangent_of_eq_38_by_the_library():
    law = EPPHTangent(**FOAM, beta=1.22, gamma=0.603)
    for strain in (0.69, 0.75, 0.85, 0.95, 0.99):
        angle = (1 - 0.603 + 0.603 * (strain - 0.689) / 0.311) * math.pi / 2
        slope = 0.8e6 * 1.22 * 0.603 * 0.5 * math.pi / 0.311 / math.cos(angle) ** 2
        stress = 0.8e6 * (1 + 1.22 * (math.tan(angle) - math.tan(0.397 * math.pi / 2)))
        assert law.loading(strain)[0] == pytest.approx(stress, rel=1e-13)
        assert law.loading(strain)[1] == pytest.approx(slope, rel=1e-13)


def test_the_tangent_of_eq_39_by_hand():
    over, span = 0.1, 0.1 + 0.689 - 0.8 / 22
    extra = 51.6 * (over / 0.00105) ** 2
    assert EPPH_FOAM.loading(0.789)[0] == pytest.approx(0.8e6 + extra / span, rel=1e-13)
    assert EPPH_FOAM.loading(0.789)[1] == pytest.approx(2 * extra / over / span - extra / span**2, rel=1e-12)


def test_a_gas_by_hand():
    law = IdealGas(density=2.0, gamma=1.5, pressure=3e5)
    stress, tangent, stiffness, smooth, history = law.point(0.2, 0.2, 0.0, 1e5, ())
    assert stress == pytest.approx(0.5 * 2.0 / 0.8 * 1e5) and smooth and history == ()
    assert tangent == stiffness == pytest.approx(1.5 * stress / 0.8)
    assert law.initial_energy == pytest.approx(3e5 / (0.5 * 2.0))
    assert law.strain_to_lockup(0.2, 1.0) == pytest.approx(0.8 * 8.0 / 2.5)


def test_eph_by_hand():
    law = EPH(density=1.0, modulus=1e6, yield_stress=1e4, hardening_modulus=1e5)
    assert law.yield_strain == 0.01 and law.loading(0.005) == (5e3, 1e6)
    assert law.loading(0.31) == (pytest.approx(1e4 + 1e5 * 0.3), 1e5)


def test_rph_by_hand():
    law = RPH(density=51.6, modulus=22e6, plateau_stress=0.8e6, hardening=0.1e6)
    for strain in (0.2, 0.6, 0.95):
        assert law.loading(strain)[0] == pytest.approx(0.8e6 + 0.1e6 * strain / (1 - strain) ** 2, rel=1e-13)
        assert law.loading(strain)[1] == pytest.approx(0.1e6 * (1 + strain) / (1 - strain) ** 3, rel=1e-13)
    assert law.loading(law.yield_strain)[1] == 22e6
    assert RPH(density=1.0, modulus=1e6, plateau_stress=5e6, hardening=1e5).yield_strain == 1.0, "the line stays below"


@pytest.mark.parametrize("curve", [
    ((0.0, 0.0), (0.1, 1e5), (0.5, 2e5)), ((0.1, 1e5), (0.5, 2e5)),
    ((0.02, 0.9e5), (0.1, 1e5), (0.5, 2e5)), ((0.1, 0.9e5), (0.3, 0.9e5), (0.5, 2e5)),
])  # fmt: skip
def test_the_corners_of_a_table_lie_on_line_and_curve(curve):
    law = Table(density=50.0, modulus=1e6, curve=curve)
    assert law.corners[0].tolist() == [0.0, 0.0] and (np.diff(law.corners[:, 0]) > 0.0).all()
    assert law.corners[1, 1] == pytest.approx(1e6 * law.corners[1, 0], rel=1e-12)
    points = [point for point in curve if point[0] > law.yield_strain * (1 + 1e-9)]
    assert [tuple(corner) for corner in law.corners[2:]] == points
    for strain, stress in points:
        assert law.loading(strain)[0] == pytest.approx(stress, rel=1e-12)
    last = (curve[-1][1] - curve[-2][1]) / (curve[-1][0] - curve[-2][0])
    assert law.loading(0.95)[0] == pytest.approx(curve[-1][1] + last * (0.95 - curve[-1][0]), rel=1e-12)
    assert law.segments == len(law.corners) - 1 == len(law.slopes) == len(law.strains) == len(law.stresses)


@pytest.mark.parametrize("left", [(), ((0.02, 0.5e5),), ((0.01, 0.2e5), (0.02, 0.5e5))])
def test_a_curve_that_begins_left_of_the_line_meets_it_where_it_crosses(left):
    law = Table(density=50.0, modulus=1e6, curve=(*left, (0.05, 0.9e5), (0.11, 1e5), (0.5, 2e5)))
    slope = 0.1e5 / 0.06
    assert law.yield_strain == pytest.approx((0.9e5 - slope * 0.05) / (1e6 - slope), rel=1e-12)
    assert law.corners[2].tolist() == [0.11, 1e5]


@pytest.mark.parametrize("curve, words", [
    (((0.0, 0.0), (0.5, 1e5)), "two points at least"), (((0.5, 1e5),), "two points at least"),
    (((0.1, 1e5), (0.5, math.inf)), "not a finite number"), (((-0.1, 0.0), (0.5, 1e5)), "rising from 0 or above to below 1"),
    (((0.1, 1e5), (1.0, 2e5)), "to below 1"), (((0.1, 1e5), (0.1, 2e5)), "increase"), (((0.2, 1e5), (0.1, 2e5)), "increase"),
    (((0.1, 2e4), (0.5, 1e4)), "do not fall"), (((0.1, -1.0), (0.5, 1e4)), "from 0 or above"),
    (((0.1, 0.0), (0.5, 0.0)), "to above 0"), (((0.1, 0.0), (0.2, 0.0), (0.5, 0.0)), "to above 0"),
    (((0.1, 2e5), (0.2, 3e5)), "never falls below"),
    (((0.1, 1e5), (0.2, 2e5)), "never falls below"),
])  # fmt: skip
def test_why_a_curve_is_none(curve, words):
    with pytest.raises(ValidationError, match=words):
        Table(density=50.0, modulus=1e6, curve=curve)


class Fickle(Law):
    """Answers as it is told."""

    answer: tuple = ()

    def point(self, strain, largest, rate, energy, history):
        return self.answer


@pytest.mark.parametrize("answer, words", [
    ((1.0, 1.0, 1.0, True), "must return"), ([1.0, 1.0, 1.0, True, ()], None), ((math.nan, 1.0, 1.0, True, ()), "stress is nan"),
    ((1.0, math.inf, 1.0, True, ()), "tangent is inf"), ((1.0, 1.0, math.nan, True, ()), "stiffness is nan"),
    ((1.0, -1.0, 1.0, True, ()), "must not be negative"), ((1.0, 1.0, -1.0, True, ()), "must not be negative"),
    ((1.0, 1.0, 0.0, True, ()), "must not be negative"), ((1.0, 0.0, 1.0, True, ()), None),
    ((1.0, 1.0, 1.0, True, [1.0]), "history must be a tuple of 0"), ((1.0, 1.0, 1.0, True, (1.0,)), "tuple of 0"),
    ((1.0, 1.0, 1.0, True, ()), None), (("x", 1.0, 1.0, True, ()), "TypeError"),
])  # fmt: skip
def test_answers_that_no_law_may_give(answer, words):
    law = Fickle.model_construct(density=1.0, answer=tuple(answer))
    if words is None:
        check_law(law)
    else:
        with pytest.raises(DeckError, match=f"^law Fickle: .*{words}"):
            check_law(law)


def test_a_law_that_changes_its_mind_or_its_type():
    class Moody(Law):
        def point(self, strain, largest, rate, energy, history):
            asked.append(strain)
            return float(len(asked)), 1.0, 1.0, True, history

    class Softening(Law):
        def point(self, strain, largest, rate, energy, history):
            return strain, 1.0, 0.0 if strain > 0.0 else 1.0, True, history

    class Remembering(Law):
        history = {"count": 0.0}  # noqa: RUF012

        def point(self, strain, largest, rate, energy, history):
            return strain, 1.0, 1.0, True, (history[0] + 1.0,)

    class Listing(Law):
        def point(self, strain, largest, rate, energy, history):
            return [strain, 1.0, 1.0, True, history]

    asked: list[float] = []
    with pytest.raises(DeckError, match="answers differently when asked twice at strain 0"):
        check_law(Moody(density=1.0))
    check_law(Softening(density=1.0))
    check_law(Remembering(density=1.0))
    with pytest.raises(DeckError, match="must return"):
        check_law(Listing(density=1.0))


def test_parameters_that_floating_point_cannot_hold_together_are_named():
    foam = EPPH(density=51.6, modulus=22e6, plateau_stress=0.8e6, densification_strain=0.689, shock_slope=1e-170)
    with pytest.raises(DeckError, match=r"^law EPPH: ZeroDivisionError: .* must be finite, .* shock_slope = 1e-170$"):
        check_law(foam)


def test_a_law_is_driven_to_nine_tenths_and_pulled():
    asked = []

    class Recorder(Law):
        def point(self, strain, largest, rate, energy, history):
            asked.append((strain, largest))
            return 0.0, 1.0, 1.0, True, history

    check_law(Recorder(density=1.0))
    assert max(asked) == (0.9, 0.9) and asked[-1] == (-1e-3, 0.9) and (0.5, 0.9) in asked and (0.5, 0.5) in asked


def test_viscosity_s_coefficients():
    assert Viscosity().coefficients() == (2.0, 0.5, 2.0)
    assert Viscosity(linear=1.0, smooth_linear=3.0, quadratic=4.0).coefficients() == (1.0, 3.0, 4.0)
    assert Viscosity(kind="none", linear=1.0).coefficients() == (0.0, 0.0, 0.0)
    assert Viscosity(linear=0.0, smooth_linear=0.0, quadratic=0.0).coefficients() == (0.0, 0.0, 0.0)
    with pytest.raises(ValidationError):
        Viscosity(linear=-1.0)
