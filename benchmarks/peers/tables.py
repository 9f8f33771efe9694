"""Tables of a comparison: its programs, its meshes, and the common objective."""

from __future__ import annotations

from collections.abc import Mapping
from statistics import median
from typing import Any

from benchmarks.peers.peer import Peer
from benchmarks.peers.record import Comparison
from hexmend.quantity import format_count, format_objective, format_quality, format_significant
from hexmend.report.tables import Table

_NONE = "–"

#: Figures that are compared: key, label, 1 if higher is better and -1 if lower is, and format.
_COMPARED = (
    ("inverted_after", "inverted", -1, format_count),
    ("invalid_after", "invalid", -1, format_count),
    ("scaled_jacobian_min_after", "scaled Jacobian min", 1, format_quality),
    ("q_min_after", "q min", 1, format_quality),
    ("q_mean_after", "q mean", 1, format_quality),
)

#: Smallest difference that counts: half a unit of the last digit that is shown.
_DIFFERENCE = 5e-5

#: Distance of a boundary, in per cent of the diagonal, up to which it counts as fixed.
_FIXED = 1e-4


def comparison_tables(record: Comparison) -> list[Table]:
    """Make the tables of programs, meshes and objectives, in the order of a page.

    Parameters
    ----------
    record : Comparison

    Returns
    -------
    list of Table
    """
    tables = [programs_table(record), meshes_table(record), objective_table(record)]
    return [table for table in tables if table.rows]


def programs_table(record: Comparison) -> Table:
    """Make the table with a row for each program, over all meshes; programs that are not installed say so."""
    head = (
        "program",
        "results",
        "valid",
        "untangled",
        "sc. Jacobian min: median",
        "better than mend, fixed",
        "worse",
        "s",
    )
    lines = [_program_line(record, program) for program in record.programs]
    notes = [
        "Results: of how many meshes. Valid: results without an invalid hex. Untangled: of the results of meshes "
        "that had invalid hexes. Better and worse: meshes on which the minimum scaled Jacobian is higher, or lower, "
        "than that of mend with a fixed boundary. Seconds: of whole processes, over all results."
    ]
    for program in record.programs:
        reason = record.missing.get(program.name)
        missing = f" Not installed: {reason}." if reason else ""
        notes.append(f"{program.title}: {program.note}.{missing}")
    return Table("Programs", head, lines, notes)


def _program_line(record: Comparison, program: Peer) -> list[str]:
    if program.name in record.missing:
        return [program.title, "not installed", *[_NONE] * 6]
    done = {mesh: row for mesh in record.names if (row := record.result(mesh, program))}
    valid = {mesh for mesh, row in done.items() if not row["invalid_after"]}
    invalid = {mesh for mesh, row in done.items() if row["invalid_before"]}
    least = {mesh: row["scaled_jacobian_min_after"] for mesh, row in done.items()}
    ours = {mesh: row["scaled_jacobian_min_after"] for mesh in done if (row := record.result(mesh, record.programs[0]))}
    gains = [round(least[mesh], 4) - round(value, 4) for mesh, value in ours.items()]
    other = program is not record.programs[0]
    return [
        program.title,
        f"{len(done)} of {len(record.names)}",
        str(len(valid)),
        f"{len(valid & invalid)} of {len(invalid)}",
        format_quality(median(least.values())) if least else _NONE,
        f"{sum(gain > 0 for gain in gains)} of {len(gains)}" if other else _NONE,
        f"{sum(gain < 0 for gain in gains)} of {len(gains)}" if other else _NONE,
        format_significant(sum(row["seconds"] for row in done.values()), 3),
    ]


