"""Laws of the user's own: from a file, from Python, with history; and those that cannot be run."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest

import hydro1d
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.jit import build
from hydro1d.laws.epph import EPPH
from hydro1d.loads.constant import Constant

SAME_AS_BUILT_IN = '''
from hydro1d import PlateauFoam, positive

class Mine(PlateauFoam):
    """Eq. 39 again."""
    modulus: float = positive("Pa")
    shock_slope: float = positive("s/m")

    def hardening(self, over):
        inverse = 1.0 / (over + self.densification_strain - self.yield_strain)
        extra = self.density * (over / self.shock_slope) ** 2 * inverse
        return extra, (2.0 * self.density / self.shock_slope**2 * over - extra) * inverse
'''
FOAM = {
    "density": 51.6,
    "modulus": 22e6,
    "plateau_stress": 0.8e6,
    "densification_strain": 0.689,
    "shock_slope": 0.00105,
}
DECK = """
[material.foam]
law = "{law}"
density = 51.6
modulus = 22e6
plateau_stress = 0.8e6
densification_strain = 0.689
shock_slope = 0.00105
[[layer]]
material = "foam"
thickness = 1
zones = 60
[left]
type = "pressure"
pulse = "constant"
peak = 3.6e6
[right]
type = "wall"
[time]
end = 2e-3
"""


def deck(tmp_path, law):
    path = tmp_path / "deck.toml"
    path.write_text(DECK.format(law=law))
    return path


def test_a_law_from_a_file_equals_the_built_in(tmp_path):
    (tmp_path / "mine.py").write_text(SAME_AS_BUILT_IN)
    mine = hydro1d.run(deck(tmp_path, "mine.py:Mine"))
    theirs = hydro1d.run(deck(tmp_path, "epph"))
    for name in ("strain", "stress", "velocity"):
        assert np.array_equal(mine[name], theirs[name])


def test_an_edit_of_the_file_takes_effect(tmp_path):
    (tmp_path / "mine.py").write_text(SAME_AS_BUILT_IN)
    before = hydro1d.run(deck(tmp_path, "mine.py:Mine"))
    (tmp_path / "mine.py").write_text(
        SAME_AS_BUILT_IN.replace("over / self.shock_slope", "1.1 * over / self.shock_slope")
    )
    after = hydro1d.run(deck(tmp_path, "mine.py:Mine"))
    assert abs(before["strain"][-1] - after["strain"][-1]).max() > 0.01


class Hardens(hydro1d.Law):
    """A law with history: every bit of first loading stiffens it."""

    modulus: float = hydro1d.positive("Pa")
    history: ClassVar[dict[str, float]] = {"hardness": 1.0, "count": 0.0}

    def point(self, strain, largest, rate, energy, history):
        hardness, count = history
        hardness = max(hardness, 1.0 + largest)
        return self.modulus * hardness * strain, self.modulus, self.modulus * hardness, False, (hardness, count + 1.0)


def test_a_law_with_history_as_a_python_object():
    column = hydro1d.Deck(
        layers=[
            hydro1d.Layer(law=Hardens(density=100.0, modulus=1e7), thickness=0.5, zones=20),
            hydro1d.Layer(law=EPPH(**FOAM), thickness=0.5, zones=20),
        ],
        left=Pressure(pulse=Constant(peak=1e6)),
        right=Wall(),
        end=2e-3,
        output={"profiles": 3},
    )
    run = hydro1d.run(column)
    hardness = run["hardness"]
    assert hardness.shape == (3, 40)
    assert np.isnan(hardness[:, 20:]).all()
    assert (hardness[0, :20] == 1.0).all() and (hardness[-1, :20] > 1.0).all()
    assert hardness[-1, :20] == pytest.approx(1.0 + run["largest_strain"][-1, :20])
    steps = run.attributes["cycles"]
    assert (run["count"][-1, :20] >= steps).all()


@pytest.mark.parametrize("body, says", [
    ("raise RuntimeError('no such thing')", "no such thing"),
    ("return float('nan'), 1e6, 1e6, True, history", "stress is nan"),
    ("return strain * 1e6, -1.0, 1e6, True, history", "must not be negative"),
    ("return strain * 1e6", "point must return"),
    ("return strain * 1e6, 1e6, 1e6, True, (1.0,)", "history must be a tuple of 0"),
    ("return 1.0 / (strain - 0.5), 1e6, 1e6, True, history", "division by zero"),
])  # fmt: skip
def test_a_law_that_cannot_be_run_says_why(tmp_path, body, says):
    (tmp_path / "bad.py").write_text(
        "from hydro1d import Law\nclass Bad(Law):\n    def point(self, strain, largest, rate, energy, history):\n"
        f"        {body}\n"
    )
    text = DECK.format(law="bad.py:Bad")
    text = "\n".join(row for row in text.splitlines() if not row.startswith(("modulus", "plateau", "densif", "shock")))
    path = tmp_path / "deck.toml"
    path.write_text(text)
    with pytest.raises(hydro1d.DeckError, match=says):
        hydro1d.run(path)


@pytest.mark.parametrize("content, law, says", [
    ("x = 1", "bad.py:Mine", "bad.py has no class Mine"),
    ("class Mine: pass", "bad.py:Mine", "not a subclass"),
    ("import no_such_module", "bad.py:Mine", "cannot be loaded"),
    ("def (", "bad.py:Mine", "cannot be loaded"),
    ("x = 1", "gone.py:Mine", "does not exist"),
    ("x = 1", "bad.py", "names no class"),
])  # fmt: skip
def test_a_file_that_cannot_be_used_says_why(tmp_path, content, law, says):
    (tmp_path / "bad.py").write_text(content)
    with pytest.raises(hydro1d.DeckError, match=says):
        hydro1d.load_deck(deck(tmp_path, law))


FOAM_OF_ONES_OWN = """
import math
import numpy as np
from hydro1d import Foam, positive

