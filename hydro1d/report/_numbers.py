"""The headline and the tables of numbers on the page."""

from typing import NamedTuple

import numpy as np

from hydro1d.analysis.energy import elastic_energy
from hydro1d.analysis.openings import find_openings
from hydro1d.analysis.transmission import NOT_REACHED, Transmission, transmission_of
from hydro1d.deck import Deck
from hydro1d.errors import FileProblem
from hydro1d.plot._data import name_of
from hydro1d.plot._units import scale_for
from hydro1d.store import Run


class Number(NamedTuple):
    """A line of a table: what, how much, and a remark."""

    label: str
    value: str
    remark: str = ""


def require_history(run: Run) -> None:
    """Raise FileProblem for a run without a single row of history."""
    if "time" not in run.history or not len(run.history["time"]):
        raise FileProblem(f"{name_of(run)} holds no history yet (status: {run.status})")


def headline(run: Run, deck: Deck | None = None) -> str:
    """The answer in a sentence or two; of a run that stopped early, only what it has shown up to there."""
    require_history(run)
    transmission, left = transmission_of(run, deck), uncrushed(run)
    if run.status != "complete":
        return _headline_so_far(run, transmission)
    text = _answer(transmission)
    if left is not None:
        text += " The column is fully crushed." if left <= 0.0 else f" {100 * left:.3g} % of the column is not crushed."
    if transmission.pending:
        text += f" At the end {' and '.join(transmission.pending)}: a later end time may change this."
    return text


def _answer(transmission: Transmission) -> str:
    support = transmission.ends.support
    if transmission.transmitted == 0.0:
        undecided = f"{NOT_REACHED[0].upper()}{NOT_REACHED[1:]}."
        return undecided if transmission.applied > 0.0 else f"The wave has not reached the {support} end."
    transmitted = scale_for("Pa", transmission.transmitted).show(transmission.transmitted)
    if transmission.applied == 0.0:
        return f"The {support} end feels {transmitted} at most."
    applied = scale_for("Pa", transmission.applied).show(transmission.applied)
    word = transmission.word[0].upper() + transmission.word[1:]
    ratio = f"{transmission.ratio:.3g} times the applied peak of {applied}"
    return f"{word}: the {support} end feels {transmitted} at most, {ratio}."


def _headline_so_far(run: Run, transmission: Transmission) -> str:
    end, support = float(run.history["time"][-1]), transmission.ends.support
    text = f"Up to {scale_for('s', end).show(end)} "
    if transmission.transmitted == 0.0:
        text += f"the wave has not reached the {support} end"
    else:
        transmitted = scale_for("Pa", transmission.transmitted).show(transmission.transmitted)
        text += f"the {support} end has felt {transmitted} at most"
        if transmission.applied > 0.0:
            applied = scale_for("Pa", transmission.applied).show(transmission.applied)
            text += f", {transmission.ratio:.3g} times the applied peak of {applied}"
    left = uncrushed(run)
    return text + ("." if left is None else f"; {100 * left:.3g} % of the column is not crushed yet.")


def uncrushed(run: Run) -> float | None:
    """Share of the column that is not crushed at the end; None where no layer can be crushed."""
    if "uncrushed_fraction" not in run.history:
        return None
    value = float(run.history["uncrushed_fraction"][-1])
    laws = {str(law.get("law")) for law in run.deck.get("material", {}).values()}
    return None if not np.isfinite(value) or laws <= {"elastic", "ideal-gas"} else value


