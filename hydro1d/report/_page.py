"""The page: its sections, tables and pictures, put together as one text of HTML."""

import base64
import hashlib
import html
import io
import json
import os
from collections.abc import Iterable, Sequence
from importlib import resources
from pathlib import Path
from typing import Any

from hydro1d import plot
from hydro1d.deck import Deck
from hydro1d.errors import file_problems
from hydro1d.plot._data import RunOrPath, as_run
from hydro1d.plot._materials import deck_of
from hydro1d.plot._units import scale_for
from hydro1d.report._data import page_data, shown_rows, telling_row
from hydro1d.report._drawing import column_svg
from hydro1d.report._numbers import Number, energy_numbers, headline, key_numbers, require_history
from hydro1d.report._theory import Row, Theory, theory_or_reason
from hydro1d.store import Run

_PICTURES = (("stress", "lagrangian"), ("strain", "lagrangian"), ("velocity", "lagrangian"), ("stress", "laboratory"))


def write_report(run: RunOrPath, path: str | os.PathLike[str], deck: Deck | str | Path | None = None) -> Path:
    """Write the page about a run. deck: where laws of the user's own are taken from. Raises FileProblem."""
    text, target = report(run, deck), Path(path)
    with file_problems("write", target):
        target.write_text(text, encoding="utf-8")
    return target


def report(run: RunOrPath, deck: Deck | str | Path | None = None) -> str:
    """The page as text: no script, style, picture or font comes from anywhere else."""
    run = as_run(run)
    require_history(run)
    known, theory = deck_of(run, deck), theory_or_reason(run)
    known_theory = theory if isinstance(theory, Theory) else None
    data = json.dumps(page_data(run, known_theory), separators=(",", ":"), allow_nan=False)
    script, style = _file("page.js"), _file("page.css")
    body = "\n".join(_sections(run, known, theory, deck))
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en"><head><meta charset="utf-8">',
            f'<meta http-equiv="Content-Security-Policy" content="{_policy(script, style)}">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{_text(run.title or 'hydro1d run')}</title>",
            f"<style>{style}</style></head>",
            f"<body><main>{body}</main>",
            f'<script type="application/json" id="data">{_inert(data)}</script>',
            f"<script>{script}</script></body></html>",
            "",
        ]
    )


def _policy(script: str, style: str) -> str:
    """Nothing but this page's own script, style and pictures may run or be shown, and nothing may be asked for."""
    allowed = [f"'sha256-{_digest(text)}'" for text in (script, style)]
    return f"default-src 'none'; img-src data:; script-src {allowed[0]}; style-src {allowed[1]}; base-uri 'none'"


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")


def _file(name: str) -> str:
    return resources.files(__package__).joinpath(name).read_text(encoding="utf-8")


def _inert(data: str) -> str:
    """JSON in which no text can end the script element around it."""
    return data.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _text(text: object) -> str:
    return html.escape(str(text))


def _sections(run: Run, known: Deck | None, theory: Theory | str, deck: Any) -> Iterable[str]:
    yield _head(run, known)
    yield f'<h2 id="column">The column</h2>{column_svg(run)}'
    yield '<h2 id="numbers">Key numbers</h2><div class="columns"><div>' + _table(key_numbers(run, known))
    yield "</div><div>" + _table(energy_numbers(run, known), "energy per area") + "</div></div>"
    yield _comparison(theory)
    if len(run.time) > 1:
        yield '<h2 id="xt">x–t diagram</h2>' + _pictures(run)
    if len(run.time):
        yield _slider(run, theory if isinstance(theory, Theory) else None)
    yield (
        '<h2 id="history">Histories</h2><div class="bar"><span class="note">Drag across a chart to zoom in, '
        'double-click to see all; point to read off.</span><button type="button" id="whole">show all</button></div>'
        '<div id="histories"></div>'
    )
    if len(run.time) > 1:
        figure, _ = plot.hugoniot(run, deck=known if deck is not None else None)
        note = (
            "Within a front the total stress σ + q follows the straight Rayleigh line; the law's curve is only where "
            "it starts and ends. Behind it, zones unload on the steep line."
        )
        yield f'<h2 id="hugoniot">Strain–stress plane</h2>{_image(figure, "strain–stress plane")}'
        yield f'<p class="note">{note}</p>'
    yield f'<h2 id="deck">The deck</h2><pre>{_text(run.deck_text or json.dumps(run.deck, indent=1))}</pre>'
    resolved = _text(json.dumps(run.deck, indent=1))
    yield f"<details><summary>as resolved, in SI units</summary><pre>{resolved}</pre></details>"
    yield "<noscript><p class='answer warning'>Profiles and histories need JavaScript.</p></noscript>"


