"""The import doctor: finds what is wrong with a mesh that can be read, explains it, and mends what can be mended.

>>> from hexmend.gallery import make
>>> examine(make("cube", size=8))
()
>>> sorted(PROBLEMS)[:3]
['coincident-nodes', 'crowded-faces', 'degenerate-hexes']
"""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.aliases import exports
from hexmend.doctor import cells, connection, nodes, winding  # noqa: F401  (they register themselves)
from hexmend.doctor.problem import PROBLEMS, Finding, Problem
from hexmend.mesh.mesh import Mesh

__all__ = ["PROBLEMS", "Finding", "Problem", "examine", "repair"]


def _ordered() -> list[Problem]:
    return sorted(PROBLEMS.values(), key=lambda one: one.rank)


def examine(mesh: Mesh, quick: bool = False) -> tuple[Finding, ...]:
    """All that is wrong with a mesh, in the order in which it should be mended.

    Parameters
    ----------
    mesh : Mesh
    quick : bool
        Only what takes a time linear in the size of the mesh, but for two sorts: nodes that hang, or lie beside others
        but not on them, are not looked for.
    """
    return tuple(found for one in _ordered() if (found := one.find(mesh, quick)) is not None)


def repair(mesh: Mesh, only: Sequence[str] = ()) -> tuple[Mesh, tuple[Finding, ...]]:
    """Mend what can be mended.

    Parameters
    ----------
    mesh : Mesh
    only : sequence of str
        Names of ailments; all if there is none.

    Returns
    -------
    mesh : Mesh
    mended : tuple of Finding
        What was found and mended, in that order.

    Raises
    ------
    ParameterError
        For an ailment that there is not.
    """
    mended = []
    for name in only:
        PROBLEMS[name]
    asked = [one for one in _ordered() if not only or one.name in only]
    changed = True
    while changed:  # merging nodes may make duplicates, and so on
        changed = False
        for one in asked:
            found = one.find(mesh)
            after = one.mend(mesh) if found is not None and found.mendable else mesh
            if after is not mesh:
                mesh, changed = after, True
                mended.append(found)
    return mesh, tuple(mended)


__getattr__ = exports(__name__)
