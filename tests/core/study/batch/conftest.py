"""A method that does what goes wrong in studies, as of another distribution, and ways to run studies with it."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager

import pytest

from hexmend import gallery, io
from tests.patience import PATIENCE

#: It writes down that it begins, does as it is told, and writes down that it is done.
TRIAL = """
import os, signal, time
from dataclasses import dataclass
import hexmend as hx

DEEDS = ("rest", "raise", "crash", "vanish", "eat", "wait", "print")

def say(word, number):
    with open(os.environ["TRIAL_LOG"], "a") as log:
        log.write(f"{word} {number} {os.getpid()}\\n")

@hx.method
@dataclass(frozen=True)
class Trial(hx.Smoother):
    name = "trial"
    title = "Trial"
    help = "Tries whoever runs it."
    source = "a test"
    does: str = hx.parameter("rest", choices=DEEDS, help="What it does.")
    number: int = hx.parameter(0, help="To tell it apart.")

    def steps(self, mesh):
        say("began", self.number)
        yield hx.Step(mesh.points)
        if self.does == "raise":
            raise ValueError("it does not like this mesh")
        if self.does == "crash":
            os.kill(os.getpid(), signal.SIGSEGV)
        if self.does == "vanish":
            os._exit(7)
        if self.does == "eat":
            hoard = [bytearray(1 << 24) for _ in range(1 << 14)]
        if self.does == "print":
            print("{}", flush=True)
        while self.does == "wait" and not os.path.exists(os.environ["TRIAL_GO"]):
            time.sleep(0.02)
        say("did", self.number)
        yield hx.Step(mesh.points)
        return hx.Outcome.CONVERGED
"""


def wait_until(what, why, study=None):
    """Wait until something is so, while the study is at work if it is named: its processes take longer than a thread."""
    limit = 4 * PATIENCE / 1000
    end = time.monotonic() + limit
    while not what():
        assert study is None or study.poll() is None, study.communicate()
        assert time.monotonic() < end, f"not within {limit:.0f} s: {why}"
        time.sleep(0.02)


def is_running(number):
    """Whether there is a process of this number that has not ended."""
    try:
        with open(f"/proc/{number}/stat", encoding="ascii", errors="replace") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


class Laboratory:
    """A folder with meshes, and the program with the method."""

    def __init__(self, folder, monkeypatch):
        self.folder, self.out = folder, folder / "out"
        info = folder / "site/trial-1.0.dist-info"
        info.mkdir(parents=True)
        (info / "METADATA").write_text("Metadata-Version: 2.1\nName: trial\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text("[hexmend.smoothers]\ntrial = trial_method\n")
        (folder / "site/trial_method.py").write_text(TRIAL)
        path = os.pathsep.join(filter(None, [str(folder / "site"), os.environ.get("PYTHONPATH", "")]))
        for name, value in {"PYTHONPATH": path, "TRIAL_LOG": folder / "log", "TRIAL_GO": folder / "go"}.items():
            monkeypatch.setenv(name, str(value))
        monkeypatch.setattr(sys, "path", [str(folder / "site"), *sys.path])  # which tasks' processes are given

    def mesh(self, name="cube.vtk", **values):
        """The path of a mesh of the gallery's."""
        io.write(self.folder / name, gallery.make("cube", **{"size": 8, "scramble": 0.2, **values}))
        return self.folder / name

    def recipe(self, text):
        """The path of a study's recipe."""
        (self.folder / "recipe.toml").write_text("format = 1\n" + text, encoding="utf-8")
        return self.folder / "recipe.toml"

    def words(self, *words):
        """The command line of a study."""
        return [sys.executable, "-m", "hexmend", "study", *map(str, words), "-o", str(self.out)]

    def run(self, *words):
        """The study's process, once it has ended."""
        done = subprocess.run(self.words(*words), capture_output=True, text=True)
        assert "Traceback" not in done.stderr, done.stderr
        return done

    @contextmanager
    def started(self, *words):
        """The study's process, at work; it is ended with the block."""
        with subprocess.Popen(self.words(*words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as study:
            try:
                yield study
            finally:
                self.go()
                if study.poll() is None:
                    study.send_signal(signal.SIGKILL)

    def go(self):
        """Let the method that waits go on."""
        (self.folder / "go").touch()

    def said(self, word):
        """Numbers of tasks and of their processes, in the order in which the method has said this."""
        log = self.folder / "log"
        lines = [line.split() for line in log.read_text().splitlines()] if log.exists() else []
        return [(int(number), int(process)) for what, number, process in lines if what == word]

    @property
    def answers(self):
        """What is kept, by the number of the trial; not what is being written."""
        kept = [json.loads(path.read_text()) for path in (self.out / "tasks").glob("[!.]*.json")]
        return {one["case"]["stages"][0]["parameters"]["number"]: one["answer"] for one in kept}


@pytest.fixture
def laboratory(tmp_path, monkeypatch):
    return Laboratory(tmp_path, monkeypatch)
