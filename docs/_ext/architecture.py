"""``{architecture}``: the rooms of the package and what each needs, drawn from the imports of the code itself.

Rooms are the folders of ``hydro1d/``, and ``api``. An arrow leads from a room to one that it imports. Arrows that follow
from others are left out; one that leads upwards, round a circle, is red.
"""

import ast
import os
import re
import textwrap
from itertools import pairwise
from pathlib import Path

import numpy as np
from docutils import nodes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from matplotlib.path import Path as Curve
from scipy.optimize import isotonic_regression
from sphinx.util.docutils import SphinxDirective

PACKAGE = Path(__file__).parents[2] / "hydro1d"
# Stages that data pass through, their colours, and the rooms of each; a room that stands nowhere is grey.
STAGES = {
    "ways in": ("#333333", ("cli", "api")),
    "what to run": ("#E69F00", ("deck", "components", "laws", "boundaries", "interfaces", "loads")),
    "the calculation": ("#0072B2", ("solver", "scheme", "jit")),
    "the result": ("#009E73", ("store",)),
    "what it says": ("#CC79A7", ("analysis", "plot", "report", "sweep", "fit")),
    "is it right, how fast": ("#8C6D31", ("analytic", "verify", "studies", "benchmarks")),
}  # fmt: skip
PATH = ("deck.toml", "Deck", "Column", "time loop", "run.h5", "Run", "figures, report")
PATH_STAGES = (1, 1, 2, 2, 3, 3, 4)
GREY, RED, INK = "#999999", "#D0312D", "#333333"
WIDTH, HEIGHT, GAP, FLOOR = 1.64, 0.74, 0.16, 1.2  # of a box, between boxes, from floor to floor; inches


def imported(path: Path) -> set[str]:
    """First words behind ``hydro1d.`` of what a file imports when it runs: not what type checkers alone see."""
    found, waiting = set(), [ast.parse(path.read_text(encoding="utf-8"))]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
            waiting += node.orelse
            continue
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
        waiting += ast.iter_child_nodes(node)
    return {name.split(".")[1] for name in found if name.startswith("hydro1d.")}


def rooms_and_needs() -> dict[str, set[str]]:
    """Each room and the rooms that it imports."""
    rooms = {folder.parent.name: sorted(folder.parent.rglob("*.py")) for folder in PACKAGE.glob("*/__init__.py")}
    rooms["api"] = [PACKAGE / "api.py"]
    return {
        room: {name for file in files for name in imported(file)} & set(rooms) - {room}
        for room, files in sorted(rooms.items())
    }


def reach(needs: dict[str, set[str]]) -> dict[str, set[str]]:
    """All rooms that each needs, at any distance."""
    far = {room: set(names) for room, names in needs.items()}
    for middle in far:
        for room in far:
            if middle in far[room]:
                far[room] |= far[middle]
    return far


def floors(needs: dict[str, set[str]]) -> dict[str, int]:
    """Floor of each room, counted from the top: one below the lowest that needs it; rooms of a circle share one."""
    far = reach(needs)
    level = dict.fromkeys(needs, 0)
    for _ in needs:
        for room, names in needs.items():
            for name in names:
                circle = room in far[name]
                level[name] = max(level[name], level[room] + (0 if circle else 1))
    return level


def arrows(needs: dict[str, set[str]]) -> list[tuple[str, str]]:
    """Those that do not follow from others."""
    far = reach(needs)
    return [
        (room, name) for room, names in needs.items() for name in sorted(names)
        if not any(name in far[other] and room not in far[other] and other not in far[name] for other in names - {name})
    ]  # fmt: skip


def chains(edges: list[tuple[str, str]], level: dict[str, int]) -> list[list]:
    """Each arrow as a list of stations, one a floor: rooms at its ends, a point of its own on each floor between."""
    made = []
    for room, name in edges:
        between = [(room, name, floor) for floor in range(level[room] + 1, level[name])]
        made.append([room, *between, name])
    return made


def places(lines: list[list], level: dict[str, int]) -> dict:
    """Horizontal places of all stations, inches: few crossings, then near to what each is joined with."""
    rows: dict[int, list] = {}
    floor_of = {
        station: level[station] if isinstance(station, str) else station[2] for line in lines for station in line
    }
    floor_of |= level
    for station in sorted(floor_of, key=str):
        rows.setdefault(floor_of[station], []).append(station)
    joined: dict = {station: [] for station in floor_of}
    for line in lines:
        for one, other in pairwise(line):
            if floor_of[one] != floor_of[other]:
                joined[one].append(other)
                joined[other].append(one)
    x = {station: float(k) for row in rows.values() for k, station in enumerate(row)}

    def middle(station, side: int) -> float:
        near = [x[other] for other in joined[station] if (floor_of[other] - floor_of[station]) * side > 0]
        return float(np.mean(near)) if near else x[station]

    for sweep in range(60):
        side = -1 if sweep % 2 == 0 else 1
        for floor in sorted(rows, reverse=side > 0):
            rows[floor].sort(key=lambda station: middle(station, side))
            spread(rows[floor], x, [middle(station, side) for station in rows[floor]])
    for _ in range(60):
        for row in rows.values():
            spread(row, x, [np.mean([x[other] for other in joined[station]] or [x[station]]) for station in row])
    return x


def spread(row: list, x: dict, wanted: list[float]) -> None:
    """Set a row as near to its wanted places as its widths allow, in its order."""
    widths = np.array([WIDTH if isinstance(station, str) else 0.12 for station in row]) + GAP
    offset = np.concatenate([[0.0], np.cumsum(0.5 * (widths[1:] + widths[:-1]))])
    for station, place in zip(row, isotonic_regression(np.array(wanted) - offset).x + offset, strict=True):
        x[station] = float(place)


