"""Table of a solver's checks."""

from __future__ import annotations

from hexmend.cli.output.text_tables import print_columns
from hexmend.quantity import format_count
from hexmend.solver_checks import Report
from hexmend.terminal_text import WorsenedText


def print_checks(report: Report) -> None:
    """Print each check with value, limit and count, then the verdict, what is left out, and a reservation."""
    rows = []
    for result in report.results:
        painted = WorsenedText if result.count else str
        beyond = f"{format_count(result.count)} of {format_count(result.total)} {result.check.unit_of_count}"
        value = f"{result.value:.4g}".replace("inf", "∞")
        counted = "–" if result.check.limit is None else beyond
        verdict = painted(_VERDICTS[result.verdict])
        rows.append([result.check.name, value, result.check.limit_text, result.check.unit or "–", counted, verdict])
    print_columns(["Check", "Worst", "Limit", "Unit", "Beyond", "Verdict"], rows)
    print(report.sentence)
    print(f"note: {report.solver.tests_validity}")
    print(f"note: {report.solver.omitted}")
    if report.solver.reservation:
        print(f"note: Limits and factors are {report.solver.reservation}.")


_VERDICTS = {"passed": "passed", "warning": "warning", "failed": "failed", "value": "no limit"}
