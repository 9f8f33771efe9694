"""Pictures of meshes under a scene, off screen: for commands, and for scripts that repeat what a window drew."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES, Displacement, ReferenceState
from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.run.recipe import Recipe
from hexmend_app.picture import Scene
from hexmend_app.picture.appearance import Arrows
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
    """Draw a scene and write it; needs neither a window nor an X server.

    Parameters
    ----------
    path : path-like
        Its suffix is one of `hexmend_app.scene.page.page_renderer.FORMATS`; a PNG carries the scene.
    scene : Scene
    meshes : sequence of Mesh
        At least one; the scene's panels name them by number from 1.
    names : sequence of str
        Names in the captions; by default those of the meshes.
    files : sequence of path-like
        Files of the meshes, which the metadata name.
    opened : Mesh, optional
        The first mesh as it was opened, whose boundary and whose edge lengths the scene may want.
    since : Mesh, optional
        The first mesh as it was when the movement began that the scene shows; by default, of several, the first itself.
    since_name : str
        Text after "since".
    recipe : Recipe, optional
        Methods that ran on the mesh since it was opened; part of the metadata.

    Raises
    ------
    HexmendError
        If nothing can be drawn here, the scene does not fit the meshes, or the file cannot be written.
    """
    prepare_off_screen()
    path, first = Path(path), meshes[0]
    named = zip(names or [one.name for one in meshes], meshes, strict=True)
    subjects = [PageMesh(name, mesh, measure(mesh.points, mesh.hexes)) for name, mesh in named]
    subjects[0] = replace(
        subjects[0],
        movement=_movement(scene, subjects, opened or first, since, since_name),
        original=None if opened is None or not scene.structure.original else opened.points,
    )
    sheet = draw_page(scene, subjects)
    known = files or [""] * len(meshes)
    shown = [
        PicturedMesh.of(opened or mesh, mesh, Path(file) if file else None, path)
        for mesh, file in zip(meshes, known, strict=True)
    ]
    sheet.write(path, with_metadata(scene, shown, recipe))
    return sheet


def moving(scene: Scene) -> bool:
    """Return True if a scene shows the movement of a mesh."""
    return scene.colours.metric in DISPLACEMENT_QUANTITIES or scene.movement.arrows is not Arrows.NONE


def movement_since(since: Mesh, name: str, mesh: Mesh, opened: Mesh) -> Displacement:
    """Return the movement of a mesh, in edge lengths of the mesh as it was opened."""
    then = ReferenceState(since.points, measure(since.points, since.hexes), name)
    return Displacement(opened, then, mesh.points, measure(mesh.points, mesh.hexes))


def _movement(
    scene: Scene, subjects: Sequence[PageMesh], opened: Mesh, since: Mesh | None, name: str
) -> Displacement | None:
    """Return the movement of the first mesh, if the scene shows it."""
    if not moving(scene):
        return None
    first = subjects[0]
    if since is not None:
        return movement_since(since, name, first.mesh, opened)
    if len(subjects) == 1:
        raise ParameterError("the scene shows how a mesh has moved: name the mesh before that, and then the mesh")
    return Displacement(
        opened, ReferenceState(first.mesh.points, first.figures, first.name), first.mesh.points, first.figures
    )
