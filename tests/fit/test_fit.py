"""Fits: parameters come back, intervals cover them, energy efficiency, what cannot be fitted."""

import re

import numpy as np
import pytest

from hydro1d import analytic, fit, load_deck
from hydro1d.cli import main
from hydro1d.errors import DeckError, FileProblem
from hydro1d.laws.table import Table

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


def rising(points, noise=0.0, yielded=0.4e6, rise=1.8e6, peak=0.0, seed=0):
    """Elastic line, a plateau that rises from `yielded` by `rise` per strain to 0.6, densification beyond."""
    strain = np.linspace(0.0, 0.9, points)[1:]
    plateau = yielded + rise * np.minimum(strain, 0.6) + peak * np.exp(-(((strain - 0.05) / 0.02) ** 2))
    stress = np.minimum(22e6 * strain, plateau + 60e6 * np.maximum(strain - 0.6, 0.0) ** 2 / (1.0 - strain))
    return fit.MeasuredCurve(strain, stress * (1.0 + noise * np.random.default_rng(seed).standard_normal(points - 1)))


@pytest.mark.parametrize("points, noise", [(12, 0.0), (30, 0.0), (300, 0.0), (3000, 0.0), (30, 0.05), (300, 0.05)])
@pytest.mark.parametrize(
    "yielded, rise, peak", [(0.8e6, 0.0, 0.0), (0.8e6, 0.5e6, 0.0), (0.4e6, 1.8e6, 0.0), (0.8e6, 0.1e6, 0.5e6)]
)
def test_energy_efficiency_of_a_rising_plateau_is_its_mean(points, noise, yielded, rise, peak):
    found = fit.energy_efficiency(rising(points, noise, yielded, rise, peak))
    # Densification sets in at 0.6, and its foot is flat. Of twelve points one lies every 0.08 of strain.
    assert 0.6 - max(0.9 / points, 0.02) < found.densification_strain < 0.65
    mean = yielded + rise * 0.5 * (found.yield_strain + found.densification_strain)
    assert found.plateau_stress == pytest.approx(
        mean, rel=0.05
    )  # the foot, the knee and the peak's flank are in the mean
    assert found.yield_strain < 0.09 and found.complete


def test_a_curve_without_a_knee_is_averaged_from_its_beginning():
    strain = np.linspace(0.0, 0.7, 100)
    found = fit.energy_efficiency(fit.MeasuredCurve(strain, 1e6 * strain))
    assert found.yield_strain == 0.0 and not found.complete
    assert found.plateau_stress == pytest.approx(0.35e6, rel=1e-6)


@pytest.mark.parametrize("law", fit.fittable())
def test_every_law_finds_a_start_on_a_rising_plateau(law):
    found = fit.fit_curve(rising(30), law, density=51.6)
    assert found.relative_rms < 0.5


def test_a_law_of_another_shape_than_the_curve_is_said():
    assert any('law = "table"' in text for text in fit.fit_curve(rising(300)).warnings())
    assert not any('law = "table"' in text for text in fit.fit_curve(measured(TANGENT, noise=0.02)).warnings())


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: fit.fit_curve(measured(TANGENT), "epph"), "density"),
        (lambda: fit.fit_curve(measured(TANGENT), "nonsense"), "there are epph-tangent"),
        (lambda: fit.fit_curve(measured(TANGENT, points=5)), "8 at least"),
        (lambda: fit.fit_curve(fit.MeasuredCurve(np.linspace(0, 60, 50), np.ones(50))), "%"),
        (lambda: fit.fit_curve(fit.MeasuredCurve(np.linspace(0, 0.6, 50), -np.ones(50))), "compression"),
    ],
)
def test_what_cannot_be_fitted_is_said(call, message):
    with pytest.raises(DeckError, match=message):
        call()


def written(path, curve, head, separator=",", decimal=".", scale=(1.0, 1e-6), encoding="utf-8"):
    rows = [
        f"{e * scale[0]:.6f}{separator}{s * scale[1]:.6f}".replace(".", decimal) for e, s in zip(*curve, strict=True)
    ]
    path.write_text("\n".join([head, *rows]), encoding=encoding)
    return path


