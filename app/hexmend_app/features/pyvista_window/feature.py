"""Windows of PyVista, with its widgets, that show the mesh as the view does."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING

from hexmend.errors import InstallationError, MeshError
from hexmend.terminal_text import install_hint
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from pyvistaqt import BackgroundPlotter


class FeaturePyvistaWindow(Feature):
    """Opens windows of PyVista.

    Attributes
    ----------
    plotters : list of BackgroundPlotter
        Plotters of the open windows.
    """

    def __init__(self, host: Host):
        super().__init__(host)
        self.plotters: list[BackgroundPlotter] = []

    def actions(self) -> Iterable[Action]:
        """Yield the action that opens a window."""
        yield Action(
            id="pyvista_window",
            text=tr("Open in PyVista window"),
            menu="View",
            help=tr("Show the mesh as it is coloured and cut now in a window of PyVista, with its widgets."),
            handle=lambda: self.try_and_report(tr("No PyVista window"), self.open),
            enabled=lambda: self.canvas is not None,
        )

    def open(self) -> None:
        """Open a window.

        Raises
        ------
        InstallationError
            If pyvistaqt is not installed.
        MeshError
            If the view shows no hexes.
        """
        left = self.canvas.viewport.remaining_after_cut()
        if left is not None and not left.any():
            raise MeshError("the view shows no hexes: move the cut or show all hexes")
        try:
            from hexmend_app.features.pyvista_window.shown_mesh import open_plotter
        except ImportError as error:
            raise InstallationError(f"pyvistaqt cannot be imported ({error}): {install_hint('app')}") from None
        plotter = open_plotter(f"{self.host.default_file_stem} – PyVista", self.canvas.viewport, self.canvas.up)
        self.plotters.append(plotter)
        plotter.app_window.signal_close.connect(partial(self.plotters.remove, plotter))

    def close(self) -> None:
        """Close the windows."""
        for plotter in list(self.plotters):
            plotter.app_window.close()
