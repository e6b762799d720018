"""Where the compaction fronts are: integral measures over the zones around the places where crushed zones end."""

from __future__ import annotations

import math

from hydro1d.jit.primitives import at
from hydro1d.scheme.records import Grid

WINDOW = 12  # zones on either side of a front that its integral measure takes in


def crushed_strain(g: Grid, number: int) -> float:
    """The layer's densification strain, or half of its largest strain so far; what has not yielded is not crushed."""
    layer, own = at(g.layers, number), at(g.layer_state, number)
    given = layer.crushed_strain
    return given if given == given else max(0.5 * own.max_strain, layer.yield_strain)


def fronts(g: Grid) -> tuple[float, float]:
    """Lagrangian positions (m) of the compaction fronts that run from the left and from the right end; NaN where none runs.

    A layer that cannot be crushed (a plate before the foam) is passed over.
    """
    zones, clock = g.zones, g.clock
    left, right = clock.left_front, clock.right_front
    while left > 0 and not is_passed(g, left - 1):
        left -= 1
    while left < zones and is_passed(g, left):
        left += 1
    while right < zones and not is_passed(g, right):
        right += 1
    while right > 0 and is_passed(g, right - 1):
        right -= 1
    clock.left_front, clock.right_front = left, right
    proximal, distal = math.nan, math.nan
    if left < right:
        if left > 0 and can_crush(g, left - 1):
            layer = at(g.layers, layer_of(g, left))
            start, end = max(left - WINDOW, layer.first), min(left + WINDOW, layer.end, right)
            proximal = g.coordinate[start]
            if start < left:
                proximal += crushed_length(g, start, end, start, end - 1)
        if right < zones and can_crush(g, right):
            layer = at(g.layers, layer_of(g, right - 1))
            start, end = max(right - WINDOW, layer.first, left), min(right + WINDOW, layer.end)
            distal = g.coordinate[end]
            if right < end:
                distal -= crushed_length(g, start, end, end - 1, start)
    return proximal, distal


def is_passed(g: Grid, zone: int) -> bool:
    """Whether a front has no more to do in a zone: it is crushed, or never can be."""
    return g.state[zone] > crushed_strain(g, layer_of(g, zone)) or not can_crush(g, zone)


def can_crush(g: Grid, zone: int) -> bool:
    """Whether the zone's layer has a strain at which it counts as crushed."""
    return crushed_strain(g, layer_of(g, zone)) < math.inf


def layer_of(g: Grid, zone: int) -> int:
    """Which layer a zone belongs to."""
    number = g.layer_count - 1
    while at(g.layers, number).first > zone:
        number -= 1
    return number


def crushed_length(g: Grid, start: int, end: int, behind: int, ahead: int) -> float:
    """Σ (ε − ε_A)/(ε_B − ε_A) ΔX (m) over zones: unlike a half level, it does not see how far the front is smeared.

    ε is the largest strain so far, so that what happens to a zone behind the front does not move the front.
    """
    length = 0.0
    for i in range(start, end):
        above = g.state[i] - g.state[ahead]
        share = above / (g.state[behind] - g.state[ahead]) if g.state[behind] > g.state[ahead] else 0.0
        length += min(max(share, 0.0), 1.0) * (g.coordinate[i + 1] - g.coordinate[i])
    return length
