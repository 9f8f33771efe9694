"""Which iterate a run keeps, and that it says what is worse: no method ends worse silently."""

import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import METHODS, StoppingCriteria, io, iterate, smooth
from hexmend.cli.main import main
from hexmend.gallery import GALLERY, make
from hexmend.quality import REGRESSION_KEYS, SUMMARY_QUANTITIES, describe_regressions, measure, regressions, summarise
from hexmend.quality.regressions import WORSE_BY
from hexmend.run.recipe import Recipe, Stage, from_toml, to_toml
from tests.core.grids import grid
from tests.core.smoothers.mend.test_mend import with_locked_corner

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
@given(mesh=meshes(), most=st.integers(0, 12))
def test_no_method_ends_with_more_invalid_hexes_or_a_lower_q_min(name, mesh, most):
    result = smooth(mesh, name, StoppingCriteria(max_iterations=most))
    before, after = result.before, result.after
    assert after.invalid <= before.invalid
    bad_before, bad_after = ((one.inverted, one.invalid) for one in (before, after))
    assert name == "mend" or bad_after <= bad_before
    if name != "mend" and bad_after == bad_before:
        assert after.q_min >= before.q_min - (SLACK if METHODS[name].optimises else 0)


@given(name=st.sampled_from([name for name, method in METHODS.items() if not method.optimises]), mesh=meshes())
def test_a_method_without_an_objective_keeps_its_best_iterate_of_equals_the_last(name, mesh):
    result = smooth(mesh, name, SHORT)
    ranks = [(*validity(row, result.history[0]), -row["q_min"]) for row in result.history]
    assert ranks[result.kept] == min(ranks)
    assert min(ranks) not in ranks[result.kept + 1 :]


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, method in METHODS.items() if method.optimises and name != "mend"])
@settings(max_examples=8)
@given(mesh=meshes())
def test_an_optimiser_keeps_its_last_iterate_unless_that_is_worse(name, mesh):
    result = smooth(mesh, name, SHORT)
    first = result.history[0]
    ranks = [(*validity(row, first), row["q_min"] < first["q_min"] - SLACK) for row in result.history]
    assert ranks[result.kept] == min(ranks)
    assert min(ranks) not in ranks[result.kept + 1 :]


@pytest.mark.parametrize("stop", [SHORT, LAST], ids=["best", "last"])
@given(name=st.sampled_from(sorted(METHODS)), mesh=meshes())
def test_worse_tells_exactly_what_is_worse(name, stop, mesh):
    result = smooth(mesh, name, stop)
    before, after = measure(mesh.points, mesh.hexes), measure(result.mesh.points, mesh.hexes)
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
    mesh = make("layered", size=2000)
    result = smooth(mesh)
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
    mesh = io.read(real_mesh("pierrot_32735.mesh"))
    result = smooth(mesh, "smart-laplacian")
    assert result.history[-1]["q_min"] < 0.1 < result.before.q_min <= result.after.q_min
    assert "was kept: " in result.message
