"""The limits of a run, and which iterate it keeps, as options, from the declarations of `StoppingCriteria`."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hexmend.run import StoppingCriteria


def add_limits(parser: argparse.ArgumentParser) -> None:
    """Declare an option for each, such as --max-iterations."""
    from hexmend.parameters import declared
    from hexmend.run import StoppingCriteria

    for limit in declared(StoppingCriteria):
        option = f"--{limit.name.replace('_', '-')}"
        if limit.type is bool:
            parser.add_argument(option, action="store_const", const="true", help=limit.help)
            continue
        if limit.choices is not None:
            parser.add_argument(option, choices=limit.choices, help=f"{limit.help} Default {limit.default}.")
            continue
        unit = f" in {limit.unit}" if limit.unit else ""
        parser.add_argument(option, metavar="X", help=f"{limit.help} Default {limit.default:g}{unit}.")


def limits(args: argparse.Namespace) -> StoppingCriteria:
    """The limits that were given, the others at their defaults."""
    from hexmend.parameters import from_strings
    from hexmend.run import StoppingCriteria

    return from_strings(StoppingCriteria, _given(args), owner="the run")


def given_limits(args: argparse.Namespace) -> dict[str, Any]:
    """The limits that were given, by name."""
    values = limits(args).values()
    return {name: values[name] for name in _given(args)}


def _given(args: argparse.Namespace) -> dict[str, str]:
    from hexmend.parameters import declared
    from hexmend.run import StoppingCriteria

    words = {limit.name: getattr(args, limit.name) for limit in declared(StoppingCriteria)}
    return {name: text for name, text in words.items() if text is not None}
