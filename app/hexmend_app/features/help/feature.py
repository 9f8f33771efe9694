"""About dialog; the pages of keys and commands, which know every feature, belong to the window."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend import __version__
from hexmend_app.feature import Action, Feature
from hexmend_app.widgets.dialogs.questions import show_about


class FeatureHelp(Feature):
    """Says what Hexmend is; the pages of keys and commands, which know every feature, are the window's."""

    order = 90

    def actions(self) -> Sequence[Action]:
        """About Hexmend."""
        return (
            Action(
                id="about",
                text="&About Hexmend",
                menu="Help",
                part=1,
                help="Version, licence and sources.",
                needs_mesh=False,
                handle=lambda: show_about(self.host.dialog_parent, __version__),
            ),
        )
