"""Whatever a function reaches, an edit of it takes effect, in this process and in the next; what cannot be kept is said."""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import questions

from hydro1d.jit import build, cache, reach
from hydro1d.laws.elastic import Elastic

compiles = pytest.mark.skipif(build.interpreted(), reason="without a compiler nothing is compiled")
pytestmark = compiles


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HYDRO1D_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(build, "_addresses", {})
    monkeypatch.setattr(build, "_noted", set())
    questions.write(tmp_path)
    return tmp_path


def in_another_process(folder, *names):
    environment = dict(os.environ, PYTHONPATH=str(Path(__file__).parents[2]))
    command = [sys.executable, questions.__file__, str(folder), *names]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def plain(folder, *names):
    module = questions.questions(folder)
    return {name: getattr(module, name)(questions.X) for name in names}


def test_an_edit_takes_effect_within_one_process_and_in_the_next(folder):
    every = (*questions.LAST, *questions.PERISH)
    before = plain(folder, *every)
    module = questions.questions(folder)
    here = {name: questions.said(getattr(module, name)) for name in every}
    assert here == pytest.approx(before, rel=1e-13)
    there = in_another_process(folder, *questions.LAST)
    assert there == {"answers": {name: here[name] for name in questions.LAST}, "notes": [], "compiled": False}

    questions.write(folder, "1.5", "2.5")
    after = plain(folder, *every)
    assert not [name for name in every if math.isclose(after[name], before[name])]
    module = questions.questions(folder)
    assert {name: questions.said(getattr(module, name)) for name in every} == pytest.approx(after, rel=1e-13)
    there = in_another_process(folder, *questions.LAST)
    assert there["answers"] == pytest.approx({name: after[name] for name in questions.LAST}, rel=1e-13)
    assert not there["compiled"]

    questions.write(folder)
    module = questions.questions(folder)
    assert {name: questions.said(getattr(module, name)) for name in every} == here


def test_what_cannot_be_kept_works_in_every_process_and_says_so(folder):
    known = plain(folder, *questions.PERISH)
    first, second = (in_another_process(folder, *questions.PERISH) for _ in range(2))
    assert first == second and first["compiled"]
    assert first["answers"] == pytest.approx(known, rel=1e-13)
    assert len(first["notes"]) == len(questions.PERISH)
    for note, (owner, why) in zip(
        first["notes"],
        [("large", "an address"), ("gamma", "numba_gamma"), ("exponent", "numba_"), ("foreign", "_FuncPtr called j0")],
        strict=True,
    ):
        assert note.startswith(f"{owner} is compiled anew in every run") and why in note
    assert not list((folder / "cache").glob("*.o"))


def test_what_cannot_be_compiled_is_refused_in_every_process(folder):
    for said in (in_another_process(folder, *questions.REFUSED) for _ in range(2)):
        for name, says in questions.REFUSED.items():
            assert re.search(says, str(said["answers"][name])), (name, said["answers"][name])
    assert not list((folder / "cache").glob("*.o"))


def test_what_is_changed_at_run_time_takes_effect(folder):
    module = questions.questions(folder)
    shape = module.shape
    assert questions.answered(module.compiled_of_module, 1.0) == 3.0
    shape.SLOPE = 10.0
    assert questions.answered(module.compiled_of_module, 1.0) == 11.5
    shape.deep.FACTOR = 5.0
    assert questions.answered(module.compiled_of_module, 1.0) == 15.0
    shape.TABLE[3] = 7.0
    assert questions.answered(module.array_of_module, 1.0) == 7.0
    shape.by_default.__defaults__ = (8.0,)
    assert questions.answered(module.default, 1.0) == 8.0


def test_a_large_array_may_go_and_others_of_its_content_come(folder):
    module = questions.questions(folder)
    first = questions.answered(module.large, 1.0)
    module.shape.BIG[:] = 3.0  # in place: what was compiled before has its own copy
    assert questions.answered(module.large, 1.0) == 3.0
    module.shape.BIG = 1.5 * np.arange(150_000.0)
    assert questions.answered(module.large, 1.0) == first


