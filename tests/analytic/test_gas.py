"""Riemann problem, Noh, simple wave: their own equations, and published numbers."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from hydro1d.analytic import Gas, Noh, RiemannProblem, SimpleWave

gammas = st.floats(1.1, 3.0)
gases = st.builds(Gas, st.floats(0.05, 20.0), st.floats(-3.0, 3.0), st.floats(1e-3, 1e3), gammas)
TORO = {
    1: (Gas(1.0, 0.0, 1.0), Gas(0.125, 0.0, 0.1), 0.30313, 0.92745, 0.42632, 0.26557),
    2: (Gas(1.0, -2.0, 0.4), Gas(1.0, 2.0, 0.4), 0.00189, 0.0, 0.02185, 0.02185),
    3: (Gas(1.0, 0.0, 1000.0), Gas(1.0, 0.0, 0.01), 460.894, 19.5975, 0.57506, 5.99924),
    5: (
        Gas(5.99924, 19.5975, 460.894),
        Gas(5.99242, -6.19633, 46.0950),
        1691.64,
        8.68975,
        14.2823,
        31.0426,
    ),
}


@pytest.mark.parametrize("case", TORO.values(), ids=TORO)
def test_star_states_of_toro(case):
    left, right, pressure, velocity, left_density, right_density = case
    problem = RiemannProblem(left, right)
    tolerance = 1e-5 if pressure > 1.0 else 0.0
    assert problem.star_pressure == pytest.approx(pressure, rel=tolerance, abs=6e-6)
    assert problem.star_velocity == pytest.approx(velocity, rel=tolerance, abs=6e-6)
    densities = [state.density for state in problem.star_states]
    np.testing.assert_allclose(densities, [left_density, right_density], rtol=tolerance, atol=6e-6)


def valid_problem(left, right):
    apart = right.velocity - left.velocity
    assume(apart < 0.9 * (left.escape_speed + right.escape_speed))
    return RiemannProblem(left, right, 0.3)


@given(gases, gases)
def test_shocks_obey_the_jump_conditions(left, right):
    problem = valid_problem(left, right)
    for shock in problem.jumps(1.0):
        assume(shock.stress > 1e-5 * shock.behind.stress)
        assert max(shock.residuals()) < 1e-9
    for side, star in zip((left, right), problem.star_states, strict=True):
        assert star.stress == pytest.approx((side.gamma - 1.0) * star.density * star.internal_energy, rel=1e-12)
    velocities = [
        left.velocity - left.velocity_change(problem.star_pressure),
        right.velocity + right.velocity_change(problem.star_pressure),
    ]
    scale = abs(left.velocity) + abs(right.velocity) + left.escape_speed + right.escape_speed
    assert abs(velocities[0] - velocities[1]) < 1e-11 * scale


@given(gases, gases)
def test_fans_are_isentropic_simple_waves(left, right):
    """Entropy and the Riemann invariant are constant, and the characteristic runs at v -/+ c."""
    problem, t = valid_problem(left, right), 0.7
    for gas, star, sign in zip((left, right), problem.star_states, (-1, 1), strict=True):
        if star.stress >= gas.pressure:
            continue
        tail = np.sqrt(gas.gamma * star.stress * star.density) / gas.density
        speed = sign * np.linspace(tail, gas.sound_speed, 9)[1:-1]
        fields = problem(0.3 + speed * t, t)
        np.testing.assert_allclose(
            fields.stress / fields.density**gas.gamma, gas.pressure / gas.density**gas.gamma, rtol=1e-10
        )
        sound = np.sqrt(gas.gamma * fields.stress / fields.density)
        invariant = gas.velocity - sign * gas.escape_speed
        np.testing.assert_allclose(
            fields.velocity - sign * 2 * sound / (gas.gamma - 1), invariant, rtol=1e-9, atol=1e-9
        )
        characteristic = 0.3 + (fields.velocity + sign * sound) * t
        np.testing.assert_allclose(problem.position(0.3 + speed * t, t), characteristic, rtol=1e-9, atol=1e-9)


@given(gases, gases)
def test_laboratory_and_lagrangian_fields_agree(left, right):
    problem, t = valid_problem(left, right), 0.4
    spread = 2.0 * t * max(left.sound_speed, right.sound_speed)
    x = 0.3 + spread * np.linspace(-1.0, 1.0, 38)
    fronts = [shock.coordinate for shock in problem.jumps(t)]
    x = x[np.min([abs(x - front) for front in (*fronts, 1e9)], axis=0) > 1e-6 * spread]
    for here, there in zip(problem(x, t), problem.laboratory(problem.position(x, t), t), strict=True):
        np.testing.assert_allclose(here, there, rtol=1e-6, atol=1e-6 * np.max(np.abs(here)))


@given(gases, gases)
def test_mass_between_positions_is_initial_mass(left, right):
    problem, t = valid_problem(left, right), 0.4
    step = 1e-6
    x = 0.3 + np.array([-2.0, -1.1, -0.1, 0.1, 1.1, 2.0]) * t * max(left.sound_speed, right.sound_speed)
    stretch = (problem.position(x + step, t) - problem.position(x - step, t)) / (2 * step)
    fields = problem(x, t)
    initial = np.where(x < 0.3, left.density, right.density)
    away = [abs(x - shock.coordinate) > 3 * step for shock in problem.jumps(t)] + [np.full(6, True)]
    good = np.all(away, axis=0)
    np.testing.assert_allclose((stretch * fields.density)[good], initial[good], rtol=2e-3)
    np.testing.assert_allclose(1.0 - fields.strain, initial / fields.density, rtol=1e-10)


@given(gases)
def test_equal_states_stay(gas):
    problem = RiemannProblem(gas, gas)
    fields = problem(np.array([-1.0, 0.0, 1.0]), 0.5)
    np.testing.assert_allclose(fields.density, gas.density, rtol=1e-12)
    np.testing.assert_allclose(fields.velocity, gas.velocity, rtol=1e-12, atol=1e-12 * gas.sound_speed)


def test_mirror():
    left, right = Gas(1.0, 0.3, 2.0, 1.3), Gas(0.4, -0.2, 0.1, 1.9)
    problem = RiemannProblem(left, right)
    mirrored = RiemannProblem(Gas(0.4, 0.2, 0.1, 1.9), Gas(1.0, -0.3, 2.0, 1.3))
    x = np.linspace(-2.0, 2.0, 40)
    a, b = problem(x, 0.5), mirrored(-x, 0.5)
    np.testing.assert_allclose(a.velocity, -b.velocity, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(a.stress, b.stress, rtol=1e-12)


def test_vacuum_is_refused():
    with pytest.raises(ValueError, match="vacuum"):
        RiemannProblem(Gas(1.0, -10.0, 0.4), Gas(1.0, 10.0, 0.4))


@given(gammas, st.floats(0.1, 10.0), st.floats(0.1, 10.0), st.floats(0.0, 10.0))
def test_noh_obeys_jumps_and_the_gas_law(gamma, density, speed, pressure):
    noh = Noh(gamma, density, speed, pressure)
    (shock,) = noh.jumps()
    assert max(shock.residuals()) < 1e-10
    for state in (shock.ahead, shock.behind):
        assert state.stress == pytest.approx((gamma - 1.0) * state.density * state.internal_energy, rel=1e-12)
        assert state.density * (1.0 - state.strain) == pytest.approx(density, rel=1e-10)
    assert noh.wall_speed == pytest.approx(shock.laboratory_speed, rel=1e-10)


@given(gammas)
def test_cold_noh_closed_form(gamma):
    noh = Noh(gamma)
    assert noh.behind.density == pytest.approx((gamma + 1.0) / (gamma - 1.0), rel=1e-12)
    assert noh.wall_speed == pytest.approx(0.5 * (gamma - 1.0), rel=1e-12)
    assert noh.behind.internal_energy == pytest.approx(0.5, rel=1e-12)


def test_noh_in_both_coordinates():
    noh = Noh()
    np.testing.assert_array_equal(noh.laboratory([0.19, 0.21], 0.6).density > 2.0, [True, False])
    x = np.linspace(0.01, 1.99, 20)
    np.testing.assert_array_equal(noh.laboratory(noh.position(x, 0.6), 0.6).density, noh(x, 0.6).density)
    stretch = (noh.position(x + 1e-6, 0.6) - noh.position(x - 1e-6, 0.6)) / 2e-6
    np.testing.assert_allclose(stretch, noh.density / noh(x, 0.6).density, rtol=1e-8)  # mass between positions
    beside = noh.position(noh.front_speed * 0.6 * np.array([1.0 - 1e-9, 1.0 + 1e-9]), 0.6)
    np.testing.assert_allclose(beside, noh.wall_speed * 0.6, rtol=1e-8)  # nothing tears at the shock
    problem = RiemannProblem(Gas(1.0, 1.0, 0.2, 5 / 3), Gas(1.0, -1.0, 0.2, 5 / 3))
    assert problem.star_pressure == pytest.approx(Noh(pressure=0.2).behind.stress, rel=1e-10)


waves = st.builds(
    lambda density, pressure, mach, rise, gamma: SimpleWave(
        density, pressure, mach * np.sqrt(gamma * pressure / density), rise, gamma
    ),
    st.floats(0.1, 10.0),
    st.floats(0.1, 10.0),
    st.one_of(st.floats(0.05, 0.8), st.floats(-0.5, -0.05)),
    st.floats(0.1, 2.0),
    gammas,
)


@given(waves, st.floats(0.1, 0.9), st.floats(0.02, 0.98))
def test_simple_wave_satisfies_the_equations(wave, time_share, place_share):
    t = time_share * min(wave.end_time, 5.0 * wave.rise_time)
    x = place_share * wave.sound_speed * t
    h = 2e-5 * t
    dx = h * wave.sound_speed

    def rate(name):
        return (getattr(wave(x, t + h), name) - getattr(wave(x, t - h), name)) / (2 * h)

    def gradient(name):
        return (getattr(wave(x + dx, t), name) - getattr(wave(x - dx, t), name)) / (2 * dx)

    scale = abs(wave.velocity) / t / wave.sound_speed + 1e-12
    assert abs(rate("strain") + gradient("velocity")) < 2e-4 * scale
    assert abs(wave.density * rate("velocity") + gradient("stress")) < 2e-4 * scale * wave.density * wave.sound_speed
    fields = wave(x, t)
    assert float(fields.stress / fields.density**wave.gamma) == pytest.approx(
        wave.pressure / wave.density**wave.gamma, rel=1e-12
    )
    energy = wave.density * rate("internal_energy") - fields.stress * rate("strain")
    assert abs(energy) < 2e-4 * scale * wave.pressure
    moved = (wave.displacement(x, t + h) - wave.displacement(x, t - h)) / (2 * h)
    assert abs(moved - fields.velocity) < 1e-6 * abs(wave.velocity) + 1e-12
    squeezed = (wave.displacement(x + dx, t) - wave.displacement(x - dx, t)) / (2 * dx)
    assert abs(squeezed + fields.strain) < 1e-5 * scale * t


@given(waves)
def test_simple_wave_at_the_piston_and_ahead(wave):
    t = 0.8 * min(wave.end_time, 3.0 * wave.rise_time)
    assert float(wave(0.0, t).velocity) == pytest.approx(float(wave.piston_velocity(t)), rel=1e-9, abs=1e-12)
    assert float(wave.displacement(0.0, t)) == pytest.approx(float(wave.piston_displacement(t)), rel=1e-9, abs=1e-12)
    ahead = wave(1.001 * wave.sound_speed * t, t)
    assert (float(ahead.velocity), float(ahead.strain)) == (0.0, 0.0)
    assert float(wave.displacement(1.001 * wave.sound_speed * t, t)) == 0.0


def test_piston_displacement_is_the_integral_of_its_velocity():
    wave = SimpleWave(1.0, 1.0, 0.3, 0.5)
    nodes, weights = np.polynomial.legendre.leggauss(30)
    for low, high in pairwise([0.0, 0.2, 0.5, 0.9]):
        t = low + 0.5 * (high - low) * (nodes + 1.0)
        integral = 0.5 * (high - low) * weights @ wave.piston_velocity(t)
        assert wave.piston_displacement(high) - wave.piston_displacement(low) == pytest.approx(integral, rel=1e-12)


def test_shock_forms_where_the_strain_gradient_diverges():
    wave = SimpleWave(1.0, 1.0, 0.3, 0.5)
    gradients = []
    for t in wave.shock_time * np.array([0.9, 0.99, 0.999]):
        strain = wave(np.linspace(0.0, wave.sound_speed * t, 200001), t).strain
        gradients.append(np.max(np.abs(np.diff(strain))))
    assert gradients[1] / gradients[0] > 5.0
    assert gradients[2] / gradients[1] > 4.0
    with pytest.raises(ValueError, match=r"t = .*shock"):
        wave(0.1, 1.001 * wave.shock_time)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: Gas(1.0, 0.0, 0.0), "pressure"),
        (lambda: Gas(1.0, 0.0, 1.0, 1.0), "gamma"),
        (lambda: Noh(speed=0.0), "speed"),
        (lambda: Noh(pressure=-1.0), "pressure"),
        (lambda: Noh(length=1.0)(0.5, 2.0), "t"),
        (lambda: SimpleWave(1.0, 1.0, -10.0, 1.0), "velocity"),
        (lambda: SimpleWave(1.0, 1.0, 0.1, 0.0), "rise_time"),
    ],
)
def test_invalid_parameters_are_named(make, name):
    with pytest.raises(ValueError, match=rf"{name} = .*must be"):
        make()


@given(gases, gases)
def test_inner_speeds_bound_the_star_region(left, right):
    problem = valid_problem(left, right)
    sides = zip((-1, 1), problem.inner_speeds, problem.star_states, (left, right), strict=True)
    for sign, speed, star, gas in sides:
        assume(abs(star.density / gas.density - 1.0) > 1e-3)  # a weaker wave changes too little to be seen
        inside, beyond = problem(0.3 + sign * speed * np.array([0.999, 1.001]), 1.0).density
        assert float(inside) == pytest.approx(star.density, rel=1e-12)
        assert float(beyond) != pytest.approx(star.density, rel=1e-12)
