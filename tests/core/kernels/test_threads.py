"""How loops are shared: how many threads, what they are told by, and that nothing depends on their number."""

import importlib.util
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from hexmend import gallery, kernels
from hexmend.kernels import objective
from tests.patience import PATIENCE
from tests.programs import run_python

VARIABLES = ("HEXMEND_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT")
posix = pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are not forked here")


def program(text, said=None):
    """Run a program without any of the variables, tell it something, and return what it printed."""
    environment = {key: value for key, value in os.environ.items() if key not in VARIABLES}
    done = subprocess.run(
        [sys.executable, "-c", text],
        env=environment,
        input=said,
        capture_output=True,
        text=True,
        timeout=PATIENCE / 1000,
    )
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    return done.stdout


def available():
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


SAID = {
    "HEXMEND_THREADS=3": 3,
    "HEXMEND_THREADS= 5 |OMP_NUM_THREADS=2|OMP_THREAD_LIMIT=1": 5,
    "HEXMEND_THREADS=": available(),
    "OMP_NUM_THREADS=3": 3,
    "OMP_NUM_THREADS=4,2": 4,
    "OMP_NUM_THREADS=4|OMP_THREAD_LIMIT=2": 2,
    "OMP_THREAD_LIMIT=1": 1,
    "OMP_NUM_THREADS=many": available(),  # which is not ours to judge
}
WRONG = ["0", "-2", "two", "1.5", "²", "9" * 30]


@pytest.fixture(scope="module")
def told():
    """What the kernels make of each setting of the variables when they are loaded, asked of one process."""
    text = """
import importlib, json, os, sys
from hexmend import kernels
answers = {"": kernels.threads()}
for setting in json.loads(sys.stdin.read()):
    variables = dict(one.split("=") for one in setting.split("|"))
    os.environ.update(variables)
    try:
        answers[setting] = importlib.reload(kernels).threads()
    except Exception as error:
        answers[setting] = str(error)
    for name in variables:
        del os.environ[name]
print(json.dumps(answers))
"""
    settings = [*SAID, *(f"HEXMEND_THREADS={word}" for word in WRONG)]
    return json.loads(program(text, said=json.dumps(settings)))


@pytest.mark.parametrize(("setting", "threads"), [("", available()), *SAID.items()])
def test_variables_say_how_many(told, setting, threads):
    assert told[setting] == threads


@pytest.mark.parametrize("word", WRONG)
def test_a_number_that_is_none_is_refused(told, word):
    assert told[f"HEXMEND_THREADS={word}"] == (
        f"HEXMEND_THREADS = {word!r} cannot be used: expected a whole number from 1 to 1024"
    )


@posix
def test_by_default_there_are_as_many_as_processors_that_the_process_may_use():
    text = "import os; os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}); from hexmend import kernels; print(kernels.threads())"
    assert program(text) == "1\n"


def test_a_number_is_chosen_for_a_thread_alone():
    most = kernels.threads()

    def chosen(count):
        kernels.set_threads(count)
        return kernels.threads()

    with ThreadPoolExecutor(1) as other:
        assert other.submit(chosen, 7).result() == 7
        assert kernels.threads() == most
        assert other.submit(kernels.threads).result() == 7
        assert other.submit(chosen, 0).result() == 1


@pytest.fixture(scope="module")
def mesh():
    return gallery.make("five-side", size=3000, scramble=0.3)


def figures(mesh):
    """Energies and gradient shares: two loops over all hexes."""
    omitted = np.zeros(mesh.n_hexes, np.uint8)
    eta, shares = np.empty(mesh.n_hexes), np.empty((mesh.n_hexes, 8, 3))
    objective.energies(mesh.points, mesh.hexes, 0.1, 1.0, omitted, eta)
    objective.gradient(mesh.points, mesh.hexes, 0.1, (2.0, 1.0), omitted, shares)
    return eta.tobytes() + shares.tobytes()


def test_results_are_the_same_to_the_last_bit_with_any_number(mesh):
    def with_threads(count):
        kernels.set_threads(count)
        return figures(mesh)

    with ThreadPoolExecutor(1) as own:
        assert len(set(own.map(with_threads, (1, 2, 3, 5, 2)))) == 1


def test_threads_that_call_kernels_side_by_side_do_not_disturb_each_other(mesh):
    right = figures(mesh)
    with ThreadPoolExecutor(6) as pool:
        assert set(pool.map(lambda _: figures(mesh), range(60))) == {right}


BEGIN = """
import os, sys, time
import numpy as np
from hexmend import gallery, kernels
from hexmend.kernels import objective
kernels.set_threads(3)
mesh = gallery.make("five-side", size=3000)
omitted, eta = np.zeros(mesh.n_hexes, np.uint8), np.empty(mesh.n_hexes)
def call():
    objective.energies(mesh.points, mesh.hexes, 0.1, 1.0, omitted, eta)
    return eta.sum()
first = call()
"""


@posix
def test_a_forked_child_has_threads_of_its_own():
    child = """
child = os.fork()
if child == 0:
    os._exit(0 if call() == first and call() == first else 1)
_, status = os.waitpid(child, 0)
print(os.waitstatus_to_exitcode(status), call() == first)
"""
    assert program(BEGIN + child).split() == ["0", "True"]


