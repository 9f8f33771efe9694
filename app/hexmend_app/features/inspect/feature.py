"""Looking at elements one by one: the lines between what is chosen, the lists that choose, and the view."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QDockWidget

from hexmend.quality import element, node
from hexmend_app.features.inspect.element_panel import ElementPanel
from hexmend_app.features.inspect.worst_list import WorstList
from hexmend_app.state.commands import Commands
from hexmend_app.state.session import Session

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas


class Inspecting:
    """Chooses elements and nodes, shows what there is to know of them, isolates and digs.

    Parameters
    ----------
    session : Session
        The window's state.
    commands : Commands
    worst_list, element_panel
        Its widgets.
    element_dock : QDockWidget
        Comes to the front when an element is chosen in the view.
    node_dock : QDockWidget
        Stays in front then, if it is: it shows what is chosen too.
    """

    def __init__(
        self,
        session: Session,
        commands: Commands,
        worst_list: WorstList,
        element_panel: ElementPanel,
        element_dock: QDockWidget,
        node_dock: QDockWidget,
    ):
        selection = self._selection = session.selection
        self._session, self._document, self._view = session, session.document, session.view
        self._worst_list = worst_list
        self._element_panel = element_panel
        self._element_dock, self._node_dock = element_dock, node_dock
        self._canvas: Canvas | None = None
        selection.changed.connect(self._show_selected)
        worst_list.chosen.connect(self._go_to_worst)
        element_panel.chosen.connect(self.go_to)
        element_panel.fly_requested.connect(lambda: self.go_to(selection.hex))
        element_panel.corners_toggled.connect(self._show_selected)
        element_panel.node_chosen.connect(lambda node: selection.choose(selection.hex, node))
        element_panel.pin_toggled.connect(lambda node, on: (commands.pin(node, on), self._show_element()))

    def set_canvas(self, canvas: Canvas) -> None:
        """Take the 3D view, which comes later than the rest."""
        self._canvas = canvas
        canvas.clicked.connect(self._on_clicked)
        canvas.dug.connect(self._dig)

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        return {
            "next_worst": self._worst_list.next,
            "previous_worst": self._worst_list.previous,
            "isolate": lambda: self._view.isolate((self._selection.hex,)),
            "dig": lambda: self._dig(self._selection.hex),
            "undig": self._view.undig_last,
            "back": self._back,
        }

    def offered(self) -> dict[str, bool]:
        """Which of its actions can be done now."""
        chosen, look = self._selection.hex is not None, self._view.look
        return {
            "isolate": chosen,
            "dig": chosen,
            "undig": bool(look.dug),
            "back": chosen or look.isolation is not None,
        }

    def refresh(self) -> None:
        """Show what is chosen, and the list of the worst, as they are now."""
        now = self._document.now
        self._worst_list.set_figures(now.mesh, now.figures)
        self._show_element()

    def _show_selected(self) -> None:
        self._worst_list.set_selected(self._selection.hex)
        self._show_element()

    def _show_element(self) -> None:
        chosen, mesh = self._selection, self._document.now.mesh
        if chosen.hex is None:
            self._element_panel.show_element(None)
        else:
            tags = [name for name, members in mesh.hex_sets.items() if (members == chosen.hex).any()]
            self._element_panel.show_element(element(mesh, chosen.hex), tags)
        at = None if chosen.node is None else node(mesh, chosen.node)
        self._element_panel.show_node(at, not self._session.editable)
        if self._canvas is not None:
            self._canvas.select(chosen.hex, self._element_panel.corners_in_view, at)

    def _on_clicked(self, hit: tuple[int, int] | None) -> None:
        self._selection.choose(*(hit or (None, None)))
        if hit is not None and not self._node_dock.widget().isVisible():
            self._element_dock.raise_()

    def go_to(self, h: int) -> None:
        """Choose an element and bring it before the camera."""
        self._selection.choose(h)
        if self._canvas is not None:
            self._canvas.fly_to(h)

    def _go_to_worst(self, h: int) -> None:
        if self._worst_list.isolates:
            self._view.isolate((h,))
        self.go_to(h)

    def _dig(self, h: int) -> None:
        if h == self._selection.hex:
            self._selection.choose(None)
        self._view.dig(h)

    def _back(self) -> None:
        """First show the rest again, then look at none."""
        if self._view.look.isolation is not None:
            self._view.end_isolation()
        else:
            self._selection.choose(None)
