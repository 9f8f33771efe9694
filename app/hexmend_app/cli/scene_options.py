"""The options of commands that draw a mesh: one for each key of a scene's tables.

The key `margin` of the table `page` is the option `--page-margin`, unless `_SHORT` has a shorter name; help and bounds
are those of the table. Some keys have another notation here, and are left out by `_BY_HAND` or the command.
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
from hexmend.quality import METRICS
from hexmend.toml_text import parse_toml
from hexmend_app.cli import cut_options
from hexmend_app.cli.numbers import direction, numbers, span, wrong
from hexmend_app.codec.config_table import ConfigTable, Option, options_of
from hexmend_app.codec.docstring_help import helps
from hexmend_app.picture import Camera, Cut, Range, Scene, Show
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.camera import DIRECTIONS
from hexmend_app.picture.colour_map import value_maps
from hexmend_app.picture.layer_switch import ordered_layers

#: Tables of a scene that decide what is seen of the mesh, and those that decide how the page looks.
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

#: Keys that every command offers, whichever tables it names.
_ALWAYS = frozenset({"camera.from", "page.shading"})

_BY_HAND = frozenset(f"cut.{key}" for key in cut_options.KEYS)


class _KeyOption(NamedTuple):
    """The option of a key; a flag sets a switch to the opposite of its default."""

    table: str
    key: Option
    help: str

    @property
    def place(self) -> str:
        return f"{self.table}.{self.key.name}"

    @property
    def name(self) -> str:
        name = _SHORT.get(self.place, f"{self.table}-{self.key.name}".replace("_", "-"))
        return f"--no-{name}" if self.key.default is True else f"--{name}"

    @property
    def dest(self) -> str:
        return self.name[2:].replace("-", "_")


def _key_options() -> tuple[_KeyOption, ...]:
    """The options of all tables, in the order of the scene's."""
    tables = [one for one in options_of(Scene) if isinstance(one.kind, type) and issubclass(one.kind, ConfigTable)]
    return tuple(
        _KeyOption(table.name, key, helps(table.kind).get(key.field, ""))
        for table in tables
        for key in options_of(table.kind)
    )


def accept_negative_values(parser: argparse.ArgumentParser) -> None:
    """Take -x and -1,0,0 for values; argparse takes all words but numbers that begin with a minus for options."""
    parser._negative_number_matcher = re.compile(r"-(\d|\.\d|inf\b|[xyz]$)")


def add_arguments(
    parser: argparse.ArgumentParser, tables: Collection[str] = MESH_TABLES, without: Collection[str] = ()
) -> None:
    """Declare the options.

    Parameters
    ----------
    parser : ArgumentParser
    tables : collection of str
        Names of tables of the scene, each key of which is an option.
    without : collection of str
        Keys that are left out, such as "page.pixels".
    """
    cut_options.add_arguments(parser)
    for one in _key_options():
        if (one.table in tables or one.place in _ALWAYS) and one.place not in {*_BY_HAND, *without}:
            text = one.help.replace("%", "%%")
            if one.key.kind is bool:
                text = f"Turn off: {text[:1].lower()}{text[1:]}" if one.key.default else text
                parser.add_argument(one.name, action="store_true", help=text)
            else:
                parser.add_argument(one.name, metavar=_metavar(one.key), help=text + _limits(one.key))
    parser.add_argument(
        "--structure",
        metavar="NAMES",
        help="draw irregular, boundary or sharp edges, fixed, free or locked nodes, kinds of boundary nodes; several "
        "separated by commas",
    )
    parser.add_argument("--no-edges", action="store_true", help="leave the hexes' edges out")


def _kinds(key: Option) -> tuple[Any, ...]:
    """The types that a key's value can have, without None."""
    union = get_origin(key.kind) is UnionType
    return tuple(kind for kind in (get_args(key.kind) if union else (key.kind,)) if kind is not NoneType)


def _metavar(key: Option) -> str:
    kind = _kinds(key)[-1]
    pair = get_args(kind) == (float, float)
    return {int: "N", float: "X"}.get(kind, "LOW,HIGH" if pair else key.name.upper())


