"""Actions that choose the pace at which the iterations of runs are shown."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.feature import Action
from hexmend_app.state.run.run_controller import RunController
from hexmend_app.state.run.run_settings import Pace
from hexmend_app.state.settings import settings
from hexmend_app.translation import tr

#: Texts and explanations of the paces.
_PACES = {
    Pace.FASTEST: ("&As fast as possible", "Show the latest iteration; short runs end too quickly to be seen."),
    Pace.SLOW_START: ("&Slow start", "Show each of the first 25 iterations for at least a tenth of a second."),
    Pace.EVERY: ("E&very iteration", "Show every iteration; the run waits until it is drawn."),
}


def pace_actions(run: RunController) -> Sequence[Action]:
    """Return one action for each pace; the action of the present pace is checked, and the choice is stored."""

    def choose(pace: Pace, on: bool) -> None:
        if on and pace is not run.pace:
            run.set_pace(pace)
            settings.RUN_PACE.set(pace.value)

    return [
        Action(
            id=f"pace_{pace.value}",
            text=tr(text),
            menu="Smooth/Iterations in the view",
            help=tr(help),
            handle=lambda on, pace=pace: choose(pace, on),
            checked=lambda pace=pace: run.pace is pace,
            needs_mesh=False,
            exclusive=True,
        )
        for pace, (text, help) in _PACES.items()
    ]
