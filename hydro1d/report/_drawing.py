"""The column as a small SVG drawing."""

import html
from typing import Any

import numpy as np

from hydro1d.plot._base import PALETTE
from hydro1d.plot._units import scale_for
from hydro1d.store import Run

_WIDTH, _LEFT, _TOP, _HEIGHT = 860.0, 130.0, 34.0, 84.0
_MIN_WIDTH = 26.0  # a layer thinner than this in the drawing would not be seen


def column_svg(run: Run) -> str:
    """Layers from left to right with material, thickness and zones, and what acts on the ends."""
    layers = run.deck.get("layer", [])
    room = _WIDTH - 2 * _LEFT
    sizes = np.array([float(layer["thickness"]) for layer in layers])
    widths = np.maximum(sizes / sizes.sum() * room, min(_MIN_WIDTH, room / len(sizes)))
    widths *= room / widths.sum()
    names = list(dict.fromkeys(str(layer["material"]) for layer in layers))
    parts, x = [], _LEFT
    for layer, width in zip(layers, widths, strict=True):
        parts.append(_layer(layer, x, float(width), PALETTE[names.index(str(layer["material"])) % 7]))
        x += float(width)
    parts += [_end(run.deck.get("left", {}), _LEFT, 1.0), _end(run.deck.get("right", {}), _LEFT + room, -1.0)]
    height = _TOP + _HEIGHT + 62
    return (
        f'<svg viewBox="0 0 {_WIDTH:.0f} {height:.0f}" role="img" aria-label="the column and its boundaries">'
        f"{''.join(parts)}</svg>"
    )


def _layer(layer: dict[str, Any], x: float, width: float, colour: str) -> str:
    thickness = scale_for("m", layer["thickness"]).show(float(layer["thickness"]))
    lines = [str(layer["material"]), thickness, f"{layer['zones']} zones"]
    if layer.get("velocity"):
        lines.append(f"{float(layer['velocity']):+.4g} m/s")
    box = (
        f'<rect x="{x:.1f}" y="{_TOP}" width="{width:.1f}" height="{_HEIGHT}" fill="{colour}" fill-opacity="0.22" '
        f'stroke="{colour}"/>'
    )
    middle = x + 0.5 * width
    if width >= 70:
        texts = [_text(middle, _TOP + 26 + 20 * k, line, "middle") for k, line in enumerate(lines)]
    else:  # too narrow for words: below, on a slant-free line with a tick
        texts = [_text(middle, _TOP + _HEIGHT + 18 + 14 * k, line, "middle", 10) for k, line in enumerate(lines[:2])]
    return box + "".join(texts)


def _end(boundary: dict[str, Any], x: float, inward: float) -> str:
    kind = str(boundary.get("type", ""))
    draw = {"wall": _wall, "pressure": _arrows, "striker": _block, "piston": _block}.get(kind)
    sketch = draw(x, inward) if draw is not None else ""
    outer = x - inward * 66
    label = [_text(outer, _TOP - 8, kind, "middle", 13)]
    shown = [line for line in _facts(boundary) if line][:4]
    label += [_text(outer, _TOP + _HEIGHT + 18 + 14 * k, line, "middle", 11) for k, line in enumerate(shown)]
    return sketch + "".join(label)


def _facts(boundary: dict[str, Any]) -> list[str]:
    units = {"peak": "Pa", "duration": "s", "decay_time": "s", "velocity": "m s-1", "mass": "kg m-2"}
    facts = [f"{boundary['pulse']} pulse"] if boundary.get("pulse") else []
    for name, units_of in units.items():
        value = boundary.get(name)
        if isinstance(value, int | float):
            facts.append(f"{name.replace('_', ' ')} {scale_for(units_of, value).show(float(value))}")
    return facts


def _wall(x: float, inward: float) -> str:
    strokes = "".join(
        f'<line x1="{x}" y1="{_TOP + 12 * k}" x2="{x - inward * 14}" y2="{_TOP + 12 * k + 12}" stroke="#555"/>'
        for k in range(int(_HEIGHT // 12))
    )
    return f'<line x1="{x}" y1="{_TOP}" x2="{x}" y2="{_TOP + _HEIGHT}" stroke="#222" stroke-width="3"/>{strokes}'


def _arrows(x: float, inward: float) -> str:
    start = x - inward * 44
    arrows = []
    for k in range(4):
        y = _TOP + _HEIGHT * (k + 0.5) / 4
        tip, back = x - inward * 3, x - inward * 13
        arrows.append(
            f'<line x1="{start}" y1="{y}" x2="{back}" y2="{y}" stroke="#222" stroke-width="2"/>'
            f'<polygon points="{tip},{y} {back},{y - 5} {back},{y + 5}" fill="#222"/>'
        )
    return "".join(arrows)


def _block(x: float, inward: float) -> str:
    left = x - 36 if inward > 0 else x
    return f'<rect x="{left}" y="{_TOP + 6}" width="36" height="{_HEIGHT - 12}" fill="#888" stroke="#333"/>'


def _text(x: float, y: float, text: str, anchor: str, size: int = 13) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}">{html.escape(text[:40])}</text>'