def _head(run: Run, known: Deck | None) -> str:
    version, created = run.attributes.get("hydro1d_version", "?"), run.attributes.get("created", "")
    where = run.path.name if run.path is not None else "in memory"
    parts = [f"<h1>{_text(run.title or 'hydro1d run')}</h1>"]
    parts.append(f'<p class="meta">{_text(where)} · hydro1d {_text(version)} · {_text(created)}</p>')
    if run.status != "complete":
        message = run.attributes.get("message") or "not finished; what follows is what there is so far"
        parts.append(f'<p class="answer warning">This run is {_text(run.status)}: {_text(message)}</p>')
    parts.append(f'<p class="answer">{_text(headline(run, known))}</p>')
    links = (
        ("numbers", "numbers"),
        ("theory", "theory"),
        ("xt", "x–t diagram"),
        ("profile", "profiles"),
        ("history", "histories"),
    )
    more = (("hugoniot", "strain–stress plane"), ("deck", "deck"))
    return "".join(parts) + "<nav>" + "".join(f'<a href="#{name}">{text}</a>' for name, text in links + more) + "</nav>"


def _table(rows: Sequence[Number], caption: str = "") -> str:
    cells = "".join(
        f'<tr><td>{_text(row.label)}</td><td class="value">{_text(row.value)}</td>'
        f'<td class="remark">{_text(row.remark)}</td></tr>'
        for row in rows
    )
    head = f'<tr><th colspan="3">{_text(caption)}</th></tr>' if caption else ""
    return f"<table>{head}{cells}</table>"


def _comparison(theory: Theory | str) -> str:
    if isinstance(theory, str):
        return f'<h2 id="theory">Beside theory</h2><p class="note">No comparison. {_text(theory)}</p>'
    exact = [row for row in theory.rows if row.time <= theory.exact_until * (1 + 1e-9)]
    rest = [row for row in theory.rows if row not in exact]
    limit = scale_for("s", theory.exact_until).show(theory.exact_until, 3)
    groups = [(f"up to {limit}: the same equations", exact), ("afterwards: a simpler model" if exact else "", rest)]
    body = "".join(_group(title, rows) for title, rows in groups if rows)
    return (
        f'<h2 id="theory">Beside theory: {_text(theory.name)}</h2>'
        f"<table><tr><th>quantity</th><th>theory</th><th>calculated</th><th>difference</th></tr>{body}</table>"
        f'<p class="note">{_text(theory.assumes)} Source: {_text(theory.source)}.</p>'
    )


def _group(title: str, rows: Sequence[Row]) -> str:
    head = f'<tr><td class="remark" colspan="4">{_text(title)}</td></tr>' if title else ""
    return head + "".join(
        f'<tr><td>{_text(row.quantity)}</td><td class="value">{_text(row.scale.show(row.exact))}</td>'
        f'<td class="value">{_text(row.scale.show(row.measured))}</td>'
        f'<td class="value">{_text(row.difference)}</td></tr>'
        for row in rows
    )


def _pictures(run: Run) -> str:
    buttons, figures = [], []
    for k, (quantity, frame) in enumerate(_PICTURES):
        figure, _ = plot.xt(run, quantity, frame)
        name = f"picture-{k}"
        text = quantity if frame == "lagrangian" else f"{quantity}, laboratory"
        buttons.append(
            f'<button type="button" data-shows="{name}" aria-pressed="{str(k == 0).lower()}">{text}</button>'
        )
        hidden = "" if k == 0 else " hidden"
        figures.append(f'<div id="{name}"{hidden}>{_image(figure, f"x-t diagram of {text}")}</div>')
    return f'<div class="bar" id="pictures">{"".join(buttons)}</div>{"".join(figures)}'


def _image(figure: Any, text: str) -> str:
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=120)
    return (
        f'<img alt="{_text(text)}" src="data:image/png;base64,{base64.b64encode(stream.getvalue()).decode("ascii")}">'
    )


def _slider(run: Run, theory: Theory | None) -> str:
    note = ""
    if theory is not None:
        exact, until = (scale_for("s", time).show(time, 3) for time in (theory.exact_until, theory.until))
        first = f"exact up to {exact}, a simpler model until" if theory.exact_until < theory.until else "exact until"
        if theory.exact_until == 0.0:
            first = "a simpler model, until"
        note = f'<p class="note">Dashed: {_text(theory.name)}; {first} {until}.</p>'
    last = len(shown_rows(run)) - 1
    return (
        '<h2 id="profile">Profiles</h2><div class="bar"><button type="button" id="play">play</button>'
        f'<input type="range" id="time" min="0" max="{last}" value="{telling_row(run, theory)}" aria-label="time">'
        '<output id="clock"></output>'
        '<button type="button" id="frame" aria-pressed="false">laboratory frame</button></div>'
        f'<div id="profiles"></div>{note}'
    )
