"""The command that stands below a suggestion."""

import numpy as np

from hexmend.advice import Suggestion
from hexmend.cli.commands.smooth.suggested_command import suggested_command
from hexmend.iteration import StoppingCriteria
from hexmend.smoothers import METHODS


def test_a_command_says_what_a_suggestion_says():
    def command(*args, **more):
        return suggested_command(Suggestion("", "", "inverted", *args, **more), "a b.vtk", "out.vtk")

    assert command(METHODS["mend"](boundary="slide")) == "hexmend smooth out.vtk -o OUT --boundary slide"
    assert command(METHODS["getme"](), undo=True) == "hexmend smooth 'a b.vtk' -o OUT --method getme"
    assert command(METHODS["mend"](), StoppingCriteria(max_iterations=7, keep_last=True)).endswith(
        " OUT --max-iterations 7 --keep-last"
    )
    assert command(METHODS["mend"](), unpin=np.array([3])) == ""
