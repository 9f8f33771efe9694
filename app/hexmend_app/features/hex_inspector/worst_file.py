"""The list of the worst as a file."""

from __future__ import annotations

import csv
import io
from pathlib import Path

from hexmend.io.storage.suffixes import suffix_for
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.report.documents import write_text
from hexmend_app.state.mesh.worst_hexes import Worst


def write_worst(path: str | Path, mesh: Mesh, metric: str = "q") -> None:
    """Write the worst hexes of a mesh as CSV: element, metric, scaled Jacobian, state.

    Parameters
    ----------
    path : path-like
    mesh : Mesh
    metric : str
        A name of `hexmend.quality.METRICS`.

    Raises
    ------
    FileError
        For another suffix, or where the file cannot be written; the one that was there stays.
    """
    suffix_for(Path(path), "a list", (".csv",))
    found, out = Worst.of(mesh, measure(mesh.points, mesh.hexes), metric), io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["hex", metric, "scaled-jacobian", "state"])
    columns = found.elements.tolist(), found.values.tolist(), found.jacobians.tolist(), found.states
    writer.writerows(zip(*columns, strict=True))
    write_text(Path(path), out.getvalue())
