"""The mesh that a view shows, as a grid in a plotter of PyVista."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pyvista as pv
from pyvistaqt import BackgroundPlotter

from hexmend.interop.pyvista_grid import to_pyvista
from hexmend.mesh.solid_cells import solid_blocks
from hexmend_app.scene.camera.vtk_pose import apply_pose, pose_of
from hexmend_app.scene.colour.colouring import OUTSIDE
from hexmend_app.scene.colour.pyvista_colours import add_coloured
from hexmend_app.scene.views.viewport import Viewport
from hexmend_app.theme.palette import THEME


def open_plotter(title: str, view: Viewport, up: str) -> BackgroundPlotter:
    """Open a window of PyVista that shows what a view shows; see `show_in`."""
    theme = pv.themes.DarkTheme() if THEME.dark else pv.themes.DocumentTheme()
    plotter = BackgroundPlotter(title=title, theme=theme, auto_update=False, update_app_icon=False)
    show_in(plotter, view, up)
    return plotter


def show_in(plotter: pv.BasePlotter, view: Viewport, up: str) -> None:
    """Show what a view shows, in its colours and from its side, with a plane that can cut more away.

    Parameters
    ----------
    plotter : pyvista.Plotter
        Gets an unstructured grid with the data of the mesh, "q" and "scaled-jacobian", and the coloured values.
    view : Viewport
    up : str
        Vertical axis of the view: x, y or z.
    """
    mesh, colours, cut = view.frame.mesh, view.colours, view.frame.look.cut
    left = view.remaining_after_cut()
    solids = to_pyvista(mesh.replace(cells=tuple(solid_blocks(mesh.cells))))
    grid = solids.extract_cells(np.arange(mesh.n_elements) if left is None else np.flatnonzero(left))
    if cut.smooth:
        beyond = [side.signed_distance(np.asarray(grid.points)) for side in cut.sides]
        grid.point_data["beyond"] = np.min(beyond, axis=0) if cut.notch else np.max(beyond, axis=0)
        grid = grid.clip_scalar(scalars="beyond")
    hexes = grid.cell_data["vtkOriginalCellIds"]
    grid.cell_data["q"] = view.frame.quality.q[hexes]
    grid.cell_data["scaled-jacobian"] = view.frame.quality.scaled_jacobian[hexes]
    colouring = colours.colouring
    if view.frame.look.colours.neutral:
        colouring = replace(colouring, table=np.full_like(colouring.table, OUTSIDE))
    start = (grid.bounds[0], *grid.center[1:])  # nothing is cut away
    add = partial(plotter.add_mesh_clip_plane, normal="x", origin=start)
    add_coloured(plotter, add, grid, colours.values[hexes], colours.kinds[hexes], colouring)
    apply_pose(plotter.camera, pose_of(view.camera, up))
    plotter.reset_camera_clipping_range()
