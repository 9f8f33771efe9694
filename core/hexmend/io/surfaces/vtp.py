"""VTK's XML format for surfaces (.vtp); its arrays are decoded by meshlane."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from hexmend.errors import FileError
from hexmend.io.surfaces.format import SURFACES, Polygons, SurfaceFormat, of_one_width, parsed


def read(path: Path) -> Polygons:
    """Read a VTP file: the polygons of its pieces."""
    with open(path, "rb") as file:
        head = file.read(4096)
    if b"<VTKFile" not in head or b'type="PolyData"' not in head:
        raise FileError(path, "is no VTKFile of the type PolyData", "Convert it to PolyData, or write it as STL.")
    return parsed(path, "VTP", lambda: _polygons(path))


def _polygons(path: Path) -> Polygons:
    from meshlane.vtu import _vtu

    try:
        root = ET.parse(path).getroot()
    except ET.ParseError:  # bytes as they are, after the last array's heading
        root = _vtu._parse_raw_binary(str(path))
    reader = object.__new__(_vtu.VtuReader)  # whose arrays are the same, whatever they are of
    reader.compression, reader.byte_order = root.get("compressor"), root.get("byte_order")
    reader.header_type = root.get("header_type", "UInt32")
    appended = root.findtext("AppendedData")
    reader.appended_data = None if appended is None else appended.strip().removeprefix("_")
    points, faces, before = [np.empty((0, 3))], [], 0
    for piece in root.iter("Piece"):
        x = piece.find("Points/DataArray")
        if x is not None and int(piece.get("NumberOfPoints", "0")):
            points.append(np.asarray(reader.read_data(x), dtype=np.float64).reshape(-1, 3))
        if int(piece.get("NumberOfStrips", "0")):
            raise FileError(path, "holds triangle strips: expected polygons", "Convert them to triangles.")
        if int(piece.get("NumberOfPolys", "0")):
            arrays = {one.get("Name"): one for one in piece.findall("Polys/DataArray")}
            nodes, ends = (reader.read_data(arrays[name]).astype(np.int64) for name in ("connectivity", "offsets"))
            faces += of_one_width(np.concatenate([[0], ends]), nodes + before)
        before += len(points[-1])
    return Polygons(np.concatenate(points), faces)


SURFACES.add("vtp", SurfaceFormat("vtp", "VTP", (".vtp",), read))
