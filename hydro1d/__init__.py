"""hydro1d: a 1-D Lagrangian shock code for cellular materials under impact and blast.

>>> import hydro1d
>>> run = hydro1d.run("pulse_epph.toml")
>>> run.history["peak_right_stress"][-1]
"""

from __future__ import annotations

TYPE_CHECKING = False  # as typing has it, whose import would be a third of the time of `hydro1d --help`

__version__ = "0.2.0.dev0"

if TYPE_CHECKING:  # for type checkers and editors; at run time __getattr__ does it
    from typing import Any

    from hydro1d.api import run
    from hydro1d.boundaries.base import Boundary, End
    from hydro1d.components.parameters import above, at_least, derived, fraction, not_negative, number, pairs, positive
    from hydro1d.deck import Deck, Layer, load_deck
    from hydro1d.errors import BreakdownError, DeckError, FileProblem, Hydro1dError, Interrupted
    from hydro1d.laws.base import Foam, Law, PlateauFoam, Point, Response
    from hydro1d.loads.base import Pulse
    from hydro1d.store import Run, open_run

# Modules are loaded when a name is first used: `hydro1d --help` and plotting need few of them.
_HOME = {
    "Boundary": "boundaries.base",
    "BreakdownError": "errors",
    "Deck": "deck",
    "DeckError": "errors",
    "End": "boundaries.base",
    "FileProblem": "errors",
    "Foam": "laws.base",
    "Hydro1dError": "errors",
    "Interrupted": "errors",
    "Law": "laws.base",
    "Layer": "deck",
    "PlateauFoam": "laws.base",
    "Point": "laws.base",
    "Pulse": "loads.base",
    "Response": "laws.base",
    "Run": "store",
    "above": "components.parameters",
    "at_least": "components.parameters",
    "derived": "components.parameters",
    "fraction": "components.parameters",
    "load_deck": "deck",
    "not_negative": "components.parameters",
    "number": "components.parameters",
    "open_run": "store",
    "pairs": "components.parameters",
    "positive": "components.parameters",
    "run": "api",
}

__all__ = [*_HOME, "__version__"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import importlib

    return getattr(importlib.import_module(f"hydro1d.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    """The public names, those not yet loaded too: what TAB shows."""
    return sorted({*globals(), *__all__} - {"TYPE_CHECKING", "annotations"})
