"""Checkpoints: all records so far and the whole state of the solver in one file, which needs no other."""

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from hydro1d.errors import FileProblem
from hydro1d.store.layout import SCHEMA_VERSION
from hydro1d.store.recorder import Recorder
from hydro1d.store.source import FileSource

LAW_HASH = "law_hash_"
BOUNDARY_HASH = "boundary_hash_"
_UNKNOWN = "unknown: "  # begins a hash of code that could not be followed to its end
# Keys that may differ between a checkpoint's deck and the deck of the restart: they change no step taken so far.
_FREE = ("title", "output", "checkpoint", "time.end")
_MISSING = object()


@dataclass(frozen=True)
class Checkpoint:
    """A checkpoint that was read: the solver's state and the records up to it.

    arrays: the state, bit for bit as saved, for `State.from_arrays`; cycle and time (s): where it stands;
    law_hashes: by material, boundary_hashes: by side; source: the records.
    """

    path: Path
    arrays: dict[str, np.ndarray]
    cycle: int
    time: float
    deck_text: str
    resolved: dict[str, Any]
    law_hashes: dict[str, str]
    boundary_hashes: dict[str, str]
    schema_version: int
    attributes: dict[str, Any]
    source: FileSource


def read_checkpoint(path: str | os.PathLike[str]) -> Checkpoint:
    """Read a checkpoint. Raises FileProblem if it is not one, is truncated or damaged."""
    source = FileSource(path, check_schema=False)
    names = source.state_names()
    if not names or "checkpoint_time" not in source.attributes:
        raise FileProblem(f"{path} is a result, not a checkpoint: it holds no state to start from")
    arrays = {name: source.array(f"state/{name}") for name in names}
    attributes = source.attributes
    return Checkpoint(
        path=Path(os.path.realpath(path)),
        arrays=arrays,
        cycle=int(attributes["cycles"]),
        time=float(attributes["checkpoint_time"]),
        deck_text=source.deck_text,
        resolved=source.deck,
        law_hashes=_hashes(attributes, LAW_HASH),
        boundary_hashes=_hashes(attributes, BOUNDARY_HASH),
        schema_version=source.schema_version,
        attributes=attributes,
        source=source,
    )


def _hashes(attributes: Mapping[str, Any], kind: str) -> dict[str, str]:
    return {key.removeprefix(kind): str(value) for key, value in attributes.items() if key.startswith(kind)}


def verify_checkpoint(
    checkpoint: Checkpoint,
    resolved: Mapping[str, Any],
    law_hashes: Mapping[str, str] | None = None,
    force: bool = False,
    boundary_hashes: Mapping[str, str] | None = None,
) -> None:
    """Check that a run of the deck `resolved` may carry on from a checkpoint.

    A later end, other output and other checkpoints are fine. Another schema version, physics, code of a law (by material)
    or of a boundary (by side), also where that cannot be known, raises FileProblem that names each difference, unless
    `force` is set. An end before the checkpoint always does.
    """
    end = resolved.get("time", {}).get("end")
    if isinstance(end, int | float) and end < checkpoint.time:
        raise FileProblem(f"{checkpoint.path} stands at t = {checkpoint.time:.9g} s, after the deck's end, {end:.9g} s")
    if force:
        return
    problems = []
    if checkpoint.schema_version != SCHEMA_VERSION:
        problems.append(f"schema version: {checkpoint.schema_version} in the checkpoint, {SCHEMA_VERSION} here")
    problems += [
        f"{key}: {_shown(old)} in the checkpoint, {_shown(new)} in the deck"
        for key, old, new in _differences(checkpoint.resolved, resolved, "")
    ]
    problems += _code_problems("law of material {}", checkpoint.law_hashes, law_hashes or {})
    problems += _code_problems("{} boundary", checkpoint.boundary_hashes, boundary_hashes or {})
    if problems:
        listed = "\n".join(f"  {problem}" for problem in problems)
        raise FileProblem(f"cannot carry on from {checkpoint.path}:\n{listed}")


