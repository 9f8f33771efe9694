"""Detection of layers: on stacks of any growth, tangled or not; and in no other mesh."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METHODS, Mesh, MeshError, ParameterError, find_layers, io, iterate, measure, read, smooth
from hexmend.gallery import GALLERY, make
from hexmend.layers import Layers, keeps_layers, layers_on_sets, named_walls, run_target
from hexmend.layers.targets import first_height, fitted_lengths
from hexmend.mesh.element_target import Target
from hexmend.run.recipe import Recipe, from_toml, to_toml
from hexmend.target import given_lengths
from tests.core.grids import displaced, grid, scrambled
from tests.core.layers.stacks import scrambled_in_layers, stack

STACKS = {"growth": st.floats(1.03, 2.3), "layers": st.integers(5, 12)}


def made(growth, layers, thin=4.0):
    """A stack whose last layer is thin still."""
    return stack(5, 4, layers, first=1 / (thin * growth**layers), growth=growth, lateral=1.0)


@given(**STACKS)
def test_a_stack_is_found_with_its_heights(growth, layers):
    mesh = made(growth, layers)
    (wall,) = find_layers(mesh).walls
    assert (wall.name, wall.count, wall.depth) == ("plate", 20, layers)
    np.testing.assert_array_equal(wall.hexes[:, 0], np.arange(20))
    heights = wall.of(given_lengths(mesh))
    np.testing.assert_allclose(heights[:, 1:] / heights[:, :-1], growth)
    np.testing.assert_array_equal(find_layers(mesh).hexes, np.arange(mesh.n_hexes))


@given(growth=st.floats(1.1, 1.6), seed=st.integers(0, 100))
def test_a_tangled_stack_is_found(growth, seed):
    mesh = stack(layers=7, first=2e-3, growth=growth)
    (wall,) = find_layers(scrambled_in_layers(mesh, 0.7, seed)).walls
    assert (wall.name, wall.count, wall.depth) == ("plate", 100, 7)


def test_layers_on_opposite_walls_are_two():
    lower = made(1.4, 6)
    mirror = lower.points * [1, 1, -1] + [0, 0, 2 * lower.points[:, 2].max()]
    points = np.concatenate([lower.points, mirror])
    upper = lower.hexes[:, [4, 5, 6, 7, 0, 1, 2, 3]] + lower.n_nodes
    points, index = np.unique(points.round(12), axis=0, return_inverse=True)
    mesh = Mesh(points, index.ravel()[np.concatenate([lower.hexes, upper])])
    layers = find_layers(mesh)
    assert [(wall.name, wall.count, wall.depth) for wall in layers.walls] == [("wall 1", 20, 6), ("wall 2", 20, 6)]
    assert layers.names == "'wall 1' and 'wall 2'"
    assert layers.hexes.size == mesh.n_hexes


def test_side_sets_divide_walls():
    mesh = stack(20, 4, 8)
    floor = np.flatnonzero(np.arange(mesh.n_hexes) < 80)
    left = floor % 20 < 15
    sides = {
        "plate": np.stack([floor[left], np.full(left.sum(), 4)], axis=1),
        "slip": np.stack([floor[~left], np.full((~left).sum(), 4)], axis=1),
    }
    walls = find_layers(mesh.replace(side_sets=sides)).walls
    assert [(wall.name, wall.count) for wall in walls] == [("plate", 60), ("slip", 20)]
    walls = find_layers(mesh.replace(side_sets={"slip": sides["slip"]})).walls
    assert [(wall.name, wall.count) for wall in walls] == [("wall 1", 60), ("slip", 20)]


def test_a_wall_is_a_whole_patch():
    mesh = stack(20, 4, 8)
    x, z = mesh.points[:, 0] / mesh.points[:, 0].max(), mesh.points[:, 2]
    partly = mesh.with_points(mesh.points + np.outer(np.where(x > 0.25, z * 50, 0), [0, 0, 1]))
    assert not find_layers(partly)
    quarter = np.stack([np.flatnonzero(np.arange(80) % 20 < 5), np.full(20, 4)], axis=1)
    (wall,) = find_layers(partly.replace(side_sets={"inlet": quarter})).walls
    assert (wall.name, wall.count) == ("inlet", 20)


def test_the_span_of_a_two_dimensional_mesh_is_no_lateral_length():
    mesh = stack(20, 1, 8, first=0.01, growth=1.2, lateral=0.2)
    (wall,) = find_layers(mesh.with_points(mesh.points * [1, 1e-3, 1])).walls
    assert (wall.name, wall.count, wall.depth) == ("plate", 20, 8)


@pytest.mark.parametrize("mesh", [
    grid(6), stack(growth=1.0), stack(layers=4, first=0.05, growth=1.2), scrambled(grid(8), 0.5),
    *(make(name, size=600) for name in GALLERY if name != "layered"), make("kershaw", size=13824),
], ids=str)  # fmt: skip
def test_other_meshes_have_no_layers(mesh):
    assert not find_layers(mesh)


#: Name, number of faces and number of layers of all walls of the real meshes and the gallery. The aerofoil's mesh has
#: more thin hexes, at a boundary between two of its blocks that are not connected.
WALLS = {
    "BC_Q2_parents.cgns": [("bc-1-wall", 240, 14)],
    "flat_plate": [("plate", 40, 36), ("upstreamSlip", 10, 36)],
    "naca_viscous.cgns": [("wall 1", 512, 12)],
    "layered": [("cylinder", 248, 20)],
    "layered, scrambled": [("cylinder", 248, 20)],
}


@pytest.mark.slow
def test_walls_of_real_meshes_and_of_the_gallery(real_mesh):
    readme = real_mesh("README.md")
    meshes = {path.name: read(path) for path in readme.parent.iterdir() if path != readme}
    for name in GALLERY:
        meshes[name] = make(name, size=5000)
        meshes[f"{name}, scrambled"] = make(name, size=5000, scramble=0.6)
    found = {name: find_layers(mesh).walls for name, mesh in meshes.items()}
    assert {
        name: [(wall.name, wall.count, wall.depth) for wall in walls] for name, walls in found.items() if walls
    } == WALLS
    (aerofoil,) = found["naca_viscous.cgns"]
    assert np.median(aerofoil.of(given_lengths(meshes["naca_viscous.cgns"]))[:, 0]) == pytest.approx(2.51, rel=0.01)


# Layers on walls that sets name: of any growth, kept by runs, and in all the places where they can be named.


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
    printed = run_command("smooth", path, "-o", out, "--layers", "flor", status=2).err
    assert "layers = flor: there is no set 'flor'" in printed


@pytest.mark.parametrize("scramble", [0.0, 0.5])
def test_layers_are_found_whatever_is_pinned(scramble):
    mesh = make("layered", size=2000, scramble=scramble)
    (wall,) = find_layers(mesh).walls
    for pinned in (np.ones(mesh.n_nodes, dtype=bool), np.arange(mesh.n_nodes) % 2 == 0):
        (same,) = find_layers(mesh.replace(pinned=pinned), measure(mesh.points, mesh.hexes)).walls
        np.testing.assert_array_equal(wall.hexes, same.hexes)


# Targets of runs: layers are kept unless another target is asked for.


@pytest.mark.parametrize(("target", "layers", "kept"), [
    ("auto", "auto", True), ("auto", "keep", True), ("auto", "free", False),
    ("ideal", "auto", False), ("ideal", "keep", True), ("x + 1", "auto", False), ("given-size", "auto", False),
    ("given-shape", "auto", True), ("given", "auto", True), ("given-shape", "free", False),
])  # fmt: skip
def test_layers_are_kept_unless_another_target_is_asked_for(target, layers, kept):
    assert keeps_layers(target, layers) == kept


def test_a_mesh_without_layers_has_no_target_of_its_own():
    assert run_target(grid(3), "auto", Layers()) is None
    assert run_target(grid(3), "ideal", Layers()) is None


def test_the_target_of_a_mesh_with_layers_is_its_shape_as_given():
    mesh = stack()
    target = run_target(mesh, "auto", find_layers(mesh))
    assert (target.name, target.size_weight) == ("given-shape", 0)
    np.testing.assert_array_equal(target.lengths, given_lengths(mesh))


def test_the_target_of_a_tangled_mesh_with_layers_has_one_first_height():
    mesh = scrambled_in_layers(stack(first=1e-3), 0.7)
    layers = find_layers(mesh)
    heights = layers.walls[0].of(run_target(mesh, "auto", layers).lengths)
    np.testing.assert_allclose(heights[:, 0], 1e-3, rtol=0.02)
    np.testing.assert_allclose(heights[:, 1:] / heights[:, :-1], 1.3, rtol=0.02)


def test_a_target_that_the_mesh_has_is_taken_unless_another_is_named():
    own = Target(np.ones((27, 3)), name="own")
    mesh = grid(3).with_element_target(own)
    assert run_target(mesh, "auto", Layers()) is own
    assert run_target(mesh, "ideal", Layers()) is None
    assert run_target(mesh, "given", Layers()).name == "given"


def test_layers_keep_their_lengths_under_another_target():
    base = stack(6, 6, 6, first=0.01, growth=1.3, lateral=0.2)
    layers, own = find_layers(base), given_lengths(base)
    part = Layers((type(layers.walls[0])("plate", layers.walls[0].hexes[:, :3], layers.walls[0].faces[:, :3]),))
    inside = part.hexes
    outside = np.setdiff1d(np.arange(base.n_hexes), inside)
    sized = run_target(base, "0.1", part, 2.0)
    np.testing.assert_array_equal(sized.lengths[inside], own[inside])
    np.testing.assert_array_equal(sized.lengths[outside], 0.1)
    assert (sized.name, sized.size_weight) == ("0.1, layers as given", 2.0)
    cubes = run_target(base, "ideal", part)
    np.testing.assert_array_equal(cubes.lengths[inside], own[inside])
    aspect = np.ptp(np.log(cubes.lengths[outside]), axis=1)
    assert (aspect <= np.ptp(np.log(own[outside]), axis=1) + 1e-12).all()
    np.testing.assert_allclose(cubes.lengths[outside].prod(axis=1), own[outside].prod(axis=1))


# Heights fitted to one first height: stacks keep their thickness, and perfect ones every bit but rounding.


def over_a_bump(mesh, share):
    """Squeeze the stack over a bump of this share of its thickness."""
    x, top = mesh.points[:, 0] / mesh.points[:, 0].max(), mesh.points[:, 2].max()
    bump = share * np.sin(np.pi * x) ** 2
    return mesh.with_points(mesh.points + np.outer(bump * (top - mesh.points[:, 2]), [0, 0, 1]))


@given(growth=st.floats(1.1, 1.5), layers=st.integers(5, 12))
def test_equal_columns_keep_their_heights(growth, layers):
    mesh = stack(layers=layers, first=1e-3, growth=growth)
    lengths = given_lengths(mesh)
    np.testing.assert_allclose(fitted_lengths(lengths, find_layers(mesh)), lengths, rtol=1e-9)


@given(share=st.floats(0.05, 0.4))
def test_squeezed_columns_get_the_first_height_of_the_others_and_keep_their_thickness(share):
    mesh = over_a_bump(stack(24, 6, 14, first=1e-3, growth=1.25, lateral=0.1), share)
    layers, lengths = find_layers(mesh), given_lengths(mesh)
    (wall,) = layers.walls
    before, after = wall.of(lengths), wall.of(fitted_lengths(lengths, layers))
    np.testing.assert_allclose(np.nansum(after, axis=1), np.nansum(before, axis=1), rtol=1e-9)
    np.testing.assert_allclose(after[:, 0], first_height(wall, lengths), rtol=1e-9)
    np.testing.assert_allclose(after[:, 0], 1e-3, rtol=0.02)
    ratios = after[:, 1:] / after[:, :-1]
    np.testing.assert_allclose(ratios, ratios[:, :1] * np.ones(ratios.shape[1]), rtol=1e-6)
    others = given_lengths(mesh)[:, :2]
    np.testing.assert_array_equal(fitted_lengths(lengths, layers)[:, :2], others)


def test_a_wall_without_one_first_height_stays():
    mesh = stack(24, 6, 8, first=1e-3, growth=1.3, lateral=0.1)
    wedge = mesh.points * [1, 1, 0] + mesh.points * [0, 0, 1] * (1 + 4 * mesh.points[:, [0]])
    mesh = mesh.with_points(wedge)
    lengths = given_lengths(mesh)
    np.testing.assert_array_equal(fitted_lengths(lengths, find_layers(mesh)), lengths)
