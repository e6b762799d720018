"""What the tests of the command line start from."""

from types import SimpleNamespace

import pytest
from command_line import DECK, outcome


@pytest.fixture
def deck(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "decks").mkdir()
    path = tmp_path / "decks" / "short.toml"
    path.write_text(DECK)
    return str(path)


@pytest.fixture
def calculated(monkeypatch):
    """Stands for `hydro1d.api.run`: remembers how it was called, returns or raises what a test wants."""
    import hydro1d.api

    record = SimpleNamespace(calls=[], answer=outcome())

    def run(deck, output, *, restart, force, progress):
        record.calls.append(SimpleNamespace(deck=deck, output=output, restart=restart, force=force, progress=progress))
        if isinstance(record.answer, BaseException):
            raise record.answer
        return record.answer

    monkeypatch.setattr(hydro1d.api, "run", run)
    return record
