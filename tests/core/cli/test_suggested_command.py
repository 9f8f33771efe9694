"""The command that stands below a suggestion."""

import numpy as np

from hexmend import METHODS, MotionRules, StoppingCriteria
from hexmend.advice import Suggestion
from hexmend.cli.commands.smooth.suggested_command import RunOptions, suggested_command


def test_a_command_says_what_a_suggestion_says():
    def command(*args, **more):
        return suggested_command(Suggestion("", "", "inverted", *args, **more), "a b.vtk", "out.vtk")

    assert command(METHODS["mend"](boundary="slide")) == "hexmend smooth out.vtk -o OUT --boundary slide"
    assert command(METHODS["getme"](), undo=True) == "hexmend smooth 'a b.vtk' -o OUT --method getme"
    assert command(METHODS["mend"](), StoppingCriteria(max_iterations=7, keep_last=True)).endswith(
        " OUT --max-iterations 7 --keep-last"
    )
    assert command(METHODS["mend"](), unpin=np.array([3])) == ""


def test_a_command_keeps_the_options_of_the_run():
    def command(smoother, **more):
        options = RunOptions(MotionRules(fix="a"), as_is=True, surface="skin.stl", only="part", rings=3)
        return suggested_command(Suggestion("", "", "inverted", smoother, **more), "a.vtk", "out.vtk", options)

    slides = command(METHODS["mend"](boundary="slide"))
    assert slides.endswith(" --as-is --boundary slide --surface skin.stl --only part --rings 3 --fix a")
    assert command(METHODS["mend"]()) == "hexmend smooth out.vtk -o OUT --as-is --only part --rings 3 --fix a"
    assert command(METHODS["mend"](), widen=True).endswith("--rings 8 --fix a")
    assert command(METHODS["mend"](), rules=MotionRules()).endswith("--rings 3")
    assert command(METHODS["mend"](target="-x + 2")).partition("--as-is ")[2].startswith("'--target=-x + 2' ")
