"""The entries of the palette: commands, panels, their controls, methods, and metrics to colour by."""

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
from hexmend_app.shell.palette.ranking import PaletteEntry
from hexmend_app.shell.panels.docks import Docks
from hexmend_app.widgets.section import Section

if TYPE_CHECKING:
    from hexmend_app.state.session.session import Session

#: Controls of panels.
_CONTROLS = (QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit, QSlider)


def commands(actions: Mapping[str, QAction]) -> Iterator[PaletteEntry]:
    """The enabled actions, except those that only open a panel: panels have entries themselves.

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
        yield PaletteEntry(
            name=name,
            do=action.trigger,
            help=action.statusTip(),
            kind=action.property("within") or "",
            keys=action.shortcut().toString(QKeySequence.SequenceFormat.NativeText),
            icon=action.icon(),
        )


def panels_in(docks: Docks, panels: Iterable[Panel]) -> Iterator[PaletteEntry]:
    """Entries that show a panel, then entries that focus a control of a panel."""
    shown = [panel for panel in panels if panel.id in docks.ids()]
    for panel in shown:
        yield PaletteEntry(name=panel.title, do=partial(docks.show_panel, panel.id), help=panel.help, kind="Panel")
    for panel in shown:
        for control in _controls(panel.widget):
            yield PaletteEntry(
                name=control.accessibleName(),
                do=partial(_go_to, docks, panel, control),
                help=control.accessibleDescription(),
                kind=f"In {panel.title}",
            )


def choices(session: Session) -> Iterator[PaletteEntry]:
    """The methods, with their last parameters, and the metrics to colour by."""
    order, stop = (
        session.run_setup,
        session.run_setup.stage.stop if session.run_setup.stage is not None else StoppingCriteria(),
    )
    if session.editable:
        for method in METHODS.values():
            stage = Stage(order.smoother_of(method.name), stop)
            reason = f"Chosen: {method.title}. Run starts it."
            yield PaletteEntry(
                name=method.title, do=partial(order.choose, stage, reason), help=method.help, kind="Method"
            )
    if session.document.is_open:
        for metric in (*METRICS.values(), *DISPLACEMENT_QUANTITIES.values()):
            do = partial(session.view.colour_by, metric.name)
            yield PaletteEntry(name=metric.title, do=do, help=metric.meaning, kind="Colour by")


def _controls(panel: QWidget) -> Iterator[QWidget]:
    """The focusable controls of a panel, in collapsed sections too."""
    for widget in panel.findChildren(QWidget):
        within = isinstance(widget.parentWidget(), (QAbstractSpinBox, QComboBox))
        if not isinstance(widget, _CONTROLS) or within or isinstance(widget.parentWidget(), Section):
            continue
        if widget.accessibleName() and widget.isEnabledTo(panel) and _can_be_seen(widget, panel):
            yield widget


def _can_be_seen(widget: QWidget, panel: QWidget) -> bool:
    """Return True if nothing but collapsed sections hides a widget."""
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
