"""E-P-P-H and other curves with an elastic precursor: conservation, Eqs. 36-47, limits, printed numbers."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from hydro1d.analytic import (
    EPPH,
    RPPL,
    CompactionPulse,
    CompactionStriker,
    RPPLPulse,
    RPPLStriker,
    TangentEPPH,
    stiff_eppr,
    stiff_rppl,
)

ROHACELL = EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105)
TANGENT = TangentEPPH(51.6, 22e6, 0.8e6, 0.689, 1.22, 0.603)
PAPER = CompactionPulse(ROHACELL, length=1.0, pressure=3.6e6, duration=1.53e-3)

slower = settings(max_examples=12)


@st.composite
def columns(draw):
    rho, plateau, locking = draw(st.floats(30.0, 300.0)), draw(st.floats(0.2e6, 3e6)), draw(st.floats(0.45, 0.8))
    modulus = plateau * draw(st.floats(20.0, 60.0))
    fastest = np.sqrt(9.0 * plateau / rho)
    curve = draw(
        st.sampled_from(
            [
                EPPH(rho, modulus, plateau, locking, (1 - locking) / fastest),
                TangentEPPH(rho, modulus, plateau, locking, 1.1, 0.6),
                stiff_eppr(rho, modulus, plateau, locking, 300 * plateau),
            ]
        )
    )
    if draw(st.booleans()):
        return CompactionPulse(curve, 1.0, plateau * draw(st.floats(1.5, 5.0)), draw(st.floats(0.5, 2.0)) / 1e3)
    velocity = curve.yield_velocity + draw(st.floats(0.2, 0.9)) * np.sqrt(plateau * 4.0 / rho)
    return CompactionStriker(curve, 1.0, rho * draw(st.floats(0.2, 2.0)), velocity)


@slower
@given(columns(), st.floats(0.02, 0.98))
def test_fronts_obey_the_jump_conditions_and_the_curve(column, share):
    fronts = column.jumps(share * column.end_time)
    assert len(fronts) == 2
    for front in fronts:
        assert max(front.residuals()) < 1e-10
        for state in (front.ahead, front.behind):
            assert state.stress == pytest.approx(float(column.curve.stress(state.strain)), rel=1e-10)


@slower
@given(columns(), st.floats(0.02, 0.98))
def test_momentum_and_energy_of_the_whole_column(column, share):
    t, curve = share * column.end_time, column.curve
    now = column.history(t)
    start = column.duration if isinstance(column, CompactionPulse) else 0.0
    steady = float(column.history(min(t, start)).front)
    marks = sorted({0.0, steady, *(front.coordinate for front in column.jumps(t)), 1.0})
    totals = np.zeros(2)
    for low, high in itertools.pairwise(marks):
        nodes, weights = np.polynomial.legendre.leggauss(60)
        x = low + 0.5 * (high - low) * (nodes + 1.0)
        fields = column(x, t)
        energy = fields.internal_energy + 0.5 * fields.velocity**2
        totals += 0.5 * (high - low) * curve.density * np.array([weights @ fields.velocity, weights @ energy])
    on_the_back = column.distal_jump.behind.stress * max(t - column.wave_arrival, 0.0)
    if isinstance(column, CompactionPulse):
        given_momentum = column.pressure * min(t, start)
        given_energy = column.pressure * float(column.history(min(t, start)).displacement)
    else:
        given_momentum = column.mass * (column.impact_velocity - float(now.velocity))
        given_energy = 0.5 * column.mass * (column.impact_velocity**2 - float(now.velocity) ** 2)
    assert totals[0] == pytest.approx(given_momentum - on_the_back, rel=1e-8)
    assert totals[1] == pytest.approx(given_energy, rel=1e-8)


@slower
@given(columns(), st.floats(0.05, 0.95))
def test_decay_follows_equations_36_45_46(column, share):
    start = getattr(column, "duration", 0.0)
    if start >= column.end_time:
        return
    t = start + share * (column.end_time - start)
    step = 1e-4 * min(t - start, column.end_time - t)
    before, now, after = (column.history(t + shift) for shift in (-step, 0.0, step))
    curve = column.curve
    relative = float(now.velocity) - curve.yield_velocity
    change = column.jumps(t)[-1 if t < column.wave_arrival else 0].strain
    block = column.end_mass + curve.density * float(now.front)
    assert (after.front - before.front) / (2 * step) == pytest.approx(relative / change, rel=1e-6)
    assert (after.displacement - before.displacement) / (2 * step) == pytest.approx(float(now.velocity), rel=1e-6)
    resistance = curve.yield_stress + curve.density * relative**2 / change
    assert -(after.velocity - before.velocity) / (2 * step) == pytest.approx(resistance / block, rel=1e-5)
    assert float(now.front_stress) == pytest.approx(resistance, rel=1e-10)
    assert np.max(np.abs(column.momentum_residual(np.linspace(0.0, column.end_time, 9)))) < 1e-10


def test_numbers_of_the_paper():
    at_end = PAPER.history(1.53e-3)
    assert ROHACELL.elastic_speed == pytest.approx(652.96, abs=0.005)
    assert ROHACELL.yield_velocity == pytest.approx(23.744, abs=0.0005)
    assert ROHACELL.yield_strain == pytest.approx(0.0364, abs=0.00005)
    assert float(at_end.laboratory_front) == pytest.approx(0.4019, abs=0.00006)
    assert float(at_end.displacement) == pytest.approx(0.3711, abs=0.00005)
    assert 51.6 * float(at_end.front) == pytest.approx(19.58, abs=0.005)
    assert PAPER.distal_jump.behind.stress == pytest.approx(0.843e6, abs=0.0005e6)
    assert PAPER.distal_jump.front_speed == pytest.approx(-35.04, abs=0.005)
    assert PAPER.arrest_time == pytest.approx(6.885e-3, rel=1e-12)
    assert PAPER.meeting_time == pytest.approx(5.94e-3, abs=0.005e-3)
    assert float(PAPER.uncrushed_share(5.0e-3)) == pytest.approx(0.0695, abs=0.00005)
    assert 1.53e-3 * ROHACELL.elastic_speed == pytest.approx(1.0, abs=0.002)


def test_printed_end_follows_from_another_start_of_stage_two():
    """6.13 ms and 8.1 %: [v] for VY + [v], and cS T for the crushed length of Eq. 44."""
    front = PAPER.loading.jumps()[1]
    yield_velocity, c_s = ROHACELL.yield_velocity, front.shock_speed

    def rates(t, state):
        velocity, crushed = state
        relative = max(velocity - yield_velocity, 1e-6)
        change = 0.689 - ROHACELL.yield_strain + 0.00105 * relative
        return [-(0.8e6 + 51.6 * relative**2 / change) / (51.6 * crushed), relative / change]

    def slow(t, state):
        return state[0] - yield_velocity - 1e-4

    slow.terminal = True
    result = solve_ivp(rates, (1.53e-3, 7e-3), [front.velocity, c_s * 1.53e-3], rtol=1e-10, atol=1e-12, events=slow)
    assert result.t[-1] == pytest.approx(6.13e-3, abs=0.01e-3)
    distal = 1.0 + PAPER.distal_jump.front_speed * (result.t[-1] - PAPER.wave_arrival)
    assert distal - result.y[1, -1] == pytest.approx(0.081, abs=0.002)


def test_epph_decay_against_its_quadrature():
    """With J the momentum and X = J y the equations are homogeneous: ln(J1/J) is an integral over y."""
    t = 4e-3
    front = float(PAPER.history(t).front)
    momentum = [PAPER.momentum - 0.8e6 * time for time in (1.53e-3, t)]
    a, s, k = (0.689 - ROHACELL.yield_strain) * 51.6, 0.00105, 1.0 / 0.8e6
    ends = float(PAPER.history(1.53e-3).front) / momentum[0], front / momentum[1]
    integral = quad(lambda y: (a * y + s) / (y * (a * y + s) + k), *ends, epsrel=1e-12)[0]
    assert integral == pytest.approx(np.log(momentum[0] / momentum[1]), rel=1e-10)


def test_rigid_limit_of_the_pulse_is_the_closed_form():
    exact = RPPLPulse(RPPL(51.6, 0.8e6, 0.689), 3.6e6, 1.53e-3)
    distances = []
    for stiffness in (1e4, 1e6, 1e8):
        column = CompactionPulse(stiff_rppl(51.6, 0.8e6, 0.689, stiffness * 0.8e6), 2.0, 3.6e6, 1.53e-3)
        t = 3e-3
        difference = np.array(column.history(t)[:3:2]) / np.array(exact.history(t)[:3:2]) - 1.0
        distances.append(np.max(np.abs(difference)))
        assert column.arrest_time == pytest.approx(exact.stop_time, rel=1e-8)
    np.testing.assert_allclose(np.array(distances[:-1]) / np.array(distances[1:]), 10.0, rtol=0.1)


@given(st.floats(0.05, 0.95))
@slower
def test_striker_on_rigid_locking_is_scheme_one_shifted(share):
    """v0 - VY for v0, eD - eY for eD, u - VY t for u; locking made rigid by 1e12 times the plateau."""
    curve = stiff_eppr(155.0, 10e6, 0.3e6, 0.67, 0.3e18)
    column = CompactionStriker(curve, 1.0, 40.0, 60.0)
    shifted = RPPLStriker(RPPL(155.0, 0.3e6, 0.67 - 0.03), 40.0, 60.0 - curve.yield_velocity)
    t = share * column.end_time
    now, expected = column.history(t), shifted.history(t)
    assert float(now.front) == pytest.approx(float(expected.front), rel=1e-8)
    assert float(now.velocity) == pytest.approx(float(expected.velocity) + curve.yield_velocity, rel=1e-8)
    assert float(now.displacement) == pytest.approx(float(expected.displacement) + curve.yield_velocity * t, rel=1e-8)
    assert float(now.left_stress) == pytest.approx(float(expected.left_stress), rel=1e-7)


def test_regions():
    t = 1.2e-3
    precursor, proximal = PAPER.jumps(t)
    x = np.array([proximal.coordinate - 1e-6, proximal.coordinate + 1e-6, precursor.coordinate + 1e-6])
    np.testing.assert_allclose(PAPER(x, t).stress, [3.6e6, 0.8e6, 0.0], rtol=1e-12)
    t = 4e-3
    proximal, distal = PAPER.jumps(t)
    assert proximal.coordinate < distal.coordinate
    x = np.array([0.0, proximal.coordinate - 1e-9, proximal.coordinate + 1e-6, distal.coordinate + 1e-6])
    fields = PAPER(x, t)
    expected = [0.0, proximal.behind.stress, 0.8e6, PAPER.distal_jump.behind.stress]
    np.testing.assert_allclose(fields.stress, expected, rtol=1e-6)
    np.testing.assert_allclose(fields.velocity[2:], [ROHACELL.yield_velocity, 0.0], rtol=1e-12)
    assert fields.strain[1] == pytest.approx(proximal.behind.strain, rel=1e-6)


def test_fields_broadcast():
    fields = PAPER(np.linspace(0.0, 1.0, 5)[:, None], np.array([1e-3, 4e-3])[None, :])
    assert all(field.shape == (5, 2) for field in fields)
    alone = PAPER(np.linspace(0.0, 1.0, 5), 4e-3)
    np.testing.assert_allclose(fields.strain[:, 1], alone.strain, rtol=1e-12)


def test_long_pulse_meets_in_stage_one():
    column = CompactionPulse(ROHACELL, 1.0, 3.6e6, 8e-3)
    assert column.meeting_time < column.duration
    front, speed = column.loading.jumps()[1].front_speed, column.distal_jump.front_speed
    assert column.meeting_time == pytest.approx((1.0 - speed * column.wave_arrival) / (front - speed), rel=1e-10)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: CompactionPulse(ROHACELL, 1.0, 0.7e6, 1e-3), "pressure"),
        (lambda: CompactionPulse(ROHACELL, 0.0, 2e6, 1e-3), "length"),
        (lambda: CompactionPulse(ROHACELL, 1.0, 2e6, -1e-3), "duration"),
        (lambda: CompactionPulse(stiff_eppr(100.0, 5e6, 1e6, 0.6, 400e6), 1.0, 4e6, 1e-3), "pressure"),
        (lambda: CompactionStriker(ROHACELL, 1.0, 10.0, 20.0), "impact_velocity"),
        (lambda: CompactionStriker(stiff_eppr(100.0, 5e6, 1e6, 0.6, 400e6), 1.0, 10.0, 200.0), "impact_velocity"),
        (lambda: PAPER.history(6e-3), "t"),
    ],
)
def test_invalid_parameters_are_named(make, name):
    with pytest.raises(ValueError, match=rf"{name} = .*must be"):
        make()
