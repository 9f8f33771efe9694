"""Tasks on a real cluster of this machine: a scheduler and two workers, processes of their own, one of which is killed."""

import csv
import json
import os
import signal
import subprocess
import sys
from contextlib import ExitStack, contextmanager

import pytest

from tests.core.study.batch.conftest import is_running, wait_until

pytestmark = pytest.mark.slow

pytest.importorskip("distributed", reason="Dask's distributed is not installed")

WAITS = '[[method]]\nmethod = "trial"\nparameters = { does = "wait", number = [1, 2, 3, 4] }'


class Cluster:
    """A scheduler and workers of one thread each."""

    def __init__(self, folder, stack):
        self._folder, self._stack = folder, stack
        file = folder / "scheduler.json"
        self.scheduler = self._begin("scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", file)
        wait_until(lambda: file.exists() and file.stat().st_size, "the scheduler says where it is")
        self.address = json.loads(file.read_text())["address"]
        self.workers = [self.add_worker(name) for name in ("first", "second")]

    def add_worker(self, name):
        """Another worker that nobody starts again when it has gone."""
        return self._begin("worker", self.address, "--no-nanny", "--nthreads", "1", "--name", name)

    def _begin(self, what, *words):
        command = [sys.executable, "-m", "dask", what, *map(str, words), "--no-dashboard"]
        with open(self._folder / "cluster.log", "ab") as log:
            process = self._stack.enter_context(subprocess.Popen(command, stdout=log, stderr=log))
        self._stack.callback(process.kill)
        return process


@pytest.fixture
def cluster(laboratory, monkeypatch):
    monkeypatch.setenv("DASK_TEMPORARY_DIRECTORY", str(laboratory.folder / "dask"))
    with ExitStack() as stack:
        yield Cluster(laboratory.folder, stack)


@contextmanager
def at_work(laboratory, cluster):
    """A study at work: both workers have begun a task."""
    words = laboratory.recipe(WAITS), laboratory.mesh(), "--scheduler", cluster.address
    with laboratory.started(*words) as study:
        wait_until(lambda: len(laboratory.said("began")) == 2, "both workers begin a task", study)
        yield study


def parent(process):
    with open(f"/proc/{process}/stat", encoding="ascii", errors="replace") as file:
        return int(file.read().rpartition(")")[2].split()[1])


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
def test_tasks_of_a_killed_worker_are_run_by_another(laboratory, cluster):
    with at_work(laboratory, cluster) as study:
        by_worker = {parent(process): (number, process) for number, process in laboratory.said("began")}
        assert set(by_worker) == {worker.pid for worker in cluster.workers}
        killed = cluster.workers[0]
        lost, process = by_worker[killed.pid]
        os.kill(killed.pid, signal.SIGKILL)
        wait_until(lambda: not is_running(process), "the task's process ends with its worker")
        assert laboratory.said("did") == []
        laboratory.go()
        out, err = study.communicate()
        assert study.returncode == 0, err
    assert "4 tasks: 4 done now, 0 done before, 0 without a result." in out
    with open(laboratory.out / "study.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [(row["case"], row["status"]) for row in rows] == [(f"trial number={k}", "done") for k in range(1, 5)]
    assert sorted(number for number, _ in laboratory.said("began")) == sorted([lost, 1, 2, 3, 4])
    assert sorted(number for number, _ in laboratory.said("did")) == [1, 2, 3, 4]
    assert set(laboratory.answers) == {1, 2, 3, 4}


def test_ctrl_c_ends_running_tasks_and_the_same_command_continues(laboratory, cluster):
    with at_work(laboratory, cluster) as study:
        study.send_signal(signal.SIGINT)
        _, err = study.communicate()
        assert study.returncode == 130
        assert "Traceback" not in err
        began = [process for _, process in laboratory.said("began")]
        wait_until(lambda: not any(map(is_running, began)), "the tasks' processes end with the study")
    done = laboratory.run(laboratory.recipe(WAITS), laboratory.mesh(), "--scheduler", cluster.address)
    assert "4 tasks: 4 done now" in done.stdout
    assert sorted(number for number, _ in laboratory.said("did")) == [1, 2, 3, 4]


def test_a_lost_scheduler_is_reported_and_finished_tasks_are_kept(laboratory, cluster):
    recipe = laboratory.recipe(f'[[method]]\nmethod = "trial"\ntitle = "rests"\n{WAITS}')
    words = recipe, laboratory.mesh(), "--scheduler", cluster.address
    with laboratory.started(*words) as study:
        wait_until(lambda: len(laboratory.answers) == 1 and len(laboratory.said("began")) >= 3, "one is done", study)
        cluster.scheduler.kill()
        _, err = study.communicate()
        assert study.returncode == 2
    assert "has gone: finished tasks are kept, and the same command continues with the others" in err.splitlines()[-1]
    assert "Traceback" not in err
    done = laboratory.run(recipe, laboratory.mesh())
    assert "5 tasks: 4 done now, 1 done before, 0 without a result." in done.stdout


def test_a_missing_scheduler_is_reported(laboratory, monkeypatch):
    done = laboratory.run(laboratory.recipe(WAITS), laboratory.mesh(), "--scheduler", "tcp//nowhere")
    assert done.returncode == 2
    assert "no scheduler answers at 'tcp//nowhere'" in done.stderr


def test_without_dask_the_message_names_what_to_install(laboratory, monkeypatch, run_command):
    monkeypatch.setitem(sys.modules, "distributed", None)
    words = ["study", laboratory.recipe(WAITS.replace("trial", "mend")), laboratory.mesh(), "--scheduler", "tcp://a:1"]
    laboratory.recipe('methods = ["mend"]')
    printed = run_command(*words, "-o", laboratory.out, status=2).err
    assert "pip install '.[study]'  in the source folder of Hexmend" in printed