def test_functions_made_by_one_function_are_several(folder):
    def made(slope):
        def inner(x):
            return slope * x

        def outer(x):
            return inner(x)

        return outer

    assert [questions.answered(made(slope), 1.0) for slope in (1e6, 3e6, 1e6)] == [1e6, 3e6, 1e6]
    both = [reach.digest(made(1.0), made(2.0), which) for which in (made(1.0), made(2.0))]
    assert len(set(both)) == 2


def test_which_of_two_functions_comes_again_counts():
    def made(slope):
        return lambda x: slope * x

    one, two = made(1.0), made(2.0)
    assert reach.digest(one, two, one) != reach.digest(one, two, two)


def test_machine_code_under_another_name_is_not_run(folder):
    module = questions.questions(folder)
    answers = [questions.answered(module.constant), questions.answered(module.helper_of_helper)]
    build._addresses.clear()
    one, other = sorted((folder / "cache").glob("*.o"))
    shutil.copy(one, other)
    assert [questions.answered(module.constant), questions.answered(module.helper_of_helper)] == answers


@pytest.mark.parametrize("library", ["numba", "llvmlite", "numpy"])
def test_the_version_of_a_library_is_part_of_the_key(folder, monkeypatch, library):
    real = metadata.version
    build._environment.cache_clear()
    before = build._environment()
    monkeypatch.setattr(metadata, "version", lambda name: "0.67.9" if name == library else real(name))
    build._environment.cache_clear()
    assert build._environment() != before
    monkeypatch.undo()
    build._environment.cache_clear()
    assert build._environment() == before


def test_a_library_that_is_not_installed_is_missed_by_who_compiles_alone(monkeypatch):
    def gone(name):
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", gone)
    build._environment.cache_clear()
    assert "numba none" in build._environment()
    monkeypatch.undo()
    build._environment.cache_clear()


def function_in(scope, text):
    scope["__name__"] = "of_a_user"
    exec(text, scope)
    return scope["f"]


@pytest.mark.parametrize("value, other", [
    (1.0, 1), (1.0, True), (0.0, -0.0), (1, True), ("a", b"a"), ((1, 2), [1, 2]), ((1, (2, 3)), (1, 2, 3)),
    (np.float64(1.0), 1.0), (np.float32(1.0), np.float64(1.0)), (np.zeros(2), np.zeros((1, 2))),
    (np.zeros(2), np.zeros(2, dtype=int)), ({"a": 1}, {"a": 2}), ({"a", "b"}, {"a", "c"}), (range(3), range(4)),
    (math.sin, math.cos), (np.sin, np.cos), (np.interp, np.sum), (float, int), (None, ...),
    (function_in({}, "def f(x): return x"), function_in({}, "def f(y): return y")),
    (function_in({}, "def f(x): return 1.0"), function_in({}, "def f(x): return 1")),
    (function_in({}, "def f(x, y=1): return x"), function_in({}, "def f(x, y=2): return x")),
    (function_in({}, "def f(x, *, y=1): return x"), function_in({}, "def f(x, *, y=2): return x")),
    (function_in({}, "def f(x): return (lambda: 1)()"), function_in({}, "def f(x): return (lambda: 2)()")),
    (function_in({"g": 1}, "def f(x): return g"), function_in({"g": 2}, "def f(x): return g")),
    (function_in({"g": 1}, "def f(x): return (lambda: g)()"), function_in({"g": 2}, "def f(x): return (lambda: g)()")),
    (function_in({}, "class f:\n A = 1"), function_in({}, "class f:\n A = 2")),
    (function_in({}, "class f:\n @property\n def a(s): return 1"),
     function_in({}, "class f:\n @property\n def a(s): return 2")),
    (function_in({}, "class f:\n @staticmethod\n def a(): return 1"),
     function_in({}, "class f:\n @staticmethod\n def a(): return 2")),
    (function_in({}, "import functools\n@functools.cache\ndef f(): return 1"),
     function_in({}, "import functools\n@functools.cache\ndef f(): return 2")),
])  # fmt: skip
def test_different_things_have_different_digests(value, other):
    assert reach.digest(value) != reach.digest(other)
    assert reach.digest(value) == reach.digest(value)