def test_files(tmp_path):
    with pytest.raises(FileProblem, match="no such file"):
        fit.read_curve(tmp_path / "none.csv")
    with pytest.raises(FileProblem, match="a folder"):
        fit.read_curve(tmp_path)
    bad = written(tmp_path / "bad.csv", fit.MeasuredCurve(np.linspace(0.9, 0.0, 40), np.full(40, 1e6)), "strain,stress")
    with pytest.raises(DeckError, match="does not rise at 39 of 40"):
        fit.read_curve(bad)


@pytest.mark.parametrize(
    "form",
    [
        {"head": "Dehnung [%];Spannung [N/mm²]", "separator": ";", "decimal": ",", "scale": (100.0, 1e-6), "encoding": "cp1252"},
        {"head": "strain\tstress [kPa]", "separator": "\t", "decimal": ",", "scale": (1.0, 1e-3)},
        {"head": "strain [MPa],stress", "options": {"strain_unit": "%", "stress_unit": "MPa"}, "scale": (100.0, 1e-6)},
        {"head": "strain,stress [MPa]", "scale": (-1.0, -1e-6)},
    ],
)  # fmt: skip
def test_curves_as_machines_write_them(tmp_path, form):
    options = form.pop("options", {})
    exact = measured(TANGENT)
    found = fit.read_measured(written(tmp_path / "c.csv", exact, **form), **options).curve
    assert np.allclose(found.strain, exact.strain, atol=1e-6) and np.allclose(found.stress, exact.stress, atol=2.0)


def test_a_curve_without_its_elastic_part(tmp_path):
    loading = measured(TANGENT)
    strain, stress = np.insert(loading.strain[20:], 0, 0.0), np.insert(loading.stress[20:], 0, 0.8e6)
    plateau = fit.MeasuredCurve(strain, stress)
    found = fit.read_measured(written(tmp_path / "c.csv", plateau, "strain,stress [MPa]"))
    assert len(found.curve.strain) == len(loading.strain) - 20
    assert found.notes == ("left out: the stress of 0.8 MPa at strain 0, where every law begins with none",)


def test_what_is_assumed_of_a_file_is_said(tmp_path):
    path = tmp_path / "c.csv"
    loading = measured(TANGENT)
    unloading = fit.MeasuredCurve(np.linspace(0.9, 0.8, 30), np.linspace(3e6, 0.0, 30))
    both = fit.MeasuredCurve(*(np.concatenate(pair) for pair in zip(loading, unloading, strict=True)))
    found = fit.read_measured(written(path, both, "strain,stress", scale=(1.0, 1.0)))
    assert np.allclose(found.curve.strain, loading.strain, atol=1e-6)
    assert "left out: 30 of 330 points" in found.notes[0] and "taken as Pa (largest: 4" in found.notes[1]
    assert fit.read_measured(written(path, loading, "strain,stress [MPa]")).notes == ()
    with pytest.raises(DeckError, match=r"4\.0.* too small for Pa; is it MPa.*--stress-unit MPa"):
        fit.read_measured(written(path, loading, "strain,stress"))
    with pytest.raises(DeckError, match="--strain-unit %"):
        fit.read_measured(written(path, loading, "strain,stress [MPa]", scale=(100.0, 1e-6)))


@pytest.mark.parametrize(
    ("curve", "law", "doubtful"),
    [
        (measured(TANGENT, noise=0.02), "epph-tangent", set()),
        (measured(TANGENT, noise=0.02), "trilinear", set()),
        (measured(TANGENT, noise=0.02, last=0.5), "trilinear", {"densification_strain", "locking_modulus"}),
        (measured(TANGENT, noise=0.02, last=0.5), "epph-tangent", {"densification_strain", "beta", "gamma"}),
        (measured(TANGENT, noise=0.02, last=0.5), "rph", {"hardening"}),
        (measured(analytic.RPH(51.6, 22e6, 0.8e6, 0.05e6)), "epph-tangent", {"gamma"}),
    ],
)
def test_what_the_curve_does_not_say_is_named(curve, law, doubtful):
    found = fit.fit_curve(curve, law)
    assert {*found.undetermined, *found.at_bound} == doubtful
    for name, (low, high) in found.intervals.items():
        assert np.isfinite([low, high]).all() == (name not in doubtful)
        assert sum(bool(re.search(rf"\b{name}\b", text)) for text in found.warnings()) == (name in doubtful)
        line = next(line for line in found.deck_fragment().splitlines() if line.startswith(f"{name} = "))
        assert line.endswith(found.doubt(name).removeprefix("none: ") or line)


