"""When a run has converged: by the way of a node or by its greatest coordinate, and never while a stage is to come."""

import dataclasses
import json
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import (
    METHODS,
    Outcome,
    Recipe,
    Smoother,
    Stage,
    Step,
    StoppingCriteria,
    compare,
    io,
    iterate,
    measure,
    smooth,
)
from hexmend.cli.main import main
from hexmend.energy import ObjectiveNorm, energies
from hexmend.gallery import GALLERY, make
from hexmend.quality import REGRESSION_KEYS, SUMMARY_QUANTITIES, describe_regressions, objective, regressions, summarise
from hexmend.quality.regressions import WORSE_BY
from hexmend.report.comparison import comparison_rows, record_table
from hexmend.run.recipe import from_toml, to_toml
from hexmend.smoothers.base_optimiser import ObjectiveSmoother
from tests.core.grids import grid, scrambled
from tests.core.smoothers.mend.test_mend import with_locked_corner

MIDDLE = 13  # of a grid of 2 x 2 x 2


@dataclass(frozen=True)
class Shifts(Smoother):
    """Moves the node in the middle by (3, 4, 0) twentieths, then by a tenth of that, and so on."""

    name = "shifts"
    title = help = source = "shifts"
    more_until: int = 0
    infeasible_until: int = 0

    def steps(self, mesh):
        points = mesh.points
        yield Step(points)
        for number in range(20):
            points = points.copy()
            points[MIDDLE] += np.array([3.0, 4.0, 0.0]) / 20 * 0.1**number * (-1) ** number
            yield Step(points, intermediate=number < self.more_until, infeasible=number < self.infeasible_until)


@pytest.mark.parametrize(("move", "tolerance", "iterations"), [
    ("length", 0.26, 1), ("length", 0.24, 2), ("length", 0.21, 2), ("length", 0.026, 2), ("length", 0.024, 3),
    ("coordinate", 0.21, 1), ("coordinate", 0.19, 2), ("coordinate", 0.16, 2), ("coordinate", 0.019, 3),
])  # fmt: skip
def test_what_is_compared_with_the_tolerance_is_the_way_or_the_greatest_change_of_a_coordinate(
    move, tolerance, iterations
):
    result = smooth(grid(2), Shifts(), StoppingCriteria(move=move, tolerance=tolerance))
    assert result.outcome is Outcome.CONVERGED
    assert len(result.history) == iterations + 1
    assert result.history[1]["largest_move"] == pytest.approx(0.25)  # the way, whatever ends the run


def test_moves_alone_end_an_optimiser_whose_objective_still_falls():
    mesh = make("five-side", size=1000)
    stop = StoppingCriteria(tolerance=0.05, max_iterations=100)
    by_both, by_moves = (smooth(mesh, "global-sd", replace(stop, moves_only=alone)) for alone in (False, True))
    assert by_moves.outcome is Outcome.CONVERGED
    assert by_moves.iterations < by_both.iterations
    assert by_moves.history[-1]["largest_move"] < stop.tolerance


def test_a_run_has_not_converged_while_another_stage_is_to_come():
    assert len(smooth(grid(2), Shifts(more_until=3), StoppingCriteria(tolerance=1.0)).history) == 5


def test_a_infeasible_is_no_result():
    result = smooth(grid(2), Shifts(infeasible_until=20), StoppingCriteria(tolerance=1e-3))
    np.testing.assert_array_equal(result.mesh.points, grid(2).points)


def test_a_tolerance_that_is_reached_exactly_is_not_enough():
    mesh = grid(2)
    moved = mesh.points[MIDDLE] + np.array([3.0, 4.0, 0.0]) / 20 - mesh.points[MIDDLE]
    way = float(np.sqrt(np.square(moved).sum())) / mesh.mean_edge_length
    assert len(smooth(mesh, Shifts(), StoppingCriteria(tolerance=way)).history) == 3


@pytest.mark.parametrize("goal", ["shape", "scaled-jacobian"])
def test_the_start_is_worse_than_itself_in_nothing(goal):
    mesh = grid(2)
    points = mesh.points.copy()
    points[MIDDLE] += 0.2
    figures = measure(points, mesh.elements)
    *counts, harmed, last = METHODS["mend"](goal=goal).rank(figures, figures)
    assert [*counts, bool(harmed)] == [False, False, 0, 0, False]
    assert goal != "shape" or not last
    worse = points.copy()
    worse[MIDDLE] += 0.1
    of_worse = METHODS["mend"](goal=goal).rank(figures, measure(worse, mesh.elements))
    assert of_worse > (*counts, harmed, last)