FACTORS = {{"soft": 1.0}}

class Mine(Foam):
    modulus: float = positive("Pa")
    kind: str = "soft"

    def _curve(self, strain):
        return strain * (1.0 + strain**3)

    def loading(self, strain):
        {body}
"""
SMALL = "[material.foam]\nlaw = 'mine.py:Mine'\ndensity = 50\nmodulus = 2e7\n" + DECK[DECK.index("[[layer]]") :]


def own_foam(tmp_path, body):
    (tmp_path / "mine.py").write_text(FOAM_OF_ONES_OWN.format(body=body))
    path = tmp_path / "deck.toml"
    path.write_text(SMALL)
    return path


compiles = pytest.mark.skipif(build.interpreted(), reason="without a compiler there is nothing that it refuses")


@compiles
@pytest.mark.parametrize("body, says", [
    ("return np.interp(strain, [0.0, 1.0], [0.0, self.modulus]), self.modulus", "it makes an object (a list"),
    ("return (far(strain), 0.0) if strain > 2.0 else (self.modulus * strain, self.modulus)", "'far' is not defined"),
    ("return self.modulus * strain * FACTORS['soft'], self.modulus", "'FACTORS'"),
    ("return self.modulus * strain, self.modulus if self.kind == 'soft' else 0.0", "Unknown attribute 'kind' of type Mine"),
    ("return self.modulus * strain, sum(x for x in (self.modulus, 0.0))", "yield in a closure is unsupported"),
    ("import math; return self.modulus * strain, self.modulus", "IMPORT_NAME"),
    ("return self.modulus * strain, float(f'{self.modulus:.9g}')", "f-strings"),
])  # fmt: skip
def test_what_numba_cannot_compile_is_said_with_its_line(tmp_path, body, says):
    path = own_foam(tmp_path, body)
    with pytest.raises(hydro1d.DeckError) as caught:
        hydro1d.run(path)
    first, line, allowed = str(caught.value).splitlines()
    where = FOAM_OF_ONES_OWN.splitlines().index("        {body}") + 1
    assert (
        first.startswith(f"{tmp_path / 'mine.py'}, line {where}: Mine.loading cannot be compiled: ") and says in first
    )
    assert line.strip() == body
    assert "floats" in allowed
    assert len(first) < 400


@compiles
def test_a_refusal_without_a_line_still_names_the_function(tmp_path):
    path = own_foam(
        tmp_path, "x = np.zeros(int(self.modulus)); return x[int(strain)] + self.modulus * strain, self.modulus"
    )
    with pytest.raises(hydro1d.DeckError, match=r"mine\.py: Mine\.loading cannot be compiled: it makes an object"):
        hydro1d.run(path)


def test_hydro1ds_own_kernels_are_not_blamed_on_anybody(monkeypatch):
    from hydro1d.jit import refusals

    failure = refusals.Failure(test_hydro1ds_own_kernels_are_not_blamed_on_anybody, ValueError("x"))
    assert refusals.explanation(EPPH, [failure]) is None


def test_a_method_may_begin_with_an_underscore(tmp_path):
    run = hydro1d.run(own_foam(tmp_path, "return self.modulus * self._curve(strain), self.modulus"))
    assert run.attributes["status"] == "complete"


@pytest.mark.parametrize("body, says", [
    ("return 0.5 * self.modulus * strain, 0.5 * self.modulus", "loading must begin along the elastic line"),
    ("return 1e5 * math.tanh(3.0 * strain * self.modulus / 1e5), self.modulus", "a slope of .* where the modulus is 2e+"),
    ("return 1e5 * strain**0.5, self.modulus", "loading must begin along the elastic line"),
])  # fmt: skip
def test_a_curve_that_does_not_begin_with_its_modulus_is_refused(tmp_path, body, says):
    with pytest.raises(hydro1d.DeckError, match=says.replace("+", r"\+")):
        hydro1d.load_deck(own_foam(tmp_path, body))


def test_a_rounded_knee_of_the_right_slope_runs(tmp_path):
    body = (
        "e = strain * self.modulus / 1e5; "
        "return 1e5 * math.tanh(e) + 1e8 * strain**6, self.modulus / math.cosh(e) ** 2 + 6e8 * strain**5"
    )
    assert hydro1d.run(own_foam(tmp_path, body)).attributes["status"] == "complete"


def test_a_constant_that_cannot_be_computed_is_named(tmp_path):
    path = own_foam(tmp_path, "return self.modulus * strain, self.modulus")
    source = (tmp_path / "mine.py").read_text().replace("import Foam,", "import Foam, derived,")
    (tmp_path / "mine.py").write_text(source + "\n    @derived\n    def speed(self):\n        return 1.0 / 0.0\n")
    with pytest.raises(hydro1d.DeckError, match="its constant speed cannot be computed: ZeroDivisionError"):
        hydro1d.load_deck(path)


def test_a_law_that_has_no_stress_where_it_would_yield_is_refused():
    text = "[material.foam]\nlaw = 'rph'\ndensity = 50\nmodulus = 1e3\nplateau_stress = 1e6\nhardening = 1e5\n"
    with pytest.raises(hydro1d.DeckError, match="needs a modulus above 1000 Pa"):
        hydro1d.load_deck(text + DECK[DECK.index("[[layer]]") :])
