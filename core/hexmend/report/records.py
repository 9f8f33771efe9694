"""Records of a run for other programs: JSON and CSV."""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hexmend.io.storage.atomic import atomic_write

if TYPE_CHECKING:
    from hexmend.iteration import Result


def record(result: Result) -> dict[str, Any]:
    """Return the report of `hexmend smooth --json`; some keys are there only where they apply.

    These are `stages` for recipes, `surface` for sliding boundaries, `materials` and `layers` where there are any, and
    `target`.
    """
    from hexmend.iteration.figures import HISTORY
    from hexmend.run.recipe import Recipe

    report = {
        "method": result.method,
        "parameters": dict(result.parameters),
        "outcome": result.outcome.key,
        "message": result.message,
        "worse": list(result.worse),
        **{key: getattr(result, key) for key in ("iterations", "kept", "seconds", "setup_seconds")},
        "before": result.before.to_dict(),
        "after": result.after.to_dict(),
        "history": [{column: row[column] for column in HISTORY} for row in result.history],
    }
    if result.surface is not None:
        report["surface"] = result.surface.to_dict() | {"left": result.departures.to_dict()}
    if result.materials:
        report["materials"] = {name: volume.to_dict() for name, volume in result.materials.items()}
    if result.layers:
        report["layers"] = [wall.to_dict() for wall in result.layers]
    if result.mesh.element_target is not None:
        report["target"] = result.mesh.element_target.name
        report["q_of_target"] = list(result.target_q)
    return report | {"stages": [stage.to_dict() for stage in result.stages]} if result.method == Recipe.name else report


def to_json(data: Any) -> str:
    """Return JSON text; raises ValueError for NaN and infinity, which JSON does not have."""
    return json.dumps(data, indent=2, allow_nan=False)


def write_json(path: str | Path, data: Any) -> None:
    """Write JSON to a file, as a whole or not at all."""
    with atomic_write(path) as temporary:
        temporary.write_text(to_json(data) + "\n", encoding="utf-8")


def write_csv(path: str | Path, rows: Sequence[Mapping[str, Any]]) -> None:
    """Write rows as CSV; missing values are empty fields, and a mapping becomes `key=value` words."""
    flat = [{key: _cell(value) for key, value in row.items() if not isinstance(value, list)} for row in rows]
    columns = list(dict.fromkeys(key for row in flat for key in row))
    with (
        atomic_write(path) as temporary,
        open(temporary, "w", newline="", encoding="utf-8", errors="surrogateescape") as file,
    ):
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(flat)


def _cell(value: Any) -> Any:
    return " ".join(f"{key}={one}" for key, one in value.items()) if isinstance(value, Mapping) else value


def write_history(path: str | Path, result: Result) -> None:
    """Write the history as CSV, with an empty field for an infinite objective."""
    from hexmend.iteration.figures import HISTORY

    write_csv(path, [{column: row[column] for column in HISTORY} for row in result.history])
