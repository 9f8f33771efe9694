"""Cells in the viewer's colours, in plotters of PyVista."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pyvista as pv

from hexmend_app.scene.colour.colouring import Colouring

#: Colour bar, and shading: faces in the shade keep a colour that can be compared with the bar.
_BAR = {"vertical": True, "position_x": 0.86, "position_y": 0.2, "height": 0.6, "fmt": "%.4g", "title_font_size": 18}
_SHADING = {"ambient": 0.5, "diffuse": 0.5, "specular": 0.0}


def add_coloured(
    plotter: Any, add: Callable[..., Any], data: pv.DataSet, values: np.ndarray, kinds: np.ndarray, by: Colouring
) -> None:
    """Add a data set with coloured cells to a plotter, with its colour bar and axes.

    Parameters
    ----------
    plotter : pyvista.Plotter
    add : callable
        Its method `add_mesh`, or one of its widgets, such as `add_mesh_clip_plane`, with options.
    data : pyvista.DataSet
        Gets an array of the cells named by the title of the colours: values within their range, and NaN, -inf and inf
        in cells with the first, second and third special colour.
    values : (k,) float64
        Value of each cell.
    kinds : (k,) uint8
        Number of the special colour of each cell from 1; 0 for none.
    by : Colouring
    """
    ends = (-0.5, len(by.names) - 0.5) if by.names else (by.low, by.high)
    special = [kinds == 1, kinds == 2, kinds == 3]
    known = np.where(np.isnan(values), ends[0], values).clip(*ends)
    data.cell_data[by.title] = np.select(special, [np.nan, -np.inf, np.inf], known)
    table = pv.LookupTable(values=np.insert(by.table, 3, 255, axis=1), scalar_range=ends)
    for name, one in zip(("nan_color", "below_range_color", "above_range_color"), by.special_colours, strict=False):
        setattr(table, name, one.colour)
    bar_options = {**_BAR, "n_labels": 0} if by.names else _BAR
    looks = {"show_edges": True, "edge_opacity": 0.5, "scalar_bar_args": bar_options, **_SHADING}
    names = {float(value): name for value, name in enumerate(by.names)}
    add(data, name="mesh", scalars=by.title, cmap=table, clim=ends, annotations=names, **looks)
    bar = plotter.scalar_bars[by.title]
    annotate = (
        (bar.SetNanAnnotation, bar.DrawNanAnnotationOn),
        (bar.SetBelowRangeAnnotation, bar.DrawBelowRangeSwatchOn),
        (bar.SetAboveRangeAnnotation, bar.DrawAboveRangeSwatchOn),
    )
    for (name_it, show), one, cells in zip(annotate, by.special_colours, special, strict=False):
        if cells.any():
            name_it(one.name)
            show()
    plotter.add_axes()
