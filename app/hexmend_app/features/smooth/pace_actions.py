"""Actions that choose the pace at which the iterations of runs are shown."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.feature import Action
from hexmend_app.state.run.pace import Pace
from hexmend_app.state.run.run_controller import RunController
from hexmend_app.state.settings import settings
from hexmend_app.translation import tr

#: Texts and explanations of the paces.
_PACES = {
    Pace.FASTEST: ("&As fast as possible", "Show the newest iteration; short runs are over before the eye moves."),
    Pace.EASED: ("&Eased", "Let iterations merge into one another; short runs are shown for two to three seconds."),
    Pace.EVERY: ("E&very one", "Wait with the next iteration until the last one is shown: slower, none is skipped."),
}


def pace_actions(run: RunController) -> Sequence[Action]:
    """Return one action for each pace, of which the present one is checked; the choice is stored."""

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
