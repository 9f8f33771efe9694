"""VTKHDF files of one part, read in slices."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.base import hdf5
from hexmend.io.formats.vtk.grid import Grid
from hexmend.io.formats.vtk.vtkhdf import VTKHDFReader, group_of


class VTKHDFSlices:
    """VTKHDF file that can be read in slices; see `SlicedFile`."""

    def __init__(self, path: Path):
        self._path = path
        with hdf5.open_file(path) as file:
            root = group_of(file, "VTKHDF")
            self.n_nodes, self.n_cells = (int(root[f"NumberOf{name}"][0]) for name in ("Points", "Cells"))
            self.field_data = VTKHDFReader(path, root).read_field_data()

    @classmethod
    def open(cls, path: Path) -> VTKHDFSlices | None:
        """Open a file; None if only the whole of it can be read."""
        with hdf5.open_file(path) as file:
            root = group_of(file, "VTKHDF")
            if root is None or root.attrs.get("Type") not in (b"UnstructuredGrid", "UnstructuredGrid"):
                return None
            counts = [root.get(f"NumberOf{name}") for name in ("Points", "Cells", "ConnectivityIds")]
            if "Steps" in root or any(count is None or count.shape != (1,) for count in counts):
                return None
            groups = [group_of(root, section) or {} for section in ("PointData", "CellData")]
            if any(group[name].dtype.kind not in "biuf" for group in groups for name in group):
                return None
        return cls(path)

    def read(self, nodes: slice, cells: slice) -> Grid:
        """See `SlicedFile.read`."""
        with hdf5.open_file(self._path) as file:
            reader = VTKHDFReader(self._path, group_of(file, "VTKHDF"))
            start = reader.read_rows("Offsets", slice(cells.start, cells.stop + 1)).astype(np.int64)
            ids = slice(int(start[0]), max(int(start[-1]), int(start[0])))
            points = reader.read_rows("Points", nodes).astype(np.float64, copy=False)
            types, numbers = reader.read_rows("Types", cells), reader.read_rows("Connectivity", ids)
            data = reader.read_data("PointData", nodes), reader.read_data("CellData", cells)
        return Grid(points, types, start - start[0], numbers, *data)

    def ids(self) -> None:
        """See `SlicedFile.ids`."""
