"""Files of a new polyMesh, as text or binary.

Replacement of the coordinates in a file of points; its header, encoding and everything else stay as they are.

Times of an OpenFOAM case at which points are stored: the same mesh, moved by the solver.
"""

from __future__ import annotations

import gzip
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.base.numbering import runs
from hexmend.io.formats.openfoam.boundary import ZONE_FILES, Patch
from hexmend.io.formats.openfoam.case import existing_part, find_case, times
from hexmend.io.formats.openfoam.foam_file import FoamFile
from hexmend.io.formats.openfoam.lists import find_list, read_vectors
from hexmend.io.formats.openfoam.topology import PolyTopology


def replaced_points(path: Path, points: np.ndarray) -> bytes:
    """Return the content of a file of points with other coordinates.

    Parameters
    ----------
    path : Path
        The file; it is not changed.
    points : (n, 3) float64
        As many as the file holds. Decimals are the shortest that give the same number back.

    Returns
    -------
    bytes
        Compressed if the file is.

    Raises
    ------
    FileError
        For a damaged file, and one with another number of points.
    """
    file = FoamFile(path)
    data = file.data  # with comments
    span = find_list(file, "points", file.arch.scalar, 3)
    if span.count != len(points):
        problem = f"holds {span.count:,} points: expected {len(points):,}"
        raise file.error(problem, "Check whether the case was remeshed in the meantime.")
    new = points.astype(file.arch.scalar).tobytes() if file.is_binary else b"\n" + vector_rows(points)
    content = b"".join([data[: span.begin], new, data[span.end :]])
    return gzip.compress(content, 6) if file.is_compressed else content


def vector_rows(points: np.ndarray) -> bytes:
    """Format points as lines "(x y z)"."""
    parts = (format_rows(points[part]) for part in row_chunks(len(points)))
    return b"".join(b"(" + part[:-1].replace(b"\n", b")\n(") + b")\n" for part in parts)


_LABEL, _SCALAR = np.dtype("<i4"), np.dtype("<f8")
_RULE = b"\n// ************************************************************************* //\n"


def write_poly_mesh(folder: Path, mesh: PolyTopology, encoding: str) -> None:
    """Write points, faces, owner, neighbour, boundary and zones into a folder; `encoding` is "ascii" or "binary"."""
    binary = encoding == "binary"
    counts = f"nPoints: {len(mesh.points)} nCells: {mesh.n_cells} nFaces: {len(mesh.owner)}"
    note = f"{counts} nInternalFaces: {len(mesh.neighbour)}"
    _write(folder / "points", "vectorField", encoding, _list(mesh.points, _SCALAR, binary))
    kind = "faceCompactList" if binary else "faceList"
    _write(folder / "faces", kind, encoding, _compact(mesh.loops) if binary else _faces(mesh.loops))
    _write(folder / "owner", "labelList", encoding, _list(mesh.owner, _LABEL, binary), note)
    _write(folder / "neighbour", "labelList", encoding, _list(mesh.neighbour, _LABEL, binary), note)
    _write(folder / "boundary", "polyBoundaryMesh", "ascii", _boundary(mesh.patches))
    zones = {"cellZones": mesh.cell_zones, "faceZones": mesh.face_zones, "pointZones": mesh.point_zones}
    for name, members in zones.items():
        if members:
            _write(folder / name, "regIOobject", encoding, _zones(name, members, binary))


def _write(path: Path, kind: str, encoding: str, body: Iterator[bytes], note: str = "") -> None:
    lines = [
        "version     2.0;",
        f"format      {encoding};",
        'arch        "LSB;label=32;scalar=64";',
        f"class       {kind};",
    ]
    lines += [f'note        "{note}";'] if note else []
    lines += ['location    "constant/polyMesh";', f"object      {path.name};"]
    with open(path, "wb") as file:
        file.write("\n".join(["FoamFile", "{", *(f"    {line}" for line in lines), "}", "", ""]).encode())
        for part in body:
            file.write(part)
        file.write(_RULE)


def _list(values: np.ndarray, dtype: np.dtype, binary: bool) -> Iterator[bytes]:
    """Yield a list of labels (k,) or vectors (k, 3); `dtype` is that of binary numbers."""
    yield b"%d\n(" % len(values)
    if binary:
        yield values.astype(dtype).tobytes()
    else:
        yield b"\n"
        for part in row_chunks(len(values)):
            yield vector_rows(values[part]) if values.ndim > 1 else format_rows(values[part])
    yield b")\n"


