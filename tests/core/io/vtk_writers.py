"""Data of VTK, written by VTK's own writers."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hexmend.mesh.mesh import Mesh


def by_vtk(writer: object, path: Path, data: object, options: Mapping[str, object] | None = None) -> None:
    """Write by a writer whose methods are called by name, each with a value or with none."""
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    for name, value in (options or {}).items():
        getattr(writer, name)(*(() if value is None else (value,)))
    assert writer.Write()


def grid_by_vtk(mesh: Mesh, arrays: Mapping[str, object], material: np.ndarray, fields: Mapping[str, object]) -> object:
    """Make VTK's grid of a mesh with arrays of its nodes, materials and field data; a list is one of texts."""
    import pyvista
    import vtk

    content = pyvista.UnstructuredGrid({12: mesh.hexes.astype(np.int64)}, mesh.points)
    content.cell_data["material"] = material
    for data, given in ((content.point_data, arrays), (content.field_data, fields)):
        for name, values in given.items():
            if isinstance(values, list):
                texts = vtk.vtkStringArray()
                texts.SetName(name)
                for words in values:
                    texts.InsertNextValue(words)
                data.VTKObject.AddArray(texts)
            else:
                data[name] = values
    return content
