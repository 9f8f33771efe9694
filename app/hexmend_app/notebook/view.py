"""Interactive view of a mesh in a notebook, by PyVista."""

from __future__ import annotations

import math
from typing import Any

from hexmend.errors import HexmendError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, Metric, measure
from hexmend_app.scene.render.graphics import prepare_off_screen


def plotter(mesh: Mesh, metric: str = "q", **options: Any) -> Any:
    """Return a PyVista plotter with the surface of a mesh, coloured by a metric.

    Parameters
    ----------
    mesh : Mesh
    metric : str
    **options
        Passed to `pyvista.Plotter`, such as `off_screen=True`.

    Raises
    ------
    ParameterError
        If there is no metric of that name.
    """
    quantity = METRICS[metric]
    values = quantity.values(mesh, measure(mesh.points, mesh.hexes))
    prepare_off_screen()
    import pyvista as pv

    from hexmend_app.scene.geometry.skin import Skin

    faces = Skin(mesh).visible()
    skin = pv.PolyData.from_regular_faces(faces.places(mesh.points), faces.quads)
    skin.cell_data[quantity.title] = values[faces.hexes]
    result = pv.Plotter(**options)
    result.add_mesh(skin, scalars=quantity.title, clim=_range(quantity), show_edges=True, edge_opacity=0.5)
    result.add_axes()
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
    result = plotter(mesh, metric, notebook=True, window_size=[800, 560])
    try:
        return result.show(jupyter_backend=options.pop("jupyter_backend", "html"), return_viewer=True, **options)
    except ImportError as error:
        raise HexmendError(f'the view needs a missing package ({error}): pip install "hexmend[notebook]"') from None


def _range(metric: Metric) -> tuple[float, float] | None:
    """Return the range of a metric if it is finite, which makes the colours of two meshes comparable."""
    return metric.full_range if all(map(math.isfinite, metric.full_range)) else None
