"""`hexmend render`: a picture of a mesh, without a window and without an X server."""

from __future__ import annotations

import argparse
from pathlib import Path

from hexmend_app.cli import looks
from hexmend_app.cli.numbers import wrong

#: Meshes that are drawn side by side at most.
_MOST = 4


class Render:
    """A mesh, or several side by side, as PNG."""

    name = "render"
    help = "Write a picture of a mesh, or of several side by side; needs neither a window nor an X server."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        looks.prepare(parser)
        parser.add_argument(
            "mesh", metavar="MESH", nargs="+", help="the mesh file; two to four are drawn side by side, alike"
        )
        parser.add_argument("-o", "--output", metavar="PNG", required=True, help="where to write the picture")
        looks.add_arguments(parser, "1600x1000")
        parser.add_argument("--transparent", action="store_true", help="leave the background out")
        parser.add_argument("--captions", metavar="A,B,...", help="names of several meshes (default: of their files)")
        parser.add_argument("--no-bar", action="store_true", help="leave the colour bar out")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.io import read
        from hexmend.quality import measure

        size, names = looks.size_of(args), _captions(args)
        meshes = [read(path) for path in args.mesh]
        mesh = meshes[0]
        figures = measure(mesh.points, mesh.hexes)
        look = looks.look_of(args, mesh)
        view = looks.view_of(args)
        from hexmend_app.scene.graphics import prepare_off_screen

        prepare_off_screen()
        from hexmend_app.scene.export.figure import Panel, figure
        from hexmend_app.scene.export.picture import check_picture, picture, write_picture
        from hexmend_app.scene.frame import Frame

        check_picture(Path(args.output))  # an unknown suffix is said before the work, not after
        how = {"view": view, "transparent": args.transparent, "bar": not args.no_bar}
        if len(meshes) == 1:
            image = picture(Frame(mesh, figures, look=look), size, **how)
        else:
            others = (Panel(name, one, measure(one.points, one.hexes)) for name, one in zip(names, meshes, strict=True))
            image = figure([*others], look, size, **how)
        write_picture(Path(args.output), image)
        print(f"{args.output}: {size[0]} × {size[1]} pixels")
        return 0


def _captions(args: argparse.Namespace) -> list[str]:
    """The names of the meshes, where there are as many as can be drawn."""
    if len(args.mesh) > _MOST:
        raise wrong("MESH", f"{len(args.mesh)} files", f"{_MOST} at most")
    names = args.captions.split(",") if args.captions else [Path(path).stem for path in args.mesh]
    if len(names) != len(args.mesh):
        raise wrong("--captions", args.captions, f"{len(args.mesh)} names separated by commas, one a mesh")
    return names


#: Meshes that are drawn side by side at most.
_MOST = 4


command = Render()
