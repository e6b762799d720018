"""Each curve against its own formula, slope, inverse and convexity."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hydro1d.analytic import (
    EPH,
    EPPH,
    RPH,
    Elastic,
    Table,
    TangentEPPH,
    Trilinear,
    UserCurve,
    compaction_hugoniot,
    stiff_eppr,
    stiff_rppl,
)

DENSITY, MODULUS, PLATEAU, LOCKING = 51.6, 22e6, 0.8e6, 0.689

CURVES = {
    "elastic": Elastic(DENSITY, MODULUS),
    "epph": EPPH(DENSITY, MODULUS, PLATEAU, LOCKING, 0.00105),
    "tangent": TangentEPPH(DENSITY, MODULUS, PLATEAU, LOCKING, 1.22, 0.603),
    "trilinear": Trilinear(DENSITY, MODULUS, PLATEAU, LOCKING, 30 * PLATEAU),
    "rppl": stiff_rppl(DENSITY, PLATEAU, LOCKING, 400 * PLATEAU),
    "eppr": stiff_eppr(DENSITY, MODULUS, PLATEAU, LOCKING, 1000 * PLATEAU),
    "eph": EPH(DENSITY, MODULUS, PLATEAU, 1e6),
    "rph": RPH(DENSITY, 100e6, PLATEAU, 0.3e6),
    "table": Table(DENSITY, MODULUS, (PLATEAU / MODULUS, 0.5, 0.7, 0.8), (PLATEAU, PLATEAU, 1.2e6, 3e6)),
    "user": UserCurve(DENSITY, MODULUS, PLATEAU, lambda e: PLATEAU + 2e6 * (e - PLATEAU / MODULUS) ** 3),
}


def smooth_strains(curve, count=400):
    """Strains away from corners."""
    strains = np.linspace(1e-4, 0.97, count)
    distance = np.min([abs(strains - corner) for corner in (*curve.corners, 2.0)], axis=0)
    return strains[distance > 2e-3]


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES)
def test_tangent_is_the_derivative(curve):
    strains = smooth_strains(curve)
    step = 1e-6 * (1.0 - strains)
    slope = (curve.stress(strains + step) - curve.stress(strains - step)) / (2.0 * step)
    np.testing.assert_allclose(curve.tangent(strains), slope, rtol=2e-5, atol=1.0)


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES)
def test_concave_up_between_corners(curve):
    marks = [curve.corners[0], *curve.corners[1:], 0.97] if curve.corners else [0.0, 0.97]
    for low, high in pairwise(marks):
        stress = curve.stress(np.linspace(low, high, 101))
        assert np.all(np.diff(stress, 2) >= -1e-9 * stress[-1])


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES)
@pytest.mark.parametrize("stress", [0.3e6, 1.7e6, 3.6e6])
def test_strain_at_inverts_stress(curve, stress):
    stress = min(stress, float(curve.stress(0.9)))
    assert float(curve.stress(curve.strain_at(stress))) == pytest.approx(stress, rel=1e-12)


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES)
def test_starts_elastic_and_is_continuous(curve):
    assert float(curve.stress(0.01 * min(curve.yield_strain, 1.0))) == pytest.approx(
        0.01 * min(curve.yield_strain, 1.0) * curve.modulus
    )
    for corner in curve.corners:
        assert float(curve.stress(corner - 1e-13)) == pytest.approx(float(curve.stress(corner + 1e-13)), rel=1e-8)


def test_area_is_the_quasi_static_absorption():
    curve = CURVES["trilinear"]
    strain, locked = 0.8, 0.8 - LOCKING
    exact = PLATEAU * (strain - 0.5 * curve.yield_strain) + 0.5 * 30 * PLATEAU * locked**2
    assert curve.area(strain) == pytest.approx(exact, rel=1e-12)


@given(strain=st.floats(0.69, 0.995), beta=st.floats(0.1, 5.0), gamma=st.floats(0.1, 1.0))
def test_tangent_law_is_equation_38(strain, beta, gamma):
    curve = TangentEPPH(DENSITY, MODULUS, PLATEAU, LOCKING, beta, gamma)
    angle = 1.0 - gamma + gamma * (strain - LOCKING) / (1.0 - LOCKING)
    rise = np.tan(angle * np.pi / 2) - np.tan((1.0 - gamma) * np.pi / 2)
    assert float(curve.stress(strain)) == pytest.approx(PLATEAU * (1.0 + beta * rise), rel=1e-10)


def test_equation_38_fits_equation_39_as_closely_as_measured():
    jumps = np.linspace(10.0, 250.0, 49)
    tangent, linear = (compaction_hugoniot(CURVES[name], jumps).strain for name in ("tangent", "epph"))
    difference = tangent - linear
    assert np.sqrt(np.mean(difference**2)) == pytest.approx(0.011, abs=0.0006)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: EPPH(-1.0, MODULUS, PLATEAU, LOCKING, 0.001), "density"),
        (lambda: EPPH(DENSITY, float("nan"), PLATEAU, LOCKING, 0.001), "modulus"),
        (lambda: EPPH(DENSITY, MODULUS, PLATEAU, 1.2, 0.001), "densification_strain"),
        (lambda: EPPH(DENSITY, MODULUS, PLATEAU, 0.01, 0.001), "densification_strain"),
        (lambda: EPPH(DENSITY, MODULUS, PLATEAU, LOCKING, 0.0), "shock_slope"),
        (lambda: EPPH(DENSITY, MODULUS, PLATEAU, LOCKING, 0.00105).strain_at(6e6), "stress"),
        (lambda: TangentEPPH(DENSITY, MODULUS, PLATEAU, LOCKING, 1.0, 1.5), "gamma"),
        (lambda: EPH(DENSITY, MODULUS, PLATEAU, 2 * MODULUS), "hardening_modulus"),
        (lambda: RPH(DENSITY, 1e6, PLATEAU, 0.3e6), "modulus"),
        (lambda: Table(DENSITY, MODULUS, (0.1, 0.5), (1e6, 2e6)), "stresses"),
        (lambda: Table(DENSITY, MODULUS, (0.05, 0.5), (1.1e6 * (1.0 + 1e-6), 2e6)), "stresses"),
        (lambda: Table(DENSITY, MODULUS, (0.5, 0.1), (11e6, 12e6)), "strains"),
        (lambda: UserCurve(DENSITY, MODULUS, PLATEAU, lambda e: 2 * PLATEAU + 0 * e), "plastic"),
    ],
)
def test_invalid_parameters_are_named(make, name):
    with pytest.raises(ValueError, match=rf"{name} = .*must be"):
        make()
