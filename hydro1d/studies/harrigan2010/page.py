"""index.html: every figure and number on one self-contained page."""

import base64
import html
import math
from pathlib import Path

from hydro1d import __version__
from hydro1d.studies.harrigan2010.workshop import Number, Picture, Workshop

_SOURCE = (
    "<p>Harrigan, Reid &amp; Seyed Yaghoubi, Int. J. Impact Engineering 37 (2010) 918–927, "
    "<a href='https://doi.org/10.1016/j.ijimpeng.2009.03.011'>doi:10.1016/j.ijimpeng.2009.03.011</a>. Each table puts "
    "side by side what the paper prints, what its equations give, and what the solver gives; an empty cell is a number "
    "that a column does not have. The difference is the solver's from the equations, or else the equations' from the "
    "paper. T over Eq. 30 is a critical duration divided by that of Eq. 30 at the same pressure.</p>"
)


def write_page(work: Workshop, seconds: float) -> None:
    """Write index.html into the workshop's folder."""
    short = "" if work.size.studies else "The quick form: fewer points, coarser grids, no studies. "
    parts = [
        "<!doctype html><html lang='en'><meta charset='utf-8'>",
        "<meta name='viewport' content='width=device-width'>",
        "<title>The correct analysis of shocks, reproduced</title>",
        f"<style>\n{Path(__file__).with_name('page.css').read_text(encoding='utf-8')}</style>",
        "<h1>The correct analysis of shocks in a cellular material, reproduced</h1>",
        _SOURCE,
        f"<p class='note'>{short}Made in {seconds:.0f} s by hydro1d {__version__}. All numbers: "
        "<a href='numbers.csv'>numbers.csv</a>; what the figures were drawn from: the folder data.</p>",
        "<nav>" + " ".join(f"<a href='#{p.name}'>{html.escape(p.title)}</a>" for p in work.pictures) + "</nav>",
    ]
    for picture in work.pictures:
        parts += _section(work, picture)
    (work.folder / "index.html").write_text("\n".join(parts) + "\n</html>\n", encoding="utf-8")


def _section(work: Workshop, picture: Picture) -> list[str]:
    image = base64.b64encode((work.folder / f"{picture.name}.png").read_bytes()).decode()
    title, files = html.escape(picture.title), (f"{picture.name}.{kind}" for kind in ("csv", "svg", "png"))
    return [
        f"<h2 id='{picture.name}'>{title}</h2>",
        f"<img alt='{title}' src='data:image/png;base64,{image}'>",
        f"<p class='caption'>{html.escape(picture.caption)}</p>",
        "<p class='note'>" + " · ".join(f"<a href='{file}'>{file}</a>" for file in files) + "</p>",
        _table([item for item in work.numbers if item.figure == picture.figure]),
    ]


def _table(numbers: list[Number]) -> str:
    if not numbers:
        return ""
    head = "<tr><th>quantity</th>"
    head += "<th class='n'>paper</th><th class='n'>equations</th><th class='n'>solver</th><th>unit</th>"
    rows = [f"<table>{head}<th class='n'>difference</th><th>note</th></tr>"]
    for item in numbers:
        shown = ("" if math.isnan(x) else f"{x:.5g}" for x in (item.paper, item.equations, item.solver))
        cells = "".join(f"<td class='n'>{number}</td>" for number in shown)
        change = "" if math.isnan(item.difference) else f"{100 * item.difference:+.3g} %"
        unit = html.escape(item.unit if item.unit != "1" else "")
        rows.append(
            f"<tr><td>{html.escape(item.quantity)}</td>{cells}<td>{unit}</td>"
            f"<td class='n'>{change}</td><td class='note'>{html.escape(item.note)}</td></tr>"
        )
    return "\n".join(rows) + "</table>"
