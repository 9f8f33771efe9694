"""Memory of runs: what methods declare, what there is, and what is said where it will not suffice."""

import sys

import numpy as np
import pytest

from benchmarks.scale.memory import measure_memory
from hexmend import METHODS, Recipe, gallery, io
from hexmend.run.memory import FIXED, available, needed, shortage
from tests.programs import run_python

MEBIBYTE = 1 << 20
on_linux = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nobody says what is free, or what is held")
#: Threads reserve address space, and so many as there are cores.
ALONE = {"HEXMEND_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}

# Limits its own address space to what it has and some more, and then runs the program.
LIMITED = """
import resource, sys
from hexmend.cli.main import main
import hexmend.io, hexmend.report, hexmend.run, hexmend.smoothers, hexmend.study.compare
with open("/proc/self/status") as file:
    taken = next(int(line.split()[1]) << 10 for line in file if line.startswith("VmSize:"))
resource.setrlimit(resource.RLIMIT_AS, (taken + (int(sys.argv[1]) << 20), resource.RLIM_INFINITY))
sys.exit(main(sys.argv[2:]))
"""


@pytest.fixture
def system(tmp_path):
    """Makes a folder in which `proc` and `sys` say what is given, by path."""

    def make(texts):
        for path, text in texts.items():
            (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / path).write_text(text)
        return tmp_path

    return make


@pytest.fixture
def mesh_file(tmp_path):
    path = tmp_path / "mesh.vtu"
    io.write(path, gallery.make("cube", size=1000, scramble=0.3))
    return path


def limited(megabytes, *words):
    """The program where so much more address space than it has may be used."""
    return run_python("-c", LIMITED, megabytes, *words, variables=ALONE)


@pytest.mark.slow
@on_linux
@pytest.mark.parametrize("name", METHODS)
def test_a_run_takes_about_what_its_method_declares(name):
    values = {"solver_iterations": 5} if name.startswith("global-") and name != "global-sd" else {}
    row = measure_memory(name, 30_000, 1, **values)
    assert row["mb"] < 1.5 * row["needed_mb"]
    assert row["needed_mb"] < 4 * row["mb"] + 2 * FIXED / MEBIBYTE


@pytest.mark.parametrize("name", METHODS)
def test_what_is_needed_grows_with_what_moves(name):
    mesh, smoother = gallery.make("cube", size=1000), METHODS[name]()
    half = mesh.replace(pinned=mesh.points[:, 0] > np.median(mesh.points[:, 0]))
    none = mesh.replace(pinned=np.ones(mesh.n_nodes, bool))
    assert FIXED < needed(smoother, none) <= needed(smoother, half) <= needed(smoother, mesh)
    assert needed(METHODS[name](boundary="slide"), mesh) > needed(smoother, mesh)
    assert needed(smoother, 2_000_000) - needed(smoother, 1_000_000) == 1_000_000 * smoother.bytes_per_hex


def test_a_recipe_needs_what_its_hungriest_stage_does():
    stages = ["getme", "mend", "local-sd"]
    assert needed(Recipe.of(*stages), 1000) == max(needed(METHODS[name](), 1000) for name in stages)


def test_what_is_short_is_said_in_figures_with_what_helps():
    short = shortage(METHODS["mend"](), 1_000_000, 1_000_000_000)
    assert short.problem == "Mend on 1,000,000 hexes needs about 1.3 GB of memory, and 1.0 GB are free."
    assert short.remedy("run it (--force)") == "Close other programs, smooth a smaller mesh or run it (--force)."


INFO = {"proc/meminfo": "MemTotal: 9000 kB\nMemFree: 100 kB\nMemAvailable:    8000 kB\n"}
TWO = {
    "proc/self/cgroup": "0::/a/b\n",
    "sys/fs/cgroup/a/memory.max": "3000000\n",
    "sys/fs/cgroup/a/memory.current": "1500000\n",
    "sys/fs/cgroup/a/memory.stat": "anon 5\ninactive_file 200000\n",
    "sys/fs/cgroup/a/b/memory.max": "max\n",
    "sys/fs/cgroup/a/b/memory.current": "1000\n",
}


@pytest.mark.parametrize(("texts", "free"), [
    ({}, None),
    (INFO, 8000 << 10),
    (INFO | TWO, 1_700_000),
    (TWO, 1_700_000),
    (INFO | {"proc/self/cgroup": "0::/../elsewhere\n"}, 8000 << 10),
    (INFO | TWO | {"sys/fs/cgroup/a/memory.current": "9000000\n"}, 0),
    (INFO | TWO | {"sys/fs/cgroup/a/memory.max": "\n"}, 8000 << 10),
    ({"proc/meminfo": "MemAvailable: much\n", "proc/self/cgroup": "0::/\n"}, None),
])  # fmt: skip
def test_what_is_free_is_the_least_that_the_system_and_its_groups_leave(system, texts, free):
    assert available(system(texts)) == free


@on_linux
@pytest.mark.parametrize("words", [
    ("smooth", "-o", "out.vtu"),
    pytest.param(("compare", "-o", "out", "--methods", "laplacian,mend"), marks=pytest.mark.slow),
])  # fmt: skip
def test_a_run_beyond_a_limit_is_refused_before_it_begins_unless_forced(words, mesh_file, tmp_path):
    command, option, out, *rest = words
    words = [command, mesh_file, option, tmp_path / out, *rest]
    before = mesh_file.read_bytes()
    done = limited(310, *words)
    assert done.returncode == 3
    (line,) = done.stderr.splitlines()
    assert line.startswith("hexmend: Mend on 1,000 hexes needs about 68 MB of memory, and ")
    assert line.endswith(" or run it anyway (--force).")
    assert not (tmp_path / out).exists()
    done = limited(310, *words, "--force")
    assert done.returncode == 0
    assert done.stderr.startswith("hexmend: warning: Mend on 1,000 hexes needs about")
    assert (tmp_path / out).exists()
    assert mesh_file.read_bytes() == before


def test_memory_that_runs_out_all_the_same_is_said_in_a_line(mesh_file, tmp_path, monkeypatch, complaint):
    def ends(*arguments):
        raise MemoryError

    monkeypatch.setattr(METHODS["mend"], "steps", ends)
    said = complaint("smooth", mesh_file, "-o", tmp_path / "out.vtu", status=3)
    assert said.startswith("hexmend: not enough memory")
    assert not (tmp_path / "out.vtu").exists()
