"""Feature with the About dialog."""

from __future__ import annotations

from collections.abc import Iterable

from hexmend import __version__
from hexmend_app.feature import Action, Feature
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import show_about


class FeatureHelp(Feature):
    """Shows the About dialog; the pages of keys and commands belong to the window, which knows all features."""

    def actions(self) -> Iterable[Action]:
        """Yield the action that shows the About dialog."""
        yield Action(
            id="about",
            text=tr("&About Hexmend"),
            menu="Help",
            section=1,
            help=tr("Show version, licence and sources."),
            needs_mesh=False,
            handle=lambda: show_about(self.host.dialog_parent, __version__),
        )
