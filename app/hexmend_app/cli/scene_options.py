"""Options of commands that draw a mesh, one for each key of the tables of a scene.

The key `margin` of the table `page` becomes the option `--page-margin`, unless `_SHORT` has a shorter name; help and
bounds come from the table. Keys with another notation are excluded by `_OTHER_NOTATION` or by the command.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Collection
from dataclasses import is_dataclass, replace
from math import isfinite
from types import NoneType, UnionType
from typing import Any, NamedTuple, get_args, get_origin

from hexmend.mesh.mesh import Mesh
from hexmend.toml_text import parse_toml
from hexmend_app.cli import cut_options
from hexmend_app.cli.numbers import direction, invalid_value, numbers, span
from hexmend_app.codec.config_table import ConfigTable
from hexmend_app.codec.docstring_help import helps
from hexmend_app.codec.option import Option, options_of
from hexmend_app.picture import Camera, Cut, Range, Scene, Show
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.camera import DIRECTIONS
from hexmend_app.picture.colour_map import value_maps
from hexmend_app.picture.layer_switch import ordered_layers
from hexmend_app.picture.quantities import colour_quantity

#: Tables of a scene for the mesh, and for the page.
MESH_TABLES, PAGE_TABLES = ("cut", "colours", "show"), ("camera", "lines", "bar", "axes", "page")

_SHORT = {
    "camera.from": "view",
    "colours.map": "colour-map",
    "colours.metric": "metric",
    "colours.neutral": "neutral",
    "colours.range": "colour-range",
    "cut.notch": "notch",
    "page.background": "background",
    "page.dpi": "dpi",
    "page.shading": "shading",
    "show.quality": "quality-range",
}

#: Keys that are options of every command, whatever its tables.
_ALWAYS = frozenset({"camera.from", "page.shading"})

_OTHER_NOTATION = frozenset(f"cut.{key}" for key in cut_options.KEYS)


class _KeyOption(NamedTuple):
    """Option of a key; a flag inverts the default of a switch."""

    table: str
    key: Option
    help: str

    @property
    def full_name(self) -> str:
        return f"{self.table}.{self.key.name}"

    @property
    def name(self) -> str:
        name = _SHORT.get(self.full_name, f"{self.table}-{self.key.name}".replace("_", "-"))
        return f"--no-{name}" if self.key.default is True else f"--{name}"

    @property
    def dest(self) -> str:
        return self.name[2:].replace("-", "_")


def _key_options() -> tuple[_KeyOption, ...]:
    """Return the options of all tables in the order of the scene."""
    keys = options_of(Scene)
    tables = [key for key in keys if isinstance(key.kind, type) and issubclass(key.kind, ConfigTable)]
    return tuple(
        _KeyOption(table.name, key, helps(table.kind).get(key.field, ""))
        for table in tables
        for key in options_of(table.kind)
    )


def accept_negative_values(parser: argparse.ArgumentParser) -> None:
    """Accept -x and -1,0,0 as values; argparse takes words that begin with a minus for options, except numbers."""
    parser._negative_number_matcher = re.compile(r"-(\d|\.\d|inf\b|[xyz]$)")


def add_arguments(
    parser: argparse.ArgumentParser, tables: Collection[str] = MESH_TABLES, without: Collection[str] = ()
) -> None:
    """Add the options to a parser.

    Parameters
    ----------
    parser : ArgumentParser
    tables : collection of str
        Tables of the scene whose keys become options.
    without : collection of str
        Excluded keys, such as "page.pixels".
    """
    cut_options.add_arguments(parser)
    for option in _key_options():
        offered = option.table in tables or option.full_name in _ALWAYS
        if not offered or option.full_name in {*_OTHER_NOTATION, *without}:
            continue
        text = option.help.replace("%", "%%")
        if option.key.kind is bool:
            text = f"Turn off: {text[:1].lower()}{text[1:]}" if option.key.default else text
            parser.add_argument(option.name, action="store_true", help=text)
        else:
            parser.add_argument(option.name, metavar=_metavar(option.key), help=text + _limits(option.key))
    parser.add_argument(
        "--structure",
        metavar="NAMES",
        help="draw layers: irregular, boundary or sharp edges, fixed, free or locked nodes, kinds of boundary nodes, "
        "others (cells that are not hexes), or an additional layer; separate several by commas",
    )
    parser.add_argument("--no-edges", action="store_true", help="do not draw the edges of the hexes")
    parser.add_argument(
        "--flat", action="store_true", help="draw hexes of 20 and 27 nodes by their corners, with flat faces"
    )


def _kinds(key: Option) -> tuple[Any, ...]:
    """Return the types of a key's value except None."""
    union = get_origin(key.kind) is UnionType
    return tuple(kind for kind in (get_args(key.kind) if union else (key.kind,)) if kind is not NoneType)