def key_numbers(run: Run, deck: Deck | None) -> list[Number]:
    """The table of key numbers: loads, crushing, openings, time steps."""
    require_history(run)
    transmission, history = transmission_of(run, deck), run.history
    pressure = scale_for("Pa", [transmission.transmitted, transmission.applied])
    rows = []
    if transmission.applied > 0.0:
        rows.append(Number("peak of the applied pressure", pressure.show(transmission.applied)))
    support = transmission.ends.support
    when = _when(run, support) if transmission.transmitted > 0.0 else "the wave has not reached it"
    rows.append(Number(f"peak stress on the support ({support} end)", pressure.show(transmission.transmitted), when))
    if transmission.applied > 0.0:
        rows.append(_ratio(run, transmission))
    peak = float(history["peak_stress"][-1])
    rows.append(Number("largest stress anywhere", scale_for("Pa", peak).show(peak), "every cycle counted"))
    left = uncrushed(run)
    if left is not None:
        rows.append(Number("uncrushed", f"{100 * left:.4g} %", "share of the column's length at the end"))
    rows += _opened(run, deck)
    impulse = float(history["boundary_impulse"][-1])
    rows.append(Number("impulse of both ends", scale_for("Pa s", impulse).show(impulse), "positive to the right"))
    end = float(history["time"][-1])
    cycles = run.attributes.get("cycles", "?")
    wall = scale_for("s", float(run.attributes.get("wall_seconds") or 0.0))
    rows.append(Number("calculated to", scale_for("s", end).show(end), f"{cycles} cycles"))
    if run.attributes.get("wall_seconds"):
        rows.append(Number("wall time of the loop", wall.show(float(run.attributes["wall_seconds"]), 3)))
    if run.attributes.get("limiting_layer"):
        rows.append(Number("layer that limits the time step", str(run.attributes["limiting_layer"])))
    return rows


def _opened(run: Run, deck: Deck | None) -> list[Number]:
    """Zones that came apart, as far as the profiles show."""
    found = find_openings(run, deck) if len(run.time) else None
    if found is None:
        return []
    length = scale_for("m", run["node_coordinate"])
    first = scale_for("s", found.first).show(found.first, 3)
    where = (
        f"first seen at {first}, X from {length.show(found.low, 3)} to {length.show(found.high, 3)}; {found.outcome}"
    )
    rows = [Number("zones that opened", f"{found.zones} of {found.total}", where)]
    if found.stretched:
        most = f"{found.widest:.3g} times as long at most: the foam has parted there, its strain means little"
        rows.append(Number("zones stretched beyond their initial length", str(found.stretched), most))
    return rows


def _ratio(run: Run, transmission: Transmission) -> Number:
    if transmission.transmitted == 0.0:
        return Number("support over applied", "–", "not decided yet")
    early = run.status != "complete" and transmission.ratio <= 1.0
    return Number("support over applied", f"{transmission.ratio:.4g}", "so far" if early else transmission.word)


def _when(run: Run, support: str) -> str:
    values = run.history[f"{support}_stress"]
    time = float(run.history["time"][int(np.nanargmax(values))])
    return f"at {scale_for('s', time).show(time, 3)}"


def energy_numbers(run: Run, deck: Deck | None) -> list[Number]:
    """The balance at the end, and where the energy went."""
    require_history(run)
    history = run.history
    kinetic, internal = history["kinetic_energy"], history["internal_energy"]
    work, viscous = float(history["boundary_work"][-1]), float(history["viscous_work"][-1])
    scale = scale_for("J m-2", [work, kinetic, internal])
    initial = float(kinetic[0] + internal[0])
    gained = float(internal[-1] - internal[0])
    rows = [
        Number("at the start", scale.show(initial)),
        Number("work of both ends", scale.show(work)),
        Number("kinetic at the end", scale.show(float(kinetic[-1]))),
        Number("internal at the end", scale.show(float(internal[-1]))),
        Number("largest imbalance", f"{np.nanmax(np.abs(history['energy_error'])):.1e}", "over the energy put in"),
    ]
    if gained <= 1e-6 * (abs(work) + initial):
        return rows
    rows.append(
        Number("dissipated in fronts", scale.show(viscous), f"{100 * viscous / gained:.3g} % of the internal gain")
    )
    stored = _elastic(run, deck)
    if stored is not None:
        rest = gained - viscous - stored
        share = f"{100 * stored / gained:.3g} %"
        rows.append(Number("stored elastically", scale.show(stored), share))
        rows.append(Number("absorbed by crushing along the curve", scale.show(rest), f"{100 * rest / gained:.3g} %"))
    return rows


def _elastic(run: Run, deck: Deck | None) -> float | None:
    """Energy (J/m²) that the column would give back on unloading; None where a law does not tell."""
    if deck is None or len(run.time) == 0 or run.time[-1] < run.history["time"][-1] * (1 - 1e-9):
        return None
    laws = [layer.law for layer in deck.layers]
    if any(getattr(law, "unloading", None) != "elastic" or law.own_variables() for law in laws):
        return None
    stored = elastic_energy(run, deck)
    return stored if np.isfinite(stored) else None
