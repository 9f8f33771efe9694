"""Options of commands that run methods and draw the results."""

from __future__ import annotations

import argparse
from collections.abc import Collection

from hexmend.cli.arguments.options import add_settings
from hexmend.cli.arguments.run_arguments import given_limits, method_settings, stopping_criteria
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend.smoothers import DEFAULT_METHOD, Smoother
from hexmend.study.method_spec import parse_methods, split_names
from hexmend.terminal_text import printable
from hexmend_app.cli import scene_options
from hexmend_app.cli.numbers import invalid_value

#: The value of `--methods` that runs no method.
NONE = "none"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options to a parser."""
    text = "see `hexmend methods` (default: mend); a FILE.toml is a recipe; none runs nothing"
    parser.add_argument("--methods", metavar="A,B,...", help=text)
    add_settings(parser)
    text = "names of the original mesh and of each method's result in captions"
    parser.add_argument("--names", metavar="A,B,...", help=text)
    scene_options.add_arguments(parser)


def methods(args: argparse.Namespace) -> tuple[list[Smoother | Recipe], StoppingCriteria]:
    """Return the methods, and the limits of each run."""
    text = args.methods or DEFAULT_METHOD
    method_names = [] if text == NONE else split_names(text)
    settings = method_settings(args, [name for name in method_names if not name.endswith(".toml")])
    return parse_methods(method_names, settings, given_limits(args)), stopping_criteria(args)


def names(args: argparse.Namespace, count: int) -> list[str]:
    """Return the names of the original mesh and of the results of `count` methods; an empty list if none are given."""
    given = [printable(name.strip()) for name in args.names.split(",")] if args.names else []
    if given and (len(given) != count + 1 or len(set(given)) != len(given) or not all(given)):
        expected = f"{count + 1} different names separated by commas, the original mesh first"
        raise invalid_value("--names", args.names, expected)
    return given


def words(args: argparse.Namespace, without: Collection[str] = ()) -> list[str]:
    """Return the given options as words of a command line."""
    result: list[str] = []
    for name, value in vars(args).items():
        option = f"--{name.replace('_', '-')}"
        if name in without or value in (None, False, []):
            continue
        if value is True or value == "true":
            result.append(option)
            continue
        for text in value if isinstance(value, list) else [value]:
            result += [f"{option}={text}"] if text.startswith("-") else [option, text]
    return result
