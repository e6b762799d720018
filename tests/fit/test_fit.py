"""Fits: parameters come back, intervals cover them, energy efficiency, what cannot be fitted."""

import numpy as np
import pytest

from hydro1d import analytic, fit, load_deck
from hydro1d.cli import main
from hydro1d.errors import DeckError, FileProblem

TRUE = {"modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689, "beta": 1.22, "gamma": 0.603}
TANGENT = analytic.TangentEPPH(51.6, *TRUE.values())


def measured(curve, noise=0.0, points=300, last=0.92, seed=0):
    strain = np.linspace(0.002, last, points)
    factor = 1.0 + noise * np.random.default_rng(seed).standard_normal(points)
    return fit.MeasuredCurve(strain, curve.stress(strain) * factor)


@pytest.mark.parametrize(
    ("law", "curve"),
    [
        ("epph-tangent", TANGENT),
        ("epph", analytic.EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105)),
        ("trilinear", analytic.Trilinear(51.6, 22e6, 0.8e6, 0.689, 40e6)),
        ("rph", analytic.RPH(51.6, 22e6, 0.8e6, 0.05e6)),
        ("eph", analytic.EPH(51.6, 22e6, 0.8e6, 1e6)),
    ],
)
def test_exact_curves_give_their_parameters_back(law, curve):
    found = fit.fit_curve(measured(curve), law, density=51.6)
    names = {"eph": {"yield_stress": "yield_limit"}}.get(law, {})
    for name, value in found.values.items():
        assert value == pytest.approx(getattr(curve, names.get(name, name)), rel=2e-3), name
    assert found.rms < 1e-3 * 0.8e6


def test_intervals_cover_the_truth_about_as_often_as_they_say():
    hits = []
    for seed in range(8):
        found = fit.fit_curve(measured(TANGENT, noise=0.02, seed=seed))
        hits += [low <= TRUE[name] <= high for name, (low, high) in found.intervals.items()]
    assert np.mean(hits) > 0.75


def test_fragment_is_a_deck(tmp_path):
    fragment = fit.fit_curve(measured(TANGENT), density=51.6).deck_fragment("mine")
    deck = load_deck(
        fragment + '\n[[layer]]\nmaterial = "mine"\nthickness = 1\nzones = 10\n[left]\ntype = "free"\n'
        '[right]\ntype = "wall"\n[time]\nend = 1e-3\n'
    )
    assert deck.layers[0].law.modulus == pytest.approx(22e6, rel=1e-3)
    assert "# density" in fit.fit_curve(measured(TANGENT)).deck_fragment()


def test_energy_efficiency_of_a_plateau_is_the_plateau():
    found = fit.energy_efficiency(measured(TANGENT))
    assert found.plateau_stress == pytest.approx(0.8e6, rel=0.02)
    assert found.densification_strain == pytest.approx(0.689, abs=0.02)
    assert found.complete
    assert not fit.energy_efficiency(measured(TANGENT, last=0.5)).complete


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: fit.fit_curve(measured(TANGENT), "epph"), "density"),
        (lambda: fit.fit_curve(measured(TANGENT), "nonsense"), "there are epph-tangent"),
        (lambda: fit.fit_curve(measured(TANGENT, points=5)), "10 at least"),
        (lambda: fit.fit_curve(fit.MeasuredCurve(np.linspace(0, 60, 50), np.ones(50))), "%"),
        (lambda: fit.fit_curve(fit.MeasuredCurve(np.linspace(0, 0.6, 50), -np.ones(50))), "compression"),
    ],
)
def test_what_cannot_be_fitted_is_said(call, message):
    with pytest.raises(DeckError, match=message):
        call()


def test_files(tmp_path):
    with pytest.raises(FileProblem, match="no such file"):
        fit.read_curve(tmp_path / "none.csv")
    bad = tmp_path / "bad.csv"
    bad.write_text("strain,stress\n0.1,1\n0.05,2\n")
    with pytest.raises(DeckError, match="increase"):
        fit.read_curve(bad)


def test_commands(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    curve = measured(TANGENT, noise=0.01)
    rows = [f"{e:.6f},{s / 1e6:.6f}" for e, s in zip(*curve, strict=True)]
    (tmp_path / "foam.csv").write_text("\n".join(["strain,stress (MPa)", *rows]))
    assert main(["laws", "fit", "foam.csv", "--law", "epph-tangent", "--density", "51.6 kg/m^3"]) == 0
    out = capsys.readouterr().out
    assert "[material.foam]" in out and "95 % confidence" in out and "by energy efficiency" in out
    assert (tmp_path / "foam-epph-tangent.png").read_bytes().startswith(b"\x89PNG")
    assert main(["laws", "fit", "foam.csv", "--density", "-3"]) == 2
    assert main(["laws", "fit", "nix.csv"]) == 4
    assert main(["laws", "epph", "more"]) == 2
    assert main(["laws", "plot", "nix.toml"]) == 4
    err = capsys.readouterr().err
    assert "Traceback" not in err


def test_laws_plot(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "blast"]) == 0
    capsys.readouterr()
    assert main(["laws", "plot", "blast.toml", "--material", "stiff", "--dpi", "40"]) == 0
    assert capsys.readouterr().out == "blast-stiff.png\n"
    assert main(["laws", "plot", "blast.toml", "--dpi", "40"]) == 0  # an elastic plate
    assert main(["laws", "plot", "blast.toml", "--material", "jelly"]) == 2
    assert "plate, soft, stiff" in capsys.readouterr().err
