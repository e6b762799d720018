"""Pulses and their integrals; the clad column against its equation of motion and its two limits."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from hydro1d.analytic import (
    RPPL,
    CladColumn,
    ExponentialPulse,
    FriedlanderPulse,
    RectangularPulse,
    RPPLPulse,
    RPPLStriker,
    TablePulse,
    TriangularPulse,
)

FOAM = RPPL(51.6, 0.8e6, 0.689)
peaks, durations = st.floats(1.0e6, 1e7), st.floats(1e-4, 5e-3)
pulses = st.one_of(
    st.builds(RectangularPulse, peaks, durations),
    st.builds(TriangularPulse, peaks, durations),
    st.builds(ExponentialPulse, peaks, durations),
    st.builds(FriedlanderPulse, peaks, durations, st.floats(0.0, 10.0)),
    st.builds(lambda p, t, q: TablePulse((0.0, 0.3 * t, t), (p, q * p, 0.0)), peaks, durations, st.floats(0.4, 1.2)),
)
shares = st.floats(0.01, 0.99)


@given(pulses, st.floats(0.001, 3.0))
def test_integrals_of_the_pulses(pulse, share):
    t = share * getattr(pulse, "duration", getattr(pulse, "decay", 1e-3))
    corners = sorted({0.0, t, *(c for c in getattr(pulse, "times", (getattr(pulse, "duration", t),)) if c < t)})
    pieces = list(itertools.pairwise(corners))
    first = sum(quad(lambda s: float(pulse.pressure(s)), *ends, epsrel=1e-12)[0] for ends in pieces)
    second = sum(quad(lambda s: float(pulse.impulse(s)), *ends, epsrel=1e-12)[0] for ends in pieces)
    assert float(pulse.impulse(t)) == pytest.approx(first, rel=1e-10)
    assert float(pulse.impulse_integral(t)) == pytest.approx(second, rel=1e-10)


@given(pulses, st.floats(0.5, 50.0), shares)
def test_motion_is_the_integral_of_its_equation(pulse, mass, share):
    column = CladColumn(FOAM, mass, pulse)
    t = share * column.stop_time

    def rates(time, state):
        velocity, displacement = state
        resistance = float(FOAM.shock_stress(velocity))
        block = mass + FOAM.density * displacement / FOAM.densification_strain
        return [(float(pulse.pressure(time)) - resistance) / block, velocity]

    marks = getattr(pulse, "times", (getattr(pulse, "duration", t),))
    state = np.zeros(2)
    corners = sorted({0.0, t, *(c for c in marks if c < t)})
    for low, high in itertools.pairwise(corners):
        # a hair past the corner, so that each piece sees its own side of a jump
        shift = 1e-12 * high if low > 0.0 else 0.0
        state = solve_ivp(rates, (low + shift, high), state, method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
    now = column.history(t)
    assert float(now.displacement) == pytest.approx(state[1], rel=1e-7)
    assert float(now.velocity) == pytest.approx(state[0], rel=1e-6, abs=1e-6)


@given(pulses, st.floats(0.0, 50.0), shares)
def test_jumps_and_conservation(pulse, mass, share):
    column = CladColumn(FOAM, mass, pulse)
    t = share * column.stop_time
    (front,) = column.jumps(t)
    assert max(front.residuals()) < 1e-10
    now = column.history(t)
    momentum = (mass + FOAM.density * now.front) * now.velocity
    assert float(momentum) == pytest.approx(float(pulse.impulse(t)) - 0.8e6 * t, rel=1e-8, abs=1e-9)
    ends = column(np.array([0.0, float(now.front) * (1 - 1e-12)]), t).stress
    np.testing.assert_allclose(ends, [float(now.left_stress), float(now.front_stress)], rtol=1e-6)


@given(st.floats(0.5, 50.0), shares)
def test_energy(mass, share):
    pulse = ExponentialPulse(3.6e6, 1e-3)
    column = CladColumn(FOAM, mass, pulse)
    t = share * column.stop_time
    now = column.history(t)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    x, weights = 0.5 * float(now.front) * (nodes + 1.0), 0.5 * float(now.front) * weights
    internal = FOAM.density * weights @ column(x, t).internal_energy
    kinetic = 0.5 * (mass + FOAM.density * float(now.front)) * float(now.velocity) ** 2
    work = quad(lambda s: float(pulse.pressure(s) * column.history(s).velocity), 0.0, t, epsrel=1e-10)[0]
    assert internal + kinetic == pytest.approx(work, rel=1e-6)


@given(st.floats(1.1e6, 8e6), st.floats(2e-4, 4e-3), shares)
def test_no_plate_is_the_rppl_pulse(pressure, duration, share):
    bare, exact = CladColumn(FOAM, 0.0, RectangularPulse(pressure, duration)), RPPLPulse(FOAM, pressure, duration)
    assert bare.stop_time == pytest.approx(exact.stop_time, rel=1e-10)
    assert bare.critical_length == pytest.approx(exact.critical_length, rel=1e-9)
    t = share * exact.stop_time
    np.testing.assert_allclose(np.array(bare.history(t)), np.array(exact.history(t)), rtol=1e-7)
    x = np.array([0.1, 0.5, 0.9, 1.1]) * float(exact.history(t).front)
    for mine, its in zip(bare(x, t), exact(x, t), strict=True):
        np.testing.assert_allclose(mine, its, rtol=1e-6)


def test_a_table_is_silent_before_its_first_time_and_after_its_last():
    pulse = TablePulse((1e-3, 2e-3, 3e-3), (1e6, 2e6, 4e6))
    np.testing.assert_array_equal(pulse.pressure([0.0, 0.999e-3, 1.5e-3, 3e-3, 3.001e-3]), [0.0, 0.0, 1.5e6, 4e6, 0.0])


def test_short_strong_pulse_is_a_striker():
    mass, velocity, duration = 20.0, 50.0, 1e-9
    clad = CladColumn(FOAM, mass, RectangularPulse(mass * velocity / duration, duration))
    striker = RPPLStriker(FOAM, mass, velocity)
    assert clad.critical_length == pytest.approx(striker.critical_length, rel=1e-5)
    t = 0.4 * striker.stop_time
    np.testing.assert_allclose(np.array(clad.history(t)), np.array(striker.history(t)), rtol=1e-5)


def test_short_column_locks():
    pulse = ExponentialPulse(3.6e6, 1e-3)
    whole = CladColumn(FOAM, 5.0, pulse)
    short = CladColumn(FOAM, 5.0, pulse, 0.5 * whole.critical_length)
    assert float(short.history(short.locking_time).front) == pytest.approx(short.length, rel=1e-9)
    with pytest.raises(ValueError, match=r"t = .*locked"):
        short.history(1.01 * short.locking_time)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: CladColumn(FOAM, -1.0, RectangularPulse(2e6, 1e-3)), "mass"),
        (lambda: CladColumn(FOAM, 1.0, RectangularPulse(0.5e6, 1e-3)), "pressure"),
        (lambda: RectangularPulse(0.0, 1e-3), "peak"),
        (lambda: ExponentialPulse(1e6, -1.0), "decay"),
        (lambda: TablePulse((0.0, 0.0), (1e6, 1e6)), "times"),
        (lambda: TablePulse((0.0, 1.0), (1e6,)), "pressures"),
    ],
)
def test_invalid_parameters_are_named(make, name):
    with pytest.raises(ValueError, match=rf"{name}.* = .*must be"):
        make()
