"""History of camera poses, for going back and forward."""

from __future__ import annotations

from hexmend_app.picture.camera import CameraPose

#: Maximum number of poses in the history, including the current one.
MAX_POSES = 50


class PoseHistory:
    """Poses in which the camera came to rest, and the index of the current pose.

    Parameters
    ----------
    most : int
        Maximum number of poses; the oldest are dropped.
    """

    def __init__(self, most: int = MAX_POSES):
        self._most = most
        self._poses: list[CameraPose] = []
        self._index = -1

    def add(self, pose: CameraPose) -> bool:
        """Add a pose and drop the poses after the current one; return True if it differs from the current pose."""
        if self._poses and pose.looks_like(self._poses[self._index]):
            return False
        self._poses[self._index + 1 :] = [pose]
        del self._poses[: -self._most]
        self._index = len(self._poses) - 1
        return True

    def clear(self) -> None:
        """Clear the history."""
        self._poses.clear()
        self._index = -1

    @property
    def can_go_back(self) -> bool:
        """True if there is a previous pose."""
        return self._index > 0

    @property
    def can_go_forward(self) -> bool:
        """True if there is a next pose."""
        return self._index < len(self._poses) - 1

    def back(self) -> CameraPose | None:
        """Go to the previous pose and return it; None at the first."""
        return self._go(-1) if self.can_go_back else None

    def forward(self) -> CameraPose | None:
        """Go to the next pose and return it; None at the last."""
        return self._go(1) if self.can_go_forward else None

    def _go(self, step: int) -> CameraPose:
        self._index += step
        return self._poses[self._index]
