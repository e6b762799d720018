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
from hydro1d.analysis.theory import CURVES, curve_of
from hydro1d.cli import main
from hydro1d.errors import FileProblem
from hydro1d.report import find_theory, report, write_report
from hydro1d.report._data import shown_rows, telling_row
from hydro1d.report._numbers import energy_numbers, headline, key_numbers
from hydro1d.report._theory import theory_or_reason

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


def test_a_run_that_stopped_claims_no_more_than_it_showed():
    run = made_run(status="failed")
    assert headline(run).startswith("Up to 4 ms the right end has felt 0.84 MPa at most, 0.233 times")
    assert headline(run).endswith("% of the column is not crushed yet.")
    assert "ttenuated" not in headline(run) + str(key_numbers(run, None))


def test_a_wave_that_has_not_arrived_is_nothing():
    run = made_run()
    run.history._arrays["peak_right_stress"] = np.full(400, 1.6e-115)
    said = headline(run)
    assert said.startswith("The wave has not reached the support; attenuated or enhanced is not decided yet.")
    rows = {row.label: row for row in key_numbers(run, None)}
    assert rows["support over applied"].remark == "not decided yet"
    assert rows["peak stress on the support (right end)"].remark == "the wave has not reached it"


def test_what_goes_on_at_the_end_is_said():
    run = made_run()  # its front still runs
    assert headline(run).startswith("Attenuated so far: ")
    assert headline(run).endswith("At the end the column is still being crushed: a later end time may change this.")
    assert {row.label: row.remark for row in key_numbers(run, None)}["support over applied"] == "attenuated so far"


def test_theory_beside_the_run(result):
    theory = find_theory(hydro1d.open_run(result))
    rows = {row.quantity: row for row in theory.rows}
    behind = next(row for name, row in rows.items() if name.startswith("strain behind"))
    assert behind.measured == pytest.approx(behind.exact, rel=2e-3)
    assert any(name.startswith("fully crushed") for name in rows)


@pytest.mark.parametrize(
    "change",
    [
        {"layer": [{"material": "foam", "thickness": 0.5, "zones": 40}] * 2},
        {"left": {"type": "free"}},
        {"left": {"type": "pressure", "pulse": "friedlander", "peak": 1.0}},
        {"material": {"foam": {"law": "my.py:Foam"}}},
        {"left": {"type": "pressure", "pulse": "rectangular", "peak": 1e9, "duration": 1e-3}},
    ],
)
def test_no_theory_where_there_is_none(change):
    run = made_run(deck={**made_run().deck, **change})
    assert find_theory(run) is None
    reason = theory_or_reason(run)
    assert isinstance(reason, str) and reason.endswith(".")
    if "layer" in change:
        return  # the fields of the run made by formula are those of one layer
    text = report(run)
    assert f"No comparison. {reason[:20]}" in text and 'href="#theory"' in text


def test_why_there_is_no_theory():
    several = {"layer": [{"material": "foam", "thickness": 0.5, "zones": 40}] * 2}
    assert "this column has 2" in theory_or_reason(made_run(deck={**made_run().deck, **several}))
    other = {"material": {"foam": {"law": "table", "density": 50.0}}}
    assert 'no closed form for the law "table"' in theory_or_reason(made_run(deck={**made_run().deck, **other}))
    blast = {"left": {"type": "pressure", "pulse": "friedlander", "peak": 1.0}}
    assert "constant or a rectangular pressure" in theory_or_reason(made_run(deck={**made_run().deck, **blast}))


def test_what_the_theory_takes_for_granted_is_said_and_told_apart(result, page):
    run = hydro1d.open_run(result)
    theory = find_theory(run)
    assert theory.exact_until == 1.53e-3 < theory.until
    sides = {row.time <= theory.exact_until for row in theory.rows}
    assert sides == {True, False}
    exact = [abs(row.measured / row.exact - 1.0) for row in theory.rows if row.time <= theory.exact_until]
    assert max(exact) < 0.02  # 100 zones
    text = page.read_text()
    assert text.index("up to 1.53 ms: the same equations") < text.index("afterwards: a simpler model")
    assert "crushed foam as a rigid block" in text and "springs back" in text and "exact up to 1.53 ms" in text


def test_the_page_opens_with_a_profile_that_tells_something(result, page):
    run = hydro1d.open_run(result)
    row = telling_row(run, find_theory(run))
    assert f'max="{len(run.time) - 1}" value="{row}"' in page.read_text()
    time = run.time[shown_rows(run)]
    assert time[row] <= 1.53e-3 < time[row + 1]
    strain = run["strain"][shown_rows(run)[telling_row(run, None)]]
    assert 0.3 < (strain > 0.5).mean() < 0.7


def test_what_opened_is_among_the_key_numbers(result):
    run = hydro1d.open_run(result)
    rows = {number.label: number for number in key_numbers(run, hydro1d.load_deck(run.deck))}
    opened = rows["zones that opened"]
    assert (
        re.fullmatch(r"\d+ of 100", opened.value) and "first seen at" in opened.remark and "at the end" in opened.remark
    )
    stretched = rows["zones stretched beyond their initial length"]
    assert float(stretched.remark.split(" times")[0]) == pytest.approx(1.0 - run["strain"].min(), rel=5e-3)


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
    assert more.keys() == CURVES.keys()
    assert curve_of({"law": "table"}) is None
    with pytest.raises(KeyError, match="modulus"):
        curve_of({"law": "elastic", "density": 51.6, "modulus": True})


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
