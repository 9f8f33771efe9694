"""The runs of a report."""

import os
import signal

import pytest

from hexmend import METHODS, Run, StoppingCriteria, gallery
from hexmend.cli.process.interrupts import ExitAfterIteration
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
    done = run_methods(mesh, None, [METHODS["laplacian"](), METHODS["local-sd"]()], StoppingCriteria(max_iterations=3))
    assert done.interrupted
    assert [one.name for one in done.versions][1:] == ["laplacian"]


@pytest.mark.parametrize(("owner", "name"), [(case, "summarise"), (case, "advise"), (Run, "result")])
def test_a_second_signal_after_the_last_iteration_keeps_what_the_run_reached(monkeypatch, owner, name):
    whole, sent = getattr(owner, name), []
    methods = [METHODS["laplacian"](), METHODS["local-sd"]()]

    def interrupted(*args):
        if signals.asked and not sent:
            sent.append(signal.SIGINT)
            os.kill(os.getpid(), signal.SIGINT)
        return whole(*args)

    def ask(run):
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(owner, name, interrupted)
    mesh = gallery.make("cube", size=27, scramble=0.3)
    with ExitAfterIteration() as signals:
        done = run_methods(mesh, None, methods, StoppingCriteria(max_iterations=1), watch=ask)
    assert done.interrupted
    assert [one.name for one in done.versions] == ["initial", "laplacian"]
