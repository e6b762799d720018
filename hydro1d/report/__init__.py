"""One self-contained HTML page about a run; it asks nothing of any network."""

from hydro1d.report._page import report, write_report
from hydro1d.report._theory import Theory, find_theory

__all__ = ["Theory", "find_theory", "report", "write_report"]
