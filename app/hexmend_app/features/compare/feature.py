"""Methods on the same mesh, compared: the lines between their results, the table, the views and the histogram."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from hexmend.report.comparison import FIGURES
from hexmend.run import Stop
from hexmend.smoothers import METHODS
from hexmend_app.canvas.captions import Caption
from hexmend_app.canvas.wipe_handle import STEP
from hexmend_app.features.compare.compare_panel import ComparePanel
from hexmend_app.features.compare.comparison_table import INITIAL, Entry
from hexmend_app.features.histogram.legend import KEPT_COLOURS
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.scene.palette import BLUE, Role
from hexmend_app.state.commands import Commands
from hexmend_app.state.comparison import Compared
from hexmend_app.state.document import State
from hexmend_app.state.kept import KeptMoments
from hexmend_app.state.session import Session
from hexmend_app.widgets.wording import counted

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas

#: Methods that are ticked at first: the plain one, the fast one, an optimiser of the thesis, and the default.
TICKED = ("laplacian", "getme", "local-sd", "mend")

#: What the view of the mesh as it is now is called, as in the histogram.
_NOW = "now"


class Comparing:
    """Has methods compared, and shows what they made of the mesh beside it.

    Parameters
    ----------
    session : Session
        The window's state.
    commands : Commands
    panel : ComparePanel
    smoothing_panel : SmoothingPanel
        Says with what values the methods run, and when they end.
    kept : KeptMoments
        The distributions of what is shown.
    """

    def __init__(
        self,
        session: Session,
        commands: Commands,
        panel: ComparePanel,
        smoothing_panel: SmoothingPanel,
        kept: KeptMoments,
    ):
        self._session, self._commands, self._panel = session, commands, panel
        self._comparison, self._views, self._kept = session.comparison, session.views, kept
        self._smoothing_panel = smoothing_panel
        self._canvas: Canvas | None = None
        self._comparison.changed.connect(self.refresh)
        self._comparison.progressed.connect(self._say)
        self._views.changed.connect(self._show_views)
        self._views.wiped.connect(self._show_wipe)
        self._kept.changed.connect(self._show_captions)
        panel.run_requested.connect(self._run)
        panel.cancel_requested.connect(self._comparison.cancel)
        panel.view_toggled.connect(self._toggle)
        panel.take_requested.connect(self._take)
        panel.wipe_toggled.connect(self._views.set_wiping)

    def set_canvas(self, canvas: Canvas) -> None:
        """Take the 3D view, which comes later than the rest."""
        self._canvas = canvas
        canvas.frame.view_closed.connect(self._close)
        canvas.frame.wipe_chosen.connect(self._views.choose_wiped)
        canvas.frame.wipe_moved.connect(self._views.move_wipe)

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        return {
            "compare": self._panel.run,
            "cancel_comparison": self._comparison.cancel,
            "iteration_beside": self._show_this_beside,
            "wipe": self._views.set_wiping,
            "wipe_left": lambda: self._move_wipe(-1),
            "wipe_right": lambda: self._move_wipe(1),
            "close_views": self._close_all,
        }

    def offered(self) -> dict[str, bool]:
        """Which of its actions can be done now."""
        several, wiping = bool(self._views.all), self._views.wipe is not None
        return {
            "compare": self._panel.can_run,
            "cancel_comparison": self._comparison.busy and not self._comparison.ending,
            "iteration_beside": not self._views.full,
            "wipe": several,
            "wipe_left": wiping,
            "wipe_right": wiping,
            "close_views": several,
        }

    def checked(self) -> dict[str, bool]:
        """Which of its actions are on."""
        return {"wipe": self._views.wipe is not None}

    # Views

    def show(self, name: str, state: State) -> None:
        """Show a state of the open mesh in a view under a caption, and its distribution in the histogram.

        A view of the same name shows this state from then on; where there is no room for another, nothing happens.
        """
        before = next((one.state for one in self._views.all if one.name == name), None)
        if before is not None or not self._views.full:
            if before is not None:
                self._forget(before)
            if self._kept.of(state) is None:
                self._kept.keep(name, state)
            self._views.show(name, state)

    def _show_this_beside(self) -> None:
        moment = self._session.timeline.moment
        self.show("the mesh as it was" if moment is None else moment.name, self._session.document.now)

    def _close(self, number: int) -> None:
        self._forget(self._views.all[number - 1].state)
        self._views.close(number)

    def _close_all(self) -> None:
        for shown in self._views.all:
            self._forget(shown.state)
        self._views.close_all()

    def _close_results(self) -> None:
        """Close the views of what is about to be forgotten; others, such as those of iterations, stay."""
        results = [self._comparison.initial, *(one.state for one in self._comparison.results)]
        for number, shown in reversed(list(enumerate(self._views.all, 1))):
            if any(shown.state is state for state in results):
                self._close(number)

    def _forget(self, state: State) -> None:
        kept = self._kept.of(state)
        if kept is not None:
            self._kept.remove(kept.slot)

    def _move_wipe(self, way: int) -> None:
        if self._views.wipe is not None:
            self._views.move_wipe(self._views.wipe.at + way * STEP)

    def _show_views(self) -> None:
        if self._canvas is not None:
            others = [(one.state.mesh, one.state.figures) for one in self._views.all]
            self._canvas.show_beside(others, self._views.wipe)
        self._show_captions()
        self.refresh()

    def _show_wipe(self) -> None:
        if self._canvas is not None:
            self._canvas.move_wipe(self._views.wipe)

    def _show_captions(self) -> None:
        if self._canvas is not None and self._session.document.is_open:
            shown = [(_NOW, self._session.document.now, BLUE)]
            shown += [(one.name, one.state, self._colour(one.state)) for one in self._views.all]
            captions = [
                Caption(name, state.summary.q_min, state.summary.inverted, colour) for name, state, colour in shown
            ]
            self._canvas.frame.set_captions(captions, self._views.wipe)

    def _colour(self, state: State) -> Role | None:
        kept = self._kept.of(state)
        return None if kept is None else KEPT_COLOURS[kept.slot]

    # The table

    def refresh(self) -> None:
        """Show what the methods reached, and what can be done with it."""
        comparison, views = self._comparison, self._views
        entries = [self._initial(), *(self._entry(name, comparison.of(name)) for name in METHODS)]
        self._panel.set_entries(entries, views.full, comparison.busy)
        self.enable()
        self._say()

    def enable(self) -> None:
        """Offer what can be done now."""
        session = self._session
        runnable = session.editable and not self._comparison.busy  # two at once would spoil each other's times
        self._panel.set_state(runnable, session.editable, bool(self._views.all), self._views.wipe is not None)

    def move(self) -> None:
        """Say what the view of the mesh as it is now shows."""
        if self._views.all:
            self._show_captions()

    def _initial(self) -> Entry:
        state = self._comparison.initial
        if state is None:
            return Entry(INITIAL, "The mesh as it is when the methods begin.", {})
        help = "The mesh as it was when the methods began."
        return Entry(INITIAL, help, state.summary.to_dict(), True, self._views.shows(state))

    def _entry(self, name: str, compared: Compared | None) -> Entry:
        method = METHODS[name]
        if compared is None:
            return Entry(name, f"<b>{method.title}</b><br>{method.help}", {})
        row, state = compared.row, compared.state
        figures = {one.key: getattr(row, one.key, None) for one in FIGURES}
        record = figures | (row.after.to_dict() if row.after else {})
        shown = state is not None and self._views.shows(state)
        return Entry(name, f"<b>{method.title}</b><br>{row.message}", record, state is not None, shown)

    def _say(self) -> None:
        comparison, done = self._comparison, len(self._comparison.results)
        at = comparison.progress
        if at is None:
            ended = f"{counted(done, 'method')} compared" if done else ""
            self._panel.set_status(f"{ended}, interrupted" if comparison.interrupted and ended else ended)
        elif comparison.ending:
            self._panel.set_status(f"Ending {at.method} after this iteration…")
        elif at.iteration:
            further = f"iteration {at.iteration:,}, {at.seconds:.1f} s"
            self._panel.set_status(f"{at.method} ({at.at + 1} of {at.of}): {further}")
        else:
            self._panel.set_status(f"{at.method} ({at.at + 1} of {at.of}): preparing…")

    # What the user asks for

    def _run(self, names: list[str]) -> None:
        self._smoothing_panel.request(lambda method, values, stop: self._start(names, Stop(**stop)))

    def _start(self, names: list[str], stop: Stop) -> None:
        if self._session.editable:
            self._close_results()
            values_of = self._smoothing_panel.values_of
            self._comparison.start([METHODS[name](**values_of(name)) for name in names], stop)

    def _state_of(self, name: str) -> State:
        return self._comparison.initial if name == INITIAL else self._comparison.of(name).state

    def _toggle(self, name: str, on: bool) -> None:
        state = self._state_of(name)
        if on:
            self.show(name, state)
        else:
            self._close(1 + next(k for k, one in enumerate(self._views.all) if one.state is state))

    def _take(self, name: str) -> None:
        title = "go back to the compared mesh" if name == INITIAL else METHODS[name].title
        self._commands.take(title, self._state_of(name))
