"""The limits of a run as options, from the declarations of `Stop`."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.run import Stop


def add_limits(parser: argparse.ArgumentParser) -> None:
    """Declare an option for each limit, such as --max-iterations."""
    from hexmend.parameters import declared
    from hexmend.run import Stop

    for limit in declared(Stop):
        unit = f" in {limit.unit}" if limit.unit else ""
        parser.add_argument(
            f"--{limit.name.replace('_', '-')}", metavar="X", help=f"{limit.help} Default {limit.default:g}{unit}."
        )


def limits(args: argparse.Namespace) -> Stop:
    """The limits that were given, the others at their defaults."""
    from hexmend.parameters import declared, from_strings
    from hexmend.run import Stop

    given = {limit.name: getattr(args, limit.name) for limit in declared(Stop)}
    return from_strings(Stop, {name: text for name, text in given.items() if text is not None}, owner="the run")
