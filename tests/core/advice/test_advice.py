"""Advice: why a run ended, what is left, and suggestions that are worth following."""

import numpy as np
import pytest

from hexmend import METHODS, Outcome, Recipe, Stage, StoppingCriteria, advise, iterate, smooth
from hexmend.advice.situation import Situation
from hexmend.gallery import make
from hexmend.mesh.second_order import MID_EDGES
from hexmend.quality import measure, objective
from tests.core.boundary.solids import ball, slid
from tests.core.grids import grid, with_edge_midpoints
from tests.core.smoothers.mend.test_mend import with_locked_corner

MESHES = {
    "cube, tangled": ("cube", {"size": 216, "scramble": 2.0}),
    "bridge, tangled": ("bridge-sharp", {"size": 250, "scramble": 0.4}),
    "five-side, tangled": ("five-side", {"size": 500, "scramble": 1.5}),
}
SHORT = StoppingCriteria(max_iterations=12)
RUNS = {
    **{name: (name, StoppingCriteria()) for name in METHODS if not name.startswith("global")},
    **{f"{name}, cut short": (name, SHORT) for name in METHODS if name != "global-nr"},
    "laplacian, last kept": ("laplacian", StoppingCriteria(keep_last=True)),
    "mend, shape": (METHODS["mend"](goal="shape"), StoppingCriteria()),
    "mend, shape, cut short": (METHODS["mend"](goal="shape"), SHORT),
    "mend, p = 4": (METHODS["mend"](p=4), StoppingCriteria()),
    "mend, soon cut short": ("mend", StoppingCriteria(max_iterations=3)),
    "local-sd, p = 4": (METHODS["local-sd"](p=4), SHORT),
    "mend, then lifted": (Recipe.of("mend", "getme-sequential"), None),
}


AGAIN = "Undo, then the same with larger limits"
FIGURES = "q_min", "q_mean", "scaled_jacobian_min"


def better(gain, before, after):
    """Whether a figure of `Summary` is better."""
    if gain in ("q_min", "q_norm"):
        return getattr(after, gain) > getattr(before, gain)
    if gain == "figures":
        changes = [getattr(after, name) - getattr(before, name) for name in FIGURES]
        return min(changes) >= -1e-12 and max(changes) > 0
    then, now = getattr(before, gain), getattr(after, gain)
    return now is not None and (then is None or now < then)


def followed(mesh, result, suggestion):
    """What comes of a suggestion."""
    begin = mesh if suggestion.undo else result.mesh
    if suggestion.unpin.size:
        pinned = begin.pinned.copy()
        pinned[suggestion.unpin] = False
        begin = begin.replace(pinned=pinned)
    return smooth(begin, suggestion.smoother, suggestion.stop)


def energy(mesh, smoother):
    """The objective that a method minimises."""
    return objective(measure(mesh.points, mesh.hexes), *smoother.norm)


@pytest.mark.slow
@pytest.mark.parametrize("which", MESHES)
def test_following_a_suggestion_helps(which):
    name, parameters = MESHES[which]
    assert follow_all(make(name, **parameters)), "nothing was suggested at all"


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (1, 2))])
def test_following_a_suggestion_helps_on_a_mesh_that_differs_in_its_last_bits(seed):
    name, parameters = MESHES["five-side, tangled"]
    mesh = make(name, **parameters)
    noise = np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape)
    near = mesh.with_points(mesh.points * (1 + 1e-15 * noise))
    few = {what: RUNS[what] for what in ("local-sd", "local-sd, cut short", "mend", "getme")}
    assert follow_all(near, few)  # which of them are offered depends on the last bits


@pytest.mark.slow
def test_hexes_left_inverted_by_mend_at_fixed_nodes_are_told_to_slide():
    mesh, rng = grid(4), np.random.default_rng(7)
    lower = np.flatnonzero(mesh.points[mesh.hexes].mean(axis=1)[:, 2] < mesh.points[:, 2].mean())
    points, sets = mesh.points.copy(), {"lower": lower, "upper": np.setdiff1d(np.arange(mesh.n_hexes), lower)}
    points[mesh.free] += rng.uniform(-0.9, 0.9, (27, 3)) * mesh.mean_edge_length
    mesh = mesh.with_points(points).replace(hex_sets=sets)  # the interface between the sets is fixed as it was moved
    result = smooth(mesh, "mend")
    advice = advise(result)
    assert advice.unlocked.size == result.after.inverted > 0
    (suggestion,) = advice.suggestions
    assert suggestion.title == "Mend with sliding boundary"
    assert followed(mesh, result, suggestion).after.inverted == 0


@pytest.mark.slow
def test_following_a_suggestion_helps_beside_what_is_locked():
    follow_all(with_locked_corner(make("five-side", size=300)))
    assert follow_all(with_locked_corner(make("five-side", size=150, scramble=0.8))), "nothing was suggested at all"


