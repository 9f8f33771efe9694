"""The loop: records, stop conditions, outcomes."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from hexmend import (
    METHODS,
    Outcome,
    ParameterError,
    Recipe,
    Run,
    Smoother,
    Stage,
    Step,
    advise,
    gallery,
    measure,
    smooth,
    summarise,
)
from hexmend.gallery import make
from hexmend.iteration.figures import HISTORY
from hexmend.layers import find_layers, grading_message
from hexmend.report.records import record, to_json, write_history, write_json
from hexmend.run import StoppingCriteria, iterate
from hexmend.target import given_lengths
from tests.core.grids import displaced, grid, scrambled
from tests.core.layers.stacks import scrambled_in_layers, stack


@pytest.fixture(scope="module")
def mesh():
    return make("cube", size=125, scramble=0.5)


def test_history_has_a_row_an_iteration_and_one_before(mesh):
    result = smooth(mesh, "local-sd")
    assert result.outcome is Outcome.CONVERGED
    assert [row["iteration"] for row in result.history] == list(range(result.iterations + 1))
    assert set(result.history[0]) == {*HISTORY, "objective_formula"}
    assert result.history[0]["inverted"] == result.before.inverted > 0
    assert result.history[0]["objective"] is None
    assert result.history[-1]["objective"] == result.after.objective
    assert result.history[0]["scaled_jacobian_min"] == result.before.scaled_jacobian_min < 0
    assert result.history[-1]["scaled_jacobian_min"] == result.after.scaled_jacobian_min
    assert result.history[-1]["largest_move"] < 1e-4 <= result.history[-2]["largest_move"]
    seconds = [row["seconds"] for row in result.history]
    assert seconds == sorted(seconds)
    assert result.seconds == seconds[-1]
    assert "Converged" in result.message
    assert "no hex is invalid" in result.message


@pytest.mark.parametrize("most", [0, 4])
def test_the_iteration_limit_is_kept(mesh, most):
    result = smooth(mesh, "local-sd", StoppingCriteria(max_iterations=most, tolerance=0))
    assert result.iterations == most
    assert result.outcome is Outcome.MAX_ITERATIONS


@pytest.mark.parametrize(("limit", "count"), [(10, 0), (10.5, 1), (13, 3)])
def test_the_time_limit_counts_the_preparations_and_ends_after_the_iteration_at_hand(mesh, monkeypatch, limit, count):
    clock = [0.0]

    def steps(self, mesh):
        clock[0] += 10
        yield Step(mesh.points)
        while True:
            clock[0] += 1
            yield Step(mesh.points)

    monkeypatch.setattr(METHODS["laplacian"], "steps", steps)
    monkeypatch.setattr("hexmend.run.stage_run.perf_counter", lambda: clock[0])
    result = smooth(mesh, "laplacian", StoppingCriteria(max_seconds=limit, tolerance=0))
    assert result.iterations == count
    assert result.outcome is Outcome.MAX_SECONDS
    assert (result.seconds, result.setup_seconds) == (count, 10)


def test_a_mesh_with_nothing_free_is_said():
    result = smooth(grid(1), "laplacian")
    assert result.outcome is Outcome.NOTHING_FREE
    assert result.iterations == 0


def test_closing_early_keeps_what_was_reached(mesh):
    run = iterate(mesh, "local-sd")
    first = next(run)
    run.close()
    assert list(run) == []
    result = run.result()
    assert result.outcome is Outcome.STOPPED
    assert result.iterations == 1
    np.testing.assert_array_equal(result.mesh.points, first.points)


def test_watching_can_end_the_run(mesh):
    assert smooth(mesh, "local-sd", watch=lambda it: it.number < 3).iterations == 3


def test_iterations_are_read_only_and_carry_their_figures(mesh):
    for it in iterate(mesh, "laplacian", StoppingCriteria(max_iterations=2)):
        with pytest.raises(ValueError, match="read-only"):
            it.points[0] = 0
        assert it.quality.q.shape == (mesh.n_hexes,)
        assert it.row()["q_min"] == it.quality.q.min()


def test_unknown_methods_and_wrong_limits_are_said(mesh):
    with pytest.raises(ParameterError, match="did you mean laplacian"):
        iterate(mesh, "laplacain")
    with pytest.raises(ParameterError, match="tolerance = -1 is out of range"):
        StoppingCriteria(tolerance=-1)


def test_reports_are_complete_and_strict(mesh, tmp_path):
    result = smooth(mesh, "local-sd", StoppingCriteria(max_iterations=3))
    report = record(result)
    assert set(report) == {
        "method", "parameters", "outcome", "message", "worse", "iterations", "kept", "seconds", "setup_seconds", "before",
        "after", "history",
    }  # fmt: skip
    assert report["outcome"] == "max-iterations"
    assert "NaN" not in to_json(report)
    with pytest.raises(ValueError, match="not JSON compliant"):
        to_json({"q": math.inf})
    write_json(tmp_path / "report.json", report)
    write_history(tmp_path / "history.csv", result)
    rows = (tmp_path / "history.csv").read_text().splitlines()
    assert rows[0] == ",".join(HISTORY)
    assert len(rows) == 1 + 4


def test_an_optimiser_beside_the_barrier_has_not_converged_however_short_its_steps():
    mesh = grid(3)
    inner = np.flatnonzero(mesh.free)[0]

    def pushed(by):
        return displaced(mesh, inner, -by)

    sound, inverted = 0.0, 1.0  # as far as it goes before a hex is flat
    while inverted - sound > 1e-7:
        half = (sound + inverted) / 2
        sound, inverted = (sound, half) if measure(pushed(half).points, mesh.hexes).n_inverted else (half, inverted)
    assert summarise(pushed(sound)).objective > 1e6
    for method in ("global-nr", "global-mnr", "local-sd", "local-nr", "local-mnr"):
        result = smooth(pushed(sound), method)
        assert result.outcome is Outcome.CONVERGED
        assert result.after.q_min > 0.99, method


@dataclass(frozen=True)
class Spoils(Smoother):
    """Moves well twice, then gives a coordinate that is no number."""

    name = "spoils"
    title = help = source = "A test"

    def steps(self, mesh):
        points = mesh.points
        yield Step(points)
        for k in range(3):
            points = points.copy()
            points[mesh.free] += 1e-3
            if k == 2:
                points[np.flatnonzero(mesh.free)[0], 1] = np.nan
            yield Step(points)


def test_a_step_that_is_no_number_ends_the_run_and_the_last_good_one_is_kept():
    mesh = scrambled(grid(3), 0.1)
    result = smooth(mesh, Spoils(), StoppingCriteria(keep_last=True, tolerance=0))
    assert result.outcome is Outcome.NOT_FINITE
    assert result.iterations == 2
    assert np.isfinite(result.mesh.points).all()
    assert "not finite" in result.message


@pytest.mark.parametrize(
    ("inverted", "said"), [(0, "no hex is invalid"), (1, "1 hex still inverted"), (2, "2 hexes still inverted")]
)
def test_the_message_counts_iterations_and_inverted_hexes(inverted, said):
    """Corners of the solid, whose nodes are all fixed, are pushed in."""
    mesh = make("cube", size=64)
    points = mesh.points.copy()
    ends = [int((sign * points.sum(axis=1)).argmax()) for sign in (1, -1)][:inverted]
    points[ends] += 0.7 * (points.mean(axis=0) - points[ends])
    run = iterate(mesh.with_points(points), "laplacian", StoppingCriteria(max_iterations=2, tolerance=0))
    assert said in run.message
    assert "moved nodes" not in run.message
    assert run.message.startswith("Running. 0 iterations in 0 s; ")
    next(run)
    assert f"1 iteration in {run.last.seconds:.3g} s; " in run.message
    list(run)
    assert run.message.startswith(Outcome.MAX_ITERATIONS.value + " 2 iterations in ")


def test_the_message_of_a_run_that_a_limit_ended_names_the_longest_move_of_the_last_iteration():
    run = iterate(make("cube", size=64, scramble=0.2), "laplacian", StoppingCriteria(max_iterations=2, tolerance=0))
    list(run)
    assert f"; the last one moved nodes by up to {run.last.largest_move:.2g} mean edge lengths; " in run.message


def test_the_message_of_a_run_whose_last_step_goes_back_to_its_result_names_no_move():
    mesh, random = grid(2, 2, 3), np.random.default_rng(1)
    run = iterate(mesh.with_points(mesh.points + random.uniform(-0.6, 0.6, mesh.points.shape)), "mend", goal="shape")
    list(run)
    assert run.outcome is Outcome.CONVERGED
    assert run.last.largest_move > 0.1
    assert "moved nodes" not in run.message


# Runs on meshes with layers: they are kept unless another target is asked for, and their loss is said everywhere.


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
