"""Padding of the mesh in the background."""

from __future__ import annotations

from typing import NamedTuple

from hexmend.padding import pad
from hexmend_app.state.mesh.document import Edit, State
from hexmend_app.state.tasks.mesh_change import BackgroundChange, MeshChange, prepared_state
from hexmend_app.state.tasks.task import Task


class PaddingChoice(NamedTuple):
    """Options of a layer: the arguments of `hexmend.pad`.

    Parameters
    ----------
    name : str or None
        Set under whose faces the layer is laid.
    around : str or None
        Hexes around which it is laid, "locked" or "inverted"; without both it is under the whole boundary.
    rings : int
    thickness : float or None
        None for the default.
    """

    name: str | None = None
    around: str | None = None
    rings: int = 1
    thickness: float | None = None


class MeshPadder(BackgroundChange):
    """Lays a layer of hexes under the boundary and mends the mesh; `ended` sends a `hexmend.Padding`."""

    def start(self, choice: PaddingChoice) -> bool:
        """Start padding the mesh; return False if it is not editable."""
        return self._begin("padding", lambda before, task: _pad(before, choice, task))


def _pad(before: State, choice: PaddingChoice, task: Task) -> MeshChange:
    """Pad, mend, measure and prepare a mesh; mending ends when the task is cancelled."""
    padding = pad(before.mesh, *choice, progress=False, watch=lambda _: not task.cancelled.is_set())
    return MeshChange(padding, "pad", prepared_state(padding.mesh), Edit(before, pad, tuple(choice)))
