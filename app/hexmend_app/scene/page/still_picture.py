"""Off-screen pictures of meshes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend_app.picture import Scene
from hexmend_app.picture.appearance import Arrows
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES, Displacement, ReferenceState
from hexmend_app.picture.picture_metadata import PicturedMesh, with_metadata
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import PageRenderer, draw_page
from hexmend_app.scene.render.graphics import prepare_off_screen


def write_picture(
    path: str | Path,
    scene: Scene,
    meshes: Sequence[Mesh],
    names: Sequence[str] = (),
    *,
    files: Sequence[str | Path] = (),
) -> PageRenderer:
    """Draw a scene and write it to a file; requires neither a window nor an X server.

    Parameters
    ----------
    path : path-like
        Path with a suffix of `hexmend_app.scene.page.page_renderer.FORMATS`; a PNG contains the scene as metadata.
    scene : Scene
    meshes : sequence of Mesh
        At least one mesh; panels refer to them by number from 1.
    names : sequence of str
        Names in the captions; by default the names of the meshes.
    files : sequence of path-like
        Files of the meshes, for the metadata.

    Raises
    ------
    HexmendError
        If drawing is impossible on this machine, the scene does not fit the meshes, or the file cannot be written.
    """
    prepare_off_screen()
    path = Path(path)
    named = zip(names or [mesh.name for mesh in meshes], meshes, strict=True)
    page_meshes = [PageMesh(name, mesh, measure(mesh.points, mesh.hexes, mesh.mid_nodes)) for name, mesh in named]
    page_meshes[0] = replace(page_meshes[0], movement=_movement(scene, page_meshes))
    page = draw_page(scene, page_meshes)
    pictured = [
        PicturedMesh.of(mesh, mesh, Path(file) if file else None, path)
        for mesh, file in zip(meshes, files or [""] * len(meshes), strict=True)
    ]
    page.write(path, with_metadata(scene, pictured))
    return page


def moving(scene: Scene) -> bool:
    """Return True if a scene shows the movement of a mesh, by colours or by arrows."""
    return scene.colours.metric in DISPLACEMENT_QUANTITIES or scene.movement.arrows is not Arrows.NONE


def _movement(scene: Scene, meshes: Sequence[PageMesh]) -> Displacement | None:
    """Return the movement of the first mesh, if the scene shows it."""
    if not moving(scene):
        return None
    if len(meshes) == 1:
        raise ParameterError(
            "the scene shows the movement of a mesh: name the mesh before the movement first, then the mesh"
        )
    first = meshes[0]
    reference = ReferenceState(first.mesh.points, first.figures, first.name)
    return Displacement(first.mesh, reference, first.mesh.points, first.figures)
