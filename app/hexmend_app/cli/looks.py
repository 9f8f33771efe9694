"""The options of commands that draw a mesh: how it is looked at."""

from __future__ import annotations

import argparse
import re
from dataclasses import fields
from math import isfinite
from typing import TYPE_CHECKING

from hexmend_app.cli import clip
from hexmend_app.cli.numbers import direction, span, wrong

if TYPE_CHECKING:
    from hexmend.mesh import Mesh
    from hexmend_app.state.look import Look, Structure

_NAMED = ("iso", "+x", "-x", "+y", "-y", "+z", "-z")


def prepare(parser: argparse.ArgumentParser) -> None:
    """Take -x and -1,0,0 as values: argparse takes words that begin with a minus for options, numbers apart."""
    parser._negative_number_matcher = re.compile(r"-(\d|\.\d|[xyz]$)")


def add_arguments(parser: argparse.ArgumentParser, size: str) -> None:
    """Declare the options; `size` is the default size."""
    clip.add_arguments(parser)
    parser.add_argument("--size", metavar="WxH", default=size, help="in pixels (default %(default)s)")
    parser.add_argument(
        "--metric", metavar="NAME", default="q", help="q, scaled-jacobian, edge-ratio, ... (default %(default)s)"
    )
    parser.add_argument("--colour-range", metavar="LOW,HIGH", help="values at the ends of the colours")
    parser.add_argument("--colour-map", metavar="NAME", default="viridis", help="viridis, cividis, plasma, inferno")
    parser.add_argument(
        "--quality-range",
        metavar="LOW,HIGH",
        help="show only hexes of a q in this range; from 0 on, inverted ones too",
    )
    parser.add_argument(
        "--view", metavar="FROM", default="iso", help="iso, +x, -x, ..., or x,y,z (default %(default)s)"
    )
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
    return args.view if args.view in _NAMED else direction(args.view, "--view")


def look_of(args: argparse.Namespace, mesh: Mesh) -> Look:
    """The look that the options ask for."""
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
    quality_range = None
    if args.quality_range:
        low, high = span(args.quality_range, "--quality-range")
        quality_range = ValueRange("q", low, high, inverted=low <= 0)
    return Look(
        clip=clip.clip_of(args, mesh),
        quality_range=quality_range,
        scale=ColourScale(metric.name, args.colour_map, mode, ends),
        edges=not args.no_edges,
        shading=not args.no_shading,
        neutral=args.neutral,
        structure=_structure(args.structure) if args.structure else Structure(),
    )


def _structure(text: str) -> Structure:
    from hexmend_app.state.look import Structure

    names, known = text.split(","), [one.name for one in fields(Structure) if one.name != "original"]
    for name in names:
        if name not in known:
            raise wrong("--structure", text, f"names among {', '.join(known)}, separated by commas")
    return Structure(**dict.fromkeys(names, True))


def size_of(args: argparse.Namespace) -> tuple[int, int]:
    """Width and height in pixels."""
    text = args.size
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and 64 <= int(width) <= 8192 and 64 <= int(height) <= 8192):
        raise wrong("--size", text, "WIDTHxHEIGHT of 64 to 8192 pixels each, as in 1600x1000")
    return int(width), int(height)
