"""Pressure steps and pistons: jump conditions, the curve itself, zones, overtaking, limits."""

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
    compaction_hugoniot,
    piston,
    pressure_step,
    stiff_eppr,
    stiff_rppl,
)
from hydro1d.analytic.jumps import absorbed_energy, density, shock_speed, stress_jump

ROHACELL = EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105)


@st.composite
def curves(draw):
    rho = draw(st.floats(20.0, 500.0))
    plateau = draw(st.floats(0.1e6, 5e6))
    modulus = plateau * draw(st.floats(12.0, 500.0))
    locking = draw(st.floats(0.3, 0.85))
    kind = draw(st.sampled_from(["epph", "tangent", "trilinear", "rppl", "eppr", "eph", "rph", "table", "elastic"]))
    return {
        "epph": lambda: EPPH(rho, modulus, plateau, locking, (1 - locking) / np.sqrt(11 * plateau / rho)),
        "tangent": lambda: TangentEPPH(rho, modulus, plateau, locking, draw(st.floats(0.3, 3.0)), 0.6),
        "trilinear": lambda: Trilinear(rho, modulus, plateau, locking, plateau * draw(st.floats(90.0, 500.0))),
        "rppl": lambda: stiff_rppl(rho, plateau, locking, 400 * plateau),
        "eppr": lambda: stiff_eppr(rho, modulus, plateau, locking, 1000 * plateau),
        "eph": lambda: EPH(rho, 30 * modulus, plateau, modulus * draw(st.floats(1.5, 10.0))),
        "rph": lambda: RPH(rho, 2 * modulus, plateau, plateau * draw(st.floats(0.1, 0.5))),
        "table": lambda: Table(
            rho, modulus, (plateau / modulus, 0.4, 0.6, 0.7), (plateau, 1.1 * plateau, 1.5 * plateau, 12 * plateau)
        ),
        "elastic": lambda: Elastic(rho, 200 * plateau),
    }[kind](), plateau


@given(curves(), st.floats(0.2, 10.0))
def test_pressure_step_obeys_jumps_and_curve(made, over):
    curve, plateau = made
    pressure = min(over * plateau, 0.95 * float(curve.stress(curve.strain_limit)))
    check(pressure_step(curve, pressure), curve)
    assert pressure_step(curve, pressure).states[-1].stress == pytest.approx(pressure, rel=1e-10)


@given(curves(), st.floats(0.05, 2.5))
def test_piston_obeys_jumps_and_curve(made, share):
    curve, plateau = made
    velocity = share * np.sqrt(plateau / curve.density)
    check(piston(curve, velocity), curve)
    assert piston(curve, velocity).states[-1].velocity == pytest.approx(velocity, rel=1e-10)


def check(solution, curve):
    fronts = solution.jumps(1e-3)
    assert max(max(front.residuals()) for front in fronts) < 1e-10
    speeds = [front.front_speed for front in fronts]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[0] == pytest.approx(curve.elastic_speed, rel=1e-9) or solution.overtaken
    assert solution.states[0][:3] == (0.0, 0.0, 0.0)
    for state in solution.states:
        assert state.stress == pytest.approx(float(curve.stress(state.strain)), rel=1e-10)
        assert state.density * (1.0 - state.strain) == pytest.approx(curve.density, rel=1e-10)
    for front in fronts:  # entropy: between its ends the curve lies nowhere above the Rayleigh line
        strains = np.linspace(front.ahead.strain, front.behind.strain, 201)
        line = front.ahead.stress + (front.stress / front.strain) * (strains - front.ahead.strain)
        assert np.all(curve.stress(strains) <= line + 1e-9 * front.behind.stress)


@pytest.mark.parametrize("loading", [pressure_step(ROHACELL, 2.4e6, 1.0), piston(ROHACELL, 150.0, 1.0)])
def test_fields_are_the_states_of_the_zones(loading):
    t = 0.9e-3
    crushed, precursor = (front.coordinate for front in reversed(loading.jumps(t)))
    x = np.array([0.0, crushed - 1e-9, crushed + 1e-9, precursor - 1e-9, precursor + 1e-9, 1.0])
    fields = loading(x, t)
    rest, yielded, final = loading.states
    expected = [final, final, yielded, yielded, rest, rest]
    for name in fields._fields:
        np.testing.assert_array_equal(getattr(fields, name), [getattr(state, name) for state in expected])
    assert loading(x[:, None], np.array([0.0, t])[None, :]).stress.shape == (6, 2)
    assert np.all(loading(x, 0.0).stress == 0.0)


def test_total_momentum_and_energy_of_the_column():
    """Momentum is the impulse of the pressure, energy its work: catches a front at the wrong place."""
    solution, t = pressure_step(ROHACELL, 3.6e6, 1.0), 1.2e-3
    edges = [0.0, *[front.coordinate for front in reversed(solution.jumps(t))]]
    zones = list(zip(np.diff(edges), reversed(solution.states[1:]), strict=True))
    momentum = sum(51.6 * width * state.velocity for width, state in zones)
    energy = sum(51.6 * width * (state.internal_energy + 0.5 * state.velocity**2) for width, state in zones)
    assert momentum == pytest.approx(3.6e6 * t, rel=1e-12)
    assert energy == pytest.approx(3.6e6 * solution.states[-1].velocity * t, rel=1e-12)


def test_numbers_of_the_paper():
    precursor, front = pressure_step(ROHACELL, 3.6e6).jumps()
    assert precursor.front_speed == pytest.approx(652.96, abs=0.005)
    assert precursor.velocity == pytest.approx(23.744, abs=0.0005)
    assert front.velocity == pytest.approx(218.81, abs=0.012)
    assert front.behind.strain == pytest.approx(0.9188, abs=0.00005)
    assert 1.53e-3 * front.laboratory_speed == pytest.approx(0.4019, abs=0.00006)
    assert 1.53e-3 * front.mass_rate == pytest.approx(19.58, abs=0.005)
    assert float(ROHACELL.stress(1.0)) == pytest.approx(5.5e6, abs=0.05e6)


