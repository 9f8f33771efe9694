"""`hexmend render`: a picture of a mesh, without a window and without an X server."""

from __future__ import annotations

import argparse
import re
from dataclasses import fields
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend_app.cli import clip
from hexmend_app.cli.numbers import direction, span, wrong

if TYPE_CHECKING:
    from hexmend.mesh import Mesh
    from hexmend.quality import ElementQuality
    from hexmend_app.state.look import Structure


class Render:
    """A mesh, or several side by side, as PNG."""

    name = "render"
    help = "Write a picture of a mesh, or of several side by side; needs neither a window nor an X server."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        # argparse takes words that begin with a minus for options, numbers apart; -x and -1,0,0 are values here.
        parser._negative_number_matcher = re.compile(r"-(\d|\.\d|[xyz]$)")
        parser.add_argument(
            "mesh", metavar="MESH", nargs="+", help="the mesh file; two to four are drawn side by side, alike"
        )
        parser.add_argument("-o", "--output", metavar="PNG", required=True, help="where to write the picture")
        clip.add_arguments(parser)
        parser.add_argument("--size", metavar="WxH", default="1600x1000", help="in pixels (default %(default)s)")
        parser.add_argument(
            "--metric", metavar="NAME", default="q", help="q, scaled-jacobian, edge-ratio, ... (default %(default)s)"
        )
        parser.add_argument("--colour-range", metavar="LOW,HIGH", help="values at the ends of the colours")
        parser.add_argument("--colour-map", metavar="NAME", default="viridis", help="viridis, cividis, plasma, inferno")
        parser.add_argument("--quality-range", metavar="LOW,HIGH", help="show only elements of a q in this range")
        parser.add_argument(
            "--view", metavar="FROM", default="iso", help="iso, +x, -x, ..., or x,y,z (default %(default)s)"
        )
        parser.add_argument("--transparent", action="store_true", help="leave the background out")
        parser.add_argument(
            "--structure",
            metavar="NAMES",
            help="draw irregular, boundary or sharp edges, fixed, free or locked nodes; several separated by commas",
        )
        parser.add_argument("--captions", metavar="A,B,...", help="names of several meshes (default: of their files)")
        parser.add_argument("--no-edges", action="store_true", help="leave the elements' edges out")
        parser.add_argument("--no-bar", action="store_true", help="leave the colour bar out")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.io import read
        from hexmend.io.atomic import replacing
        from hexmend.quality import measure

        size, names = _size(args.size), _captions(args)
        meshes = [read(path) for path in args.mesh]
        mesh = meshes[0]
        figures = measure(mesh.points, mesh.hexes)
        look = _look(args, mesh, figures)
        view = args.view if args.view in _NAMED else direction(args.view, "--view")
        from hexmend_app.scene.graphics import prepare_off_screen

        prepare_off_screen()
        from hexmend_app.scene.figure import Panel, figure
        from hexmend_app.scene.picture import picture

        how = {"view": view, "transparent": args.transparent, "bar": not args.no_bar}
        if len(meshes) == 1:
            image = picture(mesh, figures, look, size, **how)
        else:
            others = (Panel(name, one, measure(one.points, one.hexes)) for name, one in zip(names, meshes, strict=True))
            image = figure([*others], look, size, **how)
        with replacing(args.output) as temporary:
            image.save(temporary, format="PNG")
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

_NAMED = ("iso", "+x", "-x", "+y", "-y", "+z", "-z")


def _look(args: argparse.Namespace, mesh: Mesh, figures: ElementQuality):
    from hexmend.quality import METRICS
    from hexmend_app.scene.colours import MAPS
    from hexmend_app.state.look import ColourScale, Look, RangeMode, Structure, ValueRange

    if args.colour_map not in MAPS:
        raise wrong("--colour-map", args.colour_map, f"one of {', '.join(MAPS)}")
    metric = METRICS[args.metric]
    if args.colour_range:
        mode, ends = RangeMode.PINNED, span(args.colour_range, "--colour-range")
    elif all(map(isfinite, metric.full_range)):
        # What is negative is inverted, and has a colour of its own.
        mode, ends = RangeMode.PINNED, (max(metric.full_range[0], 0.0), metric.full_range[1])
    else:
        mode, ends = RangeMode.FITTED, (0.0, 1.0)
    return Look(
        clip=clip.clip_of(args, mesh),
        quality_range=ValueRange("q", *span(args.quality_range, "--quality-range")) if args.quality_range else None,
        scale=ColourScale(metric.name, args.colour_map, mode, ends),
        edges=not args.no_edges,
        structure=_structure(args.structure) if args.structure else Structure(),
    )


def _structure(text: str) -> Structure:
    from hexmend_app.state.look import Structure

    names, known = text.split(","), [one.name for one in fields(Structure)]
    for name in names:
        if name not in known:
            raise wrong("--structure", text, f"names among {', '.join(known)}, separated by commas")
    return Structure(**dict.fromkeys(names, True))


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and 64 <= int(width) <= 8192 and 64 <= int(height) <= 8192):
        raise wrong("--size", text, "WIDTHxHEIGHT of 64 to 8192 pixels each, as in 1600x1000")
    return int(width), int(height)


command = Render()