def _limits(key: Option) -> str:
    """Bounds and default as a sentence to append; "" for none."""
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
    """Return a scene in which the options take the place of its own keys.

    Parameters
    ----------
    args : Namespace
        As parsed by a parser with the options of `add_arguments`.
    scene : Scene
    **keys : dict
        Further keys by table.

    Raises
    ------
    ParameterError
        For a value that cannot be used.
    """
    keys = {table: {**given, **keys.get(table, {})} for table, given in _given(args).items()}
    keys["cut"] |= cut_options.cut_keys(args)
    fresh: dict[str, Any] = {}
    if args.clip or args.clip_box:
        fresh["cut"] = Cut()
    if args.metric:
        keys["colours"] = {"range": _range_of(args.metric), **keys["colours"]}
    if args.quality_range:
        fresh["show"] = Show(inverted=keys["show"]["quality"][0] <= 0)
    if args.view:
        fresh["camera"] = Camera(parallel=scene.camera.parallel, up=scene.camera.up)
    if args.no_edges:
        keys["lines"]["edges"] = 0.0
    if args.structure:
        fresh["structure"] = _parse_structure(args.structure)
    scene = replace(scene, **fresh)
    return replace(scene, **{name: replace(getattr(scene, name), **table) for name, table in keys.items() if table})


def _given(args: argparse.Namespace) -> dict[str, dict[str, Any]]:
    """Return the keys whose options are given, by table and field."""
    found: dict[str, dict[str, Any]] = {}
    for one in _key_options():
        table, value = found.setdefault(one.table, {}), getattr(args, one.dest, None)
        if value is True:
            table[one.key.field] = not one.key.default
        elif value:
            parse = _NOTATIONS.get(one.place)
            table[one.key.field] = parse(value) if parse else _parse(value, one)
    return found


def _parse(text: str, one: _KeyOption) -> Any:
    """Parse a value: numbers are separated by commas, and a table is written as in TOML."""
    kinds = _kinds(one.key)
    if is_dataclass(kinds[0]):
        return parse_toml(f"value = {text}", one.name)["value"]
    if kinds == (float,):
        return numbers(text, 1, one.name)[0]
    simple = [kind for kind in kinds if isinstance(kind, type) and issubclass(kind, str)]
    if len(simple) == len(kinds):
        return text
    try:
        words = text.strip("[] ").split(",")
        found = tuple(int(word) if re.fullmatch(r"\s*-?\d+\s*", word) else float(word) for word in words)
    except ValueError:
        if simple:
            return text
        raise wrong(one.name, text, "numbers separated by commas") from None
    return found[0] if len(found) == 1 and {int, float} & set(kinds) else found


def _parse_view(text: str) -> str | tuple[float, ...]:
    return text if text in DIRECTIONS else direction(text, "--view")


def _parse_map(text: str) -> str:
    if text not in value_maps():
        raise wrong("--colour-map", text, f"one of {', '.join(value_maps())}")
    return text


def _parse_range(text: str) -> Range | tuple[float, ...]:
    return Range(text) if text in list(Range) else span(text, "--colour-range")


def _parse_structure(text: str) -> Structure:
    names, known = text.split(","), [one.name for one in ordered_layers() if one.name != "original"]
    structure = Structure()
    for name in names:
        if name not in known:
            raise wrong("--structure", text, f"names among {', '.join(known)}, separated by commas")
        structure = structure.switched(name, True)
    return structure


def _range_of(metric: str) -> Range | tuple[float, float]:
    """Return the range of colours that suits a metric; inverted hexes, which are negative, have a separate colour."""
    low, high = METRICS[metric].full_range
    return (max(low, 0.0), high) if isfinite(low) and isfinite(high) else Range.FITTED


#: Parsers of keys whose options have another notation.
_NOTATIONS: dict[str, Callable[[str], Any]] = {
    "camera.from": _parse_view,
    "colours.map": _parse_map,
    "colours.range": _parse_range,
    "show.quality": lambda text: span(text, "--quality-range", finite=False),
}
