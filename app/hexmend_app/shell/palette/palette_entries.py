"""Entries of the command palette: commands, panels, methods, and metrics to colour by."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction, QKeySequence

from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.feature import Panel
from hexmend_app.picture.colours import colour_quantities
from hexmend_app.shell.palette.ranking import PaletteEntry
from hexmend_app.shell.panels.docks import Docks
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from hexmend_app.state.session.session import Session


def command_entries(actions: Mapping[str, QAction]) -> Iterator[PaletteEntry]:
    """Yield an entry for each action, except those that open a panel, which has an entry itself.

    Parameters
    ----------
    actions : mapping
        By id.
    """
    for id, action in actions.items():
        if id.startswith("panel_"):
            continue
        name = action.text().replace("&", "")
        if action.isCheckable():
            name = f"{name}: {tr('on') if action.isChecked() else tr('off')}"
        yield PaletteEntry(
            name=name,
            run=action.trigger,
            help=action.statusTip(),
            kind=action.property("within") or "",
            keys=action.shortcut().toString(QKeySequence.SequenceFormat.NativeText),
            icon=action.icon(),
            enabled=action.isEnabled(),
        )


def panel_entries(docks: Docks, panels: Iterable[Panel]) -> Iterator[PaletteEntry]:
    """Yield an entry that shows each panel."""
    for panel in panels:
        if panel.id in docks.ids():
            show = partial(docks.show_panel, panel.id)
            yield PaletteEntry(name=panel.title, run=show, help=panel.help, kind=tr("Panel"))


def choice_entries(session: Session) -> Iterator[PaletteEntry]:
    """Yield entries that choose a method, with its last parameters, or a metric to colour by."""
    run_setup = session.run_setup
    stop = run_setup.stage.stop if run_setup.stage is not None else StoppingCriteria()
    if session.editable:
        for method in METHODS.values():
            stage = Stage(run_setup.smoother_of(method.name), stop)
            choose = partial(run_setup.choose, stage, tr("{title} selected: press Run.", title=tr(method.title)))
            yield PaletteEntry(name=tr(method.title), run=choose, help=tr(method.help), kind=tr("Method"))
    if session.document.is_open:
        for metric in colour_quantities().values():
            colour = partial(session.view.colour_by, metric.name)
            yield PaletteEntry(name=tr(metric.title), run=colour, help=tr(metric.meaning), kind=tr("Colour by"))
