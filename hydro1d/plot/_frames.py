"""Where things are: in the material (Lagrangian) or in the laboratory."""

import numpy as np

from hydro1d.analysis.fronts import front_path
from hydro1d.errors import DeckError
from hydro1d.plot._units import Scale, scale_for
from hydro1d.store import Run

FRAMES = ("lagrangian", "laboratory")
FRONTS = {"front_position": "proximal front", "distal_front_position": "distal front"}


def check_frame(frame: str) -> None:
    """Raise DeckError unless `frame` is one of FRAMES."""
    if frame not in FRAMES:
        raise DeckError(f"frame {frame[:40]!r}; allowed: {', '.join(FRAMES)}")


def length_scale(run: Run) -> Scale:
    """Display unit of lengths."""
    return scale_for("m", run["node_coordinate"])


def length_label(run: Run, frame: str) -> str:
    """Label of the axis along the column."""
    return length_scale(run).label("Lagrangian coordinate X" if frame == "lagrangian" else "position x")


def interfaces(run: Run) -> np.ndarray:
    """Numbers of the nodes between two layers."""
    return np.array([layer.zones.start for layer in run.layers[1:]], dtype=int)


def along(run: Run, quantity: str, index: int, frame: str) -> np.ndarray:
    """Coordinates (m) of the values of a quantity at one profile."""
    nodes = run["node_coordinate"] if frame == "lagrangian" else run["position"][index]
    return nodes if run.describe(quantity).dimensions[-1] == "node" else 0.5 * (nodes[:-1] + nodes[1:])


def fronts(run: Run, frame: str = "lagrangian", most: int = 1500) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Paths of the compaction fronts: name -> (time, coordinate), s and m, NaN where there is none."""
    if "front_position" not in run.history:
        return {}
    time = run.history["time"]
    step = max(1, len(time) // most)
    found = {}
    for name, text in FRONTS.items():
        if name in run.history and np.isfinite(run.history[name]).any():
            where = front_path(run, name)[::step]
            found[text] = (time[::step], where if frame == "lagrangian" else in_laboratory(run, time[::step], where))
    return found


def in_laboratory(run: Run, time: np.ndarray, where: np.ndarray) -> np.ndarray:
    """Laboratory positions (m) at `time` of material points `where`, linear between the profiles; NaN stays NaN."""
    stored = run.time
    after = np.clip(np.searchsorted(stored, time), 1, max(len(stored) - 1, 1))
    result = np.full(len(time), np.nan)
    for k in np.flatnonzero(np.isfinite(where)):
        row = min(int(after[k]), len(stored) - 1)
        late = np.interp(where[k], run["node_coordinate"], run["position"][row])
        if row == 0:
            result[k] = late
            continue
        early = np.interp(where[k], run["node_coordinate"], run["position"][row - 1])
        share = (time[k] - stored[row - 1]) / (stored[row] - stored[row - 1])
        result[k] = early + np.clip(share, 0.0, 1.0) * (late - early)
    return result
