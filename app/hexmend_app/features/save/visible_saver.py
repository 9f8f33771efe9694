"""Saving of the hexes that the view shows, in the background."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject

from hexmend.doctor.removal import extract_hexes
from hexmend.errors import HexmendError
from hexmend.io import unsupported_data, write
from hexmend.mesh.mesh import Mesh
from hexmend_app.feature import Host
from hexmend_app.scene.views.viewport import Viewport
from hexmend_app.state.tasks.task import Task, drop
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_visible
from hexmend_app.widgets.wording import counted


class VisibleSaver(QObject):
    """Saves the hexes left by the cut, filters, isolation and hiding as a mesh.

    Parameters
    ----------
    host : Host
    """

    def __init__(self, host: Host):
        super().__init__()
        self._host = host
        self._task: Task | None = None

    @property
    def going_on(self) -> bool:
        """True while a file is being written."""
        return self._task is not None

    def close(self) -> None:
        """Stop waiting for the file that is being saved; an incomplete file does not replace an earlier file."""
        drop(self._task)
        self._task = None

    def ask(self, viewport: Viewport) -> None:
        """Ask for a path and save the hexes that a view shows."""
        source = self._host.session.document.path
        path = ask_visible(
            self._host.dialog_parent, self._host.default_file_stem, source.suffix if source is not None else ".vtu"
        )
        if path:
            self.save(Path(path), viewport)

    def save(self, path: Path, viewport: Viewport) -> None:
        """Save the hexes that a view shows; those that a smooth cut shows in part are included whole."""
        mesh, shown = self._host.session.document.now.mesh, viewport.remaining_after_cut()
        if shown is None:
            shown = np.ones(mesh.n_hexes, bool)
        if not shown.any():
            self._host.messages.show_error(tr("No hex is visible"), tr("Show the hexes that are to be saved first."))
            return
        self._host.busy.show_work("save_visible", tr("Saving {name}…", name=path.name))
        self._task = Task(f"saving {path.name}", lambda _: _write(path, mesh, shown))
        self._task.ended.connect(lambda: self._on_ended(path, int(shown.sum())))
        self._task.start()

    def _on_ended(self, path: Path, count: int) -> None:
        task, self._task = self._task, None
        self._host.busy.done("save_visible")
        if isinstance(task.error, HexmendError):
            self._host.messages.show_error(tr("Visible hexes not saved"), str(task.error))
            return
        if task.error is not None:
            raise task.error
        self._host.messages.show_info(tr("{count} saved to {path}", count=counted(count, "hex"), path=path))
        warn_of_omitted(self._host, path, task.result)


def _write(path: Path, mesh: Mesh, shown: np.ndarray) -> list[str]:
    """Write some hexes as a mesh, and return what the file does not store of them."""
    part = extract_hexes(mesh, shown)
    write(path, part)
    return unsupported_data(path, part)


def warn_of_omitted(host: Host, path: Path, omitted: Sequence[str]) -> None:
    """Name the data that a file does not store, if there are any."""
    if omitted:
        host.messages.show_warning(
            tr("Some data was not saved"),
            tr(
                "A {suffix} file cannot store {count}. Save as .vtu to store more.",
                suffix=path.suffix,
                count=", ".join(omitted),
            ),
        )
