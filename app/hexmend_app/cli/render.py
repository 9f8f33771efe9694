"""`hexmend render`: a picture of meshes, without a window and without an X server."""

from __future__ import annotations

import argparse
import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hexmend_app.cli import looks
from hexmend_app.cli.numbers import numbers, wrong

if TYPE_CHECKING:
    from collections.abc import Sequence

    from hexmend_app.state.scene import Camera, Scene


class Render:
    """A scene of one mesh or several as PNG, TIFF, PDF or SVG."""

    name = "render"
    help = "Write a picture of a mesh, or of several side by side; needs neither a window nor an X server."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        looks.prepare(parser)
        parser.add_argument("mesh", metavar="MESH", nargs="+", help="the mesh file; several stand side by side")
        parser.add_argument(
            "-o",
            "--output",
            metavar="PICTURE",
            required=True,
            help="where to write the picture: .png, .tif, .pdf or .svg",
        )
        parser.add_argument(
            "--scene", metavar="FILE.toml", help="draw what this file describes; other options go before it"
        )
        parser.add_argument("--save-scene", metavar="FILE.toml", help="write what is drawn as such a file")
        parser.add_argument(
            "--camera",
            metavar="CAMERA",
            help="a name in the scene or in the session drawn, or what Copy camera gives",
        )
        looks.add_arguments(parser)
        size = parser.add_mutually_exclusive_group()
        size.add_argument("--size", metavar="WxH", help="in pixels (default 1600x1000)")
        size.add_argument("--mm", metavar="WxH", help="in millimetres, as in 170x90")
        parser.add_argument("--dpi", metavar="N", help="pixels per inch (default 300 where the size is in mm)")
        ground = parser.add_mutually_exclusive_group()
        ground.add_argument("--background", metavar="COLOUR", help="white, transparent or #rrggbb (default white)")
        ground.add_argument("--transparent", action="store_true", help="leave the background out")
        parser.add_argument("--captions", metavar="A,B,...", help="what stands above the panels (default: their files)")
        parser.add_argument("--no-bar", action="store_true", help="leave the colour bar out")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.io import read
        from hexmend.io.storage.atomic import check_writable

        scene = _scene(args)
        scene.panels_of(len(args.mesh))  # what is wrong is said before the work, not after
        from hexmend_app.scene.graphics import prepare_off_screen
        from hexmend_app.state.scene import write_scene

        prepare_off_screen()
        from hexmend_app.scene.export.sheet import format_of
        from hexmend_app.scene.export.still import write_picture

        format_of(Path(args.output))
        check_writable(args.output)
        if args.save_scene:
            write_scene(args.save_scene, scene)
        meshes = [read(path) for path in args.mesh]
        sheet = write_picture(args.output, scene, meshes, [Path(path).stem for path in args.mesh], files=args.mesh)
        print(f"{args.output}: {sheet.size[0]} × {sheet.size[1]} pixels")
        return 0


def _scene(args: argparse.Namespace) -> Scene:
    """The scene of the file, with what the options say in place of its own."""
    from hexmend_app.state.scene import Place, Scene, read_scene

    scene = read_scene(args.scene) if args.scene else Scene()
    if not args.scene and not args.metric:
        args.metric = scene.colours.metric  # with the range that suits it
    scene = looks.with_options(args, scene)
    changes: dict[str, Any] = {"page": replace(scene.page, **_page(args))}
    if args.camera:
        changes["camera"] = _camera(args.camera, scene, args.mesh)
    if args.no_bar:
        changes["bar"] = replace(scene.bar, place=Place.NONE)
    if args.captions:
        changes["panels"] = _captioned(args, scene)
    return replace(scene, **changes)


def _page(args: argparse.Namespace) -> dict[str, Any]:
    """What the options say of the page."""
    page: dict[str, Any] = {}
    if args.size:
        page |= {"pixels": looks.size_of(args.size), "width": None, "height": None}
    if args.mm:
        width, height = numbers(args.mm.lower().replace("x", ","), 2, "--mm")
        page |= {"width": width, "height": height, "pixels": None}
    if args.dpi:
        (page["dpi"],) = numbers(args.dpi, 1, "--dpi")
    if args.transparent or args.background:
        page["background"] = args.background or "transparent"
    return page


def _camera(text: str, scene: Scene, paths: Sequence[str]) -> Camera:
    """The camera of a name, in the scene or else in a session that is drawn, or that a text describes."""
    from hexmend_app.state.scene import camera_from

    named = scene.cameras if text in scene.cameras else {**_kept(paths), **scene.cameras}
    if text in named:
        return named[text]
    if re.match(r"\s*(camera\s*=\s*)?\{", text):
        return camera_from(text)
    known = ", ".join(named) or "none"
    raise wrong("--camera", text, f"the text of a camera, or a name in the scene or the session (known: {known})")


def _kept(paths: Sequence[str]) -> dict[str, Camera]:
    """The cameras of the sessions among some meshes; of one name, that of the first."""
    from hexmend.io.formats.session import SUFFIX
    from hexmend_app.state.scene.kept_cameras import cameras_of

    found: dict[str, Camera] = {}
    for path in paths:
        if path.lower().endswith(SUFFIX):
            found = {**cameras_of(path), **found}
    return found


def _captioned(args: argparse.Namespace, scene: Scene) -> tuple[Any, ...]:
    names, panels = args.captions.split(","), scene.panels_of(len(args.mesh))
    if len(names) != len(panels):
        raise wrong("--captions", args.captions, f"{len(panels)} names separated by commas, one a panel")
    return tuple(replace(panel, caption=name) for panel, name in zip(panels, names, strict=True))


command = Render()
