"""Repair of the mesh in the background."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.doctor import PROBLEMS, repair
from hexmend_app.state.mesh.document import Edit, State
from hexmend_app.state.tasks.mesh_change import BackgroundChange, MeshChange, prepared_state


class MeshRepairer(BackgroundChange):
    """Repairs the problems of the mesh; `ended` sends those that were repaired, as a tuple of Finding."""

    def start(self, kinds: Sequence[str] = ()) -> bool:
        """Start repairing some kinds of problem, or all; return False if the mesh is not editable."""
        kinds = tuple(kinds)
        return self._begin("repairing", lambda before, _: _repair(before, kinds))


def _repair(before: State, kinds: tuple[str, ...]) -> MeshChange:
    """Repair, measure and prepare a mesh."""
    mesh, repaired = repair(before.mesh, kinds)
    title = "repair " + " and ".join(PROBLEMS[finding.kind].title.lower() for finding in repaired)
    return MeshChange(repaired, title, prepared_state(mesh) if repaired else None, Edit(before, repair, (kinds,)))
