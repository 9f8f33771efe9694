"""Where the mesh is looked at from, as a value that outlives the 3D view."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from hexmend_app.state.scene import Camera
from hexmend_app.state.stand import Stand

#: Places that the camera can go back or forward to, with the one where it stands.
MOST = 50


@dataclass(frozen=True)
class Journey:
    """Where the camera has stood, and is to come back to.

    Parameters
    ----------
    before, after : tuple of Stand
        What there is to go back to, and forward to; the oldest first.
    left : Stand or None
        Where it stood before something was isolated that still is.
    """

    before: tuple[Stand, ...] = ()
    after: tuple[Stand, ...] = ()
    left: Stand | None = None

    def __post_init__(self) -> None:
        if len(self.before) + len(self.after) >= MOST:
            raise ValueError(f"the camera has stood in more than {MOST} places")


class Eye(QObject):
    """Knows where the camera stands, and where it is to stand.

    Attributes
    ----------
    now : callable
        Gives where the camera stands, a Stand, or None where there is no view; who has the camera sets it.
    travelled : callable
        Gives its Journey; who has the camera sets it.
    wanted : Camera or None
        From where it is to look as soon as there is a view of the open mesh.
    journey : Journey
        What is to lie behind it then, and before it.

    Signals
    -------
    called
        It is to stand elsewhere.
    """

    called = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.now: Callable[[], Stand | None] = lambda: None
        self.travelled: Callable[[], Journey] = Journey
        self.wanted: Camera | None = None
        self.journey = Journey()

    def given(self) -> Stand | None:
        """What a session keeps."""
        return (self.wanted and self.wanted.stand) or self.now()

    def take(self, stand: Stand | None, journey: Journey) -> None:
        """Have the camera stand where a session has kept it, with the way that it has come."""
        self.look_through(None if stand is None else Camera.at(stand), journey)

    def look_through(self, camera: Camera | None, journey: Journey | None = None) -> None:
        """Have the mesh looked at as a scene has it, with no way behind it where none is given."""
        self.wanted, self.journey = camera, journey or Journey()
        self.called.emit()
