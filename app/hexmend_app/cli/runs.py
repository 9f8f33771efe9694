"""The options of commands that run methods and draw what they made of a mesh."""

from __future__ import annotations

import argparse
from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

from hexmend.cli.arguments.options import add_settings
from hexmend_app.cli import looks

if TYPE_CHECKING:
    from hexmend.run import StoppingCriteria
    from hexmend.run.recipe import Recipe
    from hexmend.smoothers import Smoother
    from hexmend_app.state.scene import Scene

#: Stands for no method at all.
NONE = "none"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    looks.prepare(parser)
    parser.add_argument(
        "--methods",
        metavar="A,B,...",
        help="see `hexmend methods` (default: mend); a FILE.toml is a recipe; none runs nothing",
    )
    add_settings(parser)
    parser.add_argument(
        "--names", metavar="A,B,...", help="what captions call the mesh as given, and then what each method made of it"
    )
    parser.add_argument("--scene", metavar="FILE.toml", help="camera, cut and colours; other options go before it")
    looks.add_arguments(parser)


def methods(args: argparse.Namespace) -> tuple[list[Smoother | Recipe], StoppingCriteria]:
    """The methods, and the limits of each."""
    from hexmend.cli.arguments.run_arguments import given_limits, method_settings, stopping_criteria
    from hexmend.smoothers import DEFAULT_METHOD
    from hexmend.study.method_spec import parse_methods, split_names

    text = args.methods or DEFAULT_METHOD
    named = [] if text == NONE else split_names(text)
    settings = method_settings(args, [name for name in named if not name.endswith(".toml")])
    return parse_methods(named, settings, given_limits(args)), stopping_criteria(args)


def names(args: argparse.Namespace, count: int) -> list[str]:
    """What versions are called where that is said: those of the mesh as given and of so many methods."""
    from hexmend.terminal_text import printable
    from hexmend_app.cli.numbers import wrong

    given = [printable(name.strip()) for name in args.names.split(",")] if args.names else []
    if given and (len(given) != count + 1 or len(set(given)) != len(given) or not all(given)):
        raise wrong("--names", args.names, f"{count + 1} different names separated by commas, the mesh as given first")
    return given


def scene(args: argparse.Namespace) -> Scene:
    """The scene of the file, with what the options say in place of its own."""
    from hexmend_app.state.scene import Scene, read_scene

    found = read_scene(args.scene) if args.scene else Scene()
    if not args.scene and not args.metric:
        args.metric = found.colours.metric  # with the range that suits it
    return looks.with_options(args, found)


def words(args: argparse.Namespace, without: Collection[str] = ()) -> list[str]:
    """The options that were given, as the command line has them."""
    return _said({name: value for name, value in vars(args).items() if name not in without})


def method_words(args: argparse.Namespace) -> list[str]:
    """Those that say which methods are run, for commands that draw nothing; empty where none is."""
    from hexmend.parameters import declared
    from hexmend.run import StoppingCriteria
    from hexmend.smoothers import DEFAULT_METHOD

    if args.methods == NONE:
        return []
    known = ("set", "boundary", *(limit.name for limit in declared(StoppingCriteria)))
    return ["--methods", args.methods or DEFAULT_METHOD, *_said({name: getattr(args, name) for name in known})]


def _said(values: Mapping[str, object]) -> list[str]:
    found: list[str] = []
    for name, value in values.items():
        option = f"--{name.replace('_', '-')}"
        if value in (None, False, []):
            continue
        if value is True or value == "true":
            found.append(option)
            continue
        for one in value if isinstance(value, list) else [value]:
            found += [f"{option}={one}"] if one.startswith("-") else [option, one]
    return found