def test_a_modulus_without_an_elastic_part_is_undetermined():
    strain = np.linspace(0.1, 0.92, 200)
    noise = 1.0 + 0.02 * np.random.default_rng(1).standard_normal(200)
    found = fit.fit_curve(fit.MeasuredCurve(strain, TANGENT.stress(strain) * noise))
    assert "modulus" in found.undetermined and "densification_strain" not in found.undetermined


def test_commands(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    curve = measured(TANGENT, noise=0.01)
    rows = [f"{e:.6f},{s / 1e6:.6f}" for e, s in zip(*curve, strict=True)]
    (tmp_path / "foam.csv").write_text("\n".join(["strain,stress (MPa)", *rows]))
    assert main(["laws", "fit", "foam.csv", "--law", "epph-tangent", "--density", "51.6 kg/m^3"]) == 0
    out = capsys.readouterr().out
    assert "[material.foam]" in out and "95 % confidence" in out and "by energy efficiency" in out
    assert (tmp_path / "foam-epph-tangent.png").read_bytes().startswith(b"\x89PNG")
    (tmp_path / "plain.csv").write_text("\n".join(rows))
    assert main(["laws", "fit", "plain.csv"]) == 2
    assert main(["laws", "fit", "plain.csv", "--stress-unit", "Mpa"]) == 2
    assert main(["laws", "fit", "plain.csv", "--law", "ephp"]) == 2
    assert main(["laws", "fit", "plain.csv", "--stress-unit", "MPa"]) == 0
    assert main(["laws", "fit", "foam.csv", "--law", "trilinear", "--max-strain", "0.5"]) == 0
    assert "note: densification_strain and locking_modulus went to the end" in capsys.readouterr().out
    assert main(["laws", "fit", "."]) == 4
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


def noisy_with_tail(points=400, noise=0.02, seed=5):
    """A rising plateau with scatter, and an unloading at the end: strain, stress in Pa."""
    curve = rising(points, noise, yielded=0.8e6, rise=0.4e6, seed=seed)
    strain = np.concatenate([curve.strain, np.linspace(0.9, 0.85, 20)[1:]])
    return fit.MeasuredCurve(strain, np.concatenate([curve.stress, np.linspace(curve.stress[-1], 0.0, 20)[1:]]))


@pytest.mark.parametrize(
    "points, noise, peak", [(12, 0.0, 0.0), (30, 0.03, 0.0), (300, 0.0, 0.5e6), (300, 0.05, 0.0), (3000, 0.03, 0.5e6)]
)
def test_a_measured_curve_becomes_a_table_that_the_law_takes(points, noise, peak):
    curve = rising(points, noise, yielded=0.8e6, rise=0.4e6, peak=peak)
    exact = rising(points, 0.0, yielded=0.8e6, rise=0.4e6, peak=peak)
    found = fit.tabulate(curve)
    law = Table(density=50.0, modulus=found.modulus, curve=tuple(map(tuple, found.points.tolist())))
    assert len(found.points) <= min(points, 100)
    for strain in np.linspace(0.001, 0.89, 50):
        assert law.loading(strain)[0] == pytest.approx(float(found.stress(strain)), rel=1e-9)
    # A table has no falls: over a peak and its flank it is a level between them. Elsewhere it is the curve without noise.
    beyond = curve.strain > 0.15
    off = np.abs(found.stress(exact.strain) - exact.stress)[beyond] / np.hypot(0.9e6, exact.stress)[beyond]
    assert np.sqrt(np.mean(off**2)) < 0.01 + 0.5 * noise
    # What the noise of a few points makes of a slope is no matter of the method.
    assert noise > 0.0 or points < 100 or found.modulus == pytest.approx(22e6, rel=0.02)


def test_the_energy_of_a_peak_is_kept_in_a_table():
    curve = rising(300, 0.0, yielded=0.8e6, rise=0.1e6, peak=0.5e6)
    table, before = fit.tabulate(curve), curve.strain <= 0.4
    energies = [
        np.trapezoid(stress[before], curve.strain[before]) for stress in (table.stress(curve.strain), curve.stress)
    ]
    assert energies[0] == pytest.approx(energies[1], rel=0.02)


def test_a_table_on_the_command_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    written(tmp_path / "raw.csv", noisy_with_tail(), "strain [%],stress [MPa]", scale=(100.0, 1e-6))
    assert main(["laws", "fit", "raw.csv", "--table", "foam.csv", "--density", "50"]) == 0
    out = capsys.readouterr().out
    assert (
        "note: left out: 19 of 418 points" in out
        and "table: foam.csv, " in out
        and (tmp_path / "raw-table.png").exists()
    )
    fragment = out[out.index("[material.foam]") :]
    column = '[[layer]]\nmaterial = "foam"\nthickness = 1\nzones = 10\n'
    rest = f'\n{column}[left]\ntype = "free"\n[right]\ntype = "wall"\n[time]\nend = 1e-3\n'
    deck = load_deck(fragment + rest, folder=tmp_path)
    assert deck.layers[0].law.curve[-1][1] > 10e6 and deck.notes == ()
    raw = fragment.replace("foam.csv", "raw.csv")
    with pytest.raises(
        DeckError, match=r"must increase strictly; hydro1d laws fit CURVE\.csv --table FILE\.csv makes such a curve"
    ):
        load_deck(raw + rest, folder=tmp_path)


@pytest.mark.parametrize("target, code, says", [
    ("raw.csv", 4, "it is the measured curve"),
    ("/nowhere/at/all.csv", 4, "No such file"),
    ("result.h5", 4, "a result"),
])  # fmt: skip
def test_a_table_destroys_nothing(tmp_path, monkeypatch, capsys, target, code, says):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "result.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    before = written(tmp_path / "raw.csv", rising(100), "strain,stress [MPa]").read_bytes()
    assert main(["laws", "fit", "raw.csv", "--table", target]) == code
    assert says in capsys.readouterr().err
    assert (tmp_path / "raw.csv").read_bytes() == before


def test_a_curve_that_makes_no_table_says_why():
    strain = np.linspace(0.01, 0.8, 50)
    with pytest.raises(DeckError, match="no table can be made of this curve: "):
        fit.tabulate(fit.MeasuredCurve(strain, 1e6 - 1e7 * strain))  # mostly tension
    with pytest.raises(DeckError, match="no stress above zero"):
        fit.tabulate(fit.MeasuredCurve(strain, -strain))


@pytest.mark.parametrize("exponent", [0.5, 1.0, 2.0])
def test_a_curve_without_a_plateau_becomes_a_table_too(exponent):
    strain = np.linspace(0.0, 0.9, 200)
    stress = 1e6 * strain**exponent
    found = fit.tabulate(fit.MeasuredCurve(strain, stress))
    assert np.abs(found.stress(strain) - stress)[45:].max() < 0.02e6  # behind the elastic line


def test_a_table_of_a_curve_without_its_elastic_part_says_so():
    curve = rising(300)
    beyond = curve.strain > 0.05
    assert not any("elastic" in note for note in fit.tabulate(curve).notes)
    (note,) = fit.tabulate(fit.MeasuredCurve(curve.strain[beyond], curve.stress[beyond])).notes
    assert "hardly a point on its elastic line" in note


def test_noise_does_not_make_steps_in_a_table():
    found = fit.tabulate(rising(400, 0.02, yielded=0.8e6, rise=0.4e6, seed=5))
    plateau = found.points[(found.points[:, 0] > 0.05) & (found.points[:, 0] < 0.6)]
    assert len(plateau) < 8  # without noise 2
    assert len(found.points) < 25


def test_what_a_machine_writes_above_the_header_is_named(tmp_path):
    rows = "\n".join(f"{e:.4f};{s / 1e6:.4f}" for e, s in zip(*rising(30), strict=True))
    path = tmp_path / "machine.csv"
    path.write_text(f"Sample;3\nstrain;stress [MPa]\n{rows}\n")
    with pytest.raises(
        DeckError, match=r"line 1: 'Sample' is not a number.* only a header and a row of units may stand"
    ):
        fit.read_curve(path)
    path.write_text(f"# Sample;3\nstrain;stress [MPa]\n{rows}\n0.9;x\n")
    with pytest.raises(DeckError, match="line 32: 'x") as caught:
        fit.read_curve(path)
    assert "header" not in str(caught.value)