@dataclass(frozen=True)
class Decides(Smoother):
    """Scrambles a grid less, then more, and says of each step what it has decided."""

    name = "decides"
    title = help = source = "decides"
    words: tuple[str, ...] = ("First.", "Second.")

    def steps(self, mesh):
        yield Step(mesh.points)
        for word, amplitude in zip(self.words, (0.1, 0.3), strict=True):
            points = mesh.points.copy()
            points[MIDDLE] = 1 + amplitude
            yield Step(points, decision=word)


@pytest.mark.parametrize(("words", "keep_last", "said", "not_said"), [
    (("First.", "Second."), True, ["First.", "Second."], []),
    (("First.", "Second."), False, ["First."], ["Second."]),  # that is said of an iterate that is not kept
    (("First.", ""), False, ["First."], []),
])  # fmt: skip
def test_what_was_decided_is_told_but_of_an_iterate_that_is_not_kept(words, keep_last, said, not_said):
    mesh = grid(2)
    points = mesh.points.copy()
    points[MIDDLE] += 0.2
    result = smooth(
        mesh.with_points(points), Decides(words), StoppingCriteria(keep_last=keep_last, max_iterations=2, tolerance=0)
    )
    assert (abs(result.mesh.points[MIDDLE, 0] - 1.1) < 1e-12) != keep_last
    assert all(word in result.message for word in said)
    assert not any(word in result.message for word in not_said)


def test_the_iteration_limit_is_that_of_the_method_unless_one_is_given():
    laplacian, mend = METHODS["laplacian"](), METHODS["mend"]()
    assert [StoppingCriteria().limit_of(method) for method in (laplacian, mend)] == [300, 5000]
    assert [StoppingCriteria(max_iterations=7).limit_of(method) for method in (laplacian, mend)] == [7, 7]
    endless = StoppingCriteria(tolerance=0)
    recipe = Recipe.of(Stage(laplacian, endless), Stage(mend, StoppingCriteria(max_iterations=5)))
    run = iterate(scrambled(grid(3), 0.1, 0), recipe)
    assert run.max_iterations == 305
    run.switch_method(mend)
    assert run.max_iterations == 5005


# The objective that runs record, show and stop by is the one that the method at work minimises.


OPTIMISERS = [name for name, cls in METHODS.items() if issubclass(cls, ObjectiveSmoother)]
POWERS = [ObjectiveNorm(p, offset) for p in (1.0, 2.0, 4.0) for offset in (0.0, 1.0)]


@pytest.fixture(scope="module")
def mesh():
    return make("five-side", size=300, scramble=0.3)


def of_points(mesh, points, norm):
    """The objective as the kernels of the optimisers have it."""
    return np.power(energies(points, mesh.hexes, offset=norm.offset), norm.p).sum()


@pytest.mark.parametrize(("name", "norm"), [(name, POWERS[k % len(POWERS)]) for k, name in enumerate(OPTIMISERS)])
def test_the_recorded_objective_is_that_of_the_method_and_never_rises(mesh, name, norm):
    shape = {"goal": "shape"} if name == "mend" else {}  # other goals pass through worse objectives
    method = METHODS[name](p=norm.p, offset=norm.offset, **shape)
    run = iterate(mesh, method, StoppingCriteria(max_iterations=25))
    values = []
    for it in run:
        if it.quality.n_inverted == 0:
            assert it.objective == pytest.approx(of_points(mesh, it.points, norm), rel=1e-12)
            values.append(run.history[-1]["objective"])
    assert len(values) > 2
    assert values[-1] < values[0]
    assert all(later <= before * (1 + 1e-12) for before, later in pairwise(values))


@pytest.mark.parametrize("name", [name for name in METHODS if name not in OPTIMISERS])
def test_methods_that_minimise_nothing_record_the_default_objective(mesh, name):
    result = smooth(mesh, name, StoppingCriteria(max_iterations=3, keep_last=True))
    assert result.history[-1]["objective"] == result.after.objective


@pytest.mark.parametrize("norm", POWERS[1::3], ids=lambda norm: norm.formula)
def test_a_run_goes_on_for_as_long_as_the_objective_of_its_method_falls(norm):
    mesh = make("five-side", size=300)
    stop = StoppingCriteria(tolerance=1.0)  # every step is short enough: only the objective keeps it going
    result = smooth(mesh, METHODS["local-sd"](p=norm.p, offset=norm.offset), stop)
    assert result.outcome is Outcome.CONVERGED
    least = norm.cube_value * mesh.n_hexes
    values = [row["objective"] - least for row in result.history]
    falls = [
        before - now > max(1e-3 * before, 1e-2 * (norm.contribution(1.0) - norm.cube_value))
        for before, now in pairwise(values)
    ]
    assert falls == [True] * (len(falls) - 1) + [False]


