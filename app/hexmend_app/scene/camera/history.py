"""The views that there have been, to go back to and forward again."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.scene.camera.pose import Pose
from hexmend_app.state.eye import MOST


class Poses:
    """Poses in which the camera has come to rest, and which of them it is in.

    Parameters
    ----------
    most : int
        Of more, the oldest are forgotten.
    """

    def __init__(self, most: int = MOST):
        self._most = most
        self._all: list[Pose] = []
        self._at = -1

    def add(self, pose: Pose) -> bool:
        """Take the pose that the camera has come to rest in; another ends what was ahead. Whether it is another."""
        if self._all and pose.looks_like(self._all[self._at]):
            return False
        self._all[self._at + 1 :] = [pose]
        del self._all[: -self._most]
        self._at = len(self._all) - 1
        return True

    def clear(self) -> None:
        """Forget all."""
        self._all.clear()
        self._at = -1

    def around(self, pose: Pose) -> tuple[list[Pose], list[Pose]]:
        """What there would be to go back to, and forward to, if the camera came to rest in a pose; the oldest first."""
        if self._all and pose.looks_like(self._all[self._at]):
            return self._all[: self._at], self._all[self._at + 1 :]
        return self._all[: self._at + 1][1 - self._most :], []

    def restore(self, before: Sequence[Pose], pose: Pose, after: Sequence[Pose]) -> None:
        """Be in a pose, with those before it and after it."""
        self._all, self._at = [*before, pose, *after], len(before)

    @property
    def can_go_back(self) -> bool:
        """Whether there is one before."""
        return self._at > 0

    @property
    def can_go_forward(self) -> bool:
        """Whether there is one after."""
        return self._at < len(self._all) - 1

    def back(self) -> Pose | None:
        """The pose before; None at the first."""
        return self._go(-1) if self.can_go_back else None

    def forward(self) -> Pose | None:
        """The pose after; None at the last."""
        return self._go(1) if self.can_go_forward else None

    def _go(self, way: int) -> Pose:
        self._at += way
        return self._all[self._at]
