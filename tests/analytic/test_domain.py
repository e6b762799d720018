"""Every solution at the edges of where it is defined: outside, at the ends, empty, not a number, scalar and array."""

import math

import numpy as np
import pytest

from hydro1d.analytic import (
    EPPH,
    RPPL,
    CladColumn,
    CompactionPulse,
    CompactionStriker,
    Elastic,
    ElasticLayer,
    ElasticLayers,
    EnergyBalanceStriker,
    ExponentialPulse,
    Gas,
    Noh,
    RiemannProblem,
    RPHFoam,
    RPHPiston,
    RPHStriker,
    RPPLPulse,
    RPPLStriker,
    SimpleWave,
    TangentEPPH,
    TaylorPlate,
    ViscousProfile,
    piston,
    pressure_step,
)

RIGID, HARDENING = RPPL(51.6, 0.8e6, 0.689), RPHFoam(51.6, 0.8e6, 1e5)
FOAM, TANGENT = EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105), TangentEPPH(51.6, 22e6, 0.8e6, 0.689, 1.22, 0.603)
BAR = ElasticLayer(1000.0, 4e9, 0.5)
# A solution, its length and its last moment; infinite where there is no such end.
SOLUTIONS = {
    "striker": (RPPLStriker(RIGID, 40.0, 100.0, 1.0), 1.0, 1e-3),
    "short striker": (RPPLStriker(RIGID, 40.0, 100.0, 0.3), 0.3, RPPLStriker(RIGID, 40.0, 100.0, 0.3).locking_time),
    "pulse": (RPPLPulse(RIGID, 3.6e6, 1.53e-3, 1.0), 1.0, 6.885e-3),
    "short pulse": (RPPLPulse(RIGID, 3.6e6, 1.53e-3, 0.5), 0.5, RPPLPulse(RIGID, 3.6e6, 1.53e-3, 0.5).locking_time),
    "R-PH striker": (RPHStriker(HARDENING, 20.0, 120.0, 1.0), 1.0, 3e-3),
    "R-PH piston": (RPHPiston(HARDENING, 120.0, 1.0), 1.0, RPHPiston(HARDENING, 120.0, 1.0).end_time),
    "plate": (CladColumn(RIGID, 15.6, ExponentialPulse(8e6, 1e-3), 2.0), 2.0, None),
    "E-P-P-H pulse": (CompactionPulse(FOAM, 1.0, 3.6e6, 1.53e-3), 1.0, None),
    "E-P-P-H striker": (CompactionStriker(TANGENT, 1.0, 20.0, 100.0), 1.0, None),
    "step": (pressure_step(FOAM, 3.6e6, 1.0), 1.0, None),
    "piston": (piston(TANGENT, 100.0, 1.0), 1.0, None),
    "bars": (ElasticLayers(BAR, BAR, lambda t: 1e6 * np.ones_like(t)), 1.0, 1e-3),
    "Taylor": (TaylorPlate(1000.0, 2.25e9, 30.0, 1e7, 1e-4, 0.6), 0.6, None),
    "Noh": (Noh(length=1.0), 1.0, None),
    "Sod": (RiemannProblem(Gas(1.0, 0.0, 1.0), Gas(0.125, 0.0, 0.1), 0.5), math.inf, 0.2),
    "simple wave": (SimpleWave(1.0, 1.0, 0.15, 0.6, length=1.0), 1.0, None),
    "profile": (ViscousProfile(FOAM, 150.0, 1e-3, 2.0, 2.0), math.inf, 1e-3),
}


@pytest.fixture(params=list(SOLUTIONS))
def solution(request):
    found, length, end = SOLUTIONS[request.param]
    return found, length, found.end_time if end is None else end


