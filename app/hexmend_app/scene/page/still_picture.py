"""Off-screen pictures of meshes, for commands and for scripts that reproduce pictures of a window."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.run.recipe import Recipe
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
    opened: Mesh | None = None,
    since: Mesh | None = None,
    since_name: str = "",
    recipe: Recipe | None = None,
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
    opened : Mesh, optional
        The first mesh as opened, which defines the original surface and the unit of movements.
    since : Mesh, optional
        Reference state of movements of the first mesh; by default, the first of several meshes.
    since_name : str
        Text after "since".
    recipe : Recipe, optional
        Methods that were run on the mesh since it was opened, for the metadata.

    Raises
    ------
    HexmendError
        If drawing is impossible on this machine, the scene does not fit the meshes, or the file cannot be written.
    """
    prepare_off_screen()
    path, first = Path(path), meshes[0]
    named = zip(names or [mesh.name for mesh in meshes], meshes, strict=True)
    page_meshes = [PageMesh(name, mesh, measure(mesh.points, mesh.hexes, mesh.mid_nodes)) for name, mesh in named]
    page_meshes[0] = replace(
        page_meshes[0],
        movement=_movement(scene, page_meshes, opened or first, since, since_name),
        original=None if opened is None or not scene.structure.is_on("original") else opened.points,
    )
    page = draw_page(scene, page_meshes)
    pictured = [
        PicturedMesh.of(opened or mesh, mesh, Path(file) if file else None, path)
        for mesh, file in zip(meshes, files or [""] * len(meshes), strict=True)
    ]
    page.write(path, with_metadata(scene, pictured, recipe))
    return page


def moving(scene: Scene) -> bool:
    """Return True if a scene shows the movement of a mesh, by colours or by arrows."""
    return scene.colours.metric in DISPLACEMENT_QUANTITIES or scene.movement.arrows is not Arrows.NONE


def movement_since(since: Mesh, name: str, mesh: Mesh, opened: Mesh) -> Displacement:
    """Return the movement of a mesh since an earlier state, in edge lengths of the mesh as opened."""
    reference = ReferenceState(since.points, measure(since.points, since.hexes), name)
    return Displacement(opened, reference, mesh.points, measure(mesh.points, mesh.hexes, mesh.mid_nodes))


def _movement(
    scene: Scene, meshes: Sequence[PageMesh], opened: Mesh, since: Mesh | None, name: str
) -> Displacement | None:
    """Return the movement of the first mesh, if the scene shows it."""
    if not moving(scene):
        return None
    first = meshes[0]
    if since is not None:
        return movement_since(since, name, first.mesh, opened)
    if len(meshes) == 1:
        raise ParameterError(
            "the scene shows the movement of a mesh: name the mesh before the movement first, then the mesh"
        )
    return Displacement(
        opened, ReferenceState(first.mesh.points, first.figures, first.name), first.mesh.points, first.figures
    )
