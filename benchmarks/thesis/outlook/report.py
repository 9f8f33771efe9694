"""The report of an outlook: speed of convergence to the optimum for varied parameters."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

from hexmend.quantity import Quantity, format_count, format_significant
from hexmend.report.comparison import ended
from hexmend.report.documents import write_documents
from hexmend.report.tables import Table

_three = partial(format_significant, digits=3)

#: Columns of the table: until the run is near the optimum, and in all.
COLUMNS: tuple[Quantity, ...] = (
    Quantity("near_iterations", "sweeps", "Iterations until the objective is near the optimum.", format_count, -1),
    Quantity("near_evaluations", "evaluations", "Evaluations of a hex until then, on average.", _three, -1),
    Quantity("near_seconds", "s", "Seconds in the method until then.", _three, -1),
    Quantity("iterations", "sweeps in all", "Iterations until the run ended.", format_count, -1),
    Quantity("seconds", "s in all", "Seconds in the method until then.", _three, -1),
    Quantity("outcome", "ended", "Why the run ended.", ended),
)


def write_outlook(folder: Path, outlook: Mapping[str, Any]) -> list[Path]:
    """Write an outlook as CSV, Markdown, LaTeX and JSON.

    Parameters
    ----------
    folder : Path
    outlook : mapping
        `benchmarks.thesis.outlook.experiments.TrialResult.record`.
    """
    return write_documents(folder, outlook_stem(outlook), outlook_table(outlook), outlook["runs"], outlook)


def outlook_table(outlook: Mapping[str, Any]) -> Table:
    """Make the table with a row for each run: method, varied parameters, speed of convergence."""
    vary = outlook["vary"]
    rows = [
        [run["method"], *(str(run.get(name, "–")) for name in vary), *(column.of(run) for column in COLUMNS)]
        for run in outlook["runs"]
    ]
    title = "{section}, {title}: {mesh}, {hexes:,} hexes, {free_nodes:,} free nodes".format(**outlook)
    notes = [
        f"Sweeps, evaluations and seconds until the objective is within {100 * outlook['near']:g} % of the least that "
        "any run ended with, and in all. An evaluation is one of a hex's energy or of its derivatives; "
        "given is their number per hex."
    ]
    return Table(title, ["method", *vary, *(column.label for column in COLUMNS)], rows, notes)


def outlook_stem(outlook: Mapping[str, Any]) -> str:
    """Return the name of an outlook's files.

    >>> outlook_stem({"section": "5.2.5", "mesh": "five-side"})
    'section-5.2.5-five-side'
    """
    return f"section-{outlook['section']}-{outlook['mesh']}"
