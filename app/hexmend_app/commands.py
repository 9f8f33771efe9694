"""What the actions do to the state: the one way from the user's wish to a change."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io import write
from hexmend.parameters import declared
from hexmend.quality import summarise
from hexmend.run import Stop
from hexmend.smoothers import METHODS
from hexmend_app.state.document import Document, State
from hexmend_app.state.opener import Opener
from hexmend_app.state.run import Smoothing
from hexmend_app.state.view import View


class Commands:
    """Changes of document, view and run.

    Parameters
    ----------
    document, view, smoothing, opener
        The window's state.
    """

    def __init__(self, document: Document, view: View, smoothing: Smoothing, opener: Opener):
        self.document = document
        self.view = view
        self.smoothing = smoothing
        self.opener = opener

    def open(self, path: str | Path) -> None:
        """Open a mesh; a run under way ends first. What is open stays where the file cannot be read."""
        self.opener.open(path)

    def save(self, path: str | Path) -> None:
        """Write the mesh as it is now.

        Raises
        ------
        HexmendError
            Where it cannot be written; the file that was there stays.
        """
        write(path, self.document.now.mesh)
        self.document.saved(Path(path))

    def run(self, method: str, values: dict, stop: dict) -> None:
        """Run a method on the mesh as it is now."""
        self.smoothing.start(METHODS[method](**values), Stop(**stop))

    def step(self, method: str, values: dict, stop: dict) -> None:
        """Make one iteration: the next of a paused run, or the first of a new one."""
        if self.smoothing.busy:
            self.smoothing.step()
        else:
            self.smoothing.start(METHODS[method](**values), Stop(**stop), iterations=1)

    def reset(self) -> None:
        """End a run and put the nodes back to where they were when the mesh was opened."""
        self.smoothing.end_now()
        self.document.reset()

    def pin(self, node: int, on: bool) -> None:
        """Keep a node where it is whatever smooths the mesh, or let it go; not while a run is under way."""
        if self.smoothing.busy:
            return
        now = self.document.now
        pinned = np.zeros(now.mesh.n_nodes, bool) if now.mesh.pinned is None else now.mesh.pinned.copy()
        pinned[node] = on
        mesh = now.mesh.replace(pinned=pinned)
        self.document.commit("pin" if on else "unpin", State(mesh, now.figures, summarise(mesh, now.figures)))

    def undo(self) -> None:
        """Take back the last change, unless a run is under way."""
        if not self.smoothing.busy:
            self.document.undo()

    def redo(self) -> None:
        """Do again what was taken back, unless a run is under way."""
        if not self.smoothing.busy:
            self.document.redo()


def methods_offered() -> list[tuple]:
    """Every registered method as the smoothing panel takes it."""
    return [(one.name, one.title, one.help, one.source, declared(one)) for one in METHODS.values()]
