"""The command `hexmend render`, which draws meshes without a window or an X server."""

from __future__ import annotations

import argparse

from hexmend_app.cli.picture_command import PictureCommand

_HELP = "Write a picture of a mesh, or of several side by side; needs neither a window nor an X server."


def _arguments(parser: argparse.ArgumentParser) -> None:
    from hexmend_app.cli.scene_options import add_arguments

    parser.add_argument("mesh", metavar="MESH", nargs="+", help="the mesh file; several are drawn side by side")
    text = "where to write the picture: .png, .tif, .pdf or .svg"
    parser.add_argument("-o", "--output", metavar="PICTURE", required=True, help=text)
    parser.add_argument("--save-scene", metavar="FILE.toml", help="write the drawn scene to this file")
    text = "name of a camera in the scene or session, or a camera copied in the viewer"
    parser.add_argument("--camera", metavar="CAMERA", help=text)
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--size", metavar="WxH", help="in pixels (default 1600x1000)")
    size.add_argument("--mm", metavar="WxH", help="in millimetres, as in 170x90")
    parser.add_argument("--dpi", metavar="X", help="pixels per inch (default 300 for pages in mm)")
    parser.add_argument("--background", metavar="COLOUR", help="white, transparent or #rrggbb (default white)")
    parser.add_argument("--captions", metavar="A,B,...", help="captions of the panels (default: their files)")
    parser.add_argument("--no-bar", action="store_true", help="do not draw the colour bar")
    add_arguments(parser)


command = PictureCommand("render", _HELP, _arguments, f"{__name__}.picture")
