"""Taylor's plate and elastic layers: equations of motion, interface conditions, energy, closed forms."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from hydro1d.analytic import ElasticLayer, ElasticLayers, ExponentialPulse, TaylorPlate, reflection, transmission

plates = st.builds(
    lambda density, modulus, beta, decay: TaylorPlate(
        density,
        modulus,
        np.sqrt(density * modulus) * decay / beta,
        1e-4 * modulus,
        decay,
        np.sqrt(modulus / density) * 6 * decay,
    ),
    st.floats(10.0, 5000.0),
    st.floats(1e6, 1e11),
    st.one_of(st.floats(0.05, 0.99), st.just(1.0), st.floats(1.0001, 50.0)),
    st.floats(1e-5, 1e-2),
)
shares = st.floats(0.01, 0.99)


@given(plates, shares)
def test_plate_moves_by_taylors_equation(plate, share):
    since = share * (plate.cavitation_time - plate.arrival_time)

    def rates(t, state):
        load = 2.0 * plate.peak * np.exp(-t / plate.decay)
        return [(load - plate.impedance * state[0]) / plate.mass, state[0]]

    expected = solve_ivp(rates, (0.0, since), [0.0, 0.0], method="DOP853", rtol=1e-11, atol=1e-16).y[:, -1]
    now = plate.history(plate.arrival_time + since)
    assert float(now.velocity) == pytest.approx(expected[0], rel=1e-8)
    assert float(now.displacement) == pytest.approx(expected[1], rel=1e-7)
    load = 2.0 * plate.peak * np.exp(-since / plate.decay)
    assert float(now.pressure) == pytest.approx(load - plate.impedance * expected[0], rel=1e-6, abs=1e-7 * plate.peak)


@given(plates)
def test_cavitation(plate):
    end = plate.history(plate.cavitation_time)
    assert abs(float(end.pressure)) < 1e-9 * plate.peak
    before = plate.history(plate.arrival_time + 0.999 * (plate.cavitation_time - plate.arrival_time))
    assert float(before.pressure) > 0.0
    if plate.beta != 1.0:
        closed = 2.0 * plate.peak * plate.decay * plate.beta ** (plate.beta / (1.0 - plate.beta))
        assert plate.impulse == pytest.approx(closed, rel=1e-8)
        since = plate.decay * np.log(plate.beta) / (plate.beta - 1.0)
        assert plate.cavitation_time - plate.arrival_time == pytest.approx(since, rel=1e-9)


@given(plates, shares)
def test_medium_obeys_its_equations_and_meets_the_plate(plate, share):
    t = share * plate.end_time
    assert max(plate.jumps(t)[0].residuals()) < 1e-10
    at_plate = plate(plate.thickness, t)
    now = plate.history(t)
    assert float(at_plate.stress) == pytest.approx(float(now.pressure), abs=1e-9 * plate.peak)
    scale = plate.peak / plate.impedance
    assert float(at_plate.velocity) == pytest.approx(float(now.velocity), abs=1e-9 * scale)
    assert float(plate(0.0, t).stress) == pytest.approx(plate.peak * np.exp(-t / plate.decay), rel=1e-12)


@given(plates, st.floats(0.05, 0.9))
def test_momentum_of_medium_and_plate(plate, share):
    since = share * (min(plate.cavitation_time, 2.0 * plate.arrival_time) - plate.arrival_time)
    t = plate.arrival_time + since
    head = plate.thickness - plate.sound_speed * since
    total = plate.mass * float(plate.history(t).velocity)
    nodes, weights = np.polynomial.legendre.leggauss(80)
    for low, high in ((0.0, head), (head, plate.thickness)):
        x = low + 0.5 * (high - low) * (nodes + 1.0)
        total += 0.5 * (high - low) * plate.density * weights @ plate(x, t).velocity
    assert total == pytest.approx(-plate.peak * plate.decay * np.expm1(-t / plate.decay), rel=1e-8)


layers = st.builds(ElasticLayer, st.floats(10.0, 5000.0), st.floats(1e7, 1e11), st.floats(0.1, 2.0))
ends = st.sampled_from(["wall", "free", "transmitting"])


@given(layers, layers)
def test_coefficients(first, second):
    r, t = reflection(first, second), transmission(first, second)
    assert 1.0 + r == pytest.approx(t, rel=1e-12)  # stress is continuous
    assert (1.0 - r) / first.impedance == pytest.approx(t / second.impedance, rel=1e-9)  # velocity too
    assert reflection(second, first) == pytest.approx(-r, rel=1e-12)
    flux = r**2 / first.impedance + t**2 / second.impedance
    assert flux == pytest.approx(1.0 / first.impedance, rel=1e-9)


def end_time(bar):
    return 7.0 * min(2.0 * bar.first.transit_time, bar.first.transit_time + bar.second.transit_time)


def smooth_pulse(duration, height):
    return lambda t: np.where(t < duration, height * np.sin(np.pi * t / duration) ** 4, 0.0)


@given(layers, layers, ends, shares)
def test_conditions_at_interface_and_ends(first, second, end, share):
    bar = ElasticLayers(first, second, smooth_pulse(first.transit_time, 1e3), end)
    t = share * end_time(bar)
    near, far = first.thickness, first.thickness + second.thickness
    left, right = bar(near * (1 - 1e-9), t), bar(near, t)
    assert float(left.stress) == pytest.approx(float(right.stress), rel=1e-4, abs=1e-3)
    scale = 1e3 / min(first.impedance, second.impedance)
    assert float(left.velocity) == pytest.approx(float(right.velocity), rel=1e-4, abs=1e-6 * scale)
    assert float(bar(0.0, t).stress) == pytest.approx(float(bar.pressure(np.asarray(t))), abs=1e-6)
    last = bar(far, t)
    zero = {"wall": last.velocity * second.impedance, "free": last.stress}.get(
        end, last.stress - second.impedance * last.velocity
    )
    assert abs(float(zero)) < 1e-6


@settings(max_examples=30)
@given(layers, layers, st.sampled_from(["wall", "free"]), st.floats(0.2, 1.0))
def test_energy_stays_after_the_pulse(first, second, end, share):
    duration = first.transit_time
    bar = ElasticLayers(first, second, smooth_pulse(duration, 1e3), end)
    if share * end_time(bar) < duration:
        return
    energies = [total_energy(bar, t) for t in (duration, max(duration, share * end_time(bar)))]
    assert energies[1] == pytest.approx(energies[0], rel=1e-5)


def total_energy(bar, t):
    total = 0.0
    for start, layer in ((0.0, bar.first), (bar.first.thickness, bar.second)):
        cells = 2000 + int(400 * layer.transit_time / bar.first.transit_time)  # 400 points over the pulse
        x = start + layer.thickness * (np.arange(cells) + 0.5) / cells
        fields = bar(x, t)
        total += layer.density * layer.thickness * np.mean(fields.internal_energy + 0.5 * fields.velocity**2)
    return total


@given(layers, layers, shares)
def test_fronts_of_a_step(first, second, share):
    bar = ElasticLayers(first, second, ExponentialPulse(1e3, first.transit_time).pressure, "wall")
    last = first.transit_time + min(first.transit_time, second.transit_time)
    for t in (share * first.transit_time, first.transit_time + share * (last - first.transit_time)):
        for front in bar.jumps(t):
            assert max(front.residuals()) < 1e-8
            shift = 1e-9 * front.coordinate * np.sign(front.front_speed)
            for state, side in ((front.ahead, 1), (front.behind, -1)):
                fields = bar(front.coordinate + side * shift, t)
                assert float(fields.stress) == pytest.approx(state.stress, rel=1e-5, abs=1e-3)
                assert float(fields.velocity) == pytest.approx(state.velocity, rel=1e-5, abs=1e-3 / first.impedance)


def test_step_on_a_wall_doubles():
    layer = ElasticLayer(1000.0, 1e9, 0.5)
    bar = ElasticLayers(layer, layer, lambda t: np.full_like(t, 1e6))
    arrival = 2 * layer.transit_time
    assert float(bar(1.0, 0.999 * arrival).stress) == 0.0
    assert float(bar(1.0, 1.001 * arrival).stress) == pytest.approx(2e6, rel=1e-12)
    free = ElasticLayers(layer, layer, lambda t: np.full_like(t, 1e6), "free")
    assert float(free(1.0, 1.001 * arrival).velocity) == pytest.approx(2e6 / layer.impedance, rel=1e-12)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: TaylorPlate(1000.0, 2e9, 0.0, 1e6, 1e-4), "mass"),
        (lambda: ElasticLayer(1000.0, 1e9, -1.0), "thickness"),
        (lambda: ElasticLayers(*[ElasticLayer(1.0, 1.0, 1.0)] * 2, np.zeros_like, "wobbly"), "right_end"),
        (lambda: ElasticLayers(*[ElasticLayer(1.0, 1.0, 1.0)] * 2, np.zeros_like)(0.5, -1.0), "t"),
    ],
)
def test_invalid_parameters_are_named(make, name):
    with pytest.raises(ValueError, match=rf"{name} = .*must be"):
        make()
