"""Implementation of `hexmend render`."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from hexmend.errors import ParameterError
from hexmend.io import read
from hexmend.io.storage.atomic import check_writable
from hexmend_app.cli import scene_options
from hexmend_app.cli.numbers import invalid_value, numbers, page_size
from hexmend_app.formats.session import SUFFIX
from hexmend_app.picture import Camera, PicturePanel, Scene, TextPlace, camera_from, write_scene
from hexmend_app.picture.camera import cameras_of
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.picture.picture_metadata import PicturedMesh, with_metadata
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import draw_page, format_of


def run(args: argparse.Namespace) -> int:
    """Draw the meshes and write the picture; invalid options are reported before the meshes are read."""
    scene = _scene(args)
    scene.panels_of(len(args.mesh))
    output = Path(args.output)
    format_of(output)
    check_writable(output)
    if args.save_scene:
        write_scene(args.save_scene, scene)
    meshes = [read(path) for path in args.mesh]
    page_meshes = [PageMesh.of(mesh, Path(path).stem) for mesh, path in zip(meshes, args.mesh, strict=True)]
    page_meshes[0] = replace(page_meshes[0], movement=_movement(scene, page_meshes))
    page = draw_page(scene, page_meshes)
    pictured = [PicturedMesh.of(mesh, mesh, Path(path), output) for mesh, path in zip(meshes, args.mesh, strict=True)]
    page.write(output, with_metadata(scene, pictured))
    print(f"{args.output}: {page.size[0]} × {page.size[1]} pixels")
    return 0


def _movement(scene: Scene, meshes: Sequence[PageMesh]) -> Displacement | None:
    """Return the movement of the first mesh, if the scene shows it."""
    if not scene.shows_movement:
        return None
    if len(meshes) == 1:
        raise ParameterError(
            "the scene shows the movement of a mesh: name the mesh before the movement first, then the mesh"
        )
    first = meshes[0]
    reference = ReferenceState(first.mesh.points, first.quality, first.name)
    return Displacement(first.mesh, reference, first.mesh.points, first.quality)


def _scene(args: argparse.Namespace) -> Scene:
    """Return the scene of the file, overridden by the options."""
    bar = {"place": TextPlace.NONE} if args.no_bar else {}
    scene = scene_options.scene(args, page=_page(args), bar=bar)
    changes: dict[str, Any] = {}
    if args.camera:
        changes["camera"] = _camera(args.camera, scene, args.mesh)
    if args.captions:
        changes["panels"] = _captioned(args, scene)
    return replace(scene, **changes)


def _page(args: argparse.Namespace) -> dict[str, Any]:
    """Return the keys of the page whose options have another notation."""
    page: dict[str, Any] = {}
    if args.size:
        page |= page_size(args.size)
    if args.mm:
        width, height = numbers(args.mm.lower().replace("x", ","), 2, "--mm")
        page |= {"width": width, "height": height, "pixels": None}
    if args.dpi:
        (page["dpi"],) = numbers(args.dpi, 1, "--dpi")
    if args.background:
        page["background"] = args.background
    return page


def _camera(text: str, scene: Scene, paths: Sequence[str]) -> Camera:
    """Return the camera of a name in the scene or in a session among the files, or parse the text of a camera."""
    named = scene.cameras if text in scene.cameras else {**_session_cameras(paths), **scene.cameras}
    if text in named:
        return named[text]
    if re.match(r"\s*(camera\s*=\s*)?\{", text):
        return camera_from(text)
    known = ", ".join(named) or "none"
    expected = f"the text of a camera, or a name in the scene or the session (known: {known})"
    raise invalid_value("--camera", text, expected)


def _session_cameras(paths: Sequence[str]) -> dict[str, Camera]:
    """Return the named cameras of all sessions among the files; the first session has priority."""
    found: dict[str, Camera] = {}
    for path in paths:
        if path.lower().endswith(SUFFIX):
            found = {**cameras_of(path), **found}
    return found


def _captioned(args: argparse.Namespace, scene: Scene) -> tuple[PicturePanel, ...]:
    """Return the panels with captions from the command line."""
    names, panels = args.captions.split(","), scene.panels_of(len(args.mesh))
    if len(names) != len(panels):
        raise invalid_value(
            "--captions", args.captions, f"as many names as panels ({len(panels)}), separated by commas"
        )
    return tuple(replace(panel, caption=name) for panel, name in zip(panels, names, strict=True))
