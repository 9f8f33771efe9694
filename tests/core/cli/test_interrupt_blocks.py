"""The blocks that answer signals, within this process."""

import os
import signal
import time

import pytest

from hexmend.cli.process.interrupts import ENDING, CleanExit, ExitAfterIteration, FinishWriting
from hexmend.signal_guard import uninterrupted
from tests.patience import PATIENCE
from tests.programs import run_python

#: A program that gets a signal after each handler that a block restores, and rests then.
RESTORES = """
import os, signal, sys, time
from hexmend.cli.process import interrupts
interrupts.exit_on_signals()
whole = signal.signal
def restore(number, handler):
    before = whole(number, handler)
    os.kill(os.getpid(), signal.SIGINT)
    return before
with interrupts.CleanExit(completes=sys.argv[1] == "completes"):
    signal.signal = restore
time.sleep(1)
sys.exit(7)
"""


@pytest.fixture(autouse=True)
def handlers():
    """The handlers of signals are, after the test, those of before it."""
    before = [signal.getsignal(number) for number in ENDING]
    yield
    for number, handler in zip(ENDING, before, strict=True):
        assert signal.getsignal(number) == handler


def send(number=signal.SIGINT):
    os.kill(os.getpid(), number)


def rest(seconds):
    """Wait in short steps, between which signals are answered wherever they come from."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        time.sleep(0.005)


def test_a_signal_is_raised_when_a_function_returns_that_had_to_be_finished():
    finished = []

    @uninterrupted
    def work():
        send()
        rest(0.1)
        finished.append(True)

    with pytest.raises(KeyboardInterrupt), CleanExit():
        while len(finished) < 100:
            work()
    assert len(finished) == 1


def test_a_second_signal_ends_a_block_that_writes(capfd):
    with pytest.raises(KeyboardInterrupt), FinishWriting():
        send()
        assert capfd.readouterr().err.startswith("Writing the result; a second Ctrl-C ends at once")
        send()
        rest(PATIENCE / 1000)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_result_is_written_to_its_end_after_one_signal(number):
    with FinishWriting() as writing:
        send(number)
    assert writing.asked


def test_a_block_has_the_status_of_its_first_signal():
    for number, other in ((signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, signal.SIGINT)):
        with ExitAfterIteration() as signals:
            assert not signals.asked
            send(number)
            assert signals.asked
            with pytest.raises(KeyboardInterrupt):
                send(other)
        assert signals.status == 128 + number


def test_a_signal_that_waits_at_the_end_of_a_block_comes_to_the_one_around_it():
    @uninterrupted
    def work():
        with CleanExit():
            send()

    with pytest.raises(KeyboardInterrupt), CleanExit():
        work()


@pytest.mark.slow
@pytest.mark.parametrize(("block", "status", "said"), [("completes", 7, ""), ("", 130, "hexmend: interrupted\n")])
def test_a_signal_while_a_block_restores_handlers_is_answered_by_the_one_around_it(block, status, said):
    done = run_python("-c", RESTORES, block)
    assert (done.returncode, done.stderr) == (status, said)
