"""Export of the worst hexes as CSV."""

from __future__ import annotations

import csv
import io
from pathlib import Path

from hexmend.io.storage.suffixes import suffix_for
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.report.documents import write_text
from hexmend_app.state.mesh.worst_hexes import WorstHexes


def write_worst(path: str | Path, mesh: Mesh, metric: str = "q") -> None:
    """Write the worst hexes of a mesh as CSV: number, metric, scaled Jacobian, state, number in the file if it has one.

    Parameters
    ----------
    path : path-like
    mesh : Mesh
    metric : str
        A name of `hexmend.quality.METRICS`.

    Raises
    ------
    FileError
        If the suffix is not .csv or the file cannot be written; an existing file is left unchanged.
    """
    suffix_for(Path(path), "a list", (".csv",))
    worst, out = WorstHexes.of(mesh, measure(mesh.points, mesh.hexes, mesh.mid_nodes), metric), io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["hex", metric, "scaled-jacobian", "state", *(["id"] if worst.ids is not None else [])])
    columns = [worst.hexes.tolist(), worst.values.tolist(), worst.jacobians.tolist(), worst.states]
    columns += [worst.ids.tolist()] if worst.ids is not None else []
    writer.writerows(zip(*columns, strict=True))
    write_text(Path(path), out.getvalue())