def _code_problems(whose: str, old: Mapping[str, str], new: Mapping[str, str]) -> Iterator[str]:
    """What is to be said of hashes that differ, or that do not tell."""
    for name, value in new.items():
        known = old.get(name, value)
        reason = next((text.removeprefix(_UNKNOWN) for text in (value, known) if text.startswith(_UNKNOWN)), "")
        if reason:
            yield f"{whose.format(name)}: whether its code has changed cannot be known, since it depends on {reason}"
        elif known != value:
            yield (
                f"{whose.format(name)}: its source has changed since the checkpoint was written, or what it uses, or Python"
            )


def _differences(old: Any, new: Any, path: str) -> Iterator[tuple[str, Any, Any]]:
    if path in _FREE:
        return
    if isinstance(old, Mapping) and isinstance(new, Mapping):
        for key in dict.fromkeys([*old, *new]):
            yield from _differences(old.get(key, _MISSING), new.get(key, _MISSING), f"{path}.{key}" if path else key)
    elif isinstance(old, list | tuple) and isinstance(new, list | tuple) and len(old) == len(new):
        for index, pair in enumerate(zip(old, new, strict=True)):
            yield from _differences(*pair, f"{path}[{index}]")
    elif isinstance(old, list | tuple) and isinstance(new, list | tuple):
        yield path, f"{len(old)} entries", f"{len(new)} entries"
    elif old is _MISSING or new is _MISSING or not _same(old, new):
        yield path, old, new


def _same(old: Any, new: Any) -> bool:
    return bool(old == new) or (old != old and new != new)


def _shown(value: Any) -> str:
    return "nothing" if value is _MISSING else str(value)


def replay(checkpoint: Checkpoint, recorder: Recorder) -> None:
    """Copy the records of a checkpoint into a recorder, a few rows at a time.

    Probes that the checkpoint does not have get NaN. Raises FileProblem if zones or quantities are
    others than the recorder's.
    """
    for table in (recorder.instants, recorder.nodes, recorder.zones, recorder.rows):
        paths = [field.path for field in table.fields]
        for values in _rows(checkpoint, paths, table.rows):
            if values.shape[2:] != table.tail:
                raise FileProblem(f"cannot carry on from {checkpoint.path}: it has another number of zones")
            table.append(values)
            recorder.recorded()
    if not recorder.instants.total == recorder.nodes.total == recorder.zones.total:
        raise _ragged(checkpoint)
    if recorder.probes.fields:
        _replay_probes(checkpoint, recorder)


def _ragged(checkpoint: Checkpoint) -> FileProblem:
    return FileProblem(f"cannot carry on from {checkpoint.path}: its records differ in length")


def _replay_probes(checkpoint: Checkpoint, recorder: Recorder) -> None:
    """Copy the probes' records; a probe that the checkpoint does not have gets NaN."""
    source = checkpoint.source
    known = source.array("probes/probe") if "probes/probe" in source.names else np.empty(0)
    wanted = recorder.layout.probe_coordinate
    columns = [(new, int(np.flatnonzero(known == x)[0])) for new, x in enumerate(wanted) if x in known]
    paths = ["history/history_time"] + [field.path for field in recorder.probes.fields if columns]
    for times, *probes in _lists(checkpoint, paths, recorder.probes.rows):
        values = np.full((len(recorder.probes.fields), len(times), len(wanted)), np.nan)
        for index, array in enumerate(probes):
            for new, old in columns:
                values[index, :, new] = array[:, old]
        recorder.probe_times.append(times[None, :])
        recorder.probes.append(values)
        recorder.recorded()


def _lists(checkpoint: Checkpoint, paths: list[str], step: int) -> Iterator[list[np.ndarray]]:
    """Consecutive rows of several datasets, `step` at a time."""
    missing = [path for path in paths if path not in checkpoint.source.names]
    if missing:
        raise FileProblem(f"cannot carry on from {checkpoint.path}: it holds no {', '.join(missing)}")
    every = (checkpoint.source.rows(path, step) for path in paths)
    for arrays in zip_longest(*every, fillvalue=np.empty(0)):
        if any(len(array) != len(arrays[0]) for array in arrays):
            raise _ragged(checkpoint)
        yield list(arrays)


def _rows(checkpoint: Checkpoint, paths: list[str], step: int) -> Iterator[np.ndarray]:
    """Consecutive rows of several datasets of one shape, as arrays (dataset, rows, …)."""
    yield from (np.stack(arrays) for arrays in _lists(checkpoint, paths, step))
