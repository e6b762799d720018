"""Figures: what functions return, what they say when they cannot draw."""

import math
import warnings

import matplotlib
import numpy as np
import pytest
import synthetic
from coarse import DECK
from matplotlib.figure import Figure
from synthetic import END, LENGTH, made_run

import hydro1d
from hydro1d import plot
from hydro1d.analysis.fronts import front_path
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.errors import DeckError, FileProblem, Hydro1dError
from hydro1d.laws.elastic import Elastic
from hydro1d.laws.epph import EPPH
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.laws.trilinear import Trilinear
from hydro1d.loads.constant import Constant
from hydro1d.plot._frames import in_laboratory
from hydro1d.plot._histories import extremes
from hydro1d.plot._hugoniot import crossings
from hydro1d.plot._materials import deck_of, hugoniot_of
from hydro1d.plot._units import scale_for

FOAM = EPPH(density=51.6, modulus=22e6, plateau_stress=0.8e6, densification_strain=0.689, shock_slope=0.00105)


@pytest.mark.parametrize("kind", ["profiles", "xt", "history", "hugoniot", "overview"])
def test_every_kind_returns_figure_and_axes(kind):
    figure, axes = getattr(plot, kind)(made_run())
    assert isinstance(figure, Figure)
    for one in np.ravel(np.asarray(axes, dtype=object)):
        assert one.figure is figure
        assert one.get_xlabel() or one.get_ylabel()
    assert any(unit in one.get_ylabel() + one.get_xlabel() for unit in ("(MPa)", "(mm)", "(ms)") for one in figure.axes)


