"""Python files of the user's, run with the modules that stand beside them.

A file may import what lies in its own folder. Modules so imported are the file's alone: two folders that both have a
``helper.py`` do not mix, and a file is run again when it or one of them has changed. Nothing is written beside them.
"""

from __future__ import annotations

import sys
import threading
import traceback
import zlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from importlib.machinery import FileFinder, ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

# What a file beside cannot stand in for: hydro1d and its libraries import from these at any time.
_TAKEN = sys.stdlib_module_names | {"hydro1d", "numpy", "numba", "llvmlite", "h5py", "scipy", "pydantic", "matplotlib"}
_loading = threading.RLock()


class _Loaded(NamedTuple):
    """A file that was run: its module, and the content of every file that this took, as numbers."""

    module: ModuleType
    contents: dict[str, int]


_loaded: dict[Path, _Loaded] = {}


def load_module(path: Path) -> ModuleType:
    """The module of a user's file, run once per content, under a name that is stable from run to run.

    Raises ValueError, in one sentence, for a file that cannot be run.
    """
    with _loading:
        known = _loaded.get(path)
        if known is None or any(_fingerprint(file) != content for file, content in known.contents.items()):
            known = _loaded[path] = _run(path)
        return known.module


def _run(path: Path) -> _Loaded:
    name = f"hydro1d_user_{path.stem}_{zlib.crc32(str(path).encode(), _fingerprint(str(path)) or 0):x}"
    module = ModuleType(name)
    module.__file__ = str(path)
    before = sys.modules.get(name)
    sys.modules[name] = module
    finder = _Beside(path.parent)
    try:
        with _found_by(finder):
            finder.run(str(path), module)
    except Exception as error:
        del sys.modules[name]
        if before is not None:
            sys.modules[name] = before
        where = _place(error, finder.contents)
        raise ValueError(f"{path.name} cannot be loaded: {where}{type(error).__name__}: {error}") from error
    return _Loaded(module, finder.contents)


def _place(error: Exception, files: Iterable[str]) -> str:
    """Line of the last of these files that an error passed through; a SyntaxError says so itself."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename in files]
    if not frames or isinstance(error, SyntaxError):
        return ""
    return f"{Path(frames[-1].filename).name}, line {frames[-1].lineno}: "


class _Beside:
    """Finds and runs modules in one folder. Python's own way would keep bytecode there, and miss edits within a second."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.contents: dict[str, int] = {}
        self.names: list[str] = []

    def find_spec(self, name: str, path: Sequence[str] | None = None, _target: Any = None) -> ModuleSpec | None:
        """The module of that name, which Python looks for, if it lies in the folder."""
        if name.split(".")[0] in _TAKEN:
            return None
        for place in [str(self._folder)] if path is None else path:
            if Path(place).is_relative_to(self._folder):
                loader: Any = partial(_Loader, self)
                spec = FileFinder(place, (loader, [".py"])).find_spec(name)
                # A mere folder gives way to a package that is installed, as it does in Python.
                if spec is not None and (spec.loader is not None or PathFinder.find_spec(name, path) is None):
                    self.names.append(name)
                    return spec
        return None

    def run(self, file: str, module: ModuleType) -> None:
        """Run a file as a module."""
        content = Path(file).read_bytes()
        self.contents[file] = zlib.crc32(content)
        exec(compile(content, file, "exec"), module.__dict__)

    def hidden(self) -> list[str]:
        """Names of modules that Python has already, and that the folder has too."""
        files = [*self._folder.glob("*.py"), *(found.parent for found in self._folder.glob("*/__init__.py"))]
        own = {file.stem for file in files} - _TAKEN
        return [name for name in sys.modules if name.split(".")[0] in own]


class _Loader:
    """Runs a module that `_Beside` has found."""

    def __init__(self, finder: _Beside, _name: str, file: str) -> None:
        self._finder, self._file = finder, file

    def create_module(self, _spec: ModuleSpec) -> None:
        """Leave it to Python."""

    def exec_module(self, module: ModuleType) -> None:
        """Run the module's file."""
        self._finder.run(self._file, module)


@contextmanager
def _found_by(finder: _Beside) -> Iterator[None]:
    """Let Python look beside a file first, and forget afterwards what it has found there."""
    hidden = {name: sys.modules.pop(name) for name in finder.hidden()}
    sys.meta_path.insert(0, finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)
        for name in finder.names:
            sys.modules.pop(name, None)
        sys.modules.update(hidden)


def _fingerprint(file: str) -> int | None:
    """A number of a file's content, None where it cannot be read."""
    try:
        return zlib.crc32(Path(file).read_bytes())
    except OSError:
        return None
