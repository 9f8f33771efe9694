"""Gallery meshes: counts, soundness, determinism, size."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import StoppingCriteria, smooth, summarise
from hexmend.doctor import examine
from hexmend.gallery import GALLERY, make

every = pytest.mark.parametrize("name", GALLERY)


@pytest.mark.parametrize(
    ("name", "size", "hexes", "nodes", "free"),
    [
        ("five-side", 7350, 7350, 8711, 6119),  # the thesis's FiveSide4
        ("bridge-sharp", 32000, 32000, 35301, 28899),
        ("cube", 1000, 1000, 1331, 729),
    ],
)
def test_counts_are_those_of_the_thesis(name, size, hexes, nodes, free):
    summary = summarise(make(name, size=size))
    assert (summary.hexes, summary.nodes, summary.free_nodes) == (hexes, nodes, free)
    assert summary.inverted == 0


def test_figures_are_near_those_of_the_thesis():
    five, bridge = summarise(make("five-side")), summarise(make("bridge-sharp"))
    assert (five.q_min, five.q_mean, five.q_norm) == pytest.approx((0.5038, 0.8343, 0.8177), abs=0.06)
    assert (bridge.q_min, bridge.q_mean, bridge.q_norm) == pytest.approx((0.1679, 0.8098, 0.6421), abs=0.025)


def test_the_sharp_bridge_gains_by_optimising_and_is_inverted_by_laplacian_smoothing():
    bridge = make("bridge-sharp", size=4000)
    before = summarise(bridge)
    after = smooth(bridge, "local-sd", StoppingCriteria(max_iterations=40)).after
    assert after.inverted == 0
    assert after.q_min > before.q_min + 0.05
    assert after.q_mean > before.q_mean + 0.03
    assert after.q_norm > before.q_norm + 0.1
    assert smooth(bridge, "laplacian", StoppingCriteria(keep_last=True)).after.inverted > 0


@pytest.mark.slow
@every
@settings(max_examples=5)
@given(size=st.integers(2000, 20_000))
def test_any_size_comes_near_and_is_sound(name, size):
    mesh = make(name, size=size)
    assert mesh.n_hexes == pytest.approx(size, rel=0.3 if name != "kershaw" else 1)  # multiples of 6
    assert examine(mesh) == ()
    assert (summarise(mesh).inverted == 0) == (name != "plane")  # plane is made to be mended
    assert mesh.name == f"{name}-{mesh.n_hexes}"


@every
def test_scrambling_is_deterministic_and_leaves_the_boundary(name):
    mesh, again, other, still = (
        make(name, size=500, scramble=amplitude, seed=seed)
        for amplitude, seed in ((0.5, 1), (0.5, 1), (0.5, 2), (0, 0))
    )
    np.testing.assert_array_equal(mesh.points, again.points)
    assert (mesh.points != other.points).any()
    np.testing.assert_array_equal(mesh.points[mesh.fixed], still.points[mesh.fixed])
    assert (mesh.points[mesh.free] != still.points[mesh.free]).any()


def test_sets_and_layers_name_the_parts():
    five = make("five-side")
    assert len(five.node_sets["bottom"]) == len(five.node_sets["top"]) == 281
    assert np.bincount(five.hex_data["layer"])[1:].tolist() == [245] * 30
    assert len(make("bridge-sharp").node_sets["arch"]) == 41 * 41