def test_a_table_compares_methods_by_one_objective_and_names_it(mesh):
    methods = ["laplacian", METHODS["local-sd"](offset=0.0), METHODS["mend"](p=4.0)]
    answer = compare(mesh, methods, StoppingCriteria(max_iterations=10, keep_last=True))
    record = answer.record()
    norm = ObjectiveNorm(2.0, 0.0)  # of the first that minimises something
    meshes = [mesh, *(row.mesh for row in answer.rows)]
    for row, one in zip(comparison_rows(record), meshes, strict=True):
        assert row["objective"] == objective(measure(one.points, one.hexes), *norm)
        assert row["objective_formula"] == "Σ η², offset 0"
    table = record_table(record)
    assert "objective Σ η², offset 0" in [line[0] for line in table.rows]
    heuristics = record_table(compare(mesh, ["laplacian"], StoppingCriteria(max_iterations=2)).record())
    assert "objective Σ η²" in [line[0] for line in heuristics.rows]


# Which iterate a run keeps, and that it says what is worse: no method ends worse silently.


SHORT = StoppingCriteria(max_iterations=12)
LAST = StoppingCriteria(max_iterations=12, keep_last=True)

#: By how much the least q(H) of an optimiser's result may be lower than at the start: what four decimals do not tell.
SLACK = 0.5e-4


@pytest.fixture(scope="module")
def bridge():
    """A sound mesh in which Laplacian smoothing inverts hexes."""
    return make("bridge-sharp", size=864)


def validity(row, first):
    """The first keys by which iterates are ranked."""
    return row["invalid"] > first["invalid"], row["inverted"], row["invalid"]


def meshes():
    """Gallery meshes, from sound to badly tangled, some with an inverted hex that fixed nodes lock."""
    made = st.builds(
        lambda name, scramble, seed: make(name, size=200, scramble=scramble, seed=seed),
        st.sampled_from(sorted(set(GALLERY) - {"layered"})),  # of which layers have targets of their own
        st.sampled_from([0.0, 0.1, 0.3, 0.6, 1.0]),
        st.integers(0, 99),
    )
    return made | made.map(with_locked_corner)


@pytest.mark.slow
@pytest.mark.parametrize("name", METHODS)
@settings(max_examples=8)
@given(start=meshes(), most=st.integers(0, 12))
def test_no_method_ends_with_more_invalid_hexes_or_a_lower_q_min(name, start, most):
    result = smooth(start, name, StoppingCriteria(max_iterations=most))
    before, after = result.before, result.after
    assert after.invalid <= before.invalid
    bad_before, bad_after = ((one.inverted, one.invalid) for one in (before, after))
    assert name == "mend" or bad_after <= bad_before
    if name != "mend" and bad_after == bad_before:
        assert after.q_min >= before.q_min - (SLACK if METHODS[name].optimises else 0)


@given(name=st.sampled_from([name for name, method in METHODS.items() if not method.optimises]), start=meshes())
def test_a_method_without_an_objective_keeps_its_best_iterate_of_equals_the_last(name, start):
    result = smooth(start, name, SHORT)
    ranks = [(*validity(row, result.history[0]), -row["q_min"]) for row in result.history]
    assert ranks[result.kept] == min(ranks)
    assert min(ranks) not in ranks[result.kept + 1 :]


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, method in METHODS.items() if method.optimises and name != "mend"])
@settings(max_examples=8)
@given(start=meshes())
def test_an_optimiser_keeps_its_last_iterate_unless_that_is_worse(name, start):
    result = smooth(start, name, SHORT)
    first = result.history[0]
    ranks = [(*validity(row, first), row["q_min"] < first["q_min"] - SLACK) for row in result.history]
    assert ranks[result.kept] == min(ranks)
    assert min(ranks) not in ranks[result.kept + 1 :]


@pytest.mark.parametrize("stop", [SHORT, LAST], ids=["best", "last"])
@given(name=st.sampled_from(sorted(METHODS)), start=meshes())
def test_worse_tells_exactly_what_is_worse(name, stop, start):
    result = smooth(start, name, stop)
    before, after = measure(start.points, start.elements), measure(result.mesh.points, start.elements)
    rise = {
        "inverted": before.n_inverted - after.n_inverted,
        "invalid": before.n_invalid - after.n_invalid,
        "q_min": after.q.min() - before.q.min(),
        "scaled_jacobian": after.scaled_jacobian.min() - before.scaled_jacobian.min(),
    }
    assert list(result.worse) == [one for one in rise if rise[one] < -WORSE_BY]
    assert ("Worse than at the start" in result.message) == bool(result.worse)
    for one, key in REGRESSION_KEYS.items():
        words = result.message.partition("Worse than at the start")[2].partition("Invalid hexes")[0]
        assert (SUMMARY_QUANTITIES[key].label in words) == (one in result.worse)


