"""R-PH striker and piston: law, jumps, conservation, the equation of motion, limits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from hydro1d.analytic import RPH, RPPL, RPHFoam, RPHPiston, RPHStriker, RPPLStriker, piston

foams = st.builds(
    lambda density, plateau, ratio: RPHFoam(density, plateau, ratio * plateau),
    st.floats(30.0, 500.0),
    st.floats(0.1e6, 5e6),
    st.one_of(st.floats(0.01, 3.9), st.just(4.0), st.floats(4.1, 20.0)),
)
strikers = st.builds(
    lambda foam, mass, share: RPHStriker(foam, mass, share * np.sqrt(foam.plateau_stress / foam.density)),
    foams,
    st.floats(1.0, 100.0),
    st.floats(0.05, 3.0),
)
shares = st.floats(0.01, 0.99)


@given(strikers, shares)
def test_jumps_and_law(striker, share):
    (front,) = striker.jumps(share * striker.stop_time)
    assert max(front.residuals()) < 1e-10
    law = striker.material.stress(front.behind.strain) - striker.material.plateau_stress
    assert front.stress == pytest.approx(float(law), rel=1e-9)


@given(strikers, shares)
def test_motion_is_the_integral_of_its_equation(striker, share):
    """M + rho0 X moves: an integration that knows neither the momentum nor the logarithm."""
    foam, t = striker.material, share * striker.stop_time

    def rates(_, state):
        velocity, front, _ = state
        block = striker.mass + foam.density * front
        return [-float(foam.shock_stress(velocity)) / block, velocity + foam.slowest_front, velocity]

    start = [striker.impact_velocity, 0.0, 0.0]
    expected = solve_ivp(rates, (0.0, t), start, method="DOP853", rtol=1e-11, atol=1e-12).y[:, -1]
    now = striker.history(t)
    assert float(now.velocity) == pytest.approx(expected[0], rel=1e-7, abs=1e-9 * striker.impact_velocity)
    assert float(now.front) == pytest.approx(expected[1], rel=1e-8)
    assert float(now.displacement) == pytest.approx(expected[2], rel=1e-8)


@given(strikers, shares)
def test_conservation(striker, share):
    t, foam = share * striker.stop_time, striker.material
    now = striker.history(t)
    nodes, weights = np.polynomial.legendre.leggauss(80)
    x, weights = 0.5 * float(now.front) * (nodes + 1.0), 0.5 * float(now.front) * weights
    fields = striker(x, t)
    momentum = (striker.mass + foam.density * now.front) * now.velocity
    expected = striker.mass * striker.impact_velocity - foam.plateau_stress * t
    assert float(momentum) == pytest.approx(expected, rel=1e-9)
    kinetic = 0.5 * (striker.mass + foam.density * now.front) * now.velocity**2
    internal = foam.density * weights @ fields.internal_energy
    assert kinetic + internal == pytest.approx(0.5 * striker.mass * striker.impact_velocity**2, rel=1e-8)
    assert weights @ fields.strain == pytest.approx(float(now.displacement), rel=1e-8)


@given(strikers, shares)
def test_stress_decelerates_what_it_crosses(striker, share):
    """The crushed block moves as one: its stress falls evenly from the front to the striker, which it decelerates."""
    now = striker.history(share * striker.stop_time)
    stress = striker(np.array([0.0, 0.5, 1.0 - 1e-12]) * now.front, share * striker.stop_time).stress
    mean = 0.5 * (now.left_stress + now.front_stress)
    np.testing.assert_allclose(stress, [now.left_stress, mean, now.front_stress], rtol=1e-9)
    deceleration = now.front_stress / (striker.mass + striker.material.density * now.front)
    assert float(now.left_stress) == pytest.approx(striker.mass * float(deceleration), rel=1e-9)


@given(strikers)
def test_stop(striker):
    end = striker.history(striker.stop_time)
    assert float(end.velocity) == 0.0
    assert float(end.front) == pytest.approx(striker.stop_front, rel=1e-12)
    assert float(end.displacement) == pytest.approx(striker.stop_distance, rel=1e-12)
    short = RPHStriker(striker.material, striker.mass, striker.impact_velocity, 0.5 * striker.stop_front)
    assert float(short.history(short.end_time).front) == pytest.approx(short.length, rel=1e-9)
    with pytest.raises(ValueError, match=r"t = .*back"):
        short.history(1.01 * short.end_time)


@given(foams, st.floats(1.0, 300.0))
def test_piston(foam, velocity):
    steady = RPHPiston(foam, velocity, 1.0)
    (front,) = steady.jumps()
    assert max(front.residuals()) < 1e-10
    assert front.coordinate == 0.0
    t = 0.5 * steady.end_time
    np.testing.assert_allclose(steady([0.49, 0.51], t).velocity, [velocity, 0.0])
    assert float(foam.stress(front.behind.strain)) == pytest.approx(front.behind.stress, rel=1e-10)


def test_finite_modulus_tends_to_the_rigid_piston():
    rigid = RPHPiston(RPHFoam(50.0, 0.8e6, 0.2e6), 60.0).jumps()[0].behind
    distances = []
    for modulus in (1e8, 1e10, 1e12):
        behind = piston(RPH(50.0, modulus, 0.8e6, 0.2e6), 60.0).states[-1]
        distances.append(abs(behind.stress / rigid.stress - 1.0))
    np.testing.assert_allclose(np.array(distances[:-1]) / np.array(distances[1:]), 10.0, rtol=0.1)


def test_heavy_striker_is_a_piston():
    foam = RPHFoam(50.0, 0.8e6, 0.2e6)
    heavy, steady = RPHStriker(foam, 1e9, 60.0), RPHPiston(foam, 60.0)
    for mine, its in zip(heavy([0.01, 0.2], 1e-3), steady([0.01, 0.2], 1e-3), strict=True):
        np.testing.assert_allclose(mine, its, rtol=1e-6)


def test_other_law_other_answer():
    """Against R-P-P-L of the same plateau, a striker stops at the same time, by momentum."""
    foam = RPHStriker(RPHFoam(50.0, 0.8e6, 0.2e6), 10.0, 60.0)
    locking = RPPLStriker(RPPL(50.0, 0.8e6, 0.6), 10.0, 60.0)
    assert foam.stop_time == pytest.approx(locking.stop_time, rel=1e-14)
    assert foam.stop_distance != pytest.approx(float(locking.history(1.0).displacement), rel=1e-3)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: RPHFoam(50.0, 0.8e6, 0.0), "hardening"),
        (lambda: RPHStriker(RPHFoam(50.0, 0.8e6, 1e5), -1.0, 60.0), "mass"),
        (lambda: RPHPiston(RPHFoam(50.0, 0.8e6, 1e5), float("nan")), "velocity"),
    ],
)
def test_invalid_parameters_are_named(make, name):
    with pytest.raises(ValueError, match=rf"{name} = .*must be"):
        make()
