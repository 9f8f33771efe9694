"""States of the run: text, icon and help of the button that runs and pauses, and which commands are possible."""

from __future__ import annotations

from typing import NamedTuple


class RunState(NamedTuple):
    """Text, icon and help of the button that runs and pauses, and which commands are possible."""

    text: str
    icon: str
    help: str
    run: bool
    step: bool
    stop: bool
    reset: bool
    edit: bool


_RUN = "Smooth the mesh with this method until a stopping criterion is met."
STATES = {
    "idle": RunState("Run", "play", _RUN, run=True, step=True, stop=False, reset=False, edit=True),
    "preparing": RunState(
        "Preparing", "timer-sand", "Preparing the method.", run=False, step=False, stop=True, reset=False, edit=False
    ),
    "stopping": RunState(
        "Stopping", "timer-sand", "Stopping the run.", run=False, step=False, stop=False, reset=False, edit=False
    ),
    "running": RunState(
        "Pause", "pause", "Pause after this iteration.", run=True, step=False, stop=True, reset=False, edit=False
    ),
    "paused": RunState("Resume", "play", "Continue the run.", run=True, step=True, stop=True, reset=True, edit=True),
    "finished": RunState("Run", "play", _RUN, run=True, step=True, stop=False, reset=True, edit=True),
}
