"""The runs that a report tells of."""

from hexmend import gallery
from hexmend.run import Stop
from hexmend.smoothers import METHODS
from hexmend_app.report import case
from hexmend_app.report.case import run_methods


def test_an_interrupt_between_two_methods_keeps_those_that_are_done(monkeypatch):
    def run_one(mesh, smoother, stop, watch):
        if smoother.name == "local-sd":
            raise KeyboardInterrupt
        return whole(mesh, smoother, stop, watch)

    whole = case.run_one
    monkeypatch.setattr(case, "run_one", run_one)
    mesh = gallery.make("cube", size=27, scramble=0.3)
    done = run_methods(mesh, None, [METHODS["laplacian"](), METHODS["local-sd"]()], Stop(max_iterations=3))
    assert done.interrupted
    assert [one.name for one in done.versions][1:] == ["laplacian"]
