"""The page: complete, harmless, small, and it asks nothing of a network."""

import html.parser
import json
import re
import shutil
import subprocess

import numpy as np
import pytest
from synthetic import made_run

import hydro1d
from hydro1d.cli import main
from hydro1d.errors import FileProblem
from hydro1d.report import find_theory, report, write_report
from hydro1d.report._numbers import energy_numbers, headline, key_numbers
from hydro1d.report._theory import curve_of

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None
)
VOID = {"meta", "img", "input", "rect", "line", "polygon", "br"}


@pytest.fixture(scope="module")
def page(result, tmp_path_factory):
    return write_report(result, tmp_path_factory.mktemp("page") / "coarse.html")


class Structure(html.parser.HTMLParser):
    """Every element that opens closes; addresses are collected."""

    def __init__(self):
        super().__init__()
        self.open, self.addresses, self.names = [], [], set()

    def handle_starttag(self, tag, attributes):
        self.names.add(tag)
        self.addresses += [value for name, value in attributes if name in ("src", "href", "action", "data")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop() == tag


def test_page_is_whole_and_refers_to_nothing_outside(page):
    text = page.read_text()
    structure = Structure()
    structure.feed(text)
    assert structure.open == []
    assert all(address.startswith(("#", "data:image/png;base64,")) for address in structure.addresses)
    assert "default-src 'none'" in text and "url(" not in text and "@import" not in text
    assert not re.search(r"fetch\(|XMLHttpRequest|WebSocket|import\(", text)
    assert page.stat().st_size < 3_000_000


def test_page_escapes_what_a_deck_says(page):
    text = page.read_text()
    assert "<b>on</b>" not in text
    assert "Pulse &lt;b&gt;on&lt;/b&gt; foam &amp; wall" in text


def test_data_are_json_with_the_profiles(page, result):
    text = re.search(r'id="data">(.*?)</script>', page.read_text(), re.S).group(1)
    data = json.loads(text)
    assert len(data["profiles"]["time"]) == 36
    assert [panel["name"] for panel in data["profiles"]["panels"]] == ["stress", "strain", "velocity"]
    assert data["profiles"]["theory"]["count"] > 10
    assert len(data["histories"]["panels"]) >= 6


def test_packed_numbers_come_back(result):
    import base64

    from hydro1d.report._data import page_data

    run = hydro1d.open_run(result)
    panel = page_data(run, None)["profiles"]["panels"][1]["values"]
    raw = np.frombuffer(base64.b64decode(panel["data"]), "<u2").reshape(panel["shape"])
    values = panel["low"] + raw * (panel["high"] - panel["low"]) / 65534
    inside = (run["strain"] > panel["low"]) & (run["strain"] < panel["high"])
    assert np.abs(values - run["strain"])[inside].max() < 1e-4


def test_headline_and_numbers(result):
    run = hydro1d.open_run(result)
    assert headline(run).startswith("Attenuated: the right end feels 1.")
    labels = {number.label: number.value for number in key_numbers(run, None)}
    assert labels["peak of the applied pressure"] == "3.6 MPa"
    assert labels["layer that limits the time step"] == "foam"
    deck = hydro1d.load_deck(run.deck)
    energies = {number.label: number.value for number in energy_numbers(run, deck)}
    assert {"dissipated in fronts", "stored elastically", "absorbed by crushing along the curve"} <= set(energies)


def test_theory_beside_the_run(result):
    theory = find_theory(hydro1d.open_run(result))
    rows = {row.quantity: row for row in theory.rows}
    behind = next(row for name, row in rows.items() if name.startswith("strain behind"))
    assert behind.measured == pytest.approx(behind.exact, rel=2e-3)
    assert any(name.startswith("fully crushed") for name in rows)


@pytest.mark.parametrize(
    "change",
    [
        {"layer": [{"material": "foam", "thickness": 0.5}, {"material": "foam", "thickness": 0.5}]},
        {"left": {"type": "free"}},
        {"left": {"type": "pressure", "pulse": "friedlander", "peak": 1.0}},
        {"material": {"foam": {"law": "my.py:Foam"}}},
        {"left": {"type": "pressure", "pulse": "rectangular", "peak": 1e9, "duration": 1e-3}},
    ],
)
def test_no_theory_where_there_is_none(change):
    assert find_theory(made_run(deck={**made_run().deck, **change})) is None


def test_every_law_of_the_theory_has_its_curve():
    foam = {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689}
    more = {
        "elastic": {}, "epph": {"shock_slope": 1e-3}, "epph-tangent": {"beta": 1.0, "gamma": 0.6},
        "rppl": {"stiffness": 1e3},
        "trilinear": {"locking_modulus": 4e7}, "eppr": {"stiffness": 1e3}, "rph": {"hardening": 1e5},
        "eph": {"yield_stress": 1e6, "hardening_modulus": 1e5},
    }  # fmt: skip
    for law, own in more.items():
        assert curve_of({"law": law, **foam, **own}).stress(0.01) > 0.0
    assert curve_of({"law": "table"}) is None


def test_partial_runs_have_a_page_and_say_so():
    assert "This run is running" in report(made_run(status="running"))
    assert "Profiles</h2>" not in report(made_run(times=0))
    with pytest.raises(FileProblem, match="no history"):
        report(made_run(drop=("history",)))


def test_bad_place_is_said(result, tmp_path):
    with pytest.raises(FileProblem, match="cannot write"):
        write_report(result, tmp_path / "missing" / "a.html")


def test_command(result, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["report", str(result)]) == 0
    assert capsys.readouterr().out == "coarse.html\n"
    assert (tmp_path / "coarse.html").stat().st_size > 100_000


@pytest.mark.skipif(CHROMIUM is None, reason="needs chromium")
def test_a_browser_draws_it_and_asks_for_nothing(page, tmp_path):
    log = tmp_path / "net.json"
    done = subprocess.run(
        [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=3000",
         "--enable-logging=stderr",
         f"--user-data-dir={tmp_path / 'profile'}", f"--log-net-log={log}", "--dump-dom", f"file://{page}"],
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert 'data-ready="yes"' in done.stdout  # the script ran to its end: the policy let it
    assert done.stdout.count("<canvas") >= 9
    assert "Refused" not in done.stderr and "CONSOLE" not in done.stderr, done.stderr[-2000:]
    asked = {address for address in re.findall(r'"url":"([^"]*)"', log.read_text()) if address.startswith("http")}
    assert not {address for address in asked if "google" not in address and "gvt1" not in address}  # the browser's own
