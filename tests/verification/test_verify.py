"""The suite's own machinery: counting, failing, reporting. What it measures is its own business."""

import json
import math
import re
import subprocess
import sys
from html.parser import HTMLParser

import numpy as np
import pytest

from hydro1d.cli import main
from hydro1d.verify import Case, Effort, Row, Table, all_cases, chosen, run_case, run_suite
from hydro1d.verify.convergence import crossing, extrapolate, mean_over, order
from hydro1d.verify.markdown import markdown_page
from hydro1d.verify.page import html_page
from hydro1d.verify.rows import line
from hydro1d.verify.suite import CASES, ROWS, Report, registered_whole


def _case(study, rows=1, name="made up"):
    return Case(name, "Made up", "A case for tests.", rows, study)


def _passing(table, effort):
    table.compare("one", 1.0, 1.0 + 1e-6, 1e-3, "because")


def test_the_registry_holds_what_the_suite_says():
    cases = all_cases()
    assert (len(cases), sum(case.rows for case in cases)) == (CASES, ROWS)
    assert len({case.name for case in cases}) == CASES
    assert registered_whole(cases) is None


def test_a_missing_case_is_a_failure():
    row = registered_whole(all_cases()[:-1])
    assert row is not None
    assert not row.passed


def test_a_case_that_raises_is_a_failure_row():
    def broken(table, effort):
        _passing(table, effort)
        raise RuntimeError("out of foam")

    report = run_case(_case(broken), Effort())
    assert not report.passed
    assert "out of foam" in report.rows[-1].reason


@pytest.mark.parametrize("rows", [0, 2])
def test_a_wrong_number_of_rows_is_a_failure(rows):
    report = run_case(_case(_passing, rows), Effort())
    assert not report.passed
    assert report.rows[-1].quantity == "number of rows"


def test_the_right_number_passes_in_the_order_given():
    cases = [_case(_passing, name=f"case {k}") for k in range(7)]
    told = []
    reports = run_suite(cases, workers=3, done=told.append)
    assert [report.case.name for report in reports] == [f"case {k}" for k in range(7)] == [r.case.name for r in told]
    assert all(report.passed for report in reports)


@pytest.mark.parametrize("measured", [math.nan, math.inf, 1.1])
def test_what_is_not_near_or_not_a_number_fails(measured):
    table = Table("x")
    table.compare("q", 1.0, measured, 1e-2, "r")
    assert not table.rows[0].passed


def test_not_a_number_fails_even_where_nothing_is_asked():
    table = Table("x")
    table.report("q", 1.0, math.nan, "r")
    table.report("q", 1.0, 5.0, "r")
    assert [row.passed for row in table.rows] == [False, True]


@pytest.mark.parametrize(("found", "passed"), [(0.95, True), (0.85, False), (None, False), (math.nan, False)])
def test_an_order_below_its_least_fails(found, passed):
    table = Table("x")
    table.bound("q", 1e-4, 1e-2, "r", order=found, least_order=0.9)
    assert table.rows[0].passed is passed


def test_rows_are_plain_for_json():
    row = Row("c", "q", math.nan, math.inf, 1.0, None, math.inf, False)
    assert json.loads(json.dumps(row.plain(), allow_nan=False))["exact"] is None


def test_order_extrapolation_and_crossing():
    zones = np.array([100, 200, 400])
    assert order(zones, 3.0 / zones**1.5) == pytest.approx(1.5)
    assert extrapolate([1.0, 4.0, 16.0], 2.0 + 3.0 / np.sqrt([1.0, 4.0, 16.0]), 0.5) == pytest.approx(2.0)
    assert crossing([0.0, 1.0, 2.0], [2.0, 1.0, -1.0]) == pytest.approx(1.5)
    assert math.isnan(crossing([0.0, 1.0], [2.0, 1.0]))
    assert mean_over([0.0, 1.0, 3.0], [0.0, 1.0, 1.0], 0.5, 2.0) == pytest.approx((0.375 + 1.0) / 1.5)


