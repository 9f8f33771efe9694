"""Checks before the work of a command begins: memory, and the files to be written."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend.errors import FileError, InsufficientMemoryError
from hexmend.io.storage.atomic import check_writable
from hexmend.parameters import AUTO
from hexmend.run import memory
from hexmend.run.recipe import Recipe
from hexmend.target import SPECIFICATIONS, make_target

if TYPE_CHECKING:
    from hexmend.mesh.mesh import Mesh
    from hexmend.smoothers import Smoother


def check_memory(
    args: argparse.Namespace, methods: Iterable[Smoother | Recipe], mesh: Mesh | int, *remedies: str
) -> None:
    """Refuse runs for which memory will not suffice; with --force only warn of them.

    Parameters
    ----------
    args : argparse.Namespace
        With `force`.
    methods : iterable of Smoother or Recipe
        They are run one after another.
    mesh : Mesh or int
        The mesh, or the number of its hexes.
    remedies : str
        Other options of the command that need less memory.

    Raises
    ------
    InsufficientMemoryError
        For the method that needs the most.
    """
    free = memory.available()
    shortages = [one for one in (memory.shortage(method, mesh, free) for method in methods) if one is not None]
    if not shortages:
        return
    worst = max(shortages, key=lambda one: one.needed)
    if not args.force:
        raise InsufficientMemoryError(f"{worst.problem} {worst.remedy(*remedies, 'run it anyway (--force)')}")
    print(f"hexmend: warning: {worst.problem}", file=sys.stderr)


def check_element_targets(methods: Iterable[Smoother | Recipe], mesh: Mesh) -> None:
    """Check that the mesh can have the targets of all methods that name data or a formula.

    Parameters
    ----------
    methods : iterable of Smoother or Recipe
    mesh : Mesh

    Raises
    ------
    ParameterError
        For the first target that the mesh cannot have.
    """
    smoothers: list[Smoother] = []
    for method in methods:
        smoothers += [stage.smoother for stage in method.stages] if isinstance(method, Recipe) else [method]
    for target in dict.fromkeys(getattr(one, "target", AUTO) for one in smoothers):
        if target not in (AUTO, *SPECIFICATIONS):
            make_target(mesh, target)


def check_targets(source: str, output: str, *targets: str | None) -> None:
    """Check that reports can be written, and that none of them would replace the mesh.

    Parameters
    ----------
    source, output : str
        The mesh file that is read and the one that is written; they may be the same.
    targets : str or None
        Other files that are written.

    Raises
    ------
    FileError
        For the first target that cannot be written or is another of the files.
    """
    taken = {os.path.realpath(source), os.path.realpath(output)}
    for path in (Path(target) for target in targets if target is not None):
        if os.path.realpath(path) in taken:
            raise FileError(path, "is the mesh, or another file to be written", "Choose another name for it.")
        check_writable(path)
        taken.add(os.path.realpath(path))
