"""``hydro1d check``: is a deck right, and what does it say?"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from hydro1d.cli import _common

if TYPE_CHECKING:
    from hydro1d.boundaries.base import Boundary
    from hydro1d.deck import Deck


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d check``."""
    _common.add_deck(parser)


def run(args: argparse.Namespace) -> None:
    """Print a reading of the deck; an error in it raises DeckError."""
    from hydro1d.deck import load_deck

    deck = load_deck(args.deck, args.overrides)
    print("\n".join([f"{args.deck}: in order", *reading(deck)]))


def reading(deck: Deck) -> list[str]:
    """What the deck asks for, in a few lines."""
    plain = deck.resolved()
    lines = [f"title: {deck.title}"] if deck.title else []
    for index, layer in enumerate(deck.layers):
        law = plain["material"][plain["layer"][index]["material"]]["law"]
        size = _common.figure(layer.thickness / layer.zones, "m")
        moving = f", moving at {layer.velocity:g} m/s" if layer.velocity else ""
        thickness = _common.figure(layer.thickness, "m")
        lines.append(f"layer[{index}]: {layer.material} ({law}), {thickness} in {layer.zones} zones of {size}{moving}")
    lines += [f"{side}: {_end(getattr(deck, side), plain[side])}" for side in ("left", "right")]
    profiles = len(deck.output.profiles)  # type: ignore[arg-type]
    zones = sum(layer.zones for layer in deck.layers)
    megabytes = profiles * zones * 8 * 8 / 1e6
    lines.append(f"until t = {_common.figure(deck.time.end, 's')}; {_common.count(profiles, 'profile')}, "
                 f"about {megabytes:.3g} MB before compression")  # fmt: skip
    lines += [f"note: {text}" for text in deck.notes]
    lines += _late_enough(deck)
    lines += [f"note: {file} is Python code that this deck names; it was run to check it" for file in deck.user_code()]
    return lines


def _end(boundary: Boundary, plain: dict[str, Any]) -> str:
    """A boundary in a line: its type, its pulse, and what numbers it is given."""
    from hydro1d.components.fields import said_of

    words = [str(plain["type"]), *([str(plain["pulse"])] if "pulse" in plain else [])]
    for component in (getattr(boundary, "pulse", None), boundary):
        for name, field in type(component).model_fields.items() if component is not None else ():
            value, unit = getattr(component, name), said_of(field).get("unit")
            if isinstance(value, float) and unit is not None:
                unit = "" if unit == "1" else unit
                words.append(f"{name.replace('_', ' ')} {_common.figure(value, unit)}")
            elif isinstance(value, bool) and value != field.default:
                words.append(f"{name.replace('_', ' ')} = {str(value).lower()}")
            elif isinstance(value, tuple) and value:
                words.append(f"{name} of {_common.count(len(value), 'point')}")
    return ", ".join(words)


def _late_enough(deck: Deck) -> list[str]:
    """A note where the calculation ends before its question can be answered."""
    from hydro1d.analysis.arrival import arrival_of
    from hydro1d.analysis.transmission import ends_of

    arrival, end = arrival_of(deck), _common.figure(deck.time.end, "s")
    if arrival is None:
        return []
    support = ends_of(deck).support
    if deck.time.end < arrival.wave:
        time = _common.figure(arrival.wave, "s")
        return [
            f"note: the wave needs about {time} to reach the support ({support} end), which feels nothing until t = {end}"
        ]
    if deck.time.end < arrival.front:
        time = _common.figure(arrival.front, "s")
        return [f"note: kept at its peak, the load drives a compaction front to the support ({support} end) in about {time}; "
                f"at t = {end} it is under way, unless it has stopped"]  # fmt: skip
    return []
