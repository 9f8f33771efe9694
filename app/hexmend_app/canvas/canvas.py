"""The 3D view as a widget: the scene in a Qt interactor, what is dragged in it, the colour bar over it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QCloseEvent, QColor, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend.mesh.mesh import Mesh
from hexmend.node_step import NodeStep
from hexmend.quality import ElementQuality, NodeDetails
from hexmend_app.canvas.camera_view import CameraView
from hexmend_app.canvas.captions import HEIGHT
from hexmend_app.canvas.colour_bar import ColourBar
from hexmend_app.canvas.lighting import Lighting
from hexmend_app.canvas.pointer import Pointer
from hexmend_app.canvas.view_frame import ViewFrame
from hexmend_app.scene.colours import Colouring
from hexmend_app.scene.cutting.box_widget import BoxWidget
from hexmend_app.scene.cutting.plane_widget import PlaneWidget
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.palette import BLUE, THEME
from hexmend_app.scene.picking import Hit
from hexmend_app.state.clip import BoxClip, PlaneClip
from hexmend_app.state.views import Wipe
from hexmend_app.widgets.overlay import Overlay
from hexmend_app.widgets.style import dress

if TYPE_CHECKING:
    from hexmend_app.scene.export.sheet import Sheet
    from hexmend_app.state.scene import Camera, Page, Scene

#: Width in pixels of the ring that marks the focus, and how the focus comes by keys.
_RING = 2
_BY_KEYS = (Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason, Qt.FocusReason.ShortcutFocusReason)


class Canvas(CameraView):
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
    menu_requested(hit, place)
        The user wants to know what can be done at an element, (hex, its nearest node), or beside the mesh, None; the
        place, a QPoint of the screen, is that of the menu.
    """

    plane_dragged = Signal(object)
    box_dragged = Signal(object, object)
    clicked = Signal(object)
    dug = Signal(int)
    menu_requested = Signal(object, QPoint)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.plane = PlaneWidget(self.panes.pane, self.plane_dragged.emit)
        self.box = BoxWidget(self.panes.pane, self.box_dragged.emit)
        self.colour_bar = ColourBar()
        self._bar_place = Overlay(self.colour_bar, self.interactor, (1.0, 0.5), key="colour_bar")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(_RING, _RING, _RING, _RING)
        self.frame = ViewFrame(self.interactor)
        for part, area in self.frame.clickable.items():
            self._bar_place.keep_off(part, area)
        layout.addLayout(self.frame, 1)
        self._handled = False, 0
        self._chosen: tuple[int | None, bool] = (None, False)
        self._watch_pointer()
        self.interactor.installEventFilter(self)
        self._ring = False
        self.lighting = Lighting(self.panes, self)
        self.lighting.lit.connect(self.interactor.update)
        self._closed = False
        dress(self, self._wear_theme)

    def _watch_pointer(self) -> None:
        pointer = Pointer(self.interactor)
        pointer.pressed.connect(self.travel.leave)
        pointer.clicked.connect(lambda place: self.clicked.emit(self._at(place)))
        pointer.dug.connect(self._dig)
        pointer.double_clicked.connect(self._turn_about)
        pointer.menu_wanted.connect(self._ask_for_menu)

    def _wear_theme(self) -> None:
        if self._closed:
            return
        self.panes.set_dark(THEME.dark)
        self.plane.set_dark(THEME.dark)
        self.box.set_dark(THEME.dark)
        self.changed()

    def draw(self, frame: Frame, live: bool = False) -> None:
        """Draw a frame, in views beside the first too; `live` where more is to come, so that no fine frame is due."""
        last = self.viewport.frame
        self.panes.draw(frame)
        if not frame.is_of(last):
            self._chosen = None, False
            self.travel.begin_anew()
            for handles in (self.plane, self.box):
                handles.set_bounds(self.viewport.bounds)
        self._place_handles()
        self._show_colours()
        self.changed()
        if live:
            self.stay_coarse()

    def clear(self) -> None:
        """Draw no mesh."""
        self._chosen = None, False
        self.panes.clear()
        self._place_handles()
        self._show_colours()
        self.changed()

    def shows(self, mesh: Mesh) -> bool:
        """Whether a mesh is drawn, its nodes here or elsewhere."""
        frame = self.viewport.frame
        return frame is not None and frame.mesh.hexes is mesh.hexes

    def show_handles(self, handles: bool, at: int) -> None:
        """Let the user drag the box, or one of the planes, or nothing."""
        self._handled = handles, at
        self._place_handles()
        self.draw_soon()

    def _place_handles(self) -> None:
        """Put the handles into the first view; where a wipe leaves it out, there are none."""
        handles, at = self._handled
        clip = None if self.viewport.frame is None else self.viewport.frame.look.clip
        shown = handles and self.viewport in self.panes.seen
        self.plane.set(clip.planes[at] if isinstance(clip, PlaneClip) and at < len(clip.planes) else None, shown)
        self.box.set(clip if isinstance(clip, BoxClip) else None, shown)

    # What is pointed at

    def select(self, h: int | None, corners: bool, node: NodeDetails | None = None) -> None:
        """Mark an element, with its corners' qualities or without, and one of its nodes; None marks none."""
        self._chosen = h, corners
        self.viewport.extras.selection.select(h, corners, node)
        self._select_beside()
        self.changed()

    def _select_beside(self) -> None:
        """Mark the same element in the other views."""
        for view in self.panes.all[1:]:
            view.extras.selection.select(*self._chosen, None)

    def show_node_step(self, step: NodeStep | None) -> None:
        """Draw a node's step; None draws none."""
        if not self._closed:
            self.viewport.extras.selection.show_node_step(step)
            self.changed()

    def show_beside(self, others: Sequence[tuple[Mesh, ElementQuality]], wipe: Wipe | None = None) -> None:
        """Show other places of the same mesh's nodes in views beside the first, or two views over one another.

        Parameters
        ----------
        others : sequence of (Mesh, ElementQuality)
        wipe : Wipe, optional
            None shows all side by side.
        """
        self.panes.leave_heads(round(HEIGHT * self.devicePixelRatioF()))
        self.panes.show(others, wipe)
        self._select_beside()
        self._place_handles()
        self.frame.set_wipe(wipe)
        self._show_colours()
        self.changed()

    def move_wipe(self, wipe: Wipe) -> None:
        """Bring the edge between two views elsewhere."""
        self.frame.set_wipe(wipe)
        self.panes.move_wipe(wipe)
        self.turning()
        self.draw_soon()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Mark the focus; give the keyboard's menu key its menu."""
        kind = event.type()
        if kind == QEvent.Type.KeyPress and event.key() == Qt.Key.Key_Menu:
            self._ask_for_menu(QPointF(self.interactor.rect().center()))
        if kind == QEvent.Type.Resize:
            self.frame.fit()
        if kind in (QEvent.Type.FocusIn, QEvent.Type.FocusOut):
            # Marked where keys brought it here: who clicks knows where.
            self._ring = kind == QEvent.Type.FocusIn and event.reason() in _BY_KEYS
            self.update()
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Let the view begin and end at whole pixels of the screen: half of one, at a scale of 150 %, stays black."""
        super().resizeEvent(event)
        whole = Fraction(self.devicePixelRatioF()).limit_denominator(4).denominator
        at = self.mapTo(self.window(), QPoint(0, 0))
        right, bottom = at.x() + self.width() - _RING, at.y() + self.height() - _RING
        self.layout().setContentsMargins(
            _RING + -(at.x() + _RING) % whole,
            _RING + -(at.y() + _RING) % whole,
            _RING + right % whole,
            _RING + bottom % whole,
        )

    def paintEvent(self, event: QPaintEvent) -> None:
        """Mark the focus by a ring around the view."""
        if self._ring:
            painter = QPainter(self)
            around = self.interactor.geometry().adjusted(-_RING, -_RING, _RING, _RING)
            painter.fillRect(around, QColor(str(BLUE)))

    def _pick(self, place: QPointF) -> Hit | None:
        ratio = self.devicePixelRatioF()
        return self.panes.pick(place.x() * ratio, (self.interactor.height() - 1 - place.y()) * ratio)

    def _at(self, place: QPointF) -> tuple[int, int] | None:
        """The hex at a place of the view, and its nearest node."""
        hit = self._pick(place)
        return None if hit is None else (hit.hex, hit.node)

    def _dig(self, place: QPointF) -> None:
        hit = self._pick(place)
        if hit is not None:
            self.dug.emit(hit.hex)

    def _turn_about(self, place: QPointF) -> None:
        """Let the camera turn about what is seen at a place."""
        hit = self._pick(place)
        if hit is not None:
            self.fly_around(hit.place)

    def _ask_for_menu(self, place: QPointF) -> None:
        self.menu_requested.emit(self._at(place), self.interactor.mapToGlobal(place.toPoint()))

    @property
    def names(self) -> list[str]:
        """What the captions of several views call them."""
        return [caption.name for caption in self.frame.captions]

    def scene(self, page: Page, cameras: Mapping[str, Camera] | None = None) -> Scene:
        """The scene that shows what is seen, without the plane, on a page, with cameras that it names."""
        from hexmend_app.scene.export.views import scene_of  # with what no view needs

        return scene_of(self.panes, self.names, page, cameras)

    def sheet(self, scene: Scene) -> Sheet:
        """A scene of what is seen, drawn."""
        from hexmend_app.scene.export.views import draw_views

        return draw_views(scene, self.panes, self.names)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Let go of the graphics while the window still exists."""
        self._closed = True
        self.lighting.shut_down()
        self.plane.close()
        self.box.close()
        self.let_go()
        super().closeEvent(event)

    @property
    def colouring(self) -> Colouring | None:
        """What the colours stand for; None while no mesh is drawn."""
        return self.viewport.colouring

    def _show_colours(self) -> None:
        colouring = self.colouring
        if colouring is None:
            self.colour_bar.hide()
        else:
            self.colour_bar.setVisible(not self.viewport.frame.look.neutral)
            self.colour_bar.set_label(colouring.title)
            self.colour_bar.set_table(colouring.table)
            self.colour_bar.set_range(colouring.low, colouring.high)
            alone = len(self.panes.all) == 1  # of several, the captions say how many
            self.colour_bar.set_apart(
                [(name, n if alone else 0, colour) for name, n, colour in self.viewport.colours.apart]
            )

    def draw_still(self) -> None:
        """Draw the fine frame, and work out what light reaches it."""
        super().draw_still()
        self.lighting.start()