def test_end_of_equation_39():
    fastest = (1.0 - 0.689) / 0.00105
    assert fastest == pytest.approx(296.0, abs=0.5)
    assert float(compaction_hugoniot(ROHACELL, fastest).strain) == pytest.approx(1.0, abs=1e-12)
    with pytest.raises(ValueError, match="velocity_jump"):
        compaction_hugoniot(ROHACELL, 1.01 * fastest)


@given(st.floats(1.0, 290.0))
def test_hugoniot_of_epph_is_linear_and_of_any_curve_obeys_equations_35_and_37(jump):
    linear = compaction_hugoniot(ROHACELL, jump)
    assert float(linear.strain) == pytest.approx(0.689 + 0.00105 * jump, rel=1e-10)
    for curve in (ROHACELL, TangentEPPH(51.6, 22e6, 0.8e6, 0.689, 1.22, 0.603)):
        state = compaction_hugoniot(curve, np.array([jump]))
        change = state.strain - curve.yield_strain
        np.testing.assert_allclose(state.stress, curve.stress(state.strain), rtol=1e-12)
        np.testing.assert_allclose(state.stress - 0.8e6, stress_jump(51.6, jump, change), rtol=1e-10)
        np.testing.assert_allclose(state.shock_speed, shock_speed(curve.yield_strain, jump, change), rtol=1e-12)
        np.testing.assert_allclose(state.absorbed_energy, absorbed_energy(0.8e6, state.stress, change), rtol=1e-12)
        from_density = state.shock_speed * (1.0 - density(51.6, curve.yield_strain) / density(51.6, state.strain))
        np.testing.assert_allclose(from_density, jump, rtol=1e-12)


def test_hugoniot_refuses_a_shock_that_splits():
    hat = Table(50.0, 20e6, (0.05, 0.2, 0.8), (1e6, 3e6, 3.5e6))
    assert len(pressure_step(hat, 3.4e6).jumps()) == 3
    with pytest.raises(ValueError, match="curve"):
        compaction_hugoniot(hat, 250.0)


def test_front_that_would_overtake_the_precursor_is_one_shock_from_rest():
    soft = Trilinear(100.0, 5e6, 1e6, 0.6, 400e6)
    below, above = pressure_step(soft, 2.5e6), pressure_step(soft, 4e6)
    assert (below.overtaken, above.overtaken) == (False, True)
    (shock,) = above.jumps()
    assert shock.front_speed > soft.elastic_speed
    assert shock.ahead.stress == 0.0
    assert shock.velocity == pytest.approx(np.sqrt(4e6 * above.final_strain / 100.0), rel=1e-12)
    assert piston(soft, shock.velocity).overtaken


def test_linear_hardening_gives_a_plastic_wave_and_dissipates_nothing():
    curve = EPH(50.0, 20e6, 1e6, 2e6)
    precursor, plastic = pressure_step(curve, 1.5e6).jumps()
    assert plastic.front_speed == pytest.approx(curve.plastic_speed, rel=1e-12)
    assert plastic.front_speed == pytest.approx(np.sqrt(2e6 / 50.0), rel=1e-12)
    absorbed = precursor.absorbed_energy + plastic.absorbed_energy
    assert absorbed == pytest.approx(curve.area(plastic.behind.strain), rel=1e-12)


def test_a_shock_absorbs_more_than_the_area_under_the_curve():
    front = pressure_step(ROHACELL, 3.6e6).jumps()[1]
    area = ROHACELL.area(front.behind.strain) - ROHACELL.area(front.ahead.strain)
    assert front.absorbed_energy > 1.5 * area


@pytest.mark.parametrize("stiffness", [1e4, 1e6, 1e8])
def test_stiff_limit_is_the_rigid_formula(stiffness):
    """Eq. 25 as K grows; the distance falls as K^(-1/2)."""
    rho, plateau, locking, pressure = 51.6, 0.8e6, 0.689, 3.6e6
    curve = stiff_rppl(rho, plateau, locking, stiffness * plateau)
    rigid = np.sqrt(locking * (pressure - plateau) / rho)
    difference = pressure_step(curve, pressure).states[-1].velocity / rigid - 1.0
    assert 0.0 < difference < 1.1 / np.sqrt(stiffness)


def test_weak_shock_limit():
    """As P falls to the plateau the front slows and stops."""
    speeds = [pressure_step(ROHACELL, 0.8e6 * (1 + 10.0**-k)).jumps()[1].front_speed for k in (2, 4, 6, 8)]
    ratios = np.array(speeds[:-1]) / np.array(speeds[1:])
    np.testing.assert_allclose(ratios, 10.0, rtol=0.12)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: pressure_step(ROHACELL, -1.0), "pressure"),
        (lambda: pressure_step(ROHACELL, 9e6), "stress"),
        (lambda: piston(ROHACELL, 0.0), "velocity"),
        (lambda: piston(ROHACELL, 500.0), "velocity"),
        (lambda: piston(ROHACELL, 50.0, length=-1.0), "length"),
        (lambda: piston(ROHACELL, 50.0, length=1.0)(0.5, 1.6e-3), "t"),
        (lambda: piston(ROHACELL, 50.0, length=1.0)(1.5, 1e-3), "coordinate"),
    ],
)
def test_invalid_parameters_are_named(call, name):
    with pytest.raises(ValueError, match=rf"{name} = .*must be"):
        call()