@pytest.mark.slow
def test_a_process_ends_quietly_while_threads_wait_or_work():
    assert program(BEGIN) == ""
    beside = """
import threading
begun = threading.Event()
threading.Thread(target=lambda: [(call(), begun.set()) for _ in range(10**6)], daemon=True).start()
begun.wait()
print("end")
"""
    assert program(BEGIN + beside) == "end\n"


@posix
def test_control_c_during_a_kernel_is_a_keyboard_interrupt():
    interrupted = """
import signal, threading
for delay in (0.01, 0.013, 0.021, 0.034, 0.05):
    try:
        threading.Timer(delay, os.kill, (os.getpid(), signal.SIGINT)).start()
        while True:
            call()
    except KeyboardInterrupt:
        print("interrupted", call() == first)
"""
    assert program(BEGIN + interrupted).split() == ["interrupted", "True"] * 5


def test_the_bench_says_threads_build_and_system_without_its_version():
    from hexmend.study.machine import machine

    assert (machine()["threads"], machine()["kernels"]) == (kernels.threads(), kernels.BUILD)
    assert machine()["system"].isalpha()


def test_a_build_that_there_is_not_is_said_plainly():
    done = run_python("-c", "import hexmend.kernels", variables={"HEXMEND_KERNELS": "v9"})
    assert "HEXMEND_KERNELS = 'v9' names no build that this processor can run: expected" in done.stderr


# The builds of the kernels for different processors give the same integers and determinants, and all but the same rest.


PROGRAM = """
import sys, numpy as np
from hexmend import kernels, gallery
from hexmend.energy import MeshEnergy, ObjectiveNorm, energies
from hexmend.kernels import elements, local
from hexmend.kernels.line_search import LineSearch
from hexmend.quality import METRICS, measure
assert kernels.BUILD == sys.argv[1]
mesh = gallery.make("five-side", size=700, scramble=0.6)
energy = MeshEnergy(mesh, ObjectiveNorm(2.5))
x, v = energy.to_edge_units(mesh.points), np.random.default_rng(0).normal(size=(energy.nodes.size, 3))
sigma = np.empty((mesh.n_hexes, 8))
elements.corner_determinants(mesh.points, mesh.hexes, sigma)
matrix = energy.hessian(x, 0.1).shifted(50.0).assembled(np.float64)
colours, swept = mesh.topology.colouring(mesh.free), x.copy()
settings = local.NodeStepSettings(local.Direction.MODIFIED_NEWTON, 0.1, ObjectiveNorm(), LineSearch(max_backtracks=60))
local.sweep(swept, mesh.topology.hex_mesh, colours.start, colours.items, settings)
figures = measure(mesh.points, mesh.hexes)
np.savez(
    sys.argv[2], same_sigma=sigma, same_edges=mesh.topology.edges, same_slots=energy.sparsity.columns,
    same_inverted=figures.inverted, eta=energies(x, mesh.hexes, 0.1), gradient=energy.gradient(x, 0.1),
    product=energy.hessian(x, 0.1).matvec(v.ravel()), off=matrix.off_diagonal, own=matrix.diagonal, swept=swept,
    solved=matrix.solve(v.ravel(), 1e-10, 300).x,
    **{name: metric.of(mesh.points, mesh.hexes, figures) for name, metric in METRICS.items()},
)
"""


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """What each build that this processor can run says."""
    folder, found = tmp_path_factory.mktemp("builds"), {}
    for build in kernels.BUILDS:
        path = folder / f"{build}.npz"
        done = run_python("-c", PROGRAM, build, path, variables={"HEXMEND_KERNELS": build})
        assert done.returncode == 0, done.stderr
        found[build] = dict(np.load(path))
    return found


@pytest.mark.slow
@pytest.mark.parametrize("build", kernels.BUILDS[1:])
def test_builds_agree(answers, build):
    newest, other = answers[kernels.BUILDS[0]], answers[build]
    for name, values in newest.items():
        if name.startswith("same_"):
            np.testing.assert_array_equal(other[name], values, err_msg=name)
        else:
            finite = np.isfinite(values)
            np.testing.assert_array_equal(np.isfinite(other[name]), finite, err_msg=name)
            size = np.abs(values[finite]).max()
            tolerance = {"solved": 1e-8, "swept": 1e-8, "max-angle": 1e-9, "min-angle": 1e-9}.get(name, 1e-12)
            np.testing.assert_allclose(other[name][finite], values[finite], rtol=0, atol=tolerance * size, err_msg=name)


def test_kernels_that_are_not_built_are_one_line(tmp_path):
    program = (
        "import sys; sys.modules['hexmend.kernels._processor'] = None\n"
        "from hexmend.cli.main import main; sys.exit(main(['info', 'mesh.vtu']))"
    )
    done = run_python("-c", program, cwd=tmp_path)
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert "kernels of Hexmend are not built" in done.stderr
    assert "g++" in done.stderr


# The stubs of the compiled kernels are those of the module that is built.


ROOT = Path(__file__).resolve().parents[3]


def test_the_stubs_say_what_the_module_has(tmp_path):
    pytest.importorskip("nanobind")
    spec = importlib.util.spec_from_file_location("kernel_stubs", ROOT / "scripts/kernel_stubs.py")
    stubs = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(stubs)
    written = stubs.write(tmp_path)
    there = Path(kernels.__file__).parent
    assert {path.name for path in written} == {path.name for path in there.glob("*.pyi")}
    for path in written:
        assert path.read_text() == (there / path.name).read_text(), f"{path.name}: run python scripts/kernel_stubs.py"
