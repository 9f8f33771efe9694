"""Soak test: hours of work in one window, with a check of its memory."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count, cycle, product
from pathlib import Path
from time import perf_counter

import numpy as np
from scipy.stats import theilslopes

from benchmarks.window.windows import draw, end_run, run_event_loop, save_and_wait, wait_until
from hexmend.run import StoppingCriteria
from hexmend.run.memory import resident_mb
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.picture import Cut, CutStyle
from hexmend_app.resources import demo_mesh
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window

#: Maximum number of iterations and seconds of a run.
_ITERATIONS, _SECONDS = 20, 5.0

#: Share of the rounds excluded as warm-up, in which caches fill and each method runs for the first time.
_WARM = 0.25

#: Accepted growth from the first to the last round after the warm-up, relative to the memory.
_GROWTH = 0.05


@dataclass(frozen=True)
class Sample:
    """Memory after a round.

    Parameters
    ----------
    round : int
    minutes : float
        Since the start of the first round.
    mesh, method : str
    mb : float
        Resident memory in MiB.
    """

    round: int
    minutes: float
    mesh: str
    method: str
    mb: float

    def __str__(self) -> str:
        return f"{self.minutes:6.1f} min  round {self.round:4}  {self.mb:7.0f} MB  {self.mesh}, {self.method}"


class Memory:
    """Memory after each round."""

    def __init__(self) -> None:
        self._samples: list[Sample] = []

    def add(self, sample: Sample) -> None:
        """Add a round."""
        self._samples.append(sample)

    @property
    def warm(self) -> list[Sample]:
        """Rounds after the warm-up."""
        return self._samples[int(_WARM * len(self._samples)) :]

    @property
    def growth(self) -> float:
        """Growth in MiB from the first to the last round after the warm-up, by the Theil-Sen slope."""
        warm = self.warm
        if len(warm) < 2:
            return 0.0
        return float(theilslopes([one.mb for one in warm]).slope * (len(warm) - 1))

    @property
    def level(self) -> bool:
        """True if the memory does not grow."""
        return self.growth <= _GROWTH * float(np.median([one.mb for one in self.warm]))

    @property
    def verdict(self) -> str:
        """Result as a sentence."""
        mb, state = [one.mb for one in self.warm], "is level" if self.level else "GROWS"
        return (
            f"{len(self._samples)} rounds in {self._samples[-1].minutes:.0f} min: memory {state}: "
            f"over the last {len(mb)} rounds {min(mb):.0f} to {max(mb):.0f} MB, median {np.median(mb):.0f}, "
            f"{self.growth:+.0f} MB from the first to the last of them"
        )


def run(meshes: Sequence[str], minutes: float) -> int:
    """Run rounds until the time is over, on the demo mesh by default; return 1 if the memory grows.

    Parameters
    ----------
    meshes : sequence of str
    minutes : float

    Returns
    -------
    int
    """
    memory = Memory()
    for sample in soak(meshes or [demo_mesh()], 60 * minutes):
        memory.add(sample)
        print(sample, flush=True)
    print(memory.verdict)
    return 0 if memory.level else 1


def soak(meshes: Sequence[str | Path], seconds: float, least: int = 4) -> Iterator[Sample]:
    """Work in one window, with every method on every mesh in turn.

    Parameters
    ----------
    meshes : sequence of path
    seconds : float
        Duration.
    least : int
        Minimum number of rounds.

    Yields
    ------
    Sample
        After each round.

    Raises
    ------
    HexmendError
        If a mesh cannot be opened, a method fails, or the window does not respond.
    """
    with tempfile.TemporaryDirectory() as folder, _window() as window:
        start = perf_counter()
        for number, (name, path) in zip(count(1), cycle(product(METHODS, meshes)), strict=False):
            _round(window, Path(path), name, Path(folder))
            minutes = (perf_counter() - start) / 60
            yield Sample(number, minutes, Path(path).name, name, resident_mb())
            if number >= least and 60 * minutes >= seconds:
                return


@contextmanager
def _window() -> Iterator[Window]:
    """Open a window with autosave that closes without asking."""
    application()
    window = Window()
    window.resize(1440, 900)
    window.show()
    window.build_features()
    window.build_canvas()
    window.features["session"].program_started()
    run_event_loop(0.5)
    try:
        yield window
    finally:
        end_run(window.session)
        if window.session.document.is_open:
            window.session.document.mark_saved(window.session.document.path)
        window.close()


def _round(window: Window, path: Path, method: str, folder: Path) -> None:
    """Open a mesh, change the view, smooth, browse the timeline, save mesh, session and picture, reopen the session."""
    session = window.session
    _open(window, path)
    _change_view(window)
    _smooth(window, method)
    _browse_timeline(window)
    save_and_wait(session, folder / "mesh.vtu")
    saved = folder / "round.hexmend"
    save_and_wait(session, saved)
    window.features["export"].picture(folder / "picture.png", (1280, 800))  # type: ignore[attr-defined]
    _open(window, saved)
    for change in (session.commands.undo, session.commands.redo, session.commands.reset):
        change()
        draw(window)
    session.document.mark_saved(saved)


def _open(window: Window, path: Path) -> None:
    opener, errors = window.session.opener, []
    connection = opener.failed.connect(lambda _, error: errors.append(error))
    window.session.commands.open(path)
    wait_until(lambda: not opener.busy)
    opener.failed.disconnect(connection)
    _raise(errors)
    draw(window)


def _change_view(window: Window) -> None:
    view, mesh = window.session.view, window.session.document.now.mesh
    middle = tuple(mesh.points.mean(axis=0))
    for cut in (Cut.at((1, 0, 0), middle), Cut.at((0, 1, 0), middle, CutStyle.SMOOTH), Cut()):
        view.set_cut(cut)
        draw(window)
    for metric in ("scaled-jacobian", "q"):
        view.colour_by(metric)
        draw(window)
    view.isolate((int(np.argmin(window.session.document.now.quality.q)),), rings=2)
    draw(window)
    view.end_isolation()


def _smooth(window: Window, method: str) -> None:
    smoothing, errors = window.session.run, list[Exception]()
    connection = smoothing.failed.connect(errors.append)
    window.session.commands.run(
        Stage(METHODS[method](), StoppingCriteria(max_iterations=_ITERATIONS, max_seconds=_SECONDS))
    )
    wait_until(lambda: not smoothing.busy)
    smoothing.failed.disconnect(connection)
    _raise(errors)


def _browse_timeline(window: Window) -> None:
    timeline = window.session.timeline
    if timeline.record is not None:
        for number in np.linspace(0, timeline.record.newest, 5).astype(int):
            timeline.go(timeline.record, int(number))
            draw(window)


def _raise(errors: Iterable[Exception]) -> None:
    for error in errors:
        raise error
