"""Decimated skin, drawn while the camera moves."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkFiltersCore import vtkBinnedDecimation

from hexmend_app.scene.layers.surface import coloured, colours_of, hexes_of

#: Number of faces above which a skin is decimated while the camera moves; they take 50 ms in software rendering.
MANY = 30_000

_DIVISIONS = 64  # of each side of the bounding box, so that a grid cell is about ten pixels wide


def decimated(skin: pv.PolyData) -> pv.PolyData:
    """Cluster a surface into triangles of about the size of a grid cell, each in the colour of one of its faces.

    Parameters
    ----------
    skin : pyvista.PolyData
        Quads, with colours and hexes (see `coloured`).
    """
    quads = skin.regular_faces
    data = pv.PolyData.from_regular_faces(skin.points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))
    data.cell_data["face"] = np.tile(np.arange(len(quads)), 2)
    bins = vtkBinnedDecimation()
    bins.SetInputData(data)
    bins.SetNumberOfDivisions(_DIVISIONS, _DIVISIONS, _DIVISIONS)
    bins.SetPointGenerationModeToUseInputPoints()
    bins.ProduceCellDataOn()
    bins.ProducePointDataOff()
    bins.Update()
    coarse = pv.wrap(bins.GetOutput())
    faces = np.asarray(coarse.cell_data["face"]).astype(np.int64)
    coarse.clear_data()
    return coloured(coarse, colours_of(skin)[faces], hexes_of(skin)[faces])