def follow_all(mesh, runs=RUNS):
    """Follow every suggestion after every run on a mesh; returns the titles of what was suggested."""
    seen = set()
    for what, (smoother, stop) in runs.items():
        result = smooth(mesh, smoother, stop)
        for suggestion in advise(result).suggestions:
            then = followed(mesh, result, suggestion)
            after = then.after
            said = f"{what}: {suggestion.title}: {result.after} became {after}"
            if suggestion.gain == "energy":
                assert energy(then.mesh, suggestion.smoother) < energy(result.mesh, suggestion.smoother), said
            elif suggestion.title != AGAIN:  # which was undone: the mesh may have been as good at the limit
                assert better(suggestion.gain, result.after, after), said
            assert after.inverted <= result.after.inverted, said
            seen.add(suggestion.title)
    return seen


@pytest.mark.slow
def test_every_kind_of_suggestion_is_made_somewhere():
    bridge, tangled = make("bridge-sharp", size=864), make("bridge-sharp", size=864, scramble=0.4)
    runs = [
        smooth(tangled, "local-sd", SHORT),
        smooth(bridge, "laplacian", StoppingCriteria(keep_last=True)),
        smooth(bridge, "local-sd", SHORT),
        smooth(bridge, "global-sd", StoppingCriteria(tolerance=1e-2)),
        smooth(bridge, "mend"),
        smooth(bridge, "mend", StoppingCriteria(max_iterations=8)),
        smooth(pinned_tangle(), "mend"),
    ]
    titles = {suggestion.title for result in runs for suggestion in advise(result).suggestions}
    assert titles == {
        "Mend", "Undo, then Smart Laplacian", "Continue", "GETMe, sequential", "Unpin, then Mend",
        "Mend, goal = shape", AGAIN,
    }  # fmt: skip


def pinned_tangle():
    """A grid of which an inner node lies far out and is pinned there."""
    mesh = grid(4)
    (node,) = np.flatnonzero((mesh.points == [1, 1, 1]).all(axis=1))
    points, pinned = mesh.points.copy(), np.zeros(mesh.n_nodes, dtype=bool)
    points[node] += 4
    pinned[node] = True
    return mesh.with_points(points).replace(pinned=pinned)


def quadratic_tangle():
    """Such a mesh of second order, in which the midpoint of an edge of that node is pinned instead; their numbers."""
    tangled = pinned_tangle()
    (node,) = np.flatnonzero(tangled.pinned)
    row, corner = np.argwhere(tangled.hexes == node)[0]
    mesh = with_edge_midpoints(tangled.replace(pinned=None))
    middle = int(mesh.mid_nodes[row, np.flatnonzero((corner == MID_EDGES).any(axis=1))[0]])
    return mesh.replace(pinned=np.arange(mesh.n_nodes) == middle), int(node), middle


@pytest.mark.slow
def test_a_pin_that_holds_hexes_inverted_is_named_and_unpinning_helps():
    mesh = pinned_tangle()
    result = smooth(mesh, "mend")
    first = advise(result).suggestions[0]
    assert first.unpin.tolist() == np.flatnonzero(mesh.pinned).tolist()
    assert "Unpin the node" in first.text
    assert result.after.inverted > 0
    assert followed(mesh, result, first).after.inverted == 0


@pytest.mark.slow
def test_a_pinned_node_of_higher_order_that_holds_hexes_inverted_is_named():
    """The midpoint of an edge of the tangled node: its corners stay because it does."""
    mesh, _, middle = quadratic_tangle()
    result = smooth(mesh, "mend")
    assert result.after.inverted > 0
    first = advise(result).suggestions[0]
    assert first.unpin.tolist() == [middle]
    assert followed(mesh, result, first).after.inverted == 0


@pytest.mark.slow
def test_a_pin_is_not_named_where_a_rule_fixes_the_node_as_well():
    mesh, node, _ = quadratic_tangle()
    mesh = mesh.replace(node_sets={"some": np.array([node])}).with_rules(fix=("some",))
    assert Situation(smooth(mesh, "mend")).pinned_nodes.tolist() == []


