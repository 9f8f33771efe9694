"""What the actions do to the state: the one way from the user's wish to a change."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hexmend.doctor import AILMENTS, Finding, repair
from hexmend.fixing import with_region_free
from hexmend.io import left_out, write
from hexmend.io.session import SUFFIX
from hexmend.quality import summarise
from hexmend.recipe import Recipe, Stage
from hexmend.run.memory import Shortage, available, shortage
from hexmend.smoothers import Smoother
from hexmend_app.state import session_data
from hexmend_app.state.document import State

if TYPE_CHECKING:
    from hexmend_app.state.session import Session


class Commands:
    """Changes of document, view and run.

    Parameters
    ----------
    session : Session
        The window's state.

    Attributes
    ----------
    consent : callable
        Asked before a run for which memory will not suffice; the run begins only if it says so.
    """

    def __init__(self, session: Session):
        self._session = session
        self.consent: Callable[[Shortage], bool] = lambda short: False
        self.document, self.smoothing = session.document, session.smoothing

    def open(self, path: str | Path) -> None:
        """Open a mesh; a run under way ends first. What is open stays where the file cannot be read."""
        self.smoothing.end_now()
        self._session.opener.open(path)

    def save(self, path: str | Path) -> list[str]:
        """Write the mesh as it is now, or under a session's suffix all there is; what the file's format cannot hold.

        Raises
        ------
        HexmendError
            Where it cannot be written; the file that was there stays.
        """
        self._session.stepping.leave()
        if Path(path).suffix.lower() == SUFFIX:
            session_data.write(Path(path), self._session.given())
            self.document.saved(Path(path), changes=True)
            return []
        moment = self._session.timeline.moment
        if self.document.previews and self._session.editable:
            self.document.commit("go back" if moment is None else f"go to {moment.name}", self.document.now)
        write(path, self.document.now.mesh)
        self.document.saved(Path(path))
        return left_out(path, self.document.now.mesh)

    def run(self, stage: Stage) -> None:
        """Run a method on the mesh as it is now, unless another is being read, or memory will not suffice."""
        if self.may_run(stage.smoother):
            self._start(stage)

    def step(self, stage: Stage, iterations: int) -> None:
        """Make so many iterations: the next of a paused run, or the first of a new one."""
        if self.smoothing.busy:
            self.smoothing.step(iterations)
        elif self.may_run(stage.smoother):
            self._start(stage, iterations)

    def may_run(self, *works: Smoother | Recipe) -> bool:
        """Whether memory will suffice for methods that run one after another on the mesh as it is, or it is agreed."""
        if not self.document.is_open or self._session.opener.busy:
            return False
        free = available()
        short = [one for work in works if (one := shortage(work, self.document.now.mesh, free)) is not None]
        return not short or self.consent(max(short, key=lambda one: one.needed))

    def _start(self, stage: Stage, iterations: float = math.inf) -> None:
        if not self._session.opener.busy:
            self._session.stepping.leave()
            self._session.order.begun = stage
            self.smoothing.start(stage.smoother, stage.stop, iterations)

    def run_recipe(self, recipe: Recipe) -> None:
        """Run methods one after another on the mesh as it is now, unless another is being read."""
        if self.may_run(recipe):
            self._session.stepping.leave()
            self.smoothing.start(recipe, None)

    def branch(self, stage: Stage) -> None:
        """Run a method on the mesh as it is shown, whatever iteration that is; a run under way ends first."""
        if self.may_run(stage.smoother):
            self.smoothing.end_now()
            self._start(stage)

    def reset(self) -> None:
        """End a run and put the nodes back to where they were when the mesh was opened."""
        self.smoothing.end_now()
        self._session.stepping.leave()
        self.document.reset()

    def take(self, title: str, state: State) -> None:
        """Put the nodes to where they are in another state of the mesh, while the mesh may be changed.

        What is pinned and tagged stays so.
        """
        if self._session.editable:
            self._session.stepping.leave()
            mesh = self.document.now.mesh.with_points(state.mesh.points)
            self.document.commit(title, State(mesh, state.figures, summarise(mesh, state.figures)))

    def pin(self, nodes: int | np.ndarray, on: bool) -> None:
        """Keep a node or several where they are whatever smooths the mesh, or let them go, while it may be changed."""
        mesh = self.document.now.mesh
        pinned = np.zeros(mesh.n_nodes, bool) if mesh.pinned is None else mesh.pinned.copy()
        pinned[nodes] = on
        self._amend("pin" if on else "unpin", pinned=pinned)

    def free_only(self, hexes: Sequence[int], rings: int) -> None:
        """Pin all nodes but those of some hexes and of so many rings around them, while the mesh may be changed."""
        mesh = with_region_free(self.document.now.mesh, np.asarray(hexes, dtype=np.int64), rings)
        self._amend("free a region", pinned=mesh.pinned)

    def tag(self, name: str, hexes: Sequence[int], on: bool = True) -> None:
        """Add elements to a named group of the mesh, or take them out, while the mesh may be changed.

        A group of which nothing is left is no more.
        """
        sets = dict(self.document.now.mesh.hex_sets)
        before = np.asarray(sets.get(name, ()), dtype=np.int64)
        sets[name] = np.union1d(before, hexes) if on else np.setdiff1d(before, hexes)
        if not len(sets[name]):
            del sets[name]
        if len(before) != len(sets.get(name, ())):
            self._amend("tag" if on else "untag", hex_sets=sets)

    def remove_tag(self, name: str) -> None:
        """Let a named group of elements be no more, while the mesh may be changed."""
        self._amend("untag", hex_sets={k: v for k, v in self.document.now.mesh.hex_sets.items() if k != name})

    def rename_tag(self, name: str, other: str) -> None:
        """Call a group of elements otherwise, while the mesh may be changed."""
        sets = self.document.now.mesh.hex_sets
        self._amend("rename the tag", hex_sets={other if k == name else k: v for k, v in sets.items()})

    def _amend(self, title: str, **changes: object) -> None:
        """Change what the mesh carries beside its nodes' places."""
        if self._session.editable:
            self._session.stepping.leave()
            now = self.document.now
            mesh = now.mesh.replace(**changes)
            summary = summarise(mesh, now.figures) if "pinned" in changes else now.summary
            self.document.commit(title, State(mesh, now.figures, summary))

    def repair(self, kinds: Sequence[str] = ()) -> tuple[Finding, ...]:
        """Mend some kinds of trouble that the doctor finds, or all, while the mesh may be changed; what was mended."""
        if not self._session.editable:
            return ()
        self._session.stepping.leave()
        mesh, mended = repair(self.document.now.mesh, kinds)
        if mended:
            state = State.of(mesh.keeping_surface())
            self.document.commit("mend " + " and ".join(AILMENTS[one.kind].title.lower() for one in mended), state)
        return mended

    def undo(self) -> None:
        """Take back the last change, unless the mesh may not be changed."""
        if self._session.editable:
            self._session.stepping.leave()
            self.document.undo()

    def redo(self) -> None:
        """Do again what was taken back, unless the mesh may not be changed."""
        if self._session.editable:
            self._session.stepping.leave()
            self.document.redo()
