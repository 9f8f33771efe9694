"""Options of commands that draw a mesh: short ones for common keys of a scene, and `--key` for every key."""

from __future__ import annotations

import argparse
import re
from math import isfinite
from typing import Any

from hexmend_app.cli.numbers import invalid_value, numbers
from hexmend_app.codec.conversion import decode, encode, parse_value
from hexmend_app.picture import CutKind, Plane, Range, Scene, read_scene
from hexmend_app.picture.appearance import Structure
from hexmend_app.picture.colours import colour_quantity
from hexmend_app.picture.layer_switch import ordered_layers

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}

#: Options with a value, and switches with the value that they set: name, key of the scene, help.
_VALUES = (
    ("view", "camera.from", "direction of view: iso (default), +x, -x, +y, -y, +z, -z, or x,y,z"),
    ("metric", "colours.metric", "quality metric of `hexmend info --metrics`, movement or material (default q)"),
    ("colour-map", "colours.map", "viridis (default), cividis, plasma, inferno or another colour map"),
    ("colour-range", "colours.range", "values at both ends of the colours, as in 0.2,0.8, or full, fitted, acceptable"),
)
_SWITCHES = (
    ("smooth", "cut.style", "smooth", "cut through the hexes, which are shown whole by default"),
    ("neutral", "colours.neutral", True, "white boundary and one colour for exposed faces, instead of values"),
    ("no-edges", "lines.edges", 0.0, "do not draw the edges of the hexes"),
    ("no-shading", "page.shading", False, "do not darken cavities"),
)

#: Keys of an exact pose, which a direction replaces.
_POSE = ("position", "focal", "view_up", "scale")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options to a parser."""
    # Values such as -x and -1,0,0; argparse takes words that begin with a minus for options, except numbers.
    parser._negative_number_matcher = re.compile(r"-(\d|\.\d|inf\b|[xyz]$)")
    parser.add_argument("--scene", metavar="FILE.toml", help="camera, cut and colours; other options override them")
    text = "x, y, z or nx,ny,nz, and :position from 0 to 1 through the mesh (x:0.5)"
    parser.add_argument("--clip", metavar="PLANE", action="append", default=[], help=text)
    parser.add_argument("--flip", action="store_true", help="hide the other side of each plane")
    for name, _, text in _VALUES:
        parser.add_argument(f"--{name}", metavar=name.split("-")[-1].upper(), help=text)
    for name, _, _, text in _SWITCHES:
        parser.add_argument(f"--{name}", action="store_true", help=text)
    parser.add_argument(
        "--structure",
        metavar="NAMES",
        help="draw layers, with commas between them: irregular, boundary, sharp, fixed, free, locked, kinds, or "
        "an additional layer",
    )
    text = "another key of a scene file, as in page.margin=5 or cut.sphere='{ radius = 2 }'"
    parser.add_argument("--key", metavar="TABLE.KEY=VALUE", action="append", default=[], help=text)


def scene(args: argparse.Namespace, **keys: dict[str, Any]) -> Scene:
    """Return the scene of the file, or the default scene, overridden by the options.

    Parameters
    ----------
    args : Namespace
        From a parser with the options of `add_arguments`.
    **keys : dict
        More keys, by table.

    Raises
    ------
    FileError
        If the file cannot be read or is no scene.
    ParameterError
        If a value is invalid.
    """
    given = {table: dict(values) for table, values in keys.items()}
    for path, value in _given(args):
        table, _, key = path.partition(".")
        given.setdefault(table, {})[key] = value
    tables = encode(read_scene(args.scene) if args.scene else Scene())
    if args.metric or not args.scene:
        metric = args.metric or tables["colours"]["metric"]
        given["colours"] = {"range": _range_of(metric), **given.get("colours", {})}
    if not given.get("cut", {}).keys().isdisjoint(CutKind):
        tables["cut"] = {}
    if "from" in given.get("camera", {}):
        tables["camera"] = {key: value for key, value in tables["camera"].items() if key not in _POSE}
    if args.structure:
        tables["structure"] = encode(_parse_structure(args.structure))
    return decode(Scene, tables | {table: tables.get(table, {}) | values for table, values in given.items()})


def _given(args: argparse.Namespace) -> list[tuple[str, Any]]:
    """Return the keys that options set, as (TABLE.KEY, value)."""
    given: list[tuple[str, Any]] = []
    if args.clip:
        planes = [parse_plane(text) for text in args.clip]
        if args.flip:
            planes = [Plane(plane.flipped().normal, 1 - plane.position) for plane in planes]
        given.append(("cut.planes", planes))
    options = vars(args)
    for name, path, _ in _VALUES:
        if text := options[name.replace("-", "_")]:
            given.append((path, parse_value(text)))
    given += [(path, value) for name, path, value, _ in _SWITCHES if options[name.replace("-", "_")]]
    for text in args.key:
        path, equals, value = text.partition("=")
        if not (equals and "." in path):
            raise invalid_value("--key", text, "TABLE.KEY=VALUE, as in page.margin=5")
        given.append((path.strip(), parse_value(value)))
    return given


def parse_plane(text: str) -> Plane:
    """Parse the value of `--clip`: an axis or a normal, and a position from 0 to 1 through the mesh."""
    axis, _, position = text.partition(":")
    (share,) = numbers(position, 1, "--clip") if position else (0.5,)
    return Plane(_AXES.get(axis.lower()) or numbers(axis, 3, "--clip"), share)


def _parse_structure(text: str) -> Structure:
    names, known = text.split(","), [layer.name for layer in ordered_layers() if layer.name != "original"]
    if not set(names).issubset(known):
        raise invalid_value("--structure", text, f"names among {', '.join(known)}, separated by commas")
    return Structure.of(*names)


def _range_of(metric: str) -> Range | tuple[float, float]:
    """Return the default colour range of a metric; inverted hexes, which are negative, have a separate colour."""
    low, high = colour_quantity(metric).full_range
    return (max(low, 0.0), high) if isfinite(low) and isfinite(high) else Range.FITTED