def test_no_pyplot_and_no_global_state():
    import sys

    before = dict(matplotlib.rcParams)
    plot.xt(made_run())
    assert dict(matplotlib.rcParams) == before
    pyplot = sys.modules.get("matplotlib.pyplot")
    assert pyplot is None or not pyplot.get_fignums()


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_formats(tmp_path, ending):
    figure, _ = plot.hugoniot(made_run())
    first = plot.save(figure, tmp_path / f"a.{ending}").read_bytes()
    assert first.startswith({"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[ending])
    if ending != "pdf":
        assert plot.save(plot.hugoniot(made_run())[0], tmp_path / f"b.{ending}").read_bytes() == first


def test_save_refuses_what_it_cannot_write(tmp_path):
    figure, _ = plot.xt(made_run())
    with pytest.raises(DeckError, match=r"\.png, \.svg, \.pdf"):
        plot.save(figure, tmp_path / "a.bmp")
    with pytest.raises(FileProblem, match="cannot write"):
        plot.save(figure, tmp_path / "missing" / "a.png")


def test_units_are_those_people_use_unless_unreadable():
    assert scale_for("Pa", [3.6e6]).unit == "MPa"
    assert scale_for("Pa", [1.0]).unit == "Pa"
    assert scale_for("s", 0.03).unit == "ms"
    assert scale_for("m", [0.0, np.nan, 1.0]).unit == "mm"
    assert scale_for("m s-1", 240.0).label("velocity v") == "velocity v (m/s)"
    assert scale_for("1").label("strain ε") == "strain ε"
    assert scale_for("furlong").unit == "furlong"
    assert scale_for("m", 1.252).show(1.2523, 3) == "1250 mm"
    assert scale_for("1").show(2.5e-7) == "2.5e-07"


def test_fronts_and_mesh_lie_where_the_run_has_them():
    _, axes = plot.xt(made_run())
    front = next(line for line in axes.get_lines() if line.get_label() == "proximal front")
    x, t = front.get_data()
    known = np.isfinite(x)
    assert np.allclose(x[known], 200.0 * t[known])  # mm and ms
    assert axes.get_ylim() == (0.0, 1e3 * END)


def test_laboratory_positions_follow_the_material():
    run = made_run()
    where = np.array([0.5, np.nan])
    found = in_laboratory(run, np.array([END, END]), where)
    assert found[0] == pytest.approx(np.interp(0.5, run["node_coordinate"], run["position"][-1]))
    assert np.isnan(found[1])


def test_a_leaping_front_is_cut_off():
    run = made_run()
    path = run.history["front_position"].copy()
    path[-20:] = [0.1 + 0.04 * (k % 2) for k in range(20)]
    run.history._arrays["front_position"] = path
    assert np.isnan(front_path(run, "front_position")[-18:]).all()


def test_states_in_the_front_lie_between_its_ends():
    found = crossings(made_run())
    assert found
    for crossing in found:
        assert crossing.behind[0] > 0.85 > crossing.ahead[0]


def test_no_rayleigh_line_between_zones_that_have_unloaded():
    """The front of a short pulse dies; later only a crushed block rings, with viscosity in it."""
    deck = (
        DECK.replace('"3.6 MPa"', '"8 MPa"').replace('"1.53 ms"', '"0.2 ms"').replace("profiles = 36", "profiles = 200")
    )
    run = hydro1d.run(deck)
    found = crossings(run)
    assert found
    for crossing in found:
        (far, high), (near, low) = crossing.behind, crossing.ahead
        assert high > low > 0.79e6 and near < 0.5 < far  # from the plateau up, within a fifth per cent of its stress
    assert max(run.time[crossing.profile] for crossing in found) < 2.5e-3


def test_foam_that_opens_does_not_squeeze_the_plane():
    run = made_run()
    strain = run["strain"].copy()
    strain[-1, 3] = -40.0
    run._root._arrays["strain"] = strain
    _, axes = plot.hugoniot(run)
    assert -0.11 < axes.get_xlim()[0] < 0.0


def test_the_applied_pressure_is_drawn_with_its_corners():
    _, axes = plot.history(made_run())
    (line,) = [line for line in axes[0].get_lines() if line.get_label() == "applied pressure"]
    t, p = line.get_data()
    assert line.get_linestyle() == "--" and "its peak" in axes[0].get_legend_handles_labels()[1]
    assert np.allclose(p[t < 1.53], 3.6) and np.allclose(p[t > 1.53], 0.0)
    assert np.diff(t)[np.argmin(np.diff(p))] < 1e-6  # ms: a jump is a jump
    assert all(line.get_label() != "applied pressure" for one in axes[1:] for line in one.get_lines())
    unknown = {**made_run().deck, "left": {**made_run().deck["left"], "pulse": "evil.py:Pulse"}}
    labels = plot.history(made_run(deck=unknown))[1][0].get_legend_handles_labels()[1]
    assert labels == ["left stress", "right stress", "peak of the applied pressure"]


def test_extremes_keep_peaks():
    time = np.linspace(0.0, 1.0, 50_000)
    values = np.sin(time)
    values[12_345], values[33_333] = 99.0, -99.0
    x, y = extremes(time, values, 1000)
    assert len(x) <= 1100 and y.max() == 99.0 and y.min() == -99.0


def test_partial_run_is_drawn_and_named_so():
    figure, _ = plot.profiles(made_run(status="running"))
    assert "partial" in figure._suptitle.get_text()


def test_an_overview_of_little_draws_what_there_is():
    _, axes = plot.overview(made_run(times=1, status="interrupted"))
    told = [one.texts[0].get_text().replace("\n", " ") if one.texts else "" for one in axes.flat]
    assert [bool(text) for text in told] == [True, False, False, True]
    assert told[0].endswith("this figure needs 2 (status: interrupted); profiles and history can be drawn")
    _, axes = plot.overview(made_run(drop=("history",)))
    assert "holds no history" in axes[0, 1].texts[0].get_text()
    with pytest.raises(FileProblem, match="holds no profile"):
        plot.overview(made_run(times=0, drop=("history",)))


def test_a_comparison_says_which_run_is_not_whole():
    _, axes = plot.compare([made_run(), made_run(times=1, status="interrupted")], labels=None)
    assert axes[0].get_legend_handles_labels()[1] == ["A front by formula 1", "A front by formula 2 (interrupted)"]
    assert axes[2].get_ylabel() == "strain ε in the last profile"


@pytest.mark.parametrize(
    ("call", "options", "message"),
    [
        (lambda run: plot.xt(run, "sterss"), {}, "no profiles of 'sterss'; did you mean stress.; it has"),
        (lambda run: plot.profiles(run, times=[1.0]), {}, "not at 1000 ms"),
        (lambda run: plot.history(run, ["right_sterss"]), {}, "right_stress"),
        (lambda run: plot.history(run, ["probes/stress"]), {"drop": ("probes",)}, "has no probes"),
        (lambda run: plot.history(run), {"drop": ("history",)}, "holds no history"),
        (lambda run: plot.profiles(run), {"times": 0}, "holds no profile"),
        (lambda run: plot.xt(run), {"times": 1}, "only 1 profile"),
    ],
)
def test_what_is_not_there_is_said(call, options, message):
    with pytest.raises(FileProblem, match=message):
        call(made_run(**options))


def test_wrong_arguments_are_said():
    with pytest.raises(DeckError, match="lagrangian, laboratory"):
        plot.xt(made_run(), frame="moon")
    with pytest.raises(DeckError, match="from 0 to 79"):
        plot.hugoniot(made_run(), zones=[80])
    with pytest.raises(DeckError, match="no run"):
        plot.compare([])


def test_a_run_with_code_of_its_user_draws_without_running_it():
    deck = {**made_run().deck, "material": {"foam": {"law": "evil.py:Law"}}}
    run = made_run(deck=deck)
    assert deck_of(run) is None
    _, axes = plot.hugoniot(run)
    assert axes.texts[0].get_text().startswith("no curve: the law is code of its user's")
    assert not plot.hugoniot(made_run())[1].texts
    assert "applied pressure" in plot.history(run)[1][0].get_legend_handles_labels()[1]  # the pulse is hydro1d's own


def test_gif_moves(tmp_path):
    from PIL import Image

    with Image.open(plot.animate(made_run(), tmp_path / "a.gif", frames=4, dpi=40)) as film:
        assert film.n_frames == 4


@pytest.mark.parametrize("odd", [np.nan, np.inf])
def test_the_last_state_of_a_breakdown_is_drawn_without_a_word(tmp_path, monkeypatch, odd):
    def broken(*arguments):
        arrays = {name: np.array(values, dtype=float) for name, values in profiles(*arguments).items()}
        for name in ("density",) if odd > 0.0 else arrays:  # full strain, or a state that is not finite
            arrays[name][-1, :5] = odd
        return arrays

    profiles = synthetic._profiles
    monkeypatch.setattr(synthetic, "_profiles", broken)
    run = made_run()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for frame in ("lagrangian", "laboratory"):
            plot.save(plot.xt(run, "density", frame)[0], tmp_path / "xt.png", 30)
            plot.save(plot.profiles(run, ["density"], frame=frame)[0], tmp_path / "profiles.png", 30)
            plot.animate(run, tmp_path / "a.gif", ["density"], frame=frame, frames=2, dpi=30)


def test_film_endings(tmp_path, monkeypatch):
    with pytest.raises(DeckError, match=r"\.gif or \.mp4"):
        plot.animate(made_run(), tmp_path / "a.avi")
    monkeypatch.setattr("shutil.which", lambda name: None)
    with pytest.raises(Hydro1dError, match="ffmpeg"):
        plot.animate(made_run(), tmp_path / "a.mp4")


def test_hugoniot_of_a_law_is_the_theory():
    from hydro1d import analytic

    shock = hugoniot_of(FOAM, 0.95)
    curve = analytic.EPPH(51.6, 22e6, 0.8e6, 0.689, 0.00105)
    exact = analytic.compaction_hugoniot(curve, shock.velocity_jump[[300, -1]])
    assert np.allclose(exact.strain, shock.strain[[300, -1]], rtol=1e-6)
    assert np.allclose(exact.front_speed, shock.front_speed[[300, -1]], rtol=1e-6)
    assert (shock.shock_energy >= shock.curve_energy * (1 - 1e-9)).all()
    assert np.allclose(shock.foot, FOAM.yield_strain)


class Rounded(hydro1d.Foam):
    """A foam with a rounded knee: it leaves the elastic line long before it reaches its plateau."""

    modulus: float = hydro1d.positive("Pa")
    plateau: float = hydro1d.positive("Pa")

    def loading(self, strain):
        share = math.tanh(strain * self.modulus / self.plateau)
        return self.plateau * share + 12e6 * strain**6, self.modulus * (1.0 - share * share) + 72e6 * strain**5


ROUNDED = Rounded(density=80.0, modulus=30e6, plateau=0.5e6)


def test_hugoniot_behind_a_rounded_knee_is_what_the_solver_does():
    pressure, zones = 2e6, 400
    shock = hugoniot_of(ROUNDED, 0.9)
    run = hydro1d.run(
        hydro1d.Deck(
            layers=[hydro1d.Layer(law=ROUNDED, thickness=1.0, zones=zones)],
            left=Pressure(pulse=Constant(peak=pressure)),
            right=Wall(),
            end=1.2e-3,
            output={"profiles": 2},
        )
    )
    time, front = run.history["time"], run.history["front_position"]
    late = time > 0.5e-3
    speed = np.polyfit(time[late], front[late], 1)[0]
    assert run["strain"][-1, 5:30].mean() == pytest.approx(np.interp(pressure, shock.stress, shock.strain), rel=1e-3)
    # The front's start, and its width against a metre of column: 0.4 % at 200 zones, 0.2 % at 400.
    assert speed == pytest.approx(np.interp(pressure, shock.stress, shock.front_speed), rel=5e-3)
    # The fan of waves before the front ends in its foot; a few zones ahead of the front it is still within it.
    ahead = run["strain"][-1, int(front[-1] * zones) + 8]
    assert ahead == pytest.approx(np.interp(pressure, shock.stress, shock.foot), rel=0.1)


def test_a_rounded_knee_is_drawn_to_its_densification():
    axes = plot.law(ROUNDED)[1]
    assert axes[0, 0].get_xlim()[1] > 0.7
    assert axes[1, 0].get_lines()  # a shock is drawn
    assert not hugoniot_of(Elastic(density=1.0, modulus=1e6), 0.5).strain.size


def test_a_front_that_overtakes_the_elastic_wave_runs_into_material_at_rest():
    steep = Trilinear(density=50.0, modulus=2e6, plateau_stress=0.2e6, densification_strain=0.3, locking_modulus=50e6)
    shock = hugoniot_of(steep, 0.9)
    overtaking = shock.stress / shock.strain > steep.modulus
    assert overtaking.any() and not overtaking.all()
    assert (shock.foot[overtaking] == 0.0).all() and np.allclose(shock.foot[~overtaking], steep.yield_strain)


def test_laws_without_a_shock_or_a_curve():
    figure, _ = plot.law(Elastic(density=1.0, modulus=1e6), "elastic")
    assert isinstance(figure, Figure)
    with pytest.raises(DeckError, match="no loading curve"):
        plot.law(IdealGas(density=1.0, gamma=1.4, pressure=1e5), "gas")


def test_a_notebook_shows_the_figure():
    assert plot.xt(made_run())[0]._repr_png_().startswith(b"\x89PNG")
    assert LENGTH == 1.0
