"""Runs of several methods: one numbering, one clock, one record, whatever the stages do."""

import numpy as np
import pytest

from hexmend import METHODS, Mesh, Outcome, Recipe, Stage, StoppingCriteria, gallery, iterate, smooth
from hexmend.report.records import record, to_json
from tests.core.grids import grid

FEW = StoppingCriteria(max_iterations=4, tolerance=0)


def stage(name, most=4, **parameters):
    return Stage(METHODS[name](**parameters), StoppingCriteria(max_iterations=most, tolerance=0))


@pytest.fixture(scope="module")
def mesh():
    return gallery.make("cube", size=125, scramble=0.5)


def test_the_stages_are_what_the_methods_do_one_after_another(mesh):
    recipe = Recipe.of(stage("getme", 5), stage("local-sd", 3), stage("mend", 6, goal="shape"))
    run = iterate(mesh, recipe)
    whole = [it.points for it in run]
    alone = []
    for one in recipe.stages:
        part = iterate(mesh, one.smoother, one.stop)
        alone += [it.points for it in part]
        mesh = part.result().mesh
    assert len(whole) == len(alone) == 14
    for ours, theirs in zip(whole, alone, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    np.testing.assert_array_equal(run.result().mesh.points, mesh.points)


def test_numbers_seconds_and_history_go_on_and_every_iteration_names_its_stage(mesh):
    run = iterate(mesh, Recipe.of(stage("getme", 3), stage("local-sd", 2)))
    assert (run.start.diagnostics["stage"], run.start.diagnostics["method"]) == (1, "getme")
    seen = [(it.number, it.diagnostics["stage"], it.diagnostics["method"]) for it in run]
    assert seen == [(1, 1, "getme"), (2, 1, "getme"), (3, 1, "getme"), (4, 2, "local-sd"), (5, 2, "local-sd")]
    assert [row["iteration"] for row in run.history] == [0, 1, 2, 3, 4, 5]
    seconds = [row["seconds"] for row in run.history]
    assert seconds == sorted(seconds)
    assert seconds[4] > seconds[3]
    result = run.result()
    assert result.before == iterate(mesh, "laplacian").result().before
    assert result.iterations == 5
    assert result.setup_seconds == sum(one.setup_seconds for one in result.stages)
    assert run.decisions == [
        "Stage 1, GETMe, simultaneous, 3 iterations: Stopped at the iteration limit before it converged."
    ]
    assert run.decisions[0] in result.message


def test_the_report_lists_the_stages(mesh):
    report = record(smooth(mesh, Recipe.of(stage("getme", 3), stage("local-sd", 2, p=3))))
    to_json(report)
    assert (report["method"], report["parameters"]) == ("recipe", {})
    first, second = report["stages"]
    assert (first["method"], first["first"], first["iterations"], first["outcome"]) == ("getme", 0, 3, "max-iterations")
    assert (second["stage"], second["first"], second["iterations"]) == (2, 3, 2)
    assert (second["parameters"]["p"], second["stop"]["max_iterations"]) == (3, 2)
    assert first["seconds"] + second["seconds"] == pytest.approx(report["seconds"])


@pytest.mark.parametrize("idle", [0, 1, 2])
def test_a_stage_that_has_nothing_to_do_is_passed_over(mesh, idle):
    stages = [stage("getme", 2), stage("local-sd", 2), stage("smart-laplacian", 2)]
    stages[idle] = stage("mend", 0)
    run = iterate(mesh, Recipe.of(*stages))
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


def test_a_stage_begins_where_the_one_before_was_best(mesh, monkeypatch):
    monkeypatch.setattr(METHODS["laplacian"], "rank", lambda self, start, now: (now.q.mean() > start.q.mean() + 1e-9,))
    run = iterate(mesh, Recipe.of(stage("laplacian", 3), stage("local-sd", 1)))
    kept = [it.points for it in run][-1]
    expected = next(iterate(mesh, "local-sd")).points  # as every Laplacian step is worse by that rank
    np.testing.assert_array_equal(kept, expected)
    assert run.last.number == 4
    assert run.decisions[0].endswith("Iteration 0 of it was kept.")


def test_nothing_free_ends_all_at_once():
    result = smooth(grid(1), Recipe.of("laplacian", "mend"))
    assert (result.outcome, result.iterations, len(result.stages)) == (Outcome.NOTHING_FREE, 0, 1)


def test_the_most_that_it_can_come_to(mesh):
    run = iterate(mesh, Recipe.of(stage("getme", 3), stage("local-sd", 2)))
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


def test_the_rest_of_a_stage_is_done_by_another_method(mesh):
    run = iterate(mesh, Recipe.of(stage("getme", 5), stage("mend", 1)))
    at = [next(run), next(run)][-1]
    run.switch_method("local-sd")
    rest = list(run)
    assert [(it.number, it.diagnostics["stage"], it.diagnostics["method"]) for it in rest] == [
        (3, 1, "local-sd"), (4, 1, "local-sd"), (5, 1, "local-sd"), (6, 2, "mend"),
    ]  # fmt: skip
    expected = next(iterate(mesh.with_points(at.points), "local-sd")).points
    np.testing.assert_array_equal(rest[0].points, expected)
    assert run.decisions[0] == "After iteration 2: Local steepest descent takes over from GETMe, simultaneous."
    assert [(one.stage, one.method, one.first, one.iterations) for one in run.result().stages] == [
        (1, "getme", 0, 2), (1, "local-sd", 2, 3), (2, "mend", 5, 1),
    ]  # fmt: skip


def test_other_values_on_the_way_and_the_recipe_that_does_it_again(mesh):
    run = iterate(mesh, METHODS["local-sd"](), StoppingCriteria(max_iterations=6, tolerance=0))
    next(run)
    next(run)
    run.switch_method(METHODS["local-sd"](p=4), StoppingCriteria(max_iterations=7, tolerance=0))
    points = [it.points for it in run]
    assert run.decisions == ["After iteration 2: p = 4 instead of 2, max_iterations = 7 instead of 6."]
    assert run.last.number == 7
    result = run.result()
    assert result.method == "recipe"
    assert [one.parameters["p"] for one in result.stages] == [2, 4]
    again = [it.points for it in iterate(mesh, run.recipe)]
    assert len(again) == 7
    for ours, theirs in zip(points, again[2:], strict=True):
        np.testing.assert_array_equal(ours, theirs)


def test_other_limits_alone_do_not_begin_the_method_anew(mesh):
    plain = [it.points for it in iterate(mesh, "mend", StoppingCriteria(max_iterations=8))]
    run = iterate(mesh, "mend", StoppingCriteria(max_iterations=3))
    seen = [next(run).points, next(run).points]
    run.switch_method("mend", StoppingCriteria(max_iterations=8))
    seen += [it.points for it in run]
    for ours, theirs in zip(seen, plain, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    assert run.result().method == "mend"
    assert run.decisions[0] == "After iteration 2: max_iterations = 8 instead of 3."


def test_a_stage_that_has_ended_goes_on_under_new_limits_and_the_next_one_follows(mesh):
    run = iterate(mesh, Recipe.of(stage("getme", 2), stage("local-sd", 1)))
    next(run)
    next(run)
    run.switch_method(METHODS["getme"](relaxation=0.5), StoppingCriteria(max_iterations=3, tolerance=0))
    assert [it.diagnostics["method"] for it in run] == ["getme", "local-sd"]


def test_limits_that_are_passed_already_end_the_stage(mesh):
    run = iterate(mesh, "local-sd", FEW)
    next(run)
    next(run)
    run.switch_method("local-mnr", StoppingCriteria(max_iterations=1))
    assert run.outcome is Outcome.MAX_ITERATIONS
    assert list(run) == []
    with pytest.raises(ValueError, match="the run has ended"):
        run.switch_method("mend")


def test_a_method_that_cannot_be_prepared_leaves_the_run_as_it_was(mesh, monkeypatch):
    def steps(self, mesh: Mesh):
        raise MemoryError
        yield

    run = iterate(mesh, "local-sd", FEW)
    next(run)
    monkeypatch.setattr(METHODS["laplacian"], "steps", steps)
    with pytest.raises(MemoryError):
        run.switch_method(METHODS["laplacian"](update="simultaneous"))
    assert len(list(run)) == 3


def test_the_seconds_that_are_left_are_those_of_the_stage_less_what_it_has_taken(mesh):
    run = iterate(mesh, "laplacian", StoppingCriteria(max_iterations=50, max_seconds=1000))
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


def test_one_limit_leaves_the_others_of_each_stage_and_all_are_those_of_a_stop_that_is_given(mesh):
    recipe = Recipe.of(stage("getme", 9), Stage(METHODS["mend"](), StoppingCriteria(tolerance=1e-3, keep_last=True)))
    stops = [one.stop for one in iterate(mesh, recipe, max_iterations=2).recipe.stages]
    assert stops == [
        StoppingCriteria(max_iterations=2, tolerance=0),
        StoppingCriteria(max_iterations=2, tolerance=1e-3, keep_last=True),
    ]
    stops = [one.stop for one in iterate(mesh, recipe, StoppingCriteria(tolerance=0.5), max_iterations=2).recipe.stages]
    assert stops == [StoppingCriteria(max_iterations=2, tolerance=0.5)] * 2
