"""A mesh in a notebook that can be turned and zoomed, by PyVista."""

from __future__ import annotations

import math
from typing import Any

from hexmend.errors import HexmendError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, Metric, measure


def view(mesh: Mesh, metric: str = "q", **how: Any) -> Any:
    """What PyVista's `Plotter.show` returns for the mesh's skin; see `hexmend.notebook.view`.

    Raises
    ------
    ParameterError
        For a metric that there is not.
    HexmendError
        Where PyVista lacks what it shows notebooks with.
    """
    from hexmend_app.scene.graphics import prepare_off_screen

    declared = METRICS[metric]
    values = declared.of(mesh.points, mesh.hexes, measure(mesh.points, mesh.hexes))
    prepare_off_screen()
    import pyvista as pv

    from hexmend_app.scene.skin import Skin

    faces = Skin(mesh).visible()
    skin = pv.PolyData.from_regular_faces(faces.places(mesh.points), faces.quads)
    skin.cell_data[declared.title] = values[faces.hexes]
    plotter = pv.Plotter(notebook=True, window_size=[800, 560])
    plotter.add_mesh(skin, scalars=declared.title, clim=_range(declared), show_edges=True, edge_opacity=0.5)
    plotter.add_axes()
    try:
        return plotter.show(jupyter_backend=how.pop("jupyter_backend", "html"), return_viewer=True, **how)
    except ImportError as error:
        raise HexmendError(f'the view needs what is not installed ({error}): pip install "hexmend[notebook]"') from None


def _range(metric: Metric) -> tuple[float, float] | None:
    """The colours' range: the metric's own where it has ends, so that colours of two meshes can be compared."""
    return metric.full_range if all(map(math.isfinite, metric.full_range)) else None
