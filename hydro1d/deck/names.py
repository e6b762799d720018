"""Names by which a deck refers to components built in Python."""

import sys
from pathlib import Path

from hydro1d.components.parameters import Component

_PACKAGES = {"law": "hydro1d.laws", "boundary": "hydro1d.boundaries", "pulse": "hydro1d.loads"}


def plugin_name(kind: str, component: type[Component]) -> str:
    """The deck's word for a built-in class ("epph-tangent"), else the file and class where it is defined."""
    package, _, module = component.__module__.rpartition(".")
    if package == _PACKAGES[kind]:
        return module.replace("_", "-")
    file = getattr(sys.modules.get(component.__module__), "__file__", None)
    return f"{Path(file).name if file else component.__module__}:{component.__qualname__}"
