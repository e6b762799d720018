"""matplotlib, whatever the environment and the user's matplotlibrc ask of it.

Figures of hydro1d are written to files and need no backend, so one that matplotlib does not know must not stop them: the
variable MPLBACKEND that a notebook hands to its commands names a backend of IPython's, which may not be installed.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any


def _load() -> None:
    """Import matplotlib, then give it the backend of MPLBACKEND if it takes it."""
    if "matplotlib" in sys.modules:
        return
    backend = os.environ.pop("MPLBACKEND", "")
    try:
        import matplotlib
    finally:
        if backend:
            os.environ["MPLBACKEND"] = backend
    if backend:
        with suppress(ValueError):
            matplotlib.rcParams["backend"] = backend


@contextmanager
def without_latex(figure: Any) -> Iterator[None]:
    """Draw the texts of a figure without LaTeX, which may not be installed and cannot set our labels (ε, ², %)."""
    import matplotlib
    from matplotlib.text import Text

    if not matplotlib.rcParams["text.usetex"]:
        yield
        return
    with matplotlib.rc_context({"text.usetex": False}):  # for the texts that are made while it is drawn
        for text in figure.findobj(Text):
            text.set_usetex(False)
        yield


_load()
