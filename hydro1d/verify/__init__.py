"""The verification suite: the solver against exact solutions. ``hydro1d verify`` runs it."""

from hydro1d.verify.rows import Case, Effort, Panel, Row, Table
from hydro1d.verify.suite import Report, all_cases, chosen, run_case, run_suite

__all__ = ["Case", "Effort", "Panel", "Report", "Row", "Table", "all_cases", "chosen", "run_case", "run_suite"]
