"""A long stay in one window: whether its memory stays level while meshes are opened, smoothed, looked at and saved."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from itertools import count, cycle, product
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from hexmend.study.bench.section import resident_mb
from hexmend_app.bench.windows import draw, end_run, save_and_wait, turn, until

if TYPE_CHECKING:
    from hexmend_app.shell.window import Window

#: Of a run in a round: its most iterations, and its longest time in seconds.
_ITERATIONS, _SECONDS = 20, 5.0

#: Share of the rounds in which memory may still grow: caches fill, and every method has its first run.
_WARM = 0.25

#: Share of the memory held by which it may grow from the warm rounds to the last and be called level.
_GROWTH = 0.05


@dataclass(frozen=True)
class Sample:
    """The memory after a round.

    Parameters
    ----------
    round : int
    minutes : float
        Since the first began.
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
    """What the rounds have left, and whether that is level."""

    def __init__(self) -> None:
        self._samples: list[Sample] = []

    def add(self, sample: Sample) -> None:
        """Take another round."""
        self._samples.append(sample)

    @property
    def warm(self) -> list[Sample]:
        """The rounds that count."""
        return self._samples[int(_WARM * len(self._samples)) :]

    @property
    def growth(self) -> float:
        """MiB from the first warm round to the last, by the median of the slopes between all of them (Theil, Sen)."""
        from scipy.stats import theilslopes

        warm = self.warm
        if len(warm) < 2:
            return 0.0
        return float(theilslopes([one.mb for one in warm]).slope * (len(warm) - 1))

    @property
    def level(self) -> bool:
        """Whether the memory grows no further."""
        return self.growth <= _GROWTH * float(np.median([one.mb for one in self.warm]))

    @property
    def verdict(self) -> str:
        """All of it in a sentence."""
        mb, how = [one.mb for one in self.warm], "is level" if self.level else "GROWS"
        return (
            f"{len(self._samples)} rounds in {self._samples[-1].minutes:.0f} min: memory {how}: "
            f"over the last {len(mb)} rounds {min(mb):.0f} to {max(mb):.0f} MB, median {np.median(mb):.0f}, "
            f"{self.growth:+.0f} MB from the first of them to the last"
        )

    def given(self) -> dict[str, Any]:
        """The figures, for a file."""
        return {"growth_mb": self.growth, "level": self.level, "rounds": [asdict(one) for one in self._samples]}


def soak(meshes: Sequence[str | Path], seconds: float, least: int = 4) -> Iterator[Sample]:
    """Work in one window for so long, and at least so many rounds: every method on every mesh in turn.

    Raises
    ------
    HexmendError
        Where a mesh cannot be opened, a method fails, or nothing answers.
    """
    from hexmend.smoothers import METHODS

    with tempfile.TemporaryDirectory() as folder, _window() as window:
        began = perf_counter()
        for number, (name, path) in zip(count(1), cycle(product(METHODS, meshes)), strict=False):
            _round(window, Path(path), name, Path(folder))
            minutes = (perf_counter() - began) / 60
            yield Sample(number, minutes, Path(path).name, name, resident_mb())
            if number >= least and 60 * minutes >= seconds:
                return


@contextmanager
def _window() -> Iterator[Window]:
    """A window that is kept safe from a crash as any is; it closes without asking."""
    from hexmend_app.shell.program import application
    from hexmend_app.shell.window import Window

    application()
    window = Window()
    window.resize(1440, 900)
    window.show()
    window.furnish()
    window.build_canvas()
    window.features["session"].guard()
    turn(0.5)
    try:
        yield window
    finally:
        end_run(window.session)
        if window.session.document.is_open:
            window.session.document.saved(window.session.document.path)
        window.close()


def _round(window: Window, path: Path, method: str, folder: Path) -> None:
    """Open a mesh, look at it, smooth it, look back, save it as mesh, session and picture, and open the session."""
    session = window.session
    _open(window, path)
    _look_around(window)
    _smooth(window, method)
    _look_back(window)
    save_and_wait(session, folder / "mesh.vtu")
    saved = folder / "round.hexmend"
    save_and_wait(session, saved)
    window.features["save"].picture(folder / "picture.png", (1280, 800))
    _open(window, saved)
    for change in (session.commands.undo, session.commands.redo, session.commands.reset):
        change()
        draw(window)
    session.document.saved(saved)


def _open(window: Window, path: Path) -> None:
    opener, errors = window.session.opener, []
    told = opener.failed.connect(lambda _, error: errors.append(error))
    window.session.commands.open(path)
    until(lambda: not opener.busy)
    opener.failed.disconnect(told)
    _raise(errors)
    draw(window)


def _look_around(window: Window) -> None:
    from hexmend_app.state.clip import PlaneClip

    view, mesh = window.session.view, window.session.document.now.mesh
    middle = tuple(mesh.points.mean(axis=0))
    for clip in (PlaneClip.at((1, 0, 0), middle), PlaneClip.at((0, 1, 0), middle, crinkle=False), None):
        view.set_clip(clip)
        draw(window)
    for metric in ("scaled-jacobian", "q"):
        view.colour_by(metric)
        draw(window)
    view.isolate((int(np.argmin(window.session.document.now.figures.q)),), rings=2)
    draw(window)
    view.end_isolation()


def _smooth(window: Window, method: str) -> None:
    from hexmend.run import StoppingCriteria
    from hexmend.run.recipe import Stage
    from hexmend.smoothers import METHODS

    smoothing, errors = window.session.smoothing, []
    told = smoothing.failed.connect(errors.append)
    window.session.commands.run(
        Stage(METHODS[method](), StoppingCriteria(max_iterations=_ITERATIONS, max_seconds=_SECONDS))
    )
    until(lambda: not smoothing.busy)
    smoothing.failed.disconnect(told)
    _raise(errors)


def _look_back(window: Window) -> None:
    timeline = window.session.timeline
    if timeline.record is not None:
        for number in np.linspace(0, timeline.record.newest, 5).astype(int):
            timeline.go(timeline.record, int(number))
            draw(window)


def _raise(errors: Iterable[Exception]) -> None:
    for error in errors:
        raise error