def _faces(loops: np.ndarray) -> Iterator[bytes]:
    widths = 4 - (loops[:, 3] < 0)
    yield b"%d\n(\n" % len(loops)
    for run in runs(widths):
        width = int(widths[run.start])
        for part in row_chunks(run.stop - run.start):
            rows = format_rows(loops[run][part, :width])
            yield (b"%d(" % width) + rows[:-1].replace(b"\n", b")\n%d(" % width) + b")\n"
    yield b")\n"


def _compact(loops: np.ndarray) -> Iterator[bytes]:
    yield from _list(np.concatenate([[0], np.cumsum(4 - (loops[:, 3] < 0))]), _LABEL, True)
    yield from _list(loops[loops >= 0], _LABEL, True)


def _boundary(patches: list[Patch]) -> Iterator[bytes]:
    yield b"%d\n(\n" % len(patches)
    for patch in patches:
        lines = [f"type            {patch.type};"]
        lines += [f"neighbourPatch  {patch.neighbour};"] if patch.neighbour else []
        lines += [f"nFaces          {patch.count};", f"startFace       {patch.first};"]
        body = "".join(f"        {line}\n" for line in lines)
        yield f"    {patch.name}\n    {{\n{body}    }}\n".encode()
    yield b")\n"


def _zones(name: str, zones: Mapping[str, object], binary: bool) -> Iterator[bytes]:
    yield b"%d\n(\n" % len(zones)
    for title, members in zones.items():
        faces, flips = members if name == "faceZones" else (members, None)
        yield f"{title}\n{{\n    type {name[:-1]};\n    {ZONE_FILES[name]} List<label> ".encode()
        yield from _list(faces, _LABEL, binary)
        yield b";\n"
        if flips is not None:
            yield b"    flipMap List<bool> %d\n(" % len(flips)
            yield flips.astype(np.uint8).tobytes() if binary else b" ".join(b"%d" % flip for flip in flips)
            yield b")\n;\n"
        yield b"}\n"
    yield b")\n"


class CaseTime(NamedTuple):
    """Points of a case at a time.

    Parameters
    ----------
    value : float
        Time in seconds.
    path : Path
        File of the points.
    points : (n, 3) float64 or None
        None if they cannot be used.
    error : FileError or None
        The reason; its problem names the time.
    """

    value: float
    path: Path
    points: np.ndarray | None
    error: FileError | None


def read_times(path: Path, n_points: int) -> Iterator[CaseTime]:
    """Read the points of each time at which the mesh of a case is stored, in order, one at a time.

    Parameters
    ----------
    path : Path
        As of `find_case`. Nothing is read for a mesh other than that in constant, such as the folder of a time.
    n_points : int
        Number of points of the mesh in constant.

    Yields
    ------
    CaseTime
        With an error instead of points for a damaged file, and for points of another mesh: of another number, or of a
        time with faces of its own or after one.
    """
    files = find_case(path)
    if files is None or files.points.parent != files.mesh or not files.mesh.is_relative_to(files.root / "constant"):
        return
    remeshed = None
    for value, file in times(path):
        if existing_part(file.parent, "faces") is not None:
            remeshed = value
        try:
            yield CaseTime(value, file, _read_points(file, value, n_points, remeshed), None)
        except FileError as error:
            yield CaseTime(value, file, None, error)


def _read_points(path: Path, value: float, n_points: int, remeshed: float | None) -> np.ndarray:
    """Read the points of a time; the mesh has had its own faces since the time `remeshed`, unless that is None."""
    at = f"t = {value:.12g}"
    if remeshed is not None:
        raise FileError(path, f"{at}: the case has other faces since t = {remeshed:.12g}", "Open that time's polyMesh.")
    try:
        points = read_vectors(FoamFile(path), "points")
    except FileError as error:
        raise FileError(path, f"{at}: {error.problem}", error.remedy) from error
    if len(points) != n_points:
        problem = f"{at}: holds {len(points):,} points, expected {n_points:,} as in constant"
        raise FileError(path, problem, "Check whether the case was remeshed in the meantime.")
    if not np.isfinite(points).all():
        row = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise FileError(path, f"{at}: point {row} is not finite", "Check whether the solver diverged.")
    return points
