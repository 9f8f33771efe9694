"""All that the palette finds in a window: commands, panels, what stands in them, methods, and metrics to colour by."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit, QSlider, QWidget

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.quality import METRICS
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.feature import Panel
from hexmend_app.shell.docks import Docks
from hexmend_app.shell.ranking import Entry
from hexmend_app.widgets.section import Section

if TYPE_CHECKING:
    from hexmend_app.state.session import Session

#: What the user sets or presses in a panel.
_CONTROLS = (QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit, QSlider)


def commands(actions: Mapping[str, QAction]) -> Iterator[Entry]:
    """The actions that can be done now, but for those that only open panels: these are offered as panels.

    Parameters
    ----------
    actions : mapping
        By id.
    """
    for id, action in actions.items():
        if not action.isEnabled() or id.startswith("panel_"):
            continue
        name = action.text().replace("&", "")
        if action.isCheckable():
            name = f"{name}: {'on' if action.isChecked() else 'off'}"
        yield Entry(
            name=name,
            do=action.trigger,
            help=action.statusTip(),
            kind=action.property("within") or "",
            keys=action.shortcut().toString(QKeySequence.SequenceFormat.NativeText),
            icon=action.icon(),
        )


def panels_in(docks: Docks, panels: Iterable[Panel]) -> Iterator[Entry]:
    """The panels, to be brought to the front, and then all that is set or pressed in them, to be gone to."""
    shown = [panel for panel in panels if panel.id in docks.ids()]
    for panel in shown:
        yield Entry(name=panel.title, do=partial(docks.show_panel, panel.id), help=panel.help, kind="Panel")
    for panel in shown:
        for control in _controls(panel.widget):
            yield Entry(
                name=control.accessibleName(),
                do=partial(_go_to, docks, panel, control),
                help=control.accessibleDescription(),
                kind=f"In {panel.title}",
            )


def choices(session: Session) -> Iterator[Entry]:
    """The methods, to be chosen for the next run with what was last set for them, and metrics to colour by."""
    order, stop = session.order, session.order.stage.stop if session.order.stage is not None else StoppingCriteria()
    if session.editable:
        for method in METHODS.values():
            stage = Stage(order.smoother_of(method.name), stop)
            why = f"Chosen: {method.title}. Run starts it."
            yield Entry(name=method.title, do=partial(order.choose, stage, why), help=method.help, kind="Method")
    if session.document.is_open:
        for metric in (*METRICS.values(), *DISPLACEMENT_QUANTITIES.values()):
            do = partial(session.view.colour_by, metric.name)
            yield Entry(name=metric.title, do=do, help=metric.meaning, kind="Colour by")


def _controls(panel: QWidget) -> Iterator[QWidget]:
    """What the focus can come to in a panel; in sections that are folded too."""
    for widget in panel.findChildren(QWidget):
        within = isinstance(widget.parentWidget(), (QAbstractSpinBox, QComboBox))
        if not isinstance(widget, _CONTROLS) or within or isinstance(widget.parentWidget(), Section):
            continue
        if widget.accessibleName() and widget.isEnabledTo(panel) and _can_be_seen(widget, panel):
            yield widget


def _can_be_seen(widget: QWidget, panel: QWidget) -> bool:
    """Whether nothing hides a widget but sections that are folded."""
    folded = [section.content() for section in _sections_around(widget)]
    while widget is not panel:
        if widget.isHidden() and widget not in folded:
            return False
        widget = widget.parentWidget()
    return True


def _sections_around(widget: QWidget) -> Iterator[Section]:
    around = widget.parentWidget()
    while around is not None:
        if isinstance(around, Section):
            yield around
        around = around.parentWidget()


def _go_to(docks: Docks, panel: Panel, control: QWidget) -> None:
    docks.show_panel(panel.id)
    for section in _sections_around(control):
        section.expand()
    control.setFocus(Qt.FocusReason.ShortcutFocusReason)
