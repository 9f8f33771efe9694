"""Where the view is looked at from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from hexmend_app.feature import Action, Feature, Host

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas

_DIRECTIONS = (
    ("iso", "&Isometric", "0", "axis-arrow", "Iso"),
    ("+x", "Along &X", "1", "axis-x-arrow", "X"),
    ("+y", "Along &Y", "2", "axis-y-arrow", "Y"),
    ("+z", "Along &Z", "3", "axis-z-arrow", "Z"),
)


class FeatureCamera(Feature):
    """Brings the camera elsewhere."""

    order = 51

    def __init__(self, host: Host):
        super().__init__(host)
        self._canvas: Canvas | None = None
        self.session.selection.visited.connect(self._fly)

    def actions(self) -> Sequence[Action]:
        """Fit, the directions, and how depth is drawn."""
        ready = self._ready
        return (
            Action(
                id="fit",
                text="&Fit",
                menu="View",
                keys="F",
                icon="fit-to-page-outline",
                help="Show all that is shown of the mesh.",
                tool="Fit",
                handle=lambda: self._canvas.fit(),
                enabled=ready,
                in_view=True,
            ),
            *(
                Action(
                    id=f"view_{name.strip('+')}",
                    text=text,
                    menu="View/Camera",
                    keys=keys,
                    icon=icon,
                    help="Look from a corner." if name == "iso" else f"Look along the {tool} axis.",
                    tool=tool,
                    handle=lambda name=name: self._canvas.look_along(name),
                    enabled=ready,
                )
                for name, text, keys, icon, tool in _DIRECTIONS
            ),
            Action(
                id="parallel",
                text="&Parallel projection",
                menu="View/Camera",
                part=2,
                keys="P",
                help="Without perspective, for figures.",
                handle=lambda on: self._canvas.set_parallel(on),
                enabled=ready,
                checked=lambda: self._canvas is not None and bool(self._canvas.viewport.camera.GetParallelProjection()),
            ),
        )

    def canvas_ready(self, canvas: Canvas) -> None:
        """Take the 3D view."""
        self._canvas = canvas

    def _ready(self) -> bool:
        return self._canvas is not None

    def _fly(self, hexes: tuple[int, ...]) -> None:
        if self._canvas is not None:
            self._canvas.fly_to(*hexes)
