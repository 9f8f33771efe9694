"""Decimated skin, drawn while the camera moves."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkFiltersCore import vtkBinnedDecimation

from hexmend_app.scene.layers.surface import coloured, colours_of, hexes_of

#: Faces from which a coarse skin is worth making: they take 50 ms a frame without a graphics card.
MANY = 30_000

_DIVISIONS = 64  # of each side of the skin's box: a cell is some ten pixels wide


def decimated(skin: pv.PolyData) -> pv.PolyData:
    """Cluster a surface into triangles of about a grid cell; each has the colour of a face there.

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
    rough = pv.wrap(bins.GetOutput())
    faces = np.asarray(rough.cell_data["face"]).astype(np.int64)
    rough.clear_data()
    return coloured(rough, colours_of(skin)[faces], hexes_of(skin)[faces])
