"""The 3D view as a widget: the scene in a Qt interactor, what is dragged in it, the colour bar below."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QColor, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget
from pyvistaqt import QtInteractor

from hexmend.io.atomic import replacing
from hexmend.mesh import Mesh
from hexmend.node_step import NodeStep
from hexmend.quality import ElementQuality, Node
from hexmend_app.canvas.colour_bar import ColourBar
from hexmend_app.canvas.flying import Flying
from hexmend_app.canvas.lighting import Lighting
from hexmend_app.canvas.once_per_frame import OncePerFrame
from hexmend_app.canvas.view_frame import ViewFrame
from hexmend_app.canvas.view_keys import steer
from hexmend_app.scene.colours import Colouring
from hexmend_app.scene.cutting.box_widget import BoxWidget
from hexmend_app.scene.cutting.plane_widget import PlaneWidget
from hexmend_app.scene.export.views import picture_of
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.palette import BLUE, THEME
from hexmend_app.scene.panes import ROOM, Panes
from hexmend_app.state.clip import BoxClip, PlaneClip
from hexmend_app.state.views import Wipe
from hexmend_app.widgets.style import dress, explain

#: Milliseconds of rest after which the fine still frame is drawn.
_REST = 300

#: How far the mouse may stray in a click, in pixels; beyond it turns the mesh.
_STRAY = 3

#: Width in pixels of the ring that marks the focus, and how the focus comes by keys.
_RING = 2
_BY_KEYS = (Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason, Qt.FocusReason.ShortcutFocusReason)


class Canvas(QWidget):
    """Draws one mesh.

    Signals
    -------
    plane_dragged(ClipPlane)
        The user moved or turned the plane in the view.
    box_dragged(low, high)
        The user moved a side of the box in the view.
    clicked(hit)
        The user clicked on an element, (hex, its nearest node), or beside the mesh, None.
    dug(hex)
        The user clicked on an element with Ctrl held down.
    """

    plane_dragged = Signal(object)
    box_dragged = Signal(object, object)
    clicked = Signal(object)
    dug = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.interactor = QtInteractor(self, auto_update=False, shape=(1, ROOM), border=False)
        self.panes = Panes(self.interactor)
        self.viewport = self.panes.first
        self.plane = PlaneWidget(self.interactor, self.plane_dragged.emit)
        self.box = BoxWidget(self.interactor, self.box_dragged.emit)
        self.colour_bar = ColourBar()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(_RING, _RING, _RING, 0)
        layout.setSpacing(_RING)
        self.frame = ViewFrame(self.interactor)
        layout.addLayout(self.frame, 1)
        layout.addWidget(self.colour_bar)
        self._once = OncePerFrame(self.interactor)
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(_REST)
        self._rest.timeout.connect(self._draw_still)
        self.interactor.iren.add_observer("InteractionEvent", lambda *_: self._turning())
        self.interactor.iren.add_observer("EndInteractionEvent", lambda *_: self._rest.start())
        self._handled = False, 0
        self._chosen: tuple[int | None, bool] = (None, False)
        self._pressed: QPointF | None = None
        self.interactor.installEventFilter(self)
        explain(self.interactor, "3D view", "")
        self.interactor.setAccessibleDescription(
            "Arrow keys turn the mesh, Shift and arrow keys shift it, + and − zoom; F shows all of it."
        )
        self._ring = False
        self._flying = Flying(self)
        self._flying.moved.connect(self._on_flown)
        self.lighting = Lighting(self.panes, self)
        self.lighting.lit.connect(self.interactor.update)
        self._closed = False
        dress(self, self._wear_theme)

    def _wear_theme(self) -> None:
        if self._closed:
            return
        self.panes.set_dark(THEME.dark)
        self.plane.set_dark(THEME.dark)
        self.box.set_dark(THEME.dark)
        self._changed()

    def draw(self, frame: Frame, live: bool = False) -> None:
        """Draw a frame, in views beside the first too; `live` where more is to come, so that no fine frame is due."""
        last = self.viewport.frame
        self.panes.draw(frame)
        if not frame.is_of(last):
            self._chosen = None, False
            for handles in (self.plane, self.box):
                handles.set_bounds(self.viewport.bounds)
        self._place_handles()
        self._show_colours()
        self._changed()
        if live:
            self._rest.stop()

    def show_handles(self, handles: bool, at: int) -> None:
        """Let the user drag the box, or one of the planes, or nothing."""
        self._handled = handles, at
        self._place_handles()
        self._draw_soon()

    def _place_handles(self) -> None:
        """Put the handles into the first view; where a wipe leaves it out, there are none."""
        handles, at = self._handled
        clip = None if self.viewport.frame is None else self.viewport.frame.look.clip
        shown = handles and self.viewport in self.panes.seen
        self.plane.set(clip.planes[at] if isinstance(clip, PlaneClip) and at < len(clip.planes) else None, shown)
        self.box.set(clip if isinstance(clip, BoxClip) else None, shown)

    def fit(self) -> None:
        """Show what is shown as large as it can be."""
        self.panes.fit()
        self._changed()

    def look_along(self, direction: str) -> None:
        """Look along an axis: +x, -x, ..., iso."""
        self.panes.look_along(direction)
        self._changed()

    def set_parallel(self, on: bool) -> None:
        """Parallel projection or perspective."""
        self.viewport.eye.set_parallel(on)
        self._changed()

    def select(self, h: int | None, corners: bool, node: Node | None = None) -> None:
        """Mark an element, with its corners' qualities or without, and one of its nodes; None marks none."""
        self._chosen = h, corners
        self.viewport.chosen.select(h, corners, node)
        self._select_beside()
        self._changed()

    def _select_beside(self) -> None:
        """Mark the same element in the other views."""
        for view in self.panes.all[1:]:
            view.chosen.select(*self._chosen, None)

    def show_node_step(self, step: NodeStep | None) -> None:
        """Draw a node's step; None draws none."""
        if not self._closed:
            self.viewport.chosen.show_node_step(step)
            self._changed()

    def show_beside(self, others: Sequence[tuple[Mesh, ElementQuality]], wipe: Wipe | None = None) -> None:
        """Show other places of the same mesh's nodes in views beside the first, or two views over one another.

        Parameters
        ----------
        others : sequence of (Mesh, ElementQuality)
        wipe : Wipe, optional
            None shows all side by side.
        """
        self.panes.show(others, wipe)
        self._select_beside()
        self._place_handles()
        self.frame.set_wipe(wipe)
        self._show_colours()
        self._changed()

    def move_wipe(self, wipe: Wipe) -> None:
        """Bring the edge between two views elsewhere."""
        self.frame.set_wipe(wipe)
        self.panes.move_wipe(wipe)
        self._turning()
        self._draw_soon()

    def fly_to(self, *hexes: int) -> None:
        """Bring an element, or several together, before the camera."""
        self._flying.start(self.viewport.flight_to(*hexes))

    @property
    def flying(self) -> bool:
        """Whether the camera flies somewhere."""
        return self._flying.under_way

    def _on_flown(self) -> None:
        self.panes.reset_depth()
        self._turning()
        self._draw_soon()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Tell a click from a drag, which turns the mesh; turn it by keys too."""
        kind = event.type()
        if kind == QEvent.Type.KeyPress and event.key() not in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            if steer(self.viewport.camera, event):
                self._flying.stop()
                self.panes.reset_depth()
                self._changed()
            return True  # VTK has keys of its own, which would draw wires or end it
        if kind in (QEvent.Type.FocusIn, QEvent.Type.FocusOut):
            # Marked where keys brought it here: who clicks knows where.
            self._ring = kind == QEvent.Type.FocusIn and event.reason() in _BY_KEYS
            self.update()
        if kind == QEvent.Type.Resize:
            self.frame.fit()
        if kind == QEvent.Type.MouseButtonPress:
            self._flying.stop()
            self._pressed = event.position() if event.button() == Qt.MouseButton.LeftButton else None
        elif kind == QEvent.Type.MouseButtonRelease and self._pressed is not None:
            away = event.position() - self._pressed
            self._pressed = None
            if max(abs(away.x()), abs(away.y())) <= _STRAY:
                self._click(event.position(), bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier))
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Let the view begin and end at whole pixels of the screen: half of one, at a scale of 150 %, stays black."""
        super().resizeEvent(event)
        whole = Fraction(self.devicePixelRatioF()).limit_denominator(4).denominator
        at = self.mapTo(self.window(), QPoint(0, 0))
        right, bottom = at.x() + self.width() - _RING, at.y() + self.height() - self.colour_bar.height() - _RING
        layout = self.layout()
        layout.setContentsMargins(
            _RING + -(at.x() + _RING) % whole, _RING + -(at.y() + _RING) % whole, _RING + right % whole, 0
        )
        layout.setSpacing(_RING + bottom % whole)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Mark the focus by a ring around the view."""
        if self._ring:
            painter = QPainter(self)
            around = self.interactor.geometry().adjusted(-_RING, -_RING, _RING, _RING)
            painter.fillRect(around, QColor(str(BLUE)))

    def _click(self, at: QPointF, dig: bool) -> None:
        ratio = self.devicePixelRatioF()
        x, y = at.x() * ratio, (self.interactor.height() - 1 - at.y()) * ratio
        hit = self.panes.pick(x, y)
        if not dig:
            self.clicked.emit(None if hit is None else (hit.hex, hit.node))
        elif hit is not None:
            self.dug.emit(hit.hex)

    def save_picture(self, path: Path, size: tuple[int, int], transparent: bool) -> None:
        """Write what is seen, without the plane, as PNG of any size; of several views, all with their captions."""
        image = picture_of(self.panes, [caption.name for caption in self.frame.captions], size, transparent)
        with replacing(path) as temporary:
            image.save(temporary, format="PNG")

    def closeEvent(self, event: QCloseEvent) -> None:
        """Let go of the graphics while the window still exists."""
        self._closed = True
        self._rest.stop()
        self._flying.stop()
        self.lighting.shut_down()
        self.plane.close()
        self.box.close()
        self.interactor.close()
        super().closeEvent(event)

    @property
    def colouring(self) -> Colouring | None:
        """What the colours stand for; None while no mesh is drawn."""
        return self.viewport.colouring

    def _show_colours(self) -> None:
        colouring = self.colouring
        if colouring is not None:
            self.colour_bar.set_label(colouring.title)
            self.colour_bar.set_table(colouring.table)
            self.colour_bar.set_range(colouring.low, colouring.high)
            alone = len(self.panes.all) == 1  # of several, the captions say how many
            self.colour_bar.set_apart(
                [(name, n if alone else 0, colour) for name, n, colour in self.viewport.colours.apart]
            )

    def _changed(self) -> None:
        self.panes.moving()
        self._draw_soon()

    def _draw_soon(self) -> None:
        self._rest.start()
        self.interactor.update()

    def _turning(self) -> None:
        self._rest.stop()
        self.panes.turning()

    def rest(self) -> None:
        """Draw the fine frame soon: nothing moves for now."""
        self._rest.start()

    def _draw_still(self) -> None:
        self.panes.still()
        self.interactor.update()
        self.lighting.start()
