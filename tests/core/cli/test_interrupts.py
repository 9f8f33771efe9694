"""Ctrl-C and TERM at chosen moments of real processes: one line, the right exit status, and no result lost."""

import os
import signal
import subprocess
import sys

import pytest

from hexmend import gallery, io

pytestmark = pytest.mark.slow

#: The script that pip writes, with a place before it (`{moment}`) where the moment of the signal is chosen.
SCRIPT = """
import os, re, signal, sys
def send(count=1):
    for _ in range(count):
        os.kill(os.getpid(), int(os.environ["SIGNAL"]))
from hexmend.cli.process import interrupts
{moment}
from hexmend.cli.main import main
from hexmend.run import progress
progress.LINE_INTERVAL = progress.BAR_DELAY = 0.0
sys.exit(main())
"""
#: The signal comes as this module is imported; an exception there may be taken for another, and is none of ours.
IMPORTS = """
class Finder:
    def find_spec(name, path, target=None):
        if name == {name!r}:
            try:
                send()
            except KeyboardInterrupt:
                os._exit(77)
sys.meta_path.insert(0, Finder)
"""
#: It comes as a method is called.
CALLS = """
from {module} import {kind} as Kind
whole = Kind.{name}
def {name}(self, *args, **options):
    send({count})
    return whole(self, *args, **options)
Kind.{name} = {name}
"""
#: It comes while standard error is being written to, twice.
WRITES = """
import io
class Raw(io.RawIOBase):
    left = 2
    def writable(self):
        return True
    def write(self, data):
        if Raw.left and b"iteration" in bytes(data):
            Raw.left -= 1
            send()
        return os.write(2, data)
sys.stderr = io.TextIOWrapper(io.BufferedWriter(Raw()), line_buffering=True)
"""
#: It comes after the last line was printed, and when Python ends.
ENDS = """
import atexit, builtins
atexit.register(send)
whole = print
def print(text="", **options):
    whole(text, **options)
    if text.startswith("Written to"):
        send()
builtins.print = print
"""


@pytest.fixture
def smooth(tmp_path):
    """Starts the program on a mesh, with the signal at a moment; its output is `tmp_path / "out.vtu"`."""
    io.write(tmp_path / "mesh.vtu", gallery.make("cube", size=125, scramble=0.3))
    (tmp_path / "out.vtu").write_text("old")

    def start(moment, number=signal.SIGINT, most=50, **options):
        script = tmp_path / "hexmend"
        script.write_text(SCRIPT.format(moment=moment))
        words = [tmp_path / "mesh.vtu", "-o", tmp_path / "out.vtu", "--method", "laplacian", "--tolerance", "0"]
        return subprocess.Popen(
            [sys.executable, script, "smooth", *words, "--max-iterations", str(most)],
            env=os.environ | {"SIGNAL": str(int(number)), "TERM": "xterm"} | options.pop("env", {}),
            **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, **options},
        )

    yield start
    (tmp_path / "hexmend").unlink()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mesh.vtu", "out.vtu"]


def ended(process):
    """Wait for the end; give the exit status and what was said on standard error, without lines of progress."""
    with process:
        _, said = process.communicate(timeout=120)
    return process.returncode, [line for line in said.splitlines() if ": iteration " not in line]


@pytest.mark.parametrize(
    ("name", "number"),
    [("hexmend.cli.main", signal.SIGINT), ("argparse", signal.SIGTERM), ("numpy", signal.SIGINT),
     ("hexmend.run.run", signal.SIGTERM)],
)  # fmt: skip
def test_a_signal_during_an_import_is_one_line(smooth, tmp_path, name, number):
    status, said = ended(smooth(IMPORTS.format(name=name), number))
    assert (status, said) == (128 + number, ["hexmend: interrupted"])
    assert (tmp_path / "out.vtu").read_text() == "old"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_while_progress_is_printed_loses_nothing(smooth, tmp_path, number):
    status, said = ended(smooth(WRITES, number))
    assert status == 0
    assert said[0] == "Ending after this iteration; a second Ctrl-C ends at once."
    assert "Interrupted: the result so far is kept." in said
    assert io.read(tmp_path / "out.vtu").n_hexes == 125


@pytest.mark.parametrize(("module", "kind", "name", "count"), [
    ("hexmend.run.progress", "TimedDisplay", "show", 3),
    ("hexmend.run.run", "Run", "result", 1),
    ("hexmend.cli.command", "CoreCommand", "run", 1),
])  # fmt: skip
def test_signals_after_an_iteration_lose_nothing_and_before_it_everything(smooth, tmp_path, module, kind, name, count):
    status, said = ended(smooth(CALLS.format(module=module, kind=kind, name=name, count=count)))
    if kind == "CoreCommand":
        assert (status, said) == (130, ["hexmend: interrupted"])
        assert (tmp_path / "out.vtu").read_text() == "old"
    else:
        assert status == 0
        assert io.read(tmp_path / "out.vtu").n_hexes == 125


def test_a_second_signal_within_the_first_iteration_ends_without_a_result(smooth, tmp_path):
    status, said = ended(smooth(CALLS.format(module="hexmend.run.run", kind="Run", name="__next__", count=2)))
    assert (status, said[-1]) == (130, "hexmend: interrupted")
    assert (tmp_path / "out.vtu").read_text() == "old"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_after_the_last_line_changes_nothing(smooth, tmp_path, number):
    status, said = ended(smooth(ENDS, number))
    assert status == 0
    assert "hexmend: interrupted" not in said
    assert io.read(tmp_path / "out.vtu").n_hexes == 125


def test_a_run_whose_progress_nobody_reads_any_more_is_written(smooth, tmp_path):
    process = smooth("", most=3000)
    process.stderr.readline()
    process.stderr.close()
    with process.stdout:
        process.stdout.read()
    process.wait(timeout=120)
    assert io.read(tmp_path / "out.vtu").n_hexes == 125


@pytest.mark.parametrize("closes", [False, True])
def test_a_terminal_on_which_ctrl_c_is_pressed_or_that_closes_gets_its_result(smooth, tmp_path, closes):
    ours, theirs = pytest.importorskip("pty").openpty()
    streams = {"stdin": theirs, "stdout": theirs, "stderr": theirs, "text": False, "start_new_session": True}
    # The first line: this terminal becomes the session's own, so that it sends the signals.
    moment = "import fcntl, termios; fcntl.ioctl(0, termios.TIOCSCTTY, 0); signal.signal(signal.SIGHUP, signal.SIG_DFL)"
    process = smooth(moment, most=1_000_000, **streams)
    os.close(theirs)
    said = b""
    while b"laplacian" not in said:
        said += os.read(ours, 1000)
    if closes:
        os.close(ours)
        process.wait(timeout=120)
    else:
        os.write(ours, b"\x03")
        try:
            while more := os.read(ours, 1000):
                said += more
        except OSError:  # the other side has gone
            pass
        os.close(ours)
        assert process.wait(timeout=120) == 0
        assert b"Interrupted: the result so far is kept." in said
        assert b"Traceback" not in said
    assert io.read(tmp_path / "out.vtu").n_hexes == 125
