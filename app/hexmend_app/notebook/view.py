"""Mesh in the viewer's colours, shown by PyVista: in a notebook, in a window, or with more added to it."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import HexmendError, MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.quality.mesh_quality import find_metric, measure_mesh
from hexmend.quality.selection import region
from hexmend.terminal_text import in_notebook, install_hint
from hexmend_app.picture.colours import Colours
from hexmend_app.scene.colour.colouring import invalid_kinds, resolve
from hexmend_app.scene.render.graphics import GraphicsError, prepare_off_screen

#: Options of `plot` for `pyvista.Plotter`; others are those of its method `show`.
_OF_PLOTTER = ("border", "lighting", "line_smoothing", "notebook", "off_screen", "theme", "title", "window_size")


def plotter(mesh: Mesh, metric: str = "q", *, hexes: Sequence[int] | np.ndarray | None = None, **options: Any) -> Any:
    """Return a PyVista plotter with the surface of a mesh in the viewer's colours.

    Parameters
    ----------
    mesh : Mesh
    metric : str
        Name of a metric; underscores count as dashes.
    hexes : (k,) int or (m,) bool, optional
        Only these hexes; all by default.
    **options
        Passed to `pyvista.Plotter`, such as `off_screen=True`.

    Raises
    ------
    ParameterError
        If there is no metric of that name.
    MeshError
        For hexes that do not exist, and for no hexes.
    """
    if not (_opens_window(options) and _has_display()):
        prepare_off_screen()
    import pyvista as pv

    from hexmend_app.scene.colour.pyvista_colours import add_coloured
    from hexmend_app.scene.geometry.coloured_polygons import polygons
    from hexmend_app.scene.geometry.skin import Skin

    quantity, quality = find_metric(metric), measure_mesh(mesh)
    values = quantity.values(mesh, quality)
    colouring = resolve(Colours(metric=quantity.name), values, quality.invalid)
    faces = Skin(mesh).visible(None if hexes is None else _marks(mesh, hexes))
    skin = polygons(faces.places(mesh.points), faces.quads)
    result = pv.Plotter(**options)
    kinds = invalid_kinds(quality)
    add_coloured(result, result.add_mesh, skin, values[faces.hexes], kinds[faces.hexes], colouring)
    return result


def view(mesh: Mesh, metric: str = "q", **options: Any) -> Any:
    """Show the surface of a mesh, and return the result of `pyvista.Plotter.show`; see `hexmend.notebook.view`.

    Raises
    ------
    ParameterError
        If there is no metric of that name.
    HexmendError
        If PyVista's packages for notebooks are not installed.
    """
    return _show_in_notebook(plotter(mesh, metric, notebook=True, window_size=[800, 560]), options)


def plot(
    mesh: Mesh,
    metric: str = "q",
    *,
    hexes: Sequence[int] | np.ndarray | None = None,
    show: bool = True,
    **options: Any,
) -> Any:
    """Show a mesh in a window or a notebook; see `hexmend.notebook.plot`."""
    of_plotter = {name: options.pop(name) for name in _OF_PLOTTER if name in options}
    if not _has_display() and "screenshot" in options:
        of_plotter.setdefault("off_screen", True)
    if in_notebook():
        in_page = {"notebook": True, "window_size": [800, 560]}
        of_plotter = ({"notebook": False} if of_plotter.get("off_screen") else in_page) | of_plotter
    if show and _opens_window(of_plotter) and not _has_display():
        raise GraphicsError(
            "there is no display to open a window on: save a picture by "
            'mesh.plot(off_screen=True, screenshot="mesh.png"), or take the plotter of mesh.plot(show=False)'
        )
    result = plotter(mesh, metric, hexes=hexes, **of_plotter)
    if not show:
        return result
    return _show_in_notebook(result, options) if of_plotter.get("notebook") else result.show(**options)


def _show_in_notebook(result: Any, options: dict[str, Any]) -> Any:
    """Show a plotter where a notebook displays what is returned."""
    try:
        return result.show(jupyter_backend=options.pop("jupyter_backend", "html"), return_viewer=True, **options)
    except ImportError as error:
        raise HexmendError(f"the view needs a missing package ({error}): {install_hint('notebook')}") from None


def _marks(mesh: Mesh, hexes: Sequence[int] | np.ndarray) -> np.ndarray:
    """Return True for the hexes to be drawn, (m,) bool."""
    chosen = region(mesh, hexes=hexes)
    if not chosen.size:
        raise MeshError("there are no hexes to show: the selection is empty")
    return mask(chosen, mesh.n_elements)


def _opens_window(options: dict[str, Any]) -> bool:
    """Return True if a plotter with some options draws on the screen."""
    return not (options.get("off_screen") or options.get("notebook"))


def _has_display() -> bool:
    """Return True if a window can be opened."""
    on_linux = sys.platform.startswith("linux")
    return not on_linux or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