def test_locked_hexes_are_named_and_nothing_vain_is_suggested():
    mesh = with_locked_corner(make("five-side", size=300))
    advice = advise(smooth(mesh, "mend"))
    assert advice.locked.tolist() == [mesh.topology.node_corners.items[0] // 8]
    assert advice.unlocked.size == 0
    assert "1 of 315 hexes is inverted. It is locked: fixed nodes alone keep it inverted" in advice.state
    assert "sliding alone does not free it. Correct the boundary" in advice.state
    assert "try mend with boundary = slide" in advice.state
    assert "Let it slide" not in advice.state
    assert advice.suggestions == ()


def test_of_a_recipe_the_last_stage_is_explained():
    stages = [Stage(METHODS["getme"](), SHORT), Stage(METHODS["local-sd"](), SHORT)]
    advice = advise(smooth(make("bridge-sharp", size=500), Recipe("two", tuple(stages))))
    assert advice.reason.startswith("The last stage, Local steepest descent: Stopped at the limit of 12 iterations")


def test_a_perfect_mesh_wants_nothing():
    advice = advise(smooth(make("cube", size=64, scramble=0.3), "mend"))
    assert advice.suggestions == ()
    assert advice.state.endswith("This is close to the best possible.")


def test_a_mesh_with_nothing_free_is_explained():
    advice = advise(smooth(grid(1), "mend"))
    assert advice.reason == "Nothing to do: every node is fixed."
    assert advice.suggestions == ()


@pytest.mark.parametrize(("stop", "said"), [
    (StoppingCriteria(max_iterations=3, tolerance=0), "Stopped at the limit of 3 iterations before it converged. The last one still"),
    (StoppingCriteria(max_seconds=1e-9, tolerance=0), "Stopped at the limit of 1e-09 s, after 0 iterations, before it converged."),
    (StoppingCriteria(tolerance=0.01), "no node moved further than 0.01 mean edge lengths."),
])  # fmt: skip
def test_why_it_ended_is_said_with_its_limits(stop, said):
    assert said in advise(smooth(make("bridge-sharp", size=500), "local-sd", stop)).reason


def test_a_run_that_was_stopped_says_so_and_what_is_inverted():
    run = iterate(make("bridge-sharp", size=500, scramble=1.0), "laplacian")
    next(run)
    run.close()
    advice = advise(run.result())
    assert advice.reason.startswith("Stopped by you after 1 iteration.")
    assert advice.state.startswith(f"{advice.unlocked.size} of 500 hexes are inverted. 369 were at the start.")
    assert [one.title for one in advice.suggestions] == ["Mend", "Continue"]


@pytest.mark.parametrize("method", ["mend", "laplacian", "local-sd"])
def test_a_run_that_was_stopped_before_it_began_is_said_to_be_and_not_judged(method):
    run = iterate(make("plane", size=200), method)
    run.close()
    advice = advise(run.result())
    assert advice.reason == "Stopped by you before its first iteration: no node has moved. Press Run to start again."
    assert advice.no_suggestion == ""
    finished = advise(smooth(make("cube", size=27), "mend"))
    assert (finished.suggestions, finished.no_suggestion) == ((), "No further suggestions.")


@pytest.mark.slow
def test_locked_hexes_that_sliding_can_free_are_counted_and_freed():
    result = smooth(slid(ball(3), 0.6, seed=0), "mend", feature_angle=40.0)  # many edges, which hold some hexes
    advice = advise(result)
    now = Situation(result)
    assert 0 < now.freed < advice.locked.size
    assert (
        f"{now.freed} can be freed by sliding alone, {advice.locked.size - now.freed} cannot. Let it slide"
        in advice.state
    )
    chosen = next(one for one in advice.suggestions if one.title == "Mend with sliding boundary")
    assert f"{now.freed} of the {advice.locked.size} locked hexes can be freed" in chosen.text
    after = smooth(result.mesh, chosen.smoother, chosen.stop)
    assert after.after.inverted < result.after.inverted
    assert not any(one.title == chosen.title for one in advise(after).suggestions)


def test_a_mend_cut_short_while_its_results_do_not_count_is_begun_again():
    mesh = slid(ball(3), 0.6, seed=0)
    result = smooth(
        mesh, METHODS["mend"](goal="scaled-jacobian", boundary="slide"), StoppingCriteria(max_iterations=160)
    )
    advice = advise(result)
    assert result.kept < result.iterations
    assert "sliding has not freed these so far." in advice.state
    longer = next(one for one in advice.suggestions if one.title == "Undo, then the same with larger limits")
    assert longer.undo
    assert longer.smoother == METHODS["mend"](goal="scaled-jacobian", boundary="slide")
    assert longer.stop.max_iterations > 160
    after = smooth(mesh, longer.smoother, longer.stop)
    assert after.after.inverted < result.after.inverted
    stopped = iterate(mesh, longer.smoother)
    next(stopped)
    stopped.close()
    assert not any(one.title == longer.title for one in advise(stopped.result()).suggestions)


def test_a_locked_hex_that_sliding_has_not_freed_is_not_told_to_slide():
    result = smooth(with_locked_corner(grid(1)), METHODS["local-nr"](boundary="slide"))
    left = advise(result).state
    assert "sliding has not freed these" in left
    assert "Correct the boundary" in left


@pytest.mark.parametrize("method", ["mend", "laplacian", "getme", "getme-sequential", "local-sd", "global-mnr"])
@pytest.mark.parametrize("iterations", [1, 6])
def test_after_a_stop_the_advice_is_to_continue(method, iterations):
    run = iterate(make("bridge-sharp", size=864), METHODS[method](), StoppingCriteria())
    for number, _ in enumerate(run, 1):
        if number == iterations:
            run.close()
            break
    result = run.result()
    assert result.outcome is Outcome.STOPPED
    titles = [suggestion.title for suggestion in advise(result).suggestions]
    if result.kept == result.iterations:
        assert titles[0] == "Continue"
        (further,) = [one for one in advise(result).suggestions if one.title == "Continue"]
        assert smooth(result.mesh, further.smoother, further.stop).after.inverted <= result.after.inverted
    else:  # it went worse: to continue would only repeat that
        assert "Continue" not in titles
