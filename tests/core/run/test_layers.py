"""Runs on meshes with layers: they are kept unless another target is asked for, and their loss is said everywhere."""

import numpy as np
import pytest

from hexmend import METHODS, Recipe, Run, Stage, advise, gallery, measure, smooth
from hexmend.layers import find_layers, grading_message
from hexmend.report.records import record
from hexmend.target import given_lengths
from tests.core.grids import grid, scrambled
from tests.core.layers.stacks import scrambled_in_layers, stack

LOSS = "The layers at 'plate' lose their grading: first height 0.01"


def bent(mesh):
    """Shift the inner nodes of a stack along the wall, so that its hexes are sheared."""
    x, y, z = (mesh.points / mesh.points.max(axis=0)).T
    shear = 0.03 * np.sin(np.pi * x) * np.sin(np.pi * y) * np.sin(np.pi * z)
    return mesh.with_points(mesh.points + np.outer(shear, [1, 0, 0]))


def first_heights(mesh):
    (wall,) = find_layers(stack()).walls
    return wall.of(given_lengths(mesh))[:, 0]


def test_layers_are_kept_by_default_and_it_is_said():
    result = smooth(bent(stack()))
    np.testing.assert_allclose(first_heights(result.mesh), 0.01, rtol=0.06)
    assert result.mesh.element_target.name == "given-shape"
    assert "Boundary layers at 'plate' are kept." in result.message
    assert "layers" not in result.worse
    (wall,) = result.layers
    assert (wall.wall, wall.faces, wall.layers, wall.lost) == ("plate", 100, 8, False)
    assert wall.after.growth == pytest.approx(1.3, rel=0.01)
    assert wall.after.angle_max < wall.before.angle_max


@pytest.mark.parametrize("settings", [{"target": "ideal"}, {"layers": "free"}])
def test_their_loss_is_said_in_the_same_words_everywhere(settings):
    result = smooth(bent(stack()), **settings)
    assert result.mesh.element_target is None
    assert result.worse[-1] == "layers"
    (wall,) = result.layers
    assert wall.lost
    assert wall.loss.startswith(LOSS.replace("The", "the"))
    assert wall.loss.endswith("; --target given-shape keeps them")
    said = f"T{wall.loss[1:]}."
    assert said in result.message
    assert said in advise(result).regressions
    report = record(result)
    assert report["layers"] == [wall.to_dict()]
    assert report["worse"][-1] == "layers"
    assert "target" not in report


def test_layers_are_not_said_to_be_kept_under_targets_that_lose_them():
    result = smooth(bent(stack()), target="given-size", goal="shape")
    assert result.mesh.element_target.name == "given-size"
    assert "--target given-shape keeps them" in result.message
    assert "are kept" not in result.message


def test_a_tangled_stack_is_mended_with_its_heights():
    result = smooth(scrambled_in_layers(stack(), 0.7))
    assert result.after.inverted == 0
    np.testing.assert_allclose(first_heights(result.mesh), 0.01, rtol=0.05)


def test_later_stages_have_the_target_of_the_mesh_as_given():
    mesh = bent(stack())
    recipe = Recipe.of(Stage(METHODS["laplacian"]()), Stage(METHODS["mend"](target="given-shape")))
    run = Run(mesh, recipe)
    for _ in run:
        pass
    alone = smooth(mesh, target="given-shape")
    np.testing.assert_array_equal(run.result().mesh.element_target.lengths, alone.mesh.element_target.lengths)


def test_a_method_that_takes_over_has_its_own_target():
    run = Run(bent(stack()), METHODS["mend"](target="ideal"))
    next(run)
    run.switch_method(METHODS["mend"](target="given-size"))
    assert run.result().mesh.element_target.name == "given-size"


def test_meshes_without_layers_have_no_target_and_no_report():
    result = smooth(scrambled(grid(4), 0.3))
    assert (result.layers, result.mesh.element_target) == ((), None)
    assert "layers" not in record(result)
    assert "Edge lengths" not in result.message


def test_a_great_change_of_edge_lengths_is_said():
    places = np.array([0, 1, 3, 6, 10, 14, 17, 19, 20]) / 20
    mesh = grid(8)
    graded = mesh.with_points(places[mesh.points.astype(int)])
    uniform = mesh.with_points(mesh.points / 8)
    assert grading_message(graded, uniform, measure(graded.points, graded.hexes)) == (
        "Edge lengths change by up to a factor of 2.5; --target given-shape keeps them."
    )
    assert grading_message(uniform, scrambled(uniform, 0.02), measure(uniform.points, uniform.hexes)) == ""
    tangled = scrambled(uniform, 0.1)
    assert grading_message(tangled, uniform, measure(tangled.points, tangled.hexes)) == ""


@pytest.mark.slow
def test_scrambled_layers_of_the_gallery_come_back():
    sound = gallery.make("layered", size=4000)
    result = smooth(gallery.make("layered", size=4000, scramble=0.6))
    (wall,) = result.layers
    assert result.after.inverted == 0
    assert wall.after.first_height_mean == pytest.approx(1e-4, rel=0.01)
    assert wall.after.growth == pytest.approx(1.2, rel=0.02)
    assert result.after.scaled_jacobian_min > smooth(sound, max_iterations=0).after.scaled_jacobian_min - 1e-3


def test_a_recipe_tells_of_all_its_stages_whether_they_keep_layers():
    assert Run(stack(), Recipe.of("laplacian", "mend")).layers_message.endswith("are kept in some stages only.")
    assert Run(stack(), Recipe.of("mend", "local-nr")).layers_message.endswith("are kept.")
    assert Run(stack(), Recipe.of("laplacian", "getme")).layers_message.endswith("are not kept.")


@pytest.mark.parametrize("method", ["mend", "laplacian"])
def test_a_tangled_mesh_that_does_not_move_loses_no_layers(method):
    result = smooth(scrambled_in_layers(stack(), 0.7), method, max_iterations=0)
    assert "lose" not in result.message
    assert "layers" not in result.worse
    (wall,) = result.layers
    assert wall.after.first_height_mean == pytest.approx(wall.before.first_height_mean)
