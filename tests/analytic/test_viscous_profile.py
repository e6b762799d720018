"""The smeared front: Rayleigh line, q as prescribed, end states, integral measure, scaling with the zone."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hydro1d.analytic import EPPH, RPH, TangentEPPH, Trilinear, ViscousProfile

CURVES = [
    EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105),
    TangentEPPH(51.6, 22e6, 0.8e6, 0.689, 1.22, 0.603),
    Trilinear(51.6, 22e6, 0.8e6, 0.689, 60 * 0.8e6),
    RPH(51.6, 100e6, 0.8e6, 0.3e6),
]
profiles = st.builds(
    ViscousProfile,
    st.sampled_from(CURVES),
    st.floats(40.0, 250.0),
    st.floats(1e-4, 1e-2),
    st.floats(0.5, 3.0),
    st.floats(0.5, 4.0),
)


@settings(max_examples=15)
@given(profiles, st.floats(0.05, 0.95))
def test_front_follows_the_rayleigh_line_with_the_prescribed_q(profile, share):
    curve = profile.curve
    ahead, behind = profile._ends[:2]
    strain = ahead + share * (behind - ahead)
    x, t = float(profile.distance(strain)) + profile.front_speed * 1e-3, 1e-3
    fields = profile(x, t)
    assert float(fields.strain) == pytest.approx(strain, rel=1e-5)
    step = 1e-3 * profile.thickness
    around = profile(np.array([x - step, x + step]), t)
    dv = (around.velocity[0] - around.velocity[1]) / (2 * step) * profile.zone_width
    wave = np.sqrt(curve.tangent(fields.strain) / curve.density)
    q = dv * (profile.quadratic * fields.density * dv + profile.linear * curve.density * wave)
    corner = min(abs(strain - c) for c in curve.corners) / profile.thickness
    if corner * profile.thickness > 0.02:
        assert float(q) == pytest.approx(float(profile.viscosity(strain)), rel=2e-2)
    total = float(fields.stress) + float(profile.viscosity(fields.strain))
    line = curve.yield_stress + curve.density * profile.front_speed * (float(fields.velocity) - curve.yield_velocity)
    assert total == pytest.approx(line, rel=1e-8)
    mean = 0.5 * (curve.yield_stress + total) * (float(fields.strain) - ahead)
    stored = curve.density * float(fields.internal_energy) - 0.5 * curve.yield_stress * curve.yield_strain
    assert stored == pytest.approx(mean, rel=1e-8)


@settings(max_examples=15)
@given(profiles)
def test_ends_are_the_jump(profile):
    far = 200.0 * profile.thickness
    fields = profile(np.array([-far, far]), 0.0)
    ahead, behind = profile._ends[:2]
    np.testing.assert_allclose(fields.strain, [behind, ahead], rtol=1e-6)
    jump = fields.velocity[0] - fields.velocity[1]
    assert jump == pytest.approx(profile.velocity_jump, rel=1e-6)
    rise = profile.curve.density * profile.velocity_jump**2 / (behind - ahead)
    assert fields.stress[0] == pytest.approx(profile.curve.yield_stress + rise, rel=1e-4)


@settings(max_examples=10)
@given(profiles)
def test_shape_scales_with_the_zone(profile):
    twice = ViscousProfile(
        profile.curve, profile.velocity_jump, 2 * profile.zone_width, profile.linear, profile.quadratic
    )
    assert twice.thickness == pytest.approx(2 * profile.thickness, rel=1e-9)
    x = np.linspace(-1.0, 1.0, 7) * profile.thickness
    np.testing.assert_allclose(twice(2 * x, 0.0).strain, profile(x, 0.0).strain, rtol=1e-6)


def test_more_viscosity_is_wider():
    """Where the curve rises; on the plateau the linear term has no wave speed to work with."""
    widths = []
    for linear, quadratic in ((0.0, 1.0), (1.0, 1.0), (3.0, 1.0), (3.0, 4.0)):
        profile = ViscousProfile(CURVES[0], 150.0, 1e-3, linear, quadratic)
        ahead, behind = profile._ends[:2]
        low, high = profile.distance(ahead + np.array([0.05, 0.99]) * (behind - ahead))
        widths.append(float(low - high))
    assert np.all(np.diff(widths) > 0.1e-3)


def test_needs_a_quadratic_term():
    with pytest.raises(ValueError, match=r"quadratic = .*must be"):
        ViscousProfile(CURVES[0], 150.0, 1e-3, 1.0, 0.0)
