"""Checks between the parts of a deck: zones in all, times and positions, laws and loads on their ends."""

import itertools
from collections.abc import Sequence

from hydro1d.boundaries.base import Boundary
from hydro1d.components.units import shorten
from hydro1d.deck.messages import MAX_FOUND, Finding
from hydro1d.deck.parts import MAX_ZONES, Layer, Output, Time
from hydro1d.errors import Hydro1dError
from hydro1d.laws.base import Law
from hydro1d.laws.check import check_law


def cross_problems(
    layers: Sequence[Layer] | None,
    left: Boundary | None,
    right: Boundary | None,
    time: Time | None,
    output: Output | None,
) -> list[Finding]:
    """Return what is wrong between the parts of a deck; a part that is wrong itself comes as None."""
    found: list[Finding] = []
    if layers is not None:
        found += _check_layers(layers)
    if layers:
        found += _check_end("left", left, layers) + _check_end("right", right, layers)
    if output is not None and time is not None and not isinstance(output.profiles, int):
        found += [
            Finding(("output", "profiles", index), f"{at:g} s lies outside the run", at, f"0 to {time.end:g} s")
            for index, at in _outside(output.profiles, time.end)
        ]
    if output is not None and layers:
        depth = sum(layer.thickness for layer in layers)
        found += [
            Finding(("output", "probes", index), f"{at:g} m lies outside the column", at, f"0 to {depth:g} m")
            for index, at in _outside(output.probes, depth)
        ]
    return found


def _outside(values: Sequence[float], most: float) -> list[tuple[int, float]]:
    """Numbers below 0 or above ``most``, with their indices; at most `MAX_FOUND`."""
    outside = ((index, value) for index, value in enumerate(values) if not 0.0 <= value <= most)
    return list(itertools.islice(outside, MAX_FOUND))


def _check_layers(layers: Sequence[Layer]) -> list[Finding]:
    if not layers:
        return [Finding(("layer",), "there is none", None, "one [[layer]] or more")]
    zones = sum(layer.zones for layer in layers)
    found = []
    if zones > MAX_ZONES:
        found.append(Finding(("layer",), f"{zones} zones in all layers together", zones, f"at most {MAX_ZONES}"))
    checked: list[Law] = []
    for index, layer in enumerate(layers):
        if layer.thickness / layer.zones < 1e-300 or layer.law.density * layer.thickness / layer.zones < 1e-300:
            found.append(Finding(("layer", index), "zones of no size", None, "a larger thickness or fewer zones"))
        if not any(layer.law is law for law in checked):
            checked.append(layer.law)
            try:  # once in plain Python, so that the first error a law's author meets is not a compiler's
                check_law(layer.law)
            except (Exception, SystemExit) as error:  # a user's code may raise anything
                path = ("material", layer.material, "law") if layer.material else ("layer", index, "law")
                found.append(Finding(path, _sentence(error)))
    return found


def _sentence(error: BaseException) -> str:
    text = str(error).strip() or "no message"
    if isinstance(error, ValueError | Hydro1dError):
        return text
    return f"raised {type(error).__name__}: {shorten(text, 200)[1:-1]}"


def _check_end(side: str, boundary: Boundary | None, layers: Sequence[Layer]) -> list[Finding]:
    """Start the boundary once: a load that makes no sense on this end (a striker that flies away) is refused."""
    if boundary is None:
        return []
    sign, layer = (1.0, layers[0]) if side == "left" else (-1.0, layers[-1])
    mass = 0.5 * layer.law.density * layer.thickness / layer.zones
    try:
        boundary.start(sign * layer.velocity, mass, sign)
    except (Exception, SystemExit) as error:
        return [Finding((side,), _sentence(error))]
    return []