def _metavar(key: Option) -> str:
    kind = _kinds(key)[-1]
    pair = get_args(kind) == (float, float)
    return {int: "N", float: "X"}.get(kind, "LOW,HIGH" if pair else key.name.upper())


def _limits(key: Option) -> str:
    """Return bounds and default as a sentence to append; "" without any."""
    default = f"default {key.default}" if isinstance(key.default, int | float | str) and key.default != "" else ""
    text = ", ".join(filter(None, (key.bounds.strip(), default)))
    return f" {text[0].upper()}{text[1:]}." if text else ""


def view_of(args: argparse.Namespace) -> str | tuple[float, ...]:
    """Return the direction of view."""
    return _parse_view(args.view or DIRECTIONS[0])


def look_of(args: argparse.Namespace, mesh: Mesh) -> Look:
    """Return the look that the options describe."""
    return with_options(args, Scene()).look(mesh)


def with_options(args: argparse.Namespace, scene: Scene, **keys: dict[str, Any]) -> Scene:
    """Return a scene whose keys are overridden by the options.

    Parameters
    ----------
    args : Namespace
        From a parser with the options of `add_arguments`.
    scene : Scene
    **keys : dict
        More keys, by table.

    Raises
    ------
    ParameterError
        If a value is invalid.
    """
    keys = {table: {**given, **keys.get(table, {})} for table, given in _given(args).items()}
    keys["cut"] |= cut_options.cut_keys(args)
    replaced: dict[str, Any] = {}  # whole tables
    if cut_options.cuts(args):
        replaced["cut"] = Cut()
    if args.metric:
        keys["colours"] = {"range": _range_of(args.metric), **keys["colours"]}
    if args.quality_range:
        replaced["show"] = Show(inverted=keys["show"]["quality"][0] <= 0)
    if args.view:
        replaced["camera"] = Camera(parallel=scene.camera.parallel, up=scene.camera.up)
    if args.no_edges:
        keys["lines"]["edges"] = 0.0
    if args.structure:
        replaced["structure"] = _parse_structure(args.structure)
    if args.flat:
        replaced["structure"] = replaced.get("structure", scene.structure).without("curved")
    scene = replace(scene, **replaced)
    return replace(scene, **{name: replace(getattr(scene, name), **table) for name, table in keys.items() if table})


def _given(args: argparse.Namespace) -> dict[str, dict[str, Any]]:
    """Return the values of the given options, by table and field."""
    tables: dict[str, dict[str, Any]] = {}
    for option in _key_options():
        table, value = tables.setdefault(option.table, {}), getattr(args, option.dest, None)
        if value is True:
            table[option.key.field] = not option.key.default
        elif value:
            parse = _NOTATIONS.get(option.full_name)
            table[option.key.field] = parse(value) if parse else _parse(value, option)
    return tables


def _parse(text: str, option: _KeyOption) -> Any:
    """Parse a value: text, numbers separated by commas, or a table as in TOML."""
    kinds = _kinds(option.key)
    if is_dataclass(kinds[0]):
        return parse_toml(f"value = {text}", option.name)["value"]
    if kinds == (float,):
        return numbers(text, 1, option.name)[0]
    texts = [kind for kind in kinds if isinstance(kind, type) and issubclass(kind, str)]
    if len(texts) == len(kinds):
        return text
    try:
        words = text.strip("[] ").split(",")
        values = tuple(int(word) if re.fullmatch(r"\s*-?\d+\s*", word) else float(word) for word in words)
    except ValueError:
        if texts:
            return text
        raise invalid_value(option.name, text, "numbers separated by commas") from None
    return values[0] if len(values) == 1 and {int, float} & set(kinds) else values


def _parse_view(text: str) -> str | tuple[float, ...]:
    return text if text in DIRECTIONS else direction(text, "--view")


def _parse_map(text: str) -> str:
    if text not in value_maps():
        raise invalid_value("--colour-map", text, f"one of {', '.join(value_maps())}")
    return text


def _parse_range(text: str) -> Range | tuple[float, ...]:
    return Range(text) if text in list(Range) else span(text, "--colour-range")


def _parse_structure(text: str) -> Structure:
    names, known = text.split(","), [layer.name for layer in ordered_layers() if layer.name != "original"]
    structure = Structure()
    for name in names:
        if name not in known:
            raise invalid_value("--structure", text, f"names among {', '.join(known)}, separated by commas")
        structure = structure.switched(name, True)
    return structure


def _range_of(metric: str) -> Range | tuple[float, float]:
    """Return the default colour range of a metric; inverted hexes, which are negative, have a separate colour."""
    low, high = colour_quantity(metric).full_range
    return (max(low, 0.0), high) if isfinite(low) and isfinite(high) else Range.FITTED


#: Parsers of keys whose options have another notation.
_NOTATIONS: dict[str, Callable[[str], Any]] = {
    "camera.from": _parse_view,
    "colours.map": _parse_map,
    "colours.range": _parse_range,
    "show.quality": lambda text: span(text, "--quality-range", finite=False),
}
