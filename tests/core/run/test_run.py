"""The loop: records, stop conditions, outcomes."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from hexmend import (
    METHODS,
    Mesh,
    Outcome,
    ParameterError,
    Recipe,
    Run,
    Smoother,
    Stage,
    Step,
    StoppingCriteria,
    advise,
    gallery,
    iterate,
    measure,
    smooth,
    summarise,
)
from hexmend.gallery import make
from hexmend.iteration.figures import HISTORY
from hexmend.layers import find_layers, grading_message
from hexmend.report.records import record, to_json, write_history, write_json
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


# Runs of several methods: one numbering, one clock, one record, whatever the stages do.


FEW = StoppingCriteria(max_iterations=4, tolerance=0)


def stage(name, most=4, **parameters):
    return Stage(METHODS[name](**parameters), StoppingCriteria(max_iterations=most, tolerance=0))


@pytest.fixture(scope="module")
def scrambled_mesh():
    return gallery.make("cube", size=125, scramble=0.5)


def test_the_stages_are_what_the_methods_do_one_after_another(scrambled_mesh):
    recipe = Recipe.of(stage("getme", 5), stage("local-sd", 3), stage("mend", 6, goal="shape"))
    run = iterate(scrambled_mesh, recipe)
    whole = [it.points for it in run]
    alone = []
    for one in recipe.stages:
        part = iterate(scrambled_mesh, one.smoother, one.stop)
        alone += [it.points for it in part]
        scrambled_mesh = part.result().mesh
    assert len(whole) == len(alone) == 14
    for ours, theirs in zip(whole, alone, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    np.testing.assert_array_equal(run.result().mesh.points, scrambled_mesh.points)


def test_numbers_seconds_and_history_go_on_and_every_iteration_names_its_stage(scrambled_mesh):
    run = iterate(scrambled_mesh, Recipe.of(stage("getme", 3), stage("local-sd", 2)))
    assert (run.start.diagnostics["stage"], run.start.diagnostics["method"]) == (1, "getme")
    seen = [(it.number, it.diagnostics["stage"], it.diagnostics["method"]) for it in run]
    assert seen == [(1, 1, "getme"), (2, 1, "getme"), (3, 1, "getme"), (4, 2, "local-sd"), (5, 2, "local-sd")]
    assert [row["iteration"] for row in run.history] == [0, 1, 2, 3, 4, 5]
    seconds = [row["seconds"] for row in run.history]
    assert seconds == sorted(seconds)
    assert seconds[4] > seconds[3]
    result = run.result()
    assert result.before == iterate(scrambled_mesh, "laplacian").result().before
    assert result.iterations == 5
    assert result.setup_seconds == sum(one.setup_seconds for one in result.stages)
    assert run.decisions == [
        "Stage 1, GETMe, simultaneous, 3 iterations: Stopped at the iteration limit before it converged."
    ]
    assert run.decisions[0] in result.message


def test_the_report_lists_the_stages(scrambled_mesh):
    report = record(smooth(scrambled_mesh, Recipe.of(stage("getme", 3), stage("local-sd", 2, p=3))))
    to_json(report)
    assert (report["method"], report["parameters"]) == ("recipe", {})
    first, second = report["stages"]
    assert (first["method"], first["first"], first["iterations"], first["outcome"]) == ("getme", 0, 3, "max-iterations")
    assert (second["stage"], second["first"], second["iterations"]) == (2, 3, 2)
    assert (second["parameters"]["p"], second["stop"]["max_iterations"]) == (3, 2)
    assert first["seconds"] + second["seconds"] == pytest.approx(report["seconds"])


@pytest.mark.parametrize("idle", [0, 1, 2])
def test_a_stage_that_has_nothing_to_do_is_passed_over(scrambled_mesh, idle):
    stages = [stage("getme", 2), stage("local-sd", 2), stage("smart-laplacian", 2)]
    stages[idle] = stage("mend", 0)
    run = iterate(scrambled_mesh, Recipe.of(*stages))
    assert [it.number for it in run] == [1, 2, 3, 4]
    assert run.outcome is Outcome.MAX_ITERATIONS
    assert [one.iterations for one in run.result().stages] == [0 if number == idle else 2 for number in range(3)]


def test_a_stage_that_cannot_step_is_passed_over():
    tangled = gallery.make("cube", size=125, scramble=2.0)
    run = iterate(tangled, Recipe.of(METHODS["global-sd"](delta=0.0), "mend"))  # on tangled hexes delta = 0 is infinite
    assert next(run).number == 1
    for _ in run:
        pass
    assert [(one.outcome, one.iterations > 0) for one in run.result().stages] == [
        (Outcome.NO_DESCENT, False),
        (Outcome.CONVERGED, True),
    ]
    assert run.result().after.inverted == 0


def test_a_stage_begins_where_the_one_before_was_best(scrambled_mesh, monkeypatch):
    monkeypatch.setattr(METHODS["laplacian"], "rank", lambda self, start, now: (now.q.mean() > start.q.mean() + 1e-9,))
    run = iterate(scrambled_mesh, Recipe.of(stage("laplacian", 3), stage("local-sd", 1)))
    kept = [it.points for it in run][-1]
    expected = next(iterate(scrambled_mesh, "local-sd")).points  # as every Laplacian step is worse by that rank
    np.testing.assert_array_equal(kept, expected)
    assert run.last.number == 4
    assert run.decisions[0].endswith("Iteration 0 of it was kept.")


def test_nothing_free_ends_all_at_once():
    result = smooth(grid(1), Recipe.of("laplacian", "mend"))
    assert (result.outcome, result.iterations, len(result.stages)) == (Outcome.NOTHING_FREE, 0, 1)


def test_the_most_that_it_can_come_to(scrambled_mesh):
    run = iterate(scrambled_mesh, Recipe.of(stage("getme", 3), stage("local-sd", 2)))
    assert (run.max_iterations, run.stage_number, run.stage_count) == (5, 1, 2)
    for _ in run:
        assert run.max_iterations == 5
    assert run.stage_number == 2
    short = iterate(
        grid(3), Recipe.of(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=100)), stage("mend", 2))
    )
    next(short)
    assert short.stage == short.recipe.stages[0]
    assert short.max_iterations == 1 + 2  # a perfect grid: the first stage has converged


def test_the_rest_of_a_stage_is_done_by_another_method(scrambled_mesh):
    run = iterate(scrambled_mesh, Recipe.of(stage("getme", 5), stage("mend", 1)))
    at = [next(run), next(run)][-1]
    run.switch_method("local-sd")
    rest = list(run)
    assert [(it.number, it.diagnostics["stage"], it.diagnostics["method"]) for it in rest] == [
        (3, 1, "local-sd"), (4, 1, "local-sd"), (5, 1, "local-sd"), (6, 2, "mend"),
    ]  # fmt: skip
    expected = next(iterate(scrambled_mesh.with_points(at.points), "local-sd")).points
    np.testing.assert_array_equal(rest[0].points, expected)
    assert run.decisions[0] == "After iteration 2: Local steepest descent takes over from GETMe, simultaneous."
    assert [(one.stage, one.method, one.first, one.iterations) for one in run.result().stages] == [
        (1, "getme", 0, 2), (1, "local-sd", 2, 3), (2, "mend", 5, 1),
    ]  # fmt: skip


def test_other_values_on_the_way_and_the_recipe_that_does_it_again(scrambled_mesh):
    run = iterate(scrambled_mesh, METHODS["local-sd"](), StoppingCriteria(max_iterations=6, tolerance=0))
    next(run)
    next(run)
    run.switch_method(METHODS["local-sd"](p=4), StoppingCriteria(max_iterations=7, tolerance=0))
    points = [it.points for it in run]
    assert run.decisions == ["After iteration 2: p = 4 instead of 2, max_iterations = 7 instead of 6."]
    assert run.last.number == 7
    result = run.result()
    assert result.method == "recipe"
    assert [one.parameters["p"] for one in result.stages] == [2, 4]
    again = [it.points for it in iterate(scrambled_mesh, run.recipe)]
    assert len(again) == 7
    for ours, theirs in zip(points, again[2:], strict=True):
        np.testing.assert_array_equal(ours, theirs)


def test_other_limits_alone_do_not_begin_the_method_anew(scrambled_mesh):
    plain = [it.points for it in iterate(scrambled_mesh, "mend", StoppingCriteria(max_iterations=8))]
    run = iterate(scrambled_mesh, "mend", StoppingCriteria(max_iterations=3))
    seen = [next(run).points, next(run).points]
    run.switch_method("mend", StoppingCriteria(max_iterations=8))
    seen += [it.points for it in run]
    for ours, theirs in zip(seen, plain, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    assert run.result().method == "mend"
    assert run.decisions[0] == "After iteration 2: max_iterations = 8 instead of 3."


def test_a_stage_that_has_ended_goes_on_under_new_limits_and_the_next_one_follows(scrambled_mesh):
    run = iterate(scrambled_mesh, Recipe.of(stage("getme", 2), stage("local-sd", 1)))
    next(run)
    next(run)
    run.switch_method(METHODS["getme"](relaxation=0.5), StoppingCriteria(max_iterations=3, tolerance=0))
    assert [it.diagnostics["method"] for it in run] == ["getme", "local-sd"]


def test_limits_that_are_passed_already_end_the_stage(scrambled_mesh):
    run = iterate(scrambled_mesh, "local-sd", FEW)
    next(run)
    next(run)
    run.switch_method("local-mnr", StoppingCriteria(max_iterations=1))
    assert run.outcome is Outcome.MAX_ITERATIONS
    assert list(run) == []
    with pytest.raises(ValueError, match="the run has ended"):
        run.switch_method("mend")


def test_a_method_that_cannot_be_prepared_leaves_the_run_as_it_was(scrambled_mesh, monkeypatch):
    def steps(self, scrambled_mesh: Mesh):
        raise MemoryError
        yield

    run = iterate(scrambled_mesh, "local-sd", FEW)
    next(run)
    monkeypatch.setattr(METHODS["laplacian"], "steps", steps)
    with pytest.raises(MemoryError):
        run.switch_method(METHODS["laplacian"](update="simultaneous"))
    assert len(list(run)) == 3


def test_the_seconds_that_are_left_are_those_of_the_stage_less_what_it_has_taken(scrambled_mesh):
    run = iterate(scrambled_mesh, "laplacian", StoppingCriteria(max_iterations=50, max_seconds=1000))
    for _ in range(3):
        next(run)
    assert run.recipe.stages[0].stop.max_seconds == 1000
    run.switch_method("local-sd")
    spent = run.last.seconds + run.setup_seconds
    next(run)
    cut, rest = run.recipe.stages
    assert (cut.stop.max_seconds, rest.stop.max_seconds) == (1000, pytest.approx(1000 - spent, rel=1e-2))
    assert (cut.stop.max_iterations, rest.stop.max_iterations) == (3, 47)
    run.switch_method("local-nr", StoppingCriteria(max_seconds=1e-9, max_iterations=2))
    assert run.recipe.stages[-1].stop.max_seconds == 1e-3  # 0 would be no limit
    assert run.recipe.stages[-1].stop.max_iterations == 0


def test_one_limit_leaves_the_others_of_each_stage_and_all_are_those_of_a_stop_that_is_given(scrambled_mesh):
    recipe = Recipe.of(stage("getme", 9), Stage(METHODS["mend"](), StoppingCriteria(tolerance=1e-3, keep_last=True)))
    stops = [one.stop for one in iterate(scrambled_mesh, recipe, max_iterations=2).recipe.stages]
    assert stops == [
        StoppingCriteria(max_iterations=2, tolerance=0),
        StoppingCriteria(max_iterations=2, tolerance=1e-3, keep_last=True),
    ]
    stops = [
        one.stop
        for one in iterate(scrambled_mesh, recipe, StoppingCriteria(tolerance=0.5), max_iterations=2).recipe.stages
    ]
    assert stops == [StoppingCriteria(max_iterations=2, tolerance=0.5)] * 2
