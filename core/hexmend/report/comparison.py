"""The thesis's table of methods (Table 4.1), from the record of a comparison."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from hexmend.quality.regressions import Q_OF_TARGET, REGRESSION_KEYS
from hexmend.quality.summary import SUMMARY_QUANTITIES
from hexmend.quantity import Quantity, format_count, format_microseconds, format_milliseconds, format_significant
from hexmend.report.documents import write_document
from hexmend.report.tables import Table
from hexmend.terminal_text import WorsenedText, count_phrase

#: How a run ended, where the record's own word is not the clearest.
_ENDED = {
    "max-iterations": "iteration limit",
    "max-seconds": "time limit",
    "no-improvement": "converged",
    "no-descent": "no descent",
    "nothing-free": "nothing free",
}


#: Outcome of a run without an iteration that was better than its start.
KEPT_START = "kept the start"


class _Ended(Quantity):
    """Reason why a run ended, and whether its result is the mesh it started from."""

    def of(self, record: Mapping[str, Any]) -> str:
        """Format the outcome in a record.

        >>> _Ended("outcome", "ended", "", ended).of({"outcome": "converged", "iterations": 8, "kept": 0})
        'kept the start'
        """
        return KEPT_START if _kept_start(record) else super().of(record)


def _kept_start(record: Mapping[str, Any]) -> bool:
    """Return True if no iteration of a run was better than the initial mesh."""
    return bool(record.get("iterations")) and record.get("kept") == 0


def ended(outcome: str) -> str:
    """Return the reason why a run ended in a word or two.

    >>> ended("max-seconds")
    'time limit'
    """
    return _ENDED.get(outcome, outcome)


#: Rows of the table that are quantities of a summary.
_OF_SUMMARY = ["inverted", "invalid", "q_min", "q_mean", "q_std", "q_max", "q_norm", "scaled_jacobian_min", "objective"]
#: Rows of the table: those of the thesis, and those by which readers can judge them.
LINES: tuple[Quantity, ...] = (
    *map(SUMMARY_QUANTITIES.__getitem__, _OF_SUMMARY),
    Quantity(
        "seconds",
        "time, s",
        "Seconds in the method, without its preparation and without measuring.",
        format_significant,
        -1,
    ),
    Quantity("iterations", "iterations", "Iterations until the run ended.", format_count, -1),
    Quantity(
        "seconds_per_iteration",
        "ms per iteration",
        "Milliseconds of an iteration, on average.",
        format_milliseconds,
        -1,
    ),
    Quantity(
        "seconds_per_iteration_and_node",
        "µs per iteration, node",
        "Microseconds of an iteration for each node that may move.",
        format_microseconds,
        -1,
    ),
    _Ended("outcome", "ended", "Why the run ended, or that nothing was better than the initial mesh.", ended),
)

#: Columns of figures in the widest table of the thesis; wider tables are transposed.
_MAX_COLUMNS = 6


def comparison_table(title: str, columns: Mapping[str, Mapping[str, Any]], notes: Sequence[str] = ()) -> Table:
    """Make a table with methods in columns and figures in rows, transposed if there are many methods.

    Parameters
    ----------
    title : str
    columns : mapping
        Records by the heads of their columns, that of the initial mesh first.
    notes : sequence of str
    """
    records = columns.values()
    rows = [[label(figure, records), *(_cell(figure, record) for record in records)] for figure in LINES]
    table = Table(title, ["", *columns], rows, [*notes, *explanations(columns)])
    return table if len(columns) <= _MAX_COLUMNS else table.transposed


def label(figure: Quantity, records: Iterable[Mapping[str, Any]]) -> str:
    """Return the label of a figure; the objective has its formula, which is common to all records.

    >>> label(SUMMARY_QUANTITIES["objective"], [{"objective": 7.0, "objective_formula": "Σ η⁴, offset 0"}])
    'objective Σ η⁴, offset 0'
    """
    formula = next((one["objective_formula"] for one in records if "objective_formula" in one), None)
    return f"objective {formula}" if figure.key == "objective" and formula else figure.label


def record_table(comparison: Mapping[str, Any]) -> Table:
    """Make the table of a comparison's record, see `hexmend.study.compare.Comparison.record`."""
    initial = comparison["initial"]
    columns = {row["method"]: row for row in comparison_rows(comparison)}
    hexes, free = count_phrase(initial["hexes"], "hex", "hexes"), count_phrase(initial["free_nodes"], "free node")
    title = f"{comparison['mesh']}: {hexes}, {free}"
    notes = []
    if locked := initial["locked_inverted"]:
        which = count_phrase(locked, "of the inverted hexes is", "of the inverted hexes are")
        notes.append(f"{which} locked: fixed nodes alone keep {'it' if locked == 1 else 'them'} inverted.")
    if comparison["interrupted"]:
        notes.append("The comparison was interrupted: the last method is incomplete, and those after it are missing.")
    return comparison_table(title, columns, notes=notes)


def comparison_rows(comparison: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Return the rows for spreadsheets: the initial mesh and the methods."""
    return [{"method": "initial"} | comparison["initial"], *comparison["rows"]]


def write_comparison(path: Path, comparison: Mapping[str, Any]) -> None:
    """Write the record of a comparison as CSV, Markdown, LaTeX or JSON, by the path's suffix.

    Raises
    ------
    FileError
        For another suffix, or if the file cannot be written.
    """
    write_document(path, record_table(comparison), comparison_rows(comparison), comparison)


def _cell(figure: Quantity, record: Mapping[str, Any]) -> str:
    fallen = {REGRESSION_KEYS.get(name, name) for name in record.get("worse", ())}
    return (WorsenedText if figure.key in fallen else str)(figure.of(record))


def _fallen(columns: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Return a note on methods after which figures are worse than before."""
    labels = {name: SUMMARY_QUANTITIES[key].label for name, key in REGRESSION_KEYS.items()} | {
        "layers": "layers",
        Q_OF_TARGET: "q of target",
    }
    fallen = {head: record["worse"] for head, record in columns.items() if record.get("worse")}
    worse = [f"{head} ({', '.join(map(labels.get, names))})" for head, names in fallen.items()]
    return [f"Worse than before: {'; '.join(worse)}."] if worse else []


def explanations(columns: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Return notes on figures that are worse than before, and on runs that ended by a limit, the user or an error."""
    records = columns.values()
    ended = {record.get("outcome") for record in records}
    sentences = {
        "max-seconds": "Time limit: stopped at the time limit before it converged.",
        "max-iterations": "Iteration limit: stopped at the iteration limit before it converged.",
        "no-descent": "No descent: no step lowers the objective along the search direction.",
        "stopped": "Stopped: ended by the user before it converged.",
    }
    if any(map(_kept_start, records)):
        sentences |= {KEPT_START: "Kept the start: no iteration was better than the initial mesh."}
        ended.add(KEPT_START)
    failed = [f"{record['method']}: {record['message']}" for record in records if record.get("outcome") == "failed"]
    return _fallen(columns) + [sentence for key, sentence in sentences.items() if key in ended] + failed
