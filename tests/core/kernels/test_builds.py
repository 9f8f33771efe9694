"""The builds of the kernels for different processors give the same integers and determinants, and all but the same rest."""

import os
import subprocess
import sys

import numpy as np
import pytest

from hexmend import kernels

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
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM, build, str(path)], env=os.environ | {"HEXMEND_KERNELS": build},
            capture_output=True, text=True,
        )  # fmt: skip
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
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert "kernels of Hexmend are not built" in done.stderr
    assert "g++" in done.stderr
