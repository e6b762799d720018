"""Schemes 1 and 2 and the R-P-P-L pulse: equations of the paper, conservation, limits, printed numbers."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from hydro1d.analytic import RPPL, EnergyBalanceStriker, RPPLPulse, RPPLStriker, jumps, rppl, rppl_energy_balance
from hydro1d.analytic.rppl_pulse import critical_duration

WOOD = RPPL(155.0, 0.3e6, 0.67)
ROHACELL = RPPL(51.6, 0.8e6, 0.689)
materials = st.builds(RPPL, st.floats(20.0, 800.0), st.floats(1e4, 1e7), st.floats(0.2, 0.9))
strikers = st.builds(RPPLStriker, materials, st.floats(1.0, 500.0), st.floats(5.0, 500.0))
pulses = st.builds(
    lambda m, over, duration: RPPLPulse(m, over * m.plateau_stress, duration),
    materials,
    st.floats(1.05, 15.0),
    st.floats(1e-4, 1e-2),
)
shares = st.floats(0.001, 0.999)


@given(strikers, shares)
def test_striker_front_obeys_the_jump_conditions(striker, share):
    (front,) = striker.jumps(share * striker.stop_time)
    assert max(front.residuals()) < 1e-10
    ahead, behind = striker.material.density, striker.material.locked_density
    assert front.shock_speed * (1 - ahead / behind) == pytest.approx(front.velocity, rel=1e-12)
    assert behind * (1 - striker.material.densification_strain) == pytest.approx(ahead, rel=1e-14)


@given(strikers, shares)
def test_striker_in_time_agrees_with_equations_7_8_9(striker, share):
    t, m = share * striker.stop_time, striker.material
    now = striker.history(t)
    assert float(striker.velocity_at(now.displacement)) == pytest.approx(float(now.velocity), rel=1e-7, abs=1e-9)
    assert float(striker.stress_at(now.displacement)) == pytest.approx(float(now.front_stress), rel=1e-10)
    step = 1e-4 * min(t, striker.stop_time - t)
    before, after = striker.history(t - step), striker.history(t + step)
    assert float(after.displacement - before.displacement) / (2 * step) == pytest.approx(float(now.velocity), rel=1e-6)
    deceleration = -float(after.velocity - before.velocity) / (2 * step)
    block = striker.mass + m.density * float(now.displacement) / m.densification_strain
    assert block * deceleration == pytest.approx(float(m.shock_stress(now.velocity)), rel=1e-5)
    assert striker.mass * deceleration == pytest.approx(float(now.left_stress), rel=1e-5)


@given(strikers, shares)
def test_striker_conserves_momentum_and_energy(striker, share):
    t = share * striker.stop_time
    now, m = striker.history(t), striker.material
    x, weights = gauss(float(now.front))
    fields = striker(x, t)
    momentum = striker.mass * now.velocity + m.density * weights @ fields.velocity
    assert momentum == pytest.approx(striker.mass * striker.impact_velocity - m.plateau_stress * t, rel=1e-10)
    kinetic = 0.5 * (striker.mass + m.density * now.front) * now.velocity**2
    internal = m.density * quad(lambda x: float(striker(x, t).internal_energy), 0.0, float(now.front), epsrel=1e-10)[0]
    assert kinetic + internal == pytest.approx(0.5 * striker.mass * striker.impact_velocity**2, rel=1e-8)


def gauss(length):
    nodes, weights = np.polynomial.legendre.leggauss(40)
    return 0.5 * length * (nodes + 1.0), 0.5 * length * weights


@given(strikers, shares)
def test_stress_in_the_block_balances_its_deceleration(striker, share):
    t = share * striker.stop_time
    now = striker.history(t)
    ends = striker(np.array([0.0, float(now.front) * (1 - 1e-12)]), t).stress
    np.testing.assert_allclose(ends, [float(now.left_stress), float(now.front_stress)], rtol=1e-9)


@given(strikers)
def test_striker_stops_at_the_critical_length(striker):
    end = striker.history(striker.stop_time)
    assert float(end.front) == pytest.approx(striker.critical_length, rel=1e-10)
    assert float(end.velocity) < 1e-12 * striker.impact_velocity
    assert np.isnan(striker.history(1.1 * striker.stop_time).front_stress)
    assert striker.jumps(1.1 * striker.stop_time) == []


@given(strikers, st.floats(0.05, 0.95))
def test_full_locking(striker, share):
    short = RPPLStriker(striker.material, striker.mass, striker.impact_velocity, share * striker.critical_length)
    end = short.history(short.locking_time)
    assert float(end.front) == pytest.approx(short.length, rel=1e-9)
    assert float(end.velocity) > 0.0
    with pytest.raises(ValueError, match=r"t = .*locked"):
        short.history(1.001 * short.locking_time)
    needed = float(rppl.full_locking_velocity(striker.material, striker.mass, short.length))
    assert float(rppl.critical_length(striker.material, striker.mass, needed)) == pytest.approx(short.length, rel=1e-10)
    psi = float(rppl.energy_ratio(striker.material, striker.mass, short.length))
    static = striker.material.plateau_stress * striker.material.densification_strain * short.length
    assert 0.5 * striker.mass * needed**2 == pytest.approx(psi * static, rel=1e-10)


@given(strikers)
def test_heavy_striker_limit(striker):
    """G to infinity: constant velocity, psi = 1, both schemes crush alike."""
    heavy = RPPLStriker(striker.material, 1e12, striker.impact_velocity)
    t = 1e-3
    assert float(heavy.history(t).velocity) == pytest.approx(striker.impact_velocity, rel=1e-6)
    assert float(heavy.history(t).displacement) == pytest.approx(striker.impact_velocity * t, rel=1e-6)
    assert float(rppl.energy_ratio(striker.material, 1e12, 1.0)) == pytest.approx(1.0, abs=1e-8)


def test_slow_striker_limit_is_quasi_static_in_both_schemes():
    slow = 1e-3
    first, second = (scheme.critical_length(WOOD, 40.0, slow) for scheme in (rppl, rppl_energy_balance))
    assert float(first) == pytest.approx(float(second), rel=1e-6)


@given(strikers, st.floats(0.01, 0.9))
def test_energy_balance_scheme_obeys_its_own_equations(striker, share):
    wrong = EnergyBalanceStriker(striker.material, striker.mass, striker.impact_velocity)
    t, m = share * wrong.stop_time, striker.material
    now = wrong.history(t)
    exact = quad(lambda u: 1.0 / float(wrong.velocity_at(u)), 0.0, float(now.displacement), epsrel=1e-11, limit=200)[0]
    assert exact == pytest.approx(t, rel=1e-7)
    step = 1e-3 * min(now.displacement, wrong.critical_length * m.densification_strain - now.displacement)
    slope = (wrong.velocity_at(now.displacement + step) ** 2 - wrong.velocity_at(now.displacement - step) ** 2) / (
        4 * step
    )
    block = striker.mass + m.density * now.displacement / m.densification_strain
    resistance = m.plateau_stress + m.density * now.velocity**2 / (2 * m.densification_strain)
    assert float(-block * slope) == pytest.approx(float(resistance), rel=1e-4)
    assert float(now.front_stress) == pytest.approx(float(resistance), rel=1e-12)
    kinetic = 0.5 * (striker.mass + m.density * now.front) * now.velocity**2
    spent = kinetic + m.plateau_stress * now.displacement
    assert float(spent) == pytest.approx(0.5 * striker.mass * striker.impact_velocity**2, rel=1e-9)


@given(strikers)
def test_energy_balance_scheme_locks_at_equation_18_with_psi_one(striker):
    length = 0.7
    needed = float(rppl_energy_balance.full_locking_velocity(striker.material, striker.mass, length))
    static = striker.material.plateau_stress * striker.material.densification_strain * length
    assert 0.5 * striker.mass * needed**2 == pytest.approx(static, rel=1e-12)
    wrong = EnergyBalanceStriker(striker.material, striker.mass, 1.2 * needed, length)
    assert float(wrong.history(wrong.locking_time).front) == pytest.approx(length, rel=1e-9)


@given(strikers, shares)
def test_energy_across_the_front(striker, share):
    """Eqs. 20-22: work less kinetic energy of the element is EV of its volume."""
    (front,) = striker.jumps(share * striker.stop_time)
    m, crushed = striker.material, 1e-3
    work = jumps.striker_work(front.behind.stress, m.densification_strain * crushed)
    kinetic = jumps.element_kinetic_energy(m.density, front.velocity, crushed)
    assert float(work - kinetic) == pytest.approx(front.absorbed_energy * crushed, rel=1e-10)


@given(pulses, shares)
def test_pulse_front_obeys_the_jump_conditions(pulse, share):
    for t in (share * pulse.duration, pulse.duration + share * (pulse.stop_time - pulse.duration)):
        (front,) = pulse.jumps(t)
        assert max(front.residuals()) < 1e-10


@pytest.mark.parametrize("off", [1e-3, 1e-6, 1e-8])
def test_a_weak_jump_is_judged_by_itself(off):
    """Near the stop the jump is millionths of the stress: an error of that jump is still seen, round-off is not."""
    pulse = RPPLPulse(ROHACELL, 3.6e6, 1.53e-3)
    (front,) = pulse.jumps(pulse.duration + 0.999 * (pulse.stop_time - pulse.duration))
    assert front.stress < 1e-5 * front.behind.stress
    assert max(front.residuals()) < 1e-10
    wrong = front.behind._replace(stress=front.behind.stress + off * front.stress)
    assert replace(front, behind=wrong).residuals().momentum == pytest.approx(off, rel=0.3)


@given(pulses, shares)
def test_pulse_conserves_momentum_and_energy(pulse, share):
    t, m = share * pulse.stop_time, pulse.material
    now = pulse.history(t)
    impulse = pulse.pressure * min(t, pulse.duration) - m.plateau_stress * t
    assert float(m.density * now.front * now.velocity) == pytest.approx(impulse, rel=1e-9)
    marks = [0.0, min(pulse.pulse_length, float(now.front)), float(now.front)]
    pieces = [
        quad(lambda x: float(pulse(x, t).internal_energy), *ends, epsrel=1e-10)[0] for ends in itertools.pairwise(marks)
    ]
    kinetic = 0.5 * m.density * now.front * now.velocity**2
    work = pulse.pressure * pulse.pulse_velocity * min(t, pulse.duration)
    assert float(kinetic) + m.density * sum(pieces) == pytest.approx(work, rel=1e-8)


@given(pulses)
def test_pulse_ends(pulse):
    end = pulse.history(pulse.stop_time)
    assert float(end.front) == pytest.approx(pulse.critical_length, rel=1e-10)
    m, p = pulse.material, pulse.pressure
    closed = pulse.duration * np.sqrt(
        p * (p - m.plateau_stress) / (m.plateau_stress * m.density * m.densification_strain)
    )
    assert pulse.critical_length == pytest.approx(closed, rel=1e-10)
    assert float(critical_duration(m, p, pulse.critical_length)) == pytest.approx(pulse.duration, rel=1e-10)
    before, after = pulse.history(pulse.duration), pulse.history(pulse.duration * (1 + 1e-12))
    assert float(before.velocity) == pytest.approx(float(after.velocity), rel=1e-9)
    assert (float(before.left_stress), float(after.left_stress)) == (p, 0.0)


@pytest.mark.parametrize("share", [0.3, 0.8])
def test_pulse_on_a_short_column_locks(share):
    whole = RPPLPulse(ROHACELL, 3.6e6, 1.53e-3)
    short = RPPLPulse(ROHACELL, 3.6e6, 1.53e-3, share * whole.critical_length)
    assert float(short.history(short.locking_time).front) == pytest.approx(short.length, rel=1e-9)
    with pytest.raises(ValueError, match=r"t = .*locked"):
        short.history(1.01 * short.locking_time)


@pytest.mark.parametrize("excess", [1e-2, 1e-4, 1e-6])
def test_pressure_at_the_plateau_limit(excess):
    """P to plateau: front speed and crushed length fall as the square root, stop time tends to T."""
    pulse = RPPLPulse(ROHACELL, 0.8e6 * (1 + excess), 1e-3)
    scale = 1e-3 * np.sqrt(0.8e6 / (51.6 * 0.689))
    assert pulse.critical_length == pytest.approx(scale * np.sqrt(excess), rel=0.6 * excess)
    assert pulse.stop_time == pytest.approx(1e-3 * (1 + excess), rel=1e-12)


def test_numbers_of_the_paper():
    assert float(rppl.critical_length(WOOD, 40.0, 400.0)) == pytest.approx(2.62, abs=0.005)
    assert float(rppl_energy_balance.critical_length(WOOD, 40.0, 400.0)) == pytest.approx(15.9, abs=0.05)
    pulse = RPPLPulse(ROHACELL, 3.6e6, 1.53e-3, 1.0)
    assert pulse.pulse_velocity == pytest.approx(193.36, abs=0.005)
    assert pulse.critical_length == pytest.approx(0.911, abs=0.0005)
    assert 1.0 - pulse.critical_length == pytest.approx(0.089, abs=0.0005)
    assert pulse.stop_time == pytest.approx(6.885e-3, rel=1e-12)
    assert float(critical_duration(ROHACELL, 3.6e6, 1.0)) == pytest.approx(1.680e-3, abs=0.0005e-3)


def test_fields_by_zone():
    striker, t = RPPLStriker(WOOD, 40.0, 100.0, 1.0), 2e-3
    now = striker.history(t)
    inside, outside = striker(np.array([0.5, 1.5]) * now.front, t).strain
    assert (inside, outside) == (0.67, 0.0)
    assert float(striker(0.9, t).stress) == 0.3e6
    assert striker(np.zeros((3, 1)), np.full((1, 4), t)).density.shape == (3, 4)
    assert float(striker.deformed_length(now.displacement)) == pytest.approx(float(now.front - now.displacement))


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: RPPL(155.0, 0.3e6, 1.0), "densification_strain"),
        (lambda: RPPL(155.0, -0.3e6, 0.5), "plateau_stress"),
        (lambda: RPPLStriker(WOOD, 0.0, 10.0), "mass"),
        (lambda: RPPLStriker(WOOD, 1.0, float("inf")), "impact_velocity"),
        (lambda: EnergyBalanceStriker(WOOD, 1.0, -1.0), "impact_velocity"),
        (lambda: RPPLPulse(WOOD, 0.3e6, 1e-3), "pressure"),
        (lambda: RPPLPulse(WOOD, 1e6, 0.0), "duration"),
        (lambda: critical_duration(WOOD, 0.1e6, 1.0), "pressure"),
        (lambda: RPPLStriker(WOOD, 1.0, 10.0).history(-1.0), "t"),
    ],
)
def test_invalid_parameters_are_named(make, name):
    with pytest.raises(ValueError, match=rf"{name} = .*must be"):
        make()
