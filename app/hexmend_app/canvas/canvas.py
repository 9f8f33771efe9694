"""3D view as a widget with cut handles, captions and colour bar."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QCloseEvent, QColor, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.canvas.camera_view import CameraView
from hexmend_app.canvas.pointer import Pointer
from hexmend_app.canvas.shading_task import ShadingTask
from hexmend_app.canvas.view_captions import Caption, caption_height
from hexmend_app.canvas.view_frame import ViewFrame
from hexmend_app.canvas.view_legend import ViewLegend
from hexmend_app.picture.cut import Cut
from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.handles.box_widget import BoxWidget
from hexmend_app.scene.handles.handles import isolates_detail
from hexmend_app.scene.handles.plane_widget import PlaneWidget
from hexmend_app.scene.handles.sphere_widget import SphereWidget
from hexmend_app.scene.views.picking import Hit
from hexmend_app.state.mesh.inspection import NodeDetails
from hexmend_app.state.node_step import NodeStep
from hexmend_app.state.view.side_views import Wipe
from hexmend_app.theme.palette import BLUE, THEME
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change

if TYPE_CHECKING:
    from hexmend_app.picture import Camera, Page, Scene
    from hexmend_app.scene.page.page_renderer import PageRenderer

#: Width of the focus ring in pixels, and reasons of keyboard focus.
_RING = 2
#: Largest distance in pixels of a measured point from a node whose position it takes.
_SNAP = 10
_BY_KEYS = (Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason, Qt.FocusReason.ShortcutFocusReason)


class Canvas(CameraView):
    """Draws a mesh, and others next to it for comparison.

    Signals
    -------
    plane_dragged(Plane)
        The user moved or rotated the plane in the view.
    box_dragged(low, high)
        The user moved a side of the box in the view.
    measured(place)
        The user clicked a point while measuring; as (x, y, z).
    sphere_dragged(centre, radius)
        The user moved the sphere in the view, or changed its radius.
    clicked(hit)
        The user clicked on a hex, (hex, nearest node), or outside the mesh, None.
    hide_clicked(hex)
        The user clicked on a hex with Ctrl.
    menu_requested(hit, place)
        The user opened the context menu on a hex, (hex, nearest node), or outside the mesh, None; `place` is its
        position on the screen, a QPoint.
    """

    plane_dragged = Signal(object)
    box_dragged = Signal(object, object)
    sphere_dragged = Signal(object, float)
    clicked = Signal(object)
    measured = Signal(object)
    hide_clicked = Signal(int)
    menu_requested = Signal(object, QPoint)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.plane = PlaneWidget(self.panes.pane, self.plane_dragged.emit)
        self.box = BoxWidget(self.panes.pane, self.box_dragged.emit)
        self.sphere = SphereWidget(self.panes.pane, self.sphere_dragged.emit)
        self._handle_widgets = self.plane, self.box, self.sphere
        self.frame = ViewFrame(self.interactor)
        self._legend = ViewLegend(self.interactor, self.panes, self.frame)
        self.colour_bar = self._legend.colour_bar
        fill(QVBoxLayout(self), (self.frame, 1), margins=(_RING, _RING, _RING, _RING))
        self._handles = False, 0
        self._measuring = False
        self._selected: tuple[int | None, bool] = (None, False)
        self._connect_pointer()
        self.interactor.installEventFilter(self)
        self._ring = False
        self.shading_task = ShadingTask(self.panes, self)
        self.shading_task.finished.connect(self.interactor.update)
        self._closed = False
        on_theme_change(self, self._apply_theme)

    def _connect_pointer(self) -> None:
        pointer = Pointer(self.interactor)
        pointer.pressed.connect(self.camera_animation.begin_move)
        pointer.clicked.connect(self._click)
        pointer.hide_clicked.connect(self._dig)
        pointer.double_clicked.connect(self._rotate_about)
        pointer.menu_requested_at.connect(self._request_menu)

    def _apply_theme(self) -> None:
        if self._closed:
            return
        self.panes.set_dark(THEME.dark)
        for handles in self._handle_widgets:
            handles.set_dark(THEME.dark)
        self.changed()

    def draw(self, frame: Frame, live: bool = False) -> None:
        """Draw a frame in all views; `live` frames are followed by others, so no fine frame is drawn."""
        last = self.viewport.frame
        self.panes.draw(frame)
        if not frame.is_of(last):
            self._selected = None, False
            self.camera_animation.restart()
            for handles in self._handle_widgets:
                handles.set_bounds(self.viewport.bounds)
        self._place_handles()
        self._legend.show_colours()
        self.changed()
        if live:
            self._rest.stop()  # more changes follow

    def clear(self) -> None:
        """Draw no mesh."""
        self._selected = None, False
        self.panes.clear()
        self._place_handles()
        self._legend.show_colours()
        self.changed()

    def shows(self, mesh: Mesh) -> bool:
        """Return True if the hexes of a mesh are drawn; positions of nodes may differ."""
        frame = self.viewport.frame
        return frame is not None and frame.mesh.elements is mesh.elements

    def show_handles(self, handles: bool, at: int) -> None:
        """Show or hide the handles of the cut; a cut by planes has handles at the plane with index `at` alone."""
        self._handles = handles, at
        self._place_handles()
        self.draw_soon()

    def _place_handles(self) -> None:
        """Place the handles in the first view; they are hidden if it is not visible, or shows few isolated hexes."""
        handles, at = self._handles
        frame = self.viewport.frame
        cut = Cut() if frame is None else frame.look.cut
        shown = handles and cut.active and self.viewport in self.panes.visible and not isolates_detail(frame)
        plane = cut.planes[at] if at < len(cut.planes) else None
        self.plane.set(plane if cut.slab is None else cut.slab.middle, shown)
        self.box.set(cut.box, shown)
        self.sphere.set(cut.sphere, shown)

    # Selection

    def select(self, h: int | None, corners: bool, node: NodeDetails | None = None) -> None:
        """Mark a hex, optionally with the quality of its corners, and one of its nodes; None clears the marks."""
        if h is None and self._selected[0] is None:
            return
        self._selected = h, corners
        self.viewport.overlay_layers.selection.select(h, corners, node)
        self._select_in_other_views()
        self.changed()

    def _select_in_other_views(self) -> None:
        """Mark the same hex in the other views."""
        for view in self.panes.all[1:]:
            view.overlay_layers.selection.select(*self._selected, None)

    def show_node_step(self, step: NodeStep | None) -> None:
        """Draw the step of a node; None removes it."""
        if not self._closed:
            self.viewport.overlay_layers.selection.show_node_step(step)
            self.changed()

    def show_side_by_side(self, others: Sequence[tuple[Mesh, ElementQuality]], wipe: Wipe | None = None) -> None:
        """Show other meshes in views next to the first, or two views as a wipe.

        Parameters
        ----------
        others : sequence of (Mesh, ElementQuality)
        wipe : Wipe, optional
            None shows all views side by side.
        """
        self.panes.reserve_captions(round(caption_height(self) * self.devicePixelRatioF()))
        self.panes.show(others, wipe)
        self._select_in_other_views()
        self._place_handles()
        self.frame.set_wipe(wipe)
        self._legend.show_colours()
        self.changed()

    def show_captions(self, captions: Sequence[Caption], wipe: Wipe | None) -> None:
        """Show the captions of the views, with the numbers of hexes with special colours."""
        self.frame.set_captions(self._legend.with_counts(captions), wipe)

    def move_wipe(self, wipe: Wipe) -> None:
        """Move the edge of the wipe."""
        self.frame.set_wipe(wipe)
        self.panes.move_wipe(wipe)
        self.turning()
        self.draw_soon()

    def eventFilter(self, watched: QObject, event: Any) -> bool:
        """Redraw on changes of focus; open the context menu for the menu key."""
        kind = event.type()
        if kind == QEvent.Type.KeyPress and event.key() == Qt.Key.Key_Menu:
            self._request_menu(QPointF(self.interactor.rect().center()))
        if kind == QEvent.Type.Resize:
            self.frame.fit()
            self._legend.place()
        if kind in (QEvent.Type.FocusIn, QEvent.Type.FocusOut):
            # Show the ring for keyboard focus only.
            self._ring = kind == QEvent.Type.FocusIn and event.reason() in _BY_KEYS
            self.update()
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Align the view with device pixels; with a scale of 150 %, half a pixel would stay black otherwise."""
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
        """Draw a focus ring around the view."""
        if self._ring:
            painter = QPainter(self)
            painter.fillRect(self.interactor.geometry().adjusted(-_RING, -_RING, _RING, _RING), QColor(str(BLUE)))

    def _pick(self, place: QPointF) -> Hit | None:
        ratio = self.devicePixelRatioF()
        return self.panes.pick(place.x() * ratio, (self.interactor.height() - 1 - place.y()) * ratio)

    def _at(self, place: QPointF) -> tuple[int, int] | None:
        """Return the hex at a position of the view, and its nearest node."""
        hit = self._pick(place)
        return None if hit is None else (hit.hex, hit.node)

    def set_measuring(self, on: bool) -> None:
        """Let clicks pick points to measure, instead of selecting hexes."""
        self._measuring = on
        if on:
            self.interactor.setCursor(Qt.CursorShape.CrossCursor)
        else:
            self.interactor.unsetCursor()

    def _click(self, place: QPointF) -> None:
        if not self._measuring:
            self.clicked.emit(self._at(place))
        elif (hit := self._pick(place)) is not None:
            gap = float(np.linalg.norm(hit.place - hit.node_place))
            near = pixels(self.panes.pane.renderer, gap, hit.node_place) <= _SNAP * self.devicePixelRatioF()
            self.measured.emit(tuple((hit.node_place if near else hit.place).tolist()))

    def _dig(self, place: QPointF) -> None:
        hit = self._pick(place)
        if hit is not None:
            self.hide_clicked.emit(hit.hex)

    def _rotate_about(self, place: QPointF) -> None:
        """Make the picked point the centre of rotation."""
        hit = self._pick(place)
        if hit is not None:
            self.camera_animation.fly(self.panes.camera_controller.flight_around(hit.place))

    def _request_menu(self, place: QPointF) -> None:
        self.menu_requested.emit(self._at(place), self.interactor.mapToGlobal(place.toPoint()))

    @property
    def names(self) -> list[str]:
        """Names in the captions of several views."""
        return [caption.name for caption in self.frame.captions]

    def scene(self, page: Page, cameras: Mapping[str, Camera] | None = None) -> Scene:
        """Return the scene of the current views, with a page and named cameras."""
        from hexmend_app.scene.page.views_page import scene_of  # not needed for the view itself

        return scene_of(self.panes, self.names, page, cameras)

    def draw_page(self, scene: Scene) -> PageRenderer:
        """Draw the page of a scene of the current views."""
        from hexmend_app.scene.page.views_page import draw_views

        return draw_views(scene, self.panes, self.names)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Release graphics resources while the window still exists."""
        self._closed = True
        self.shading_task.close()
        for handles in self._handle_widgets:
            handles.close()
        self.release_graphics()
        super().closeEvent(event)

    @property
    def colouring(self) -> Colouring | None:
        """Colouring of the mesh; None if no mesh is drawn."""
        return self.viewport.colouring

    def draw_still(self) -> None:
        """Draw a fine frame, and start to compute its shading."""
        super().draw_still()
        self.shading_task.start()