def test_patterns_choose_cases():
    assert {case.name for case in chosen(["riemann *", "noh"])} == {
        "riemann sod", "riemann two-gas", "riemann toro-3", "riemann double-rarefaction", "noh",
    }  # fmt: skip
    assert len(chosen([])) == CASES


def _reports():
    def study(table, effort):
        _passing(table, effort)
        table.compare("two | <b>", 1.0, 2.0, 1e-3, "a & b", order=1.0, least_order=0.9)
        x = np.linspace(0.0, 1.0, 2000)
        table.panel("profile", "X, m", "ε", [line(x, x, "exact", "exact"), line(x, x**2, "run")])
        table.convergence([100, 200, 400], {"ε": [1e-2, 5e-3, 2.5e-3]}, "error")

    return [run_case(_case(study, 2), Effort())]


class _Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.tags, self.ids = [], [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        for name, value in attributes:
            if name in ("src", "href", "xlink:href", "action", "data"):
                self.links.append(value)
            if name == "id":
                self.ids.append(value)


def test_the_page_asks_nothing_of_the_network():
    reports = _reports() * 2
    text = html_page(reports, [row for report in reports for row in report.rows], full=False, seconds=1.0)
    page = _Page()
    page.feed(text)
    assert [link for link in page.links if not link.startswith(("#", "data:"))] == []
    assert "script" not in page.tags
    assert "@import" not in text
    assert set(re.findall(r"url\((?!#)", text)) == set()
    assert page.tags.count("svg") == 2
    assert "&lt;b&gt;" in text
    assert "FAIL" in text


def test_links_within_a_figure_meet():
    text = html_page(_reports(), [], full=False, seconds=1.0)
    page = _Page()
    page.feed(text)
    wanted = {link[1:] for link in page.links if link.startswith("#")} | set(re.findall(r"url\(#([^)]+)\)", text))
    assert wanted <= set(page.ids)
    assert len(page.ids) == len(set(page.ids))


def test_the_documentation_page_names_every_case():
    reports = _reports()
    text = markdown_page(reports, [row for report in reports for row in report.rows], full=False, seconds=1.0)
    assert "| Made up | 2 |" in text
    assert "**1 fail**" in text


def test_the_command_writes_what_it_shows(tmp_path, capsys):
    code = main(["verify", "--only", "noh", "--json", str(tmp_path / "r.json"), "--html", str(tmp_path / "r.html")])
    out = capsys.readouterr()
    rows = json.loads((tmp_path / "r.json").read_text())
    assert code == 0
    assert out.err == ""
    assert {"case", "quantity", "exact", "measured", "error", "order", "tolerance", "passed"} <= set(rows[0])
    assert all(row["quantity"] in out.out for row in rows)
    assert "all passed" in out.out
    assert "<svg" in (tmp_path / "r.html").read_text(encoding="utf-8")


def test_a_failing_row_is_a_failing_command(monkeypatch, capsys):
    from hydro1d.verify import suite

    monkeypatch.setattr(
        suite, "all_cases", lambda: [_case(lambda table, effort: table.bound("q", 1.0, 0.1, "too much"))]
    )
    assert main(["verify"]) == 1
    out = capsys.readouterr().out
    assert "too much" in out
    assert "registered rows" in out


def test_an_unknown_case_is_a_usage_error(capsys):
    assert main(["verify", "--only", "nonsense"]) == 2
    assert "no case" in capsys.readouterr().err


def test_the_list_costs_no_run(capsys):
    assert main(["verify", "--list"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == CASES


def test_help_loads_nothing_heavy():
    heavy = "[m for m in ('numba', 'numpy', 'matplotlib') if m in sys.modules]"
    code = f"import sys; from hydro1d.cli import main; main(['verify', '--help']); print({heavy})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.rstrip().endswith("[]")


def test_a_report_counts_as_passed_only_whole():
    report = run_case(_case(_passing), Effort())
    assert isinstance(report, Report)
    assert report.passed


@pytest.mark.slow
@pytest.mark.parametrize("case", all_cases(), ids=lambda case: case.name)
def test_every_case_passes(case):
    report = run_case(case, Effort())
    assert report.passed, [row for row in report.rows if not row.passed]