def test_laplacian_gives_back_a_sound_mesh_and_says_so(bridge):
    kept, last = smooth(bridge, "laplacian"), smooth(bridge, "laplacian", StoppingCriteria(keep_last=True))
    assert (kept.after.inverted, kept.worse) == (0, ())
    assert "Iteration 3 was kept: later ones were worse." in kept.message
    assert last.after.inverted > 0
    assert "Worse than at the start: inverted 0 → 12" in last.message


def test_a_stage_goes_on_from_what_was_kept_and_a_recipe_can_ask_for_the_last(bridge):
    def begun_from(stop):
        recipe = from_toml(to_toml(Recipe.of(Stage(METHODS["laplacian"](), stop), "mend")))
        run = iterate(bridge, recipe)
        list(run)
        return next(stage for stage in run.result().stages if stage.stage == 2).first

    assert begun_from(SHORT) == 3
    assert begun_from(LAST) == 12


def test_a_method_that_takes_over_goes_on_from_the_newest_and_may_end_better(bridge):
    run = iterate(bridge, "laplacian")
    for _ in range(6):
        newest = next(run)
    run.switch_method("local-sd")
    taken_over = next(run)
    expected = next(iterate(bridge.with_points(newest.points), "local-sd"))
    np.testing.assert_array_equal(taken_over.points, expected.points)
    list(run)
    assert run.best.number > 6
    assert not {"inverted", "q_min"} & set(run.result().worse)


def test_a_perfect_grid_is_not_worse_for_rounding():
    assert all(smooth(grid(3), name, LAST).worse == () for name in METHODS)


def test_the_last_digits_of_a_layered_mesh_are_no_regression():
    tangled = make("layered", size=2000)
    result = smooth(tangled)
    fallen = result.after.scaled_jacobian_min - result.before.scaled_jacobian_min
    assert abs(fallen) < WORSE_BY
    assert result.worse == ()
    assert "Worse than at the start" not in result.message


def test_the_reported_difference_is_that_beyond_the_last_digits():
    before = summarise(make("five-side", size=500))
    for change, names in ((0.5 * WORSE_BY, ()), (2 * WORSE_BY, ("q_min", "scaled_jacobian"))):
        lower = {key: getattr(before, key) - change for key in ("q_min", "scaled_jacobian_min")}
        after = dataclasses.replace(before, **lower)
        assert regressions(before, after) == names
        assert bool(describe_regressions(before, after)) == bool(names)
    assert regressions(before, before, (0.5, 0.5 - 2 * WORSE_BY)) == ("q_of_target",)
    assert regressions(before, before, (0.5, 0.5 - 0.5 * WORSE_BY)) == ()


@pytest.mark.parametrize("words", [[], ["--keep-last"]])
def test_smooth_and_compare_tell_other_programs(bridge, tmp_path, capsys, words):
    io.write(tmp_path / "bridge.vtu", bridge)
    paths = {name: str(tmp_path / name) for name in ("bridge.vtu", "out.vtu", "report.json", "tables")}
    status = main(["smooth", paths["bridge.vtu"], "-o", paths["out.vtu"], "--json", paths["report.json"],
                   "--method", "laplacian", *words])  # fmt: skip
    assert status == (4 if words else 0)
    fallen = ["inverted", "invalid", "q_min", "scaled_jacobian"] if words else []
    assert json.loads((tmp_path / "report.json").read_text())["worse"] == fallen
    assert main(["compare", paths["bridge.vtu"], "-o", paths["tables"], "--methods", "laplacian", *words]) == 0
    (row,) = json.loads((tmp_path / "tables/comparison.json").read_text())["rows"]
    assert row["worse"] == fallen
    said = capsys.readouterr().out
    assert ("Worse than before: laplacian (inverted, invalid, q min, scaled Jacobian min)." in said) == bool(words)


@pytest.mark.parametrize(
    ("command", "term", "words"),
    [("smooth", "xterm", []), ("compare", "xterm", ["--keep-last"]), ("smooth", "dumb", ["--keep-last"])],
)
def test_what_is_worse_is_red_where_there_are_colours(bridge, tmp_path, capsys, monkeypatch, command, term, words):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", term)
    monkeypatch.delenv("NO_COLOR", raising=False)
    io.write(tmp_path / "bridge.vtu", bridge)
    which = ["--method" if command == "smooth" else "--methods", "laplacian"]
    main([command, str(tmp_path / "bridge.vtu"), "-o", str(tmp_path / "out.vtu"), *which, *words])
    assert ("\x1b[31m" in capsys.readouterr().out) == bool(words)


@pytest.mark.slow
def test_smart_laplacian_does_not_spoil_the_worst_hex(real_mesh):
    tangled = io.read(real_mesh("pierrot_32735.mesh"))
    result = smooth(tangled, "smart-laplacian")
    assert result.history[-1]["q_min"] < 0.1 < result.before.q_min <= result.after.q_min
    assert "was kept: " in result.message
