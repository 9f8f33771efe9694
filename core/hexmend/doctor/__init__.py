"""Import doctor: finds problems of a mesh that can be read, explains them, and repairs those that it can.

>>> from hexmend.gallery import make
>>> examine(make("cube", size=8))
()
>>> sorted(PROBLEMS)[:3]
['coincident-nodes', 'contradictory-faces', 'crowded-faces']
"""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.doctor import connection, mid_nodes, nodes  # noqa: F401  (they register themselves)
from hexmend.doctor.problem import PROBLEMS, Finding, Problem
from hexmend.mesh.mesh import Mesh

__all__ = ["PROBLEMS", "Finding", "Problem", "examine", "repair"]


def _ordered() -> list[Problem]:
    return sorted(PROBLEMS.values(), key=lambda problem: problem.rank)


def examine(mesh: Mesh, quick: bool = False) -> tuple[Finding, ...]:
    """Find the problems of a mesh, in the order in which they should be repaired.

    Parameters
    ----------
    mesh : Mesh
    quick : bool
        Leave out searches in space: hanging nodes, and coincident nodes that are not exactly in one place.

    Returns
    -------
    tuple of Finding
    """
    return tuple(found for problem in _ordered() if (found := problem.find(mesh, quick)) is not None)


def repair(mesh: Mesh, only: Sequence[str] = ()) -> tuple[Mesh, tuple[Finding, ...]]:
    """Repair the problems of a mesh that can be repaired.

    Parameters
    ----------
    mesh : Mesh
    only : sequence of str
        Names of problems; all by default.

    Returns
    -------
    mesh : Mesh
    mended : tuple of Finding
        Findings that were repaired, in that order.

    Raises
    ------
    ParameterError
        For an unknown problem.
    """
    mended = []
    for name in only:
        PROBLEMS[name]  # raises for an unknown one
    chosen = [problem for problem in _ordered() if not only or problem.name in only]
    changed = True
    while changed:  # one repair may cause another problem, as merged nodes make duplicate hexes
        changed = False
        for problem in chosen:
            found = problem.find(mesh)
            after = problem.mend(mesh) if found is not None and found.mendable else mesh
            if after is not mesh:
                mesh, changed = after, True
                mended.append(found)
    return mesh, tuple(mended)