def test_a_point_is_an_array_of_points(solution):
    found, length, end = solution
    x, t = np.linspace(0.0, min(length, 1.0), 9), end * np.array([0.0, 0.1, 0.5, 0.9, 1.0])
    fields = found(x[:, None], t)
    for i, j in np.ndindex(9, 5):
        alone = found(float(x[i]), float(t[j]))
        for name, many, one in zip(fields._fields, fields, alone, strict=True):
            assert np.ndim(one) == 0, name
            assert float(one) == pytest.approx(float(np.broadcast_to(many, (9, 5))[i, j]), rel=1e-12), name
            assert math.isfinite(one), name
    assert all(np.shape(values) == (9, 5) for values in fields)
    assert all(np.shape(values) == (2,) for values in found([0.0, 0.1], 0))


def test_no_points_are_no_points(solution):
    found, _, end = solution
    assert all(np.shape(values) == (0,) for values in found(np.array([]), 0.5 * end))
    if hasattr(found, "history"):
        assert all(np.shape(values) == (0,) for values in found.history(np.array([])))


@pytest.mark.parametrize(
    ("name", "coordinate", "t"),
    [("coordinate", math.nan, 0.5), ("t", 0.1, math.nan), ("t", [0.1, 0.2], [0.5, math.nan])],
)
def test_not_a_number_is_never_taken(solution, name, coordinate, t):
    found, _, end = solution
    with pytest.raises(ValueError, match=rf"^{name} = nan is not allowed: {name} must be"):
        found(coordinate, np.multiply(t, end))


def test_outside_is_refused_by_its_first_value(solution):
    found, length, end = solution
    if math.isfinite(length):
        for outside in (-1e-9, 1.001 * length):
            with pytest.raises(ValueError, match=rf"^coordinate = {outside!r} is not allowed"):
                found([0.5 * length, outside], 0.5 * end)
    if not isinstance(found, ViscousProfile):  # a steady front has always run
        with pytest.raises(ValueError, match=r"^t = -1e-09 is not allowed: t must be within \[0, "):
            found(0.1, [0.5 * end, -1e-9])
    if math.isfinite(getattr(found, "end_time", math.inf)):
        with pytest.raises(ValueError, match=r"^t = .* is not allowed: t must be within .* s \(.*\)$"):
            found(0.1, 1.001 * found.end_time)


@pytest.mark.parametrize("share", [1e-12, 1e-10, 1e-8])
@pytest.mark.parametrize("mass", [1e-3, 20.0, 1e6])
@pytest.mark.parametrize(
    "make",
    [
        lambda mass: RPPLStriker(RIGID, mass, 120.0),
        lambda mass: EnergyBalanceStriker(RIGID, mass, 120.0),
        lambda mass: RPHStriker(HARDENING, mass, 120.0),
    ],
)
def test_a_moment_after_the_impact(make, mass, share):
    """The striker has gone v0 t, and what little it has slowed down is known to as many digits."""
    striker = make(mass)
    t = share * striker.stop_time
    now = striker.history(t)
    assert float(now.displacement) == pytest.approx(striker.impact_velocity * t, rel=10.0 * share + 1e-9)


@pytest.mark.parametrize("excess", [1e-12, 1e-6, 1.0, 1e4])
@pytest.mark.parametrize("duration", [1e-9, 1.53e-3, 0.918, 32.4])
def test_a_pulse_is_defined_up_to_its_stop(excess, duration):
    """T P/plateau and the end of stage 2 differ by round-off: the stress at the stop is still that of the plateau."""
    pulse = RPPLPulse(RIGID, RIGID.plateau_stress * (1.0 + excess), duration)
    assert float(pulse.history(pulse.stop_time).front_stress) == pytest.approx(RIGID.plateau_stress, rel=1e-9)
    assert np.isnan(pulse.history(1.001 * pulse.stop_time).front_stress)


def test_more_than_a_curve_can_carry_is_named():
    with pytest.raises(ValueError, match=r"^stress = .* strain 1"):
        pressure_step(Elastic(51.6, 22e6), 23e6)