@pytest.mark.parametrize("value, says", [
    (object(), "an object of type object"), (np.array([None]), "an array of objects"), ([].append, "builtin_function"),
    (np.random.default_rng().random, "of type "), (np.polynomial.Polynomial([1.0]), "Polynomial"),
    (function_in({"g": object()}, "def f(x): return g"), "an object of type object called g in f"),
    (function_in({"g": {"k": [object()]}}, "def f(x): return g"), "an object of type object called g in f"),
    (function_in({}, "def f(x):\n import shape\n return shape"), "an import called shape in f"),
])  # fmt: skip
def test_what_has_no_lasting_text_is_named(value, says):
    with pytest.raises(reach.Unreachable, match=re.escape(says)):
        reach.digest(value)


def test_an_attribute_that_is_called_like_a_global_is_not_the_global():
    scope = {"math": math, "log": object()}
    assert reach.digest(function_in(scope, "def f(x): return math.log(x)"))
    with pytest.raises(reach.Unreachable, match="called log in f"):
        reach.digest(function_in(scope, "def f(x): return math.log(log)"))
    scope["log"] = function_in({}, "def f():\n global kept\n kept = 1")
    assert reach.digest(function_in(scope, "def f(x): return math.log(x)"))
    with pytest.raises(reach.KeepsState, match="writes the global kept"):
        reach.digest(function_in(scope, "def f(x): return (lambda: log())()"))


def test_a_module_called_like_one_of_pythons_is_the_users(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "this", raising=False)
    (tmp_path / "this.py").write_text("def line(x):\n    return x\n")
    import this

    before = reach.digest(this.line)
    assert not reach.is_of_library(this) and reach.is_of_library(math) and reach.is_of_library(re.compile)
    this.line.__defaults__ = (1.0,)
    assert reach.digest(this.line) != before
    monkeypatch.delitem(sys.modules, "this")


def test_a_component_is_its_class_and_its_values():
    laws = [Elastic(density=1.0, modulus=modulus) for modulus in (1.0, 2.0, 1.0)]
    said = [reach.digest(function_in({"law": law}, "def f(x): return law.density")) for law in laws]
    assert said[0] == said[2] != said[1]
    assert laws[0].initial_energy == 0.0  # computed once and kept, which is no difference
    assert reach.digest(function_in({"law": laws[0]}, "def f(x): return law.density")) == said[0]


def test_modules_that_hold_each_other_are_followed_to_their_end():
    one, two = ModuleType("one"), ModuleType("two")
    one.two, two.one, two.SLOPE = two, one, 1.0
    f = function_in({"one": one}, "def f(x): return one.two.one.two.SLOPE")
    before = reach.digest(f)
    two.SLOPE = 2.0
    assert reach.digest(f) != before


def test_an_empty_cell_is_no_matter():
    def outer():
        def f(x):
            return later(x)

        text = reach.digest(f)
        later = math.sin
        return text, reach.digest(f)

    assert len(set(outer())) == 2


def test_texts_of_a_set_have_one_order_in_every_process(tmp_path):
    script = "from hydro1d.jit import reach\ndef f(x): return x in {'a', 'b', 'c', 'd', 'e'}\nprint(reach.digest(f))"
    environment = dict(os.environ, PYTHONPATH=str(Path(__file__).parents[2]))
    runs = [
        subprocess.check_output([sys.executable, "-c", script], env={**environment, "PYTHONHASHSEED": seed})
        for seed in "12"
    ]
    assert len(set(runs)) == 1


def test_a_cache_that_cannot_be_written_is_told_once(folder, monkeypatch):
    (folder / "file").write_text("not a folder")
    monkeypatch.setenv("HYDRO1D_CACHE_DIR", str(folder / "file" / "cache"))
    module, notes = questions.questions(folder), []
    with build.noting(notes.append):
        assert questions.answered(module.constant, 2.0) == 3.0
        assert questions.answered(module.helper, 2.0) == 3.0
    (note,) = notes
    assert note.startswith("machine code cannot be kept and is compiled anew in every run") and str(folder) in note


def test_a_full_disk_is_told_and_leaves_nothing(folder, monkeypatch):
    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    notes = []
    with build.noting(notes.append):
        assert questions.answered(questions.questions(folder).constant, 2.0) == 3.0
    assert notes == [
        f"machine code cannot be kept and is compiled anew in every run: {cache.folder()}: No space left on device"
    ]
    assert list(cache.folder().iterdir()) == []
