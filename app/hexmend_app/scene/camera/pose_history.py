"""History of camera poses, for going back and forward."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.state.view.camera_request import MOST


class PoseHistory:
    """Poses in which the camera came to rest, and the index of the present one.

    Parameters
    ----------
    most : int
        Of more, the oldest are forgotten.
    """

    def __init__(self, most: int = MOST):
        self._most = most
        self._all: list[CameraPose] = []
        self._at = -1

    def add(self, pose: CameraPose) -> bool:
        """Add a pose, which discards the poses ahead; return True if it differs from the present one."""
        if self._all and pose.looks_like(self._all[self._at]):
            return False
        self._all[self._at + 1 :] = [pose]
        del self._all[: -self._most]
        self._at = len(self._all) - 1
        return True

    def clear(self) -> None:
        """Clear the history."""
        self._all.clear()
        self._at = -1

    def around(self, pose: CameraPose) -> tuple[list[CameraPose], list[CameraPose]]:
        """Return the poses before and after, oldest first, if a pose were added."""
        if self._all and pose.looks_like(self._all[self._at]):
            return self._all[: self._at], self._all[self._at + 1 :]
        return self._all[: self._at + 1][1 - self._most :], []

    def restore(self, before: Sequence[CameraPose], pose: CameraPose, after: Sequence[CameraPose]) -> None:
        """Restore the present pose with those before and after it."""
        self._all, self._at = [*before, pose, *after], len(before)

    @property
    def can_go_back(self) -> bool:
        """True if there is a previous pose."""
        return self._at > 0

    @property
    def can_go_forward(self) -> bool:
        """True if there is a next pose."""
        return self._at < len(self._all) - 1

    def back(self) -> CameraPose | None:
        """Go to the previous pose and return it; None at the first."""
        return self._go(-1) if self.can_go_back else None

    def forward(self) -> CameraPose | None:
        """Go to the next pose and return it; None at the last."""
        return self._go(1) if self.can_go_forward else None

    def _go(self, path: int) -> CameraPose:
        self._at += path
        return self._all[self._at]
