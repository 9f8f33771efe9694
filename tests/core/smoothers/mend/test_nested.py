"""The optimum of shape begins at that of the coarse mesh where the mesh is a refinement."""

import numpy as np
import pytest

import hexmend as hx
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.smoothers.mend import stages
from hexmend.smoothers.mend.mend import Mend
from hexmend.smoothers.mend.nested.nested_start import NestedConfig
from tests.core.refined_meshes import refined, renumbered

FORCED = NestedConfig(free_nodes=1)
NEVER = NestedConfig(free_nodes=10**9)


@pytest.fixture
def forced(monkeypatch):
    """All meshes that are refinements begin at coarse ones."""

    class Forced(stages.Stages):
        def __init__(self, settings):
            super().__init__(settings, FORCED)

    monkeypatch.setattr("hexmend.smoothers.mend.mend.Stages", Forced)


def scrambled(mesh, amplitude, seed=0):
    """Free nodes moved at random, by a share of the mean edge length at most along each axis."""
    shift = np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape) * amplitude * mesh.mean_edge_length
    return mesh.with_points(mesh.points + shift * mesh.free[:, None])


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
def test_the_optimum_is_that_without_the_start_or_better(boundary):
    whole = refined(make("five-side", size=100))
    mesh, smoother = scrambled(whole, 0.3), Mend(goal="shape", p=1.0, boundary=boundary)
    ends = []
    for config in (NEVER, FORCED):
        steps = list(stages.Stages(smoother, config).steps(mesh))
        ends.append(measure(steps[-1].points, mesh.hexes).eta.sum())
    if boundary == "fixed":
        assert ends[1] == pytest.approx(ends[0], rel=1e-8)
    else:  # on facets steps end at several points
        assert ends[1] < ends[0] * (1 + 1e-6)


@pytest.mark.slow
def test_kershaws_mesh_ends_at_the_lattice_in_fewer_steps_of_all_its_nodes():
    mesh, smoother = make("kershaw", size=24**3), Mend(goal="shape", boundary="slide", p=1.0)
    counts = []
    for config in (NEVER, FORCED):
        steps = list(stages.Stages(smoother, config).steps(mesh))
        places = steps[-1].points * 24
        assert np.abs(places - np.rint(places)).max() < 1e-6
        assert np.array_equal(steps[-1].points[mesh.immovable], mesh.points[mesh.immovable])
        counts.append(sum("coarse_hexes" not in step.diagnostics for step in steps))
    assert counts[1] < 0.6 * counts[0]


@pytest.mark.usefixtures("forced")
def test_runs_keep_interfaces_and_lower_no_figure():
    coarse = make("materials", size=200)
    fine, _ = renumbered(refined(Mesh(coarse.points, coarse.hexes)), 0)
    material = (fine.points[fine.hexes].mean(axis=1)[:, 0] > np.median(fine.points[:, 0])).astype(np.int32)
    mesh = fine.rebuilt(hex_data={"material": material})
    assert mesh.interfaces is not None
    result = hx.smooth(scrambled(mesh, 0.1), "mend", layers="free")
    assert np.array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])
    assert result.after.q_min >= result.before.q_min - 1e-9
    assert result.after.q_mean >= result.before.q_mean - 1e-9