def meshes_table(record: Comparison) -> Table:
    """Make the table with a row for each mesh: as given, the results of Hexmend, and those of other programs."""
    fixed, others = record.programs[0], [program for program in record.run if not program.own]
    sliding = [program for program in record.run if program.own and program.slides]
    head = ["mesh", "hexes", "inverted", "locked", "invalid", "sc. Jacobian min as given", fixed.title]
    for program in sliding:
        head += [program.title, "distance, %"]
    head += ["q min", "q mean", "s", *(program.title for program in others), "worse with mend, fixed"]
    lines = []
    for mesh, name in record.names.items():
        given, ours = record.given(mesh), record.result(mesh, fixed)
        line = [name, *_counts(given), _jacobian(given), _jacobian(ours, record.row(mesh, fixed))]
        for program in sliding:
            row = record.result(mesh, program)
            line += [_jacobian(row, record.row(mesh, program)), _number(row, "boundary_distance", _distance)]
        line += [_number(ours, key, format_quality) for key in ("q_min_after", "q_mean_after")]
        line += [_number(ours, "seconds", _seconds)]
        line += [_jacobian(record.result(mesh, program), record.row(mesh, program)) for program in others]
        lines.append([*line, record.reason(mesh) or _remark(record, mesh, fixed)])
    notes = (
        "Columns with the name of a program: the minimum scaled Jacobian of its result, with the number of invalid "
        "hexes in brackets if there are any. Distance: of the boundary of the result of mend, slide from that of the "
        "mesh, in per cent of the diagonal. q min, q mean and seconds of mend, fixed. Worse: other programs with the "
        "same boundary that leave no more invalid hexes, and the mesh as given, where they are better.",
    )
    return Table("Meshes", head, lines, notes)


def _remark(record: Comparison, mesh: str, program: Peer) -> str:
    """Describe the figures in which a result of Hexmend is worse than the mesh as given, or than that of a program.

    Others are compared that leave no more invalid hexes, and the boundary where it was.
    """
    ours = record.result(mesh, program)
    if ours is None:
        return ""
    others: list[tuple[str, Mapping[str, Any]]] = [("as given", record.given(mesh))]
    for other in record.run:
        row = None if other.own else record.result(mesh, other)
        if row and row["invalid_after"] <= ours["invalid_after"] and row["boundary_distance"] <= _FIXED:
            others.append((other.title, row))
    words = []
    for key, label, sign, text in _COMPARED:
        better = [f"{title} {text(row[key])}" for title, row in others if sign * (row[key] - ours[key]) > _DIFFERENCE]
        if better:
            words.append(f"{'lower' if sign > 0 else 'higher'} {label}: {', '.join(better)}")
    return "; ".join(words)


def objective_table(record: Comparison) -> Table:
    """Make the table of the objective with p = 1 for the programs that minimise it, on meshes where two of them end."""
    programs = [program for program in record.run if program.shape]
    head = ["mesh", "as given", *(word for program in programs for word in (program.title, "s"))]
    lines = []
    for mesh, name in record.names.items():
        rows = [record.result(mesh, program) for program in programs]
        if sum(row is not None and row["objective_p1_after"] is not None for row in rows) < 2:
            continue
        cells = [(_number(row, "objective_p1_after", _digits), _number(row, "seconds", _seconds)) for row in rows]
        line = [name, _number(record.given(mesh), "objective_p1_after", _digits)]
        lines.append([*line, *(word for cell in cells for word in cell)])
    notes = ("Σ η: the sum over hexes of the mean of 1/q − 1 over the eight corners, which mend with p = 1 and TMOP "
             "minimise; lower is better. A dash is a mesh with inverted hexes, or no result.",)  # fmt: skip
    return Table("The same objective: Σ η and seconds", head, lines, notes)


def _number(row: Mapping[str, Any] | None, key: str, text: Any) -> str:
    value = row.get(key) if row else None
    return _NONE if value is None else text(value)


def _counts(given: Mapping[str, Any]) -> list[str]:
    keys = ("hexes", "inverted_after", "locked_inverted_after", "invalid_after")
    return [_number(given, key, format_count) for key in keys]


def _jacobian(result: Mapping[str, Any] | None, row: Mapping[str, Any] | None = None) -> str:
    """Format the minimum scaled Jacobian of a result, with its invalid hexes; for a failure its status."""
    if not result:
        return row["status"] if row else _NONE
    invalid = result["invalid_after"]
    return f"{result['scaled_jacobian_min_after']:.4f}" + (f" ({invalid:,})" if invalid else "")


def _digits(value: float) -> str:
    return format_objective(value) if value < 1000 else f"{value:,.4f}"


def _distance(value: float) -> str:
    return format_significant(value, 2)


def _seconds(value: float) -> str:
    return f"{value:.2f}"
