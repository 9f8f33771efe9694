"""The command `hexmend film`: an animation of a run, without a window and without an X server."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_force, add_method, add_surface
from hexmend_app.cli.picture_command import PictureCommand

_HELP = "Run a method and write an animation of its iterations: MP4, GIF, WebP or PNG, by the suffix."


def _arguments(parser: argparse.ArgumentParser) -> None:
    from hexmend_app.cli.scene_options import add_arguments

    parser.add_argument("mesh", metavar="MESH", help="the mesh file")
    parser.add_argument("-o", "--output", metavar="FILE.gif", required=True, help="where to write the animation")
    add_method(parser)
    add_surface(parser)
    parser.add_argument("--frames", metavar="N", default="40", help="maximum number of frames (default %(default)s)")
    parser.add_argument("--rate", metavar="N", default="10", help="frames per second (default %(default)s)")
    add_arguments(parser)
    parser.add_argument("--size", metavar="WxH", default="800x500", help="in pixels (default %(default)s)")
    parser.add_argument("--histogram", action="store_true", help="show the quality distribution next to the mesh")
    parser.add_argument("--before", action="store_true", help="show the mesh before the run next to it")
    parser.add_argument("--poster", action="store_true", help="begin with the result, as a picture of the whole film")
    parser.add_argument("--arrows", metavar="NODES", help="arrows of the displacement of nodes: sight or all")
    parser.add_argument("--since", metavar="TIME", help="start of the displacement: opened (default) or iteration")
    add_force(parser)


command = PictureCommand("film", _HELP, _arguments, f"{__name__}.animation")
