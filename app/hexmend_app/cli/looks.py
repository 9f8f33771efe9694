"""The options of commands that draw a mesh: how it is looked at."""

from __future__ import annotations

import argparse
import re
from dataclasses import fields, replace
from math import isfinite
from typing import TYPE_CHECKING, Any

from hexmend_app.cli import clip
from hexmend_app.cli.numbers import direction, span, wrong

if TYPE_CHECKING:
    from hexmend.mesh.mesh import Mesh
    from hexmend_app.state.look import Look, Structure
    from hexmend_app.state.scene import Colours, Scene

_NAMED = ("iso", "+x", "-x", "+y", "-y", "+z", "-z")


def prepare(parser: argparse.ArgumentParser) -> None:
    """Take -x and -1,0,0 as values: argparse takes words that begin with a minus for options, numbers apart."""
    parser._negative_number_matcher = re.compile(r"-(\d|\.\d|[xyz]$)")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    clip.add_arguments(parser)
    parser.add_argument("--metric", metavar="NAME", help="q, scaled-jacobian, edge-ratio, ... (default q)")
    parser.add_argument("--colour-range", metavar="LOW,HIGH", help="values at the ends of the colours")
    parser.add_argument("--colour-map", metavar="NAME", help="viridis, cividis, plasma, inferno")
    parser.add_argument(
        "--quality-range",
        metavar="LOW,HIGH",
        help="show only hexes of a q in this range; from 0 on, inverted ones too",
    )
    parser.add_argument("--view", metavar="FROM", help="iso, +x, -x, ..., or x,y,z (default iso)")
    parser.add_argument(
        "--structure",
        metavar="NAMES",
        help="draw irregular, boundary or sharp edges, fixed, free or locked nodes, kinds of boundary nodes; several "
        "separated by commas",
    )
    parser.add_argument("--neutral", action="store_true", help="white outside and one colour inside, no values")
    parser.add_argument("--no-shading", action="store_true", help="do not darken what little light reaches")
    parser.add_argument("--no-edges", action="store_true", help="leave the hexes' edges out")


def view_of(args: argparse.Namespace) -> str | tuple[float, ...]:
    """The direction to look from."""
    text = args.view or _NAMED[0]
    return text if text in _NAMED else direction(text, "--view")


def look_of(args: argparse.Namespace, mesh: Mesh) -> Look:
    """The look that the options ask for."""
    from hexmend_app.state.scene import Scene

    return with_options(args, Scene()).look(mesh)


def with_options(args: argparse.Namespace, scene: Scene) -> Scene:
    """A scene with what the options say in place of its own."""
    from hexmend_app.state.scene import Camera, Show

    changes: dict[str, Any] = {"colours": _colours(args, scene)}
    cut = clip.cut_of(args)
    if cut is not None:
        changes["cut"] = cut
    if args.quality_range:
        low, high = span(args.quality_range, "--quality-range")
        changes["show"] = Show(quality=(low, high), inverted=low <= 0)
    if args.structure:
        changes["structure"] = _structure(args.structure)
    if args.view:
        changes["camera"] = Camera(view_of(args), parallel=scene.camera.parallel, up=scene.camera.up)
    if args.no_edges:
        changes["lines"] = replace(scene.lines, edges=0.0)
    if args.no_shading:
        changes["page"] = replace(scene.page, shading=False)
    return replace(scene, **changes)


def _colours(args: argparse.Namespace, scene: Scene) -> Colours:
    from hexmend.quality import METRICS
    from hexmend_app.scene.colours import MAPS
    from hexmend_app.state.scene import Range

    if args.colour_map and args.colour_map not in MAPS:
        raise wrong("--colour-map", args.colour_map, f"one of {', '.join(MAPS)}")
    colours = scene.colours
    changes: dict[str, Any] = {}
    if args.metric:
        full = METRICS[args.metric].full_range
        # What is negative is inverted, and has a colour of its own.
        ends = (max(full[0], 0.0), full[1]) if all(map(isfinite, full)) else Range.FITTED
        changes |= {"metric": args.metric, "range": ends}
    if args.colour_range:
        changes["range"] = span(args.colour_range, "--colour-range")
    if args.colour_map:
        changes["map"] = args.colour_map
    if args.neutral:
        changes["neutral"] = True
    return replace(colours, **changes)


def _structure(text: str) -> Structure:
    from hexmend_app.state.look import Structure

    names, known = text.split(","), [one.name for one in fields(Structure) if one.name != "original"]
    for name in names:
        if name not in known:
            raise wrong("--structure", text, f"names among {', '.join(known)}, separated by commas")
    return Structure(**dict.fromkeys(names, True))


def size_of(text: str) -> tuple[int, int]:
    """Width and height in pixels."""
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and 64 <= int(width) <= 8192 and 64 <= int(height) <= 8192):
        raise wrong("--size", text, "WIDTHxHEIGHT of 64 to 8192 pixels each, as in 1600x1000")
    return int(width), int(height)
