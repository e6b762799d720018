"""Finding laws, boundaries and pulses by name.

Three sources, in this order: a class in a file of the user's (``"my_foam.py:MyFoam"``), a built-in (one file each in the
folder of its kind; the file's name is the deck's word), an entry point in the group of its kind.
"""

from __future__ import annotations

import functools
import importlib
import pkgutil
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

from hydro1d.components.parameters import Component
from hydro1d.components.user_files import load_module

_KINDS = {
    "law": ("hydro1d.laws", "hydro1d.laws.base:Law"),
    "boundary": ("hydro1d.boundaries", "hydro1d.boundaries.base:Boundary"),
    "pulse": ("hydro1d.loads", "hydro1d.loads.base:Pulse"),
}
_GROUPS = {"law": "hydro1d.laws", "boundary": "hydro1d.boundaries", "pulse": "hydro1d.pulses"}


class UnknownPlugin(ValueError):
    """No such law, boundary or pulse; `allowed` lists the names that there are."""

    def __init__(self, kind: str, name: str, allowed: list[str]) -> None:
        self.kind, self.name, self.allowed = kind, name, allowed
        super().__init__(f"no {kind} is called {name!r}; there are {', '.join(allowed)}")


def find(kind: str, spec: str, folder: Path | None = None) -> type[Component]:
    """Return the class that ``spec`` names; a relative file is looked up in ``folder`` (the deck's).

    Raises UnknownPlugin for a name that is not installed and ValueError, in one sentence, for a file that cannot be used.
    """
    if ".py" in spec:
        return _from_file(kind, spec, folder or Path.cwd())
    if spec in builtin_names(kind):
        return _builtin_loader(kind, spec)()
    loaders = available(kind)
    if spec not in loaders:
        raise UnknownPlugin(kind, spec, sorted(loaders))
    return loaders[spec]()


def available(kind: str) -> dict[str, Callable[[], type[Component]]]:
    """Names that a deck may use for this kind, each with a function that loads its class."""
    loaders = {name: _builtin_loader(kind, name) for name in builtin_names(kind)}
    for entry in _entry_points(kind):
        loaders.setdefault(entry.name, lambda entry=entry: _checked(kind, entry.load(), entry.value))  # type: ignore[misc]
    return loaders


@functools.cache
def builtin_names(kind: str) -> list[str]:
    """Names of the laws, boundaries or pulses that come with hydro1d."""
    package = importlib.import_module(_KINDS[kind][0])
    skip = {"base", "check"}
    return [
        module.name.replace("_", "-")
        for module in pkgutil.iter_modules(package.__path__)
        if module.name not in skip and not module.ispkg and not module.name.startswith("_")
    ]


def _builtin_loader(kind: str, name: str) -> Callable[[], type[Component]]:
    def load() -> type[Component]:
        module = importlib.import_module(f"{_KINDS[kind][0]}.{name.replace('-', '_')}")
        return _only_class(kind, module)

    return load


def _entry_points(kind: str) -> list:
    from importlib.metadata import entry_points  # slow to import, and only decks with third-party laws need it

    return list(entry_points(group=_GROUPS[kind]))


def _base(kind: str) -> type[Component]:
    module, name = _KINDS[kind][1].split(":")
    return getattr(importlib.import_module(module), name)


def _only_class(kind: str, module: ModuleType) -> type[Component]:
    """The component that a file defines (the last one, if it builds one upon another)."""
    classes = [
        item
        for item in vars(module).values()
        if isinstance(item, type) and issubclass(item, _base(kind)) and item.__module__ == module.__name__
    ]
    return classes[-1]


def _from_file(kind: str, spec: str, folder: Path) -> type[Component]:
    file, _, name = spec.partition(":")
    path = (folder / file).resolve()
    if not path.is_file():
        raise ValueError(f"the file {path} does not exist")
    module = load_module(path)
    if not name:
        raise ValueError(f"{spec!r} names no class; write {file}:ClassName")
    found = getattr(module, name, None)
    if found is None:
        names = [key for key, item in vars(module).items() if isinstance(item, type) and issubclass(item, _base(kind))]
        raise ValueError(f"{path.name} has no class {name}; it defines {', '.join(names) or f'no {kind}'}")
    return _checked(kind, found, spec)


def _checked(kind: str, found: object, spec: str) -> type[Component]:
    base = _base(kind)
    if not (isinstance(found, type) and issubclass(found, base)):
        raise ValueError(f"{spec} is not a subclass of hydro1d.{base.__name__}")
    return found
