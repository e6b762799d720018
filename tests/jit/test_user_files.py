"""A user's file may import what stands beside it; nothing of that mixes with other folders, lingers or is left there."""

from __future__ import annotations

import sys

import pytest

from hydro1d.components.user_files import load_module


def write(folder, **files):
    folder.mkdir(exist_ok=True)
    for name, text in files.items():
        path = folder / f"{name.replace('__', '/')}.py"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    return folder / "mine.py"


def test_two_folders_with_a_helper_of_one_name_do_not_mix(tmp_path):
    files = [write(tmp_path / name, mine="import helper", helper=f"SLOPE = {name!r}") for name in ("a", "b")]
    assert [load_module(file).helper.SLOPE for file in (*files, *files)] == ["a", "b", "a", "b"]
    assert "helper" not in sys.modules
    assert load_module(files[0]) is load_module(files[0])


@pytest.mark.parametrize("edited", ["mine", "helper", "parts__inner", "parts__deep"])
def test_an_edit_of_any_file_is_noticed_however_soon(tmp_path, edited):
    files = {
        "mine": "import helper\nNUMBER = 1\ndef total(): return NUMBER + helper.total()",
        "helper": "from parts import inner\nNUMBER = 1\ndef total(): return NUMBER + inner.total()",
        "parts__inner": "from . import deep\nNUMBER = 1\ndef total(): return NUMBER + deep.NUMBER",
        "parts__deep": "NUMBER = 1",
    }
    path = write(tmp_path, **files)
    for number in (1, 2, 3, 1):
        write(tmp_path, **{edited: files[edited].replace("NUMBER = 1", f"NUMBER = {number}")})
        assert load_module(path).total() == 3 + number
    assert not [name for name in sys.modules if name.split(".")[0] in ("helper", "parts")]
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["deep.py", "helper.py", "inner.py", "mine.py", "parts"]
    assert str(tmp_path) not in sys.path and not [
        finder for finder in sys.meta_path if type(finder).__name__ == "_Beside"
    ]


def test_modules_of_that_name_that_python_has_already_stay(tmp_path, monkeypatch):
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "of_notebook.py").write_text("SLOPE = 'of the notebook'")
    monkeypatch.syspath_prepend(tmp_path / "here")
    import of_notebook  # type: ignore[import-not-found]

    path = write(tmp_path / "deck", mine="import of_notebook", of_notebook="SLOPE = 'beside the deck'")
    assert load_module(path).of_notebook.SLOPE == "beside the deck"
    assert sys.modules["of_notebook"] is of_notebook and of_notebook.SLOPE == "of the notebook"


def test_a_helper_does_not_take_the_place_of_a_library(tmp_path):
    path = write(tmp_path, mine="import json, numpy, profile", json="x = 1", numpy="x = 1", profile="x = 1")
    module = load_module(path)
    assert not any(hasattr(library, "x") for library in (module.json, module.numpy, module.profile))


def test_a_mere_folder_gives_way_to_what_is_installed(tmp_path):
    path = write(tmp_path, mine="import pytest, data.table", data__table="x = 1", pytest__notes="x = 1")
    assert load_module(path).pytest is pytest and load_module(path).data.table.x == 1


@pytest.mark.parametrize("helper, says", [
    ("1 / 0", "mine.py cannot be loaded: helper.py, line 1: ZeroDivisionError: division by zero"),
    ("def (", r"mine.py cannot be loaded: SyntaxError: .*helper.py, line 1"),
    ("import no_such_module", "mine.py cannot be loaded: helper.py, line 1: ModuleNotFoundError"),
    ("x = '\0'", "mine.py cannot be loaded: .*null bytes"),
    ("import helper\nhelper.SLOPE", "mine.py cannot be loaded: helper.py, line 2: AttributeError"),
])  # fmt: skip
def test_a_helper_that_cannot_be_run_says_so_in_one_line(tmp_path, helper, says):
    path = write(tmp_path, mine="import helper", helper=helper)
    for _ in range(2):
        with pytest.raises(ValueError, match=says):
            load_module(path)
    assert "helper" not in sys.modules
    write(tmp_path, helper="SLOPE = 1")
    assert load_module(path).helper.SLOPE == 1


def test_a_helper_that_is_not_text_or_goes_away(tmp_path):
    path = write(tmp_path, mine="import helper", helper="SLOPE = 1")
    load_module(path)
    (tmp_path / "helper.py").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match=r"mine\.py cannot be loaded: .*(Syntax|Unicode|Value)Error"):
        load_module(path)
    (tmp_path / "helper.py").unlink()
    with pytest.raises(ValueError, match=r"mine\.py cannot be loaded: mine\.py, line 1: ModuleNotFoundError"):
        load_module(path)
