"""What the figures read off a run's file."""

import numpy as np

from hydro1d.store import Run
from hydro1d.studies.harrigan2010 import foam


def support_share(run: Run) -> float:
    """Peak support stress over P of the example."""
    return float(run.history["peak_right_stress"][-1]) / foam.PRESSURE


def crushed_at(run: Run) -> float:
    """When the last zone passed εD, s; NaN if it never did."""
    done = run.history["uncrushed_fraction"] <= 0.0
    return float(run.history["time"][np.argmax(done)]) if done.any() else float("nan")


def at_time(run: Run, column: str, time: float) -> float:
    """A column of the history at a time (s), from the rows where it is known."""
    known = np.isfinite(run.history[column])
    return float(np.interp(time, run.history["time"][known], run.history[column][known]))


def mean_during(run: Run, column: str, begin: float, end: float) -> float:
    """Mean of the rows of a column between two times, s."""
    time = run.history["time"]
    return float(np.mean(run.history[column][(time > begin) & (time < end)]))


def rest_time(run: Run) -> float:
    """When the momentum of the column first comes to zero after the pulse, s."""
    time, momentum = run.history["time"], run.history["momentum"]
    after = np.flatnonzero((time > foam.DURATION) & (momentum <= 1e-3 * momentum.max()))
    return float(time[after[0]]) if len(after) else float("nan")


def laboratory_path(run: Run, column: str) -> np.ndarray:
    """Where a front of the history is in the laboratory at the times of the profiles (m); NaN where there is none."""
    history = run.history
    seen, times = np.isfinite(history[column]), np.asarray(run.time)
    if seen.sum() < 2:
        return np.full(times.shape, np.nan)
    at = np.interp(times, history["time"][seen], history[column][seen], left=np.nan, right=np.nan)
    node = run["node_coordinate"]
    return np.array([np.interp(x, node, run["position"][k]) if x == x else np.nan for k, x in enumerate(at)])
