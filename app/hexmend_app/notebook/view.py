"""An interactive view of a mesh in a notebook, by PyVista."""

from __future__ import annotations

import math
from typing import Any

from hexmend.errors import HexmendError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, Metric, measure
from hexmend_app.scene.render.graphics import prepare_off_screen


def plotter(mesh: Mesh, metric: str = "q", **options: Any) -> Any:
    """Return a PyVista plotter in which the mesh's surface is drawn, coloured by a metric.

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
    declared = METRICS[metric]
    values = declared.of(mesh.points, mesh.hexes, measure(mesh.points, mesh.hexes))
    prepare_off_screen()
    import pyvista as pv

    from hexmend_app.scene.geometry.skin import Skin

    faces = Skin(mesh).visible()
    skin = pv.PolyData.from_regular_faces(faces.places(mesh.points), faces.quads)
    skin.cell_data[declared.title] = values[faces.hexes]
    made = pv.Plotter(**options)
    made.add_mesh(skin, scalars=declared.title, clim=_range(declared), show_edges=True, edge_opacity=0.5)
    made.add_axes()
    return made


def view(mesh: Mesh, metric: str = "q", **options: Any) -> Any:
    """Return what PyVista's `Plotter.show` returns for the mesh's surface; see `hexmend.notebook.view`.

    Raises
    ------
    ParameterError
        If there is no metric of that name.
    HexmendError
        If PyVista's packages for notebooks are not installed.
    """
    made = plotter(mesh, metric, notebook=True, window_size=[800, 560])
    try:
        return made.show(jupyter_backend=options.pop("jupyter_backend", "html"), return_viewer=True, **options)
    except ImportError as error:
        raise HexmendError(
            f'the view needs a package that is not installed ({error}): pip install "hexmend[notebook]"'
        ) from None


def _range(metric: Metric) -> tuple[float, float] | None:
    """Return the metric's own range if it is finite, so that the colours of two meshes can be compared."""
    return metric.full_range if all(map(math.isfinite, metric.full_range)) else None
