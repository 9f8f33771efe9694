"""What is said before a run for which memory will not suffice, and the option that has it made all the same."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.mesh.mesh import Mesh
    from hexmend.run.recipe import Recipe
    from hexmend.smoothers import Smoother


def add_force(parser: argparse.ArgumentParser) -> None:
    """Declare the option."""
    parser.add_argument("--force", action="store_true", help="run though memory will probably not suffice")


def check_memory(args: argparse.Namespace, works: Iterable[Smoother | Recipe], mesh: Mesh | int, *ways: str) -> None:
    """Refuse runs for which memory will not suffice, or warn of them under --force.

    Parameters
    ----------
    args : argparse.Namespace
    works : iterable of Smoother or Recipe
        To be run one after another.
    mesh : Mesh or int
        Or how many hexes it will have.
    ways : str
        What else can be done with the command.

    Raises
    ------
    ShortageError
        Of the one that needs the most.
    """
    from hexmend.errors import ShortageError
    from hexmend.run.memory import available, shortage

    free = available()
    found = [one for one in (shortage(work, mesh, free) for work in works) if one is not None]
    if not found:
        return
    worst = max(found, key=lambda one: one.needed)
    if not args.force:
        raise ShortageError(f"{worst.problem} {worst.remedy(*ways, 'run it all the same (--force)')}")
    print(f"hexmend: warning: {worst.problem}", file=sys.stderr)
