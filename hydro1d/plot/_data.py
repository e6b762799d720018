"""What figures ask of a run: quantities, profiles, names, units; each is refused in words where the run lacks it."""

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from hydro1d.deck.messages import suggestion
from hydro1d.errors import FileProblem
from hydro1d.plot._units import Scale, scale_for, words
from hydro1d.store import Run, open_run

RunOrPath = Run | str | os.PathLike[str]


def as_run(run: RunOrPath) -> Run:
    """The run itself, or the one in the file. Raises FileProblem."""
    return run if isinstance(run, Run) else open_run(run)


def name_of(run: Run) -> str:
    """What to call a run in messages and legends."""
    return str(run.path) if run.path is not None else run.title or "run"


def heading(run: Run) -> str:
    """Title of a run, with its status where that is not `complete`."""
    return _plain((run.title or (run.path.stem if run.path else "")) + state_of(run))


def state_of(run: Run) -> str:
    """In brackets what a run is that is not complete; else nothing."""
    return {"complete": "", "running": " (partial: not finished)"}.get(run.status, f" ({run.status})")


def _plain(text: str) -> str:
    """Text in which matplotlib sees no formula, cut to a line."""
    text = text if len(text) <= 90 else text[:88] + "…"
    return text.replace("$", r"\$")


def times_of(run: Run, least: int = 1) -> np.ndarray:
    """Times of the profiles, s. Raises FileProblem where there are fewer than `least`."""
    time = run.time if "time" in run else np.empty(0)
    if len(time) < least:
        held = "no profile" if len(time) == 0 else f"only {len(time)} profile" + "s" * (len(time) > 1)
        others = "; profiles and history can be drawn" if len(time) else ""
        raise FileProblem(f"{name_of(run)} holds {held}; this figure needs {least} (status: {run.status}){others}")
    return time


def scaled(run: Run, path: str, values: Any = None) -> tuple[Scale, str]:
    """Display unit and axis label of a quantity ("stress", "history/right_stress")."""
    scale = scale_for(run.describe(path).units, run[path] if values is None else values)
    return scale, scale.label(words(path.rpartition("/")[2]))


def profile_quantity(run: Run, name: str) -> np.ndarray:
    """Values (time, zone) or (time, node). Raises FileProblem for anything else, with what there is."""
    if name in run:
        values = run[name]
        if run.describe(name).dimensions in (("time", "zone"), ("time", "node")):
            return values
    there = [key for key in run if run.describe(key).dimensions[:1] == ("time",) and key != "time"]
    hint = "; the history has it" if name in run.history else suggestion(name, there)
    raise FileProblem(f"{name_of(run)} has no profiles of {name[:80]!r}{hint}; it has {', '.join(there) or 'none'}")


def nearest(time: np.ndarray, wanted: Sequence[float], name: str) -> list[int]:
    """Indices of the profiles nearest to times (s). Raises FileProblem beyond the last."""
    late = [value for value in wanted if not -1e-12 <= value <= time[-1] * (1 + 1e-6) + 1e-12]
    if late:
        scale = scale_for("s", time)
        first, last, asked = (scale.show(float(value)) for value in (time[0], time[-1], late[0]))
        raise FileProblem(f"{name} has profiles from {first} to {last}, not at {asked}")
    return list(dict.fromkeys(int(np.argmin(np.abs(time - value))) for value in wanted))