def about(room: str) -> str:
    """What a room says of itself: its docstring's first clause, without the room's own name before a colon."""
    file = PACKAGE / room / "__init__.py" if room != "api" else PACKAGE / "api.py"
    first = re.split(r"[.;]", ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))).replace("`", ""))[0]
    head, _, rest = first.partition(": ")
    own = rest and room.rstrip("s")[:6] in head.lower()
    return textwrap.fill(textwrap.shorten(rest if own else head, 68, placeholder=" …"), 25)


def colour(room: str) -> str:
    """Colour of its stage."""
    return next((shade for shade, rooms in STAGES.values() if room in rooms), GREY)


def draw() -> Figure:
    """The path of the data above, the rooms below."""
    needs = rooms_and_needs()
    level = floors(needs)
    lines = chains(arrows(needs), level)
    x = places(lines, level)
    left, right = min(x.values()) - 0.6 * WIDTH, max(x.values()) + 0.6 * WIDTH
    deep = max(level.values())
    top = 1.25
    figure = Figure(figsize=(right - left, (deep + 0.9) * FLOOR + top))
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set(xlim=(left, right), ylim=(-(deep + 0.55) * FLOOR, top + 0.35 * FLOOR))
    ax.axis("off")
    path_of_data(ax, left + 0.2, right - 0.2, top)
    for line in lines:
        arrow(
            ax,
            [(x[station], -FLOOR * (level[station] if isinstance(station, str) else station[2])) for station in line],
        )
    for room, floor in level.items():
        box(ax, x[room], -FLOOR * floor, room, about(room), colour(room))
    return figure


def path_of_data(ax, left: float, right: float, y: float) -> None:
    """The way from a deck to a report, a box a station, and the key of the colours."""
    step = (right - left) / len(PATH)
    shades = [shade for shade, _ in STAGES.values()]
    for k, (text, stage) in enumerate(zip(PATH, PATH_STAGES, strict=True)):
        low, high = left + k * step + 0.1, left + (k + 1) * step - 0.1
        shape = FancyBboxPatch(
            (low, y - 0.21), high - low, 0.42, "round,pad=0,rounding_size=0.21", lw=0, fc=shades[stage]
        )
        ax.add_patch(shape)
        ax.text(
            (low + high) / 2, y, textwrap.fill(text, 12), color="white", weight="bold", ha="center", va="center", size=9
        )
        if k:
            ax.add_patch(
                FancyArrowPatch(
                    (low - 0.2, y), (low, y), arrowstyle="-|>", mutation_scale=11, color=INK, shrinkA=1, shrinkB=1
                )
            )
    for k, (text, (shade, _)) in enumerate(STAGES.items()):
        at = left + 0.1 + k * (right - left) / len(STAGES)
        ax.plot([at + 0.06], [y - 0.55], "s", color=shade, markersize=8)
        ax.text(at + 0.2, y - 0.55, text, va="center", size=9, color=INK)


def arrow(ax, points: list[tuple[float, float]]) -> None:
    """A smooth line from the lower edge of a box through the gaps of the floors to the upper edge of another."""
    (x0, y0), (x1, y1) = points[0], points[-1]
    if y0 == y1:
        side = 1.0 if x1 > x0 else -1.0
        ends = [(x0 + side * WIDTH / 2, y0 + 0.1 * side), (x1 - side * WIDTH / 2, y1 + 0.1 * side)]
        ax.add_patch(
            FancyArrowPatch(
                *ends, connectionstyle="arc3,rad=0.2", arrowstyle="-|>", mutation_scale=10, color=RED, lw=1.2
            )
        )
        return
    vertices, codes = [(x0, y0 - HEIGHT / 2)], [Curve.MOVETO]
    for k, (x, y) in enumerate(points[1:], start=1):
        (before, low), high = vertices[-1], y + HEIGHT / 2 + 0.03
        bend = 0.5 * (low - high)
        vertices += [(before, low - bend), (x, high + bend), (x, high)]
        codes += [Curve.CURVE4] * 3
        if k < len(points) - 1:  # straight down beside the boxes of a floor
            vertices.append((x, y - HEIGHT / 2))
            codes.append(Curve.LINETO)
    ax.add_patch(
        FancyArrowPatch(path=Curve(vertices, codes), arrowstyle="-|>", mutation_scale=9, color=GREY, lw=1.0, zorder=1)
    )


def box(ax, x: float, y: float, name: str, words: str, shade: str) -> None:
    """A room: name and what it is for."""
    corner = (x - WIDTH / 2, y - HEIGHT / 2)
    ax.add_patch(
        FancyBboxPatch(corner, WIDTH, HEIGHT, "round,pad=0,rounding_size=0.08", fc="white", ec=shade, lw=1.6, zorder=2)
    )
    ax.text(x, y + 0.23, name, ha="center", va="center", size=10, weight="bold", color=shade, zorder=3)
    ax.text(x, y - 0.09, words, ha="center", va="center", size=7.3, color=INK, zorder=3, linespacing=1.15)


class Architecture(SphinxDirective):
    """The drawing, in place."""

    def run(self) -> list[nodes.Node]:
        """Draw into the build's folder; the page is read anew at every build, since the code may have changed."""
        self.env.note_reread()
        target = Path(self.env.doctreedir) / "drawings" / "architecture.svg"
        target.parent.mkdir(parents=True, exist_ok=True)
        draw().savefig(target, metadata={"Date": None})
        page = Path(self.env.doc2path(self.env.docname)).parent
        text = "path of the data; rooms of the package and what each imports"
        return [nodes.image(uri=os.path.relpath(target, page), alt=text, classes=["drawing"])]


def setup(app):
    """Register the directive."""
    app.add_directive("architecture", Architecture)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
