"""Layers on walls that sets name: of any growth, kept by runs, and in all the places where they can be named."""

import numpy as np
import pytest

from hexmend import METHODS, MeshError, ParameterError, io, iterate, measure, smooth
from hexmend.gallery import make
from hexmend.layers import find_layers, layers_on_sets, named_walls
from hexmend.run.recipe import Recipe, from_toml, to_toml
from hexmend.target import given_lengths
from tests.core.grids import displaced
from tests.core.layers.stacks import scrambled_in_layers, stack


def flat(growth=1.0, layers=6):
    """A stack of thin hexes whose heights do not grow, with a set of nodes of the lower side too."""
    mesh = stack(layers=layers, first=0.02, growth=growth)
    return mesh.replace(node_sets={"floor": np.flatnonzero(mesh.points[:, 2] == 0), "keep": np.array([0])})


@pytest.mark.parametrize(("name", "growth"), [("plate", 0.9), ("floor", 1.0), ("plate", 1.3)])
def test_a_set_is_a_wall_whatever_the_growth(name, growth):
    mesh = flat(growth)
    (wall,) = layers_on_sets(mesh, [name]).walls
    assert (wall.name, wall.count, wall.depth) == (name, 100, 6)
    heights = wall.of(given_lengths(mesh))
    np.testing.assert_allclose(heights[:, 1:] / heights[:, :-1], growth)


def test_stacks_end_where_hexes_are_no_longer_thin_or_heights_jump():
    (wall,) = layers_on_sets(stack(layers=14, first=0.01, growth=1.3), ["plate"]).walls
    assert wall.depth == 12  # 0.01 * 1.3**12 > 0.2
    mesh = flat()
    lifted = displaced(mesh, np.s_[mesh.points[:, 2] > 0.07, 2], 0.05)  # from the fourth layer of six on
    (wall,) = layers_on_sets(lifted, ["plate"]).walls
    assert wall.depth == 3


@pytest.mark.parametrize("name", ["plate", "floor"])
def test_a_run_keeps_the_heights_on_a_named_wall(name):
    mesh = scrambled_in_layers(flat(), 0.3)
    assert not find_layers(mesh)
    result = smooth(mesh, target="ideal", layers=name)
    (wall,) = result.layers
    assert (wall.wall, wall.layers, wall.lost, wall.aimed_at) == (name, 6, False, True)
    assert wall.after.first_height_mean == pytest.approx(0.02, rel=0.05)
    assert f"Boundary layers at '{name}' are kept." in result.message
    assert not smooth(mesh, target="ideal").layers


def test_names_are_texts_and_lists_and_go_through_recipes():
    assert named_walls("auto") == named_walls("keep") == named_walls("free") == ()
    assert METHODS["mend"](layers=["plate", "wing"]).layers == "plate,wing"
    assert METHODS["mend"](layers=["keep"]).layers == "set:keep"
    assert named_walls("set:keep, plate") == ("keep", "plate")
    recipe = Recipe.of(METHODS["mend"](layers=["plate"]))
    assert from_toml(to_toml(recipe)) == recipe
    text = 'format = 1\n[[stage]]\nmethod = "mend"\nparameters = { layers = ["plate"] }\n'
    assert from_toml(text).stages[0].smoother.layers == "plate"
    assert iterate(flat(), layers=["plate"], max_iterations=1).layers.walls[0].name == "plate"


def test_what_is_wrong_is_named():
    mesh = flat()
    with pytest.raises(MeshError, match="the set 'keep' has no face on the boundary"):
        layers_on_sets(mesh, ["keep"])
    with pytest.raises(ParameterError, match=r"layers = set:keep: the set 'keep' has no face"):
        smooth(mesh, layers="set:keep")
    with pytest.raises(
        ParameterError,
        match=r"layers = plat: there is no set 'plat': did you mean plate\? there are 'floor', 'keep', 'plate' \(expected auto",
    ):
        smooth(mesh, layers="plat")


def test_the_option_names_walls(tmp_path, run_command):
    path, out = str(tmp_path / "flat.vtu"), str(tmp_path / "out.vtu")
    io.write(path, scrambled_in_layers(flat(), 0.3))
    printed = run_command("smooth", path, "-o", out, "--layers", "floor")
    assert "Boundary layers at 'floor' are kept." in printed.err
    assert "Layers at 'floor' (6 layers on 100 faces)" in printed.out
    assert (
        "layers = flor: there is no set 'flor'"
        in run_command("smooth", path, "-o", out, "--layers", "flor", status=2).err
    )


@pytest.mark.parametrize("scramble", [0.0, 0.5])
def test_layers_are_found_whatever_is_pinned(scramble):
    mesh = make("layered", size=2000, scramble=scramble)
    (wall,) = find_layers(mesh).walls
    for pinned in (np.ones(mesh.n_nodes, dtype=bool), np.arange(mesh.n_nodes) % 2 == 0):
        (same,) = find_layers(mesh.replace(pinned=pinned), measure(mesh.points, mesh.hexes)).walls
        np.testing.assert_array_equal(wall.hexes, same.hexes)
