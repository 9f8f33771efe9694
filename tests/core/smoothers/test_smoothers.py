"""What sets the methods apart.

What is no method or metric is refused where it is announced, with what is missing.
"""

import itertools
from dataclasses import dataclass

import numpy as np
import pytest

import hexmend as hx
from hexmend import METHODS, Laplacian, LocalSteepestDescent, Outcome, SmartLaplacian, StoppingCriteria, measure, smooth
from hexmend.gallery import make
from hexmend.quality import METRICS
from hexmend.quality import metric as metrics
from hexmend.quality.regressions import WORSE_BY
from hexmend.smoothers import Smoother, method
from hexmend.smoothers import base as smoother
from hexmend.smoothers.general import edge_length_ratio
from hexmend.smoothers.local import single_node
from hexmend.smoothers.sliding_smoother import PATIENCE, Sweeps
from tests.core.boundary.solids import ball, slid
from tests.core.grids import grid, scrambled


def after(mesh, smoother, steps=1):
    """Return the points after some iterations."""
    return next(itertools.islice(smoother.steps(mesh), steps, None)).points


def test_laplacian_simultaneous_looks_at_the_old_places():
    mesh = scrambled(grid(3), 0.3)
    points = mesh.points.copy()
    for i in np.flatnonzero(mesh.free):
        points[i] = mesh.points[mesh.topology.rings[i]].mean(axis=0)
    np.testing.assert_allclose(after(mesh, Laplacian(update="simultaneous"), 1), points, rtol=1e-14)


def test_laplacian_inverts_hexes_on_bridge_sharp_and_smart_laplacian_does_not():
    mesh = make("bridge-sharp", size=4000)
    assert measure(mesh.points, mesh.hexes).n_inverted == 0
    assert smooth(mesh, Laplacian(), StoppingCriteria(max_iterations=400, keep_last=True)).after.inverted > 0
    assert smooth(mesh, SmartLaplacian(), StoppingCriteria(max_iterations=60)).after.inverted == 0


def test_local_sd_with_a_higher_p_ends_with_a_better_worst_hex():
    mesh = make("five-side", size=700)
    least = [
        smooth(mesh, LocalSteepestDescent(p=p), StoppingCriteria(tolerance=1e-5)).after.q_min for p in (1.0, 2.0, 8.0)
    ]
    assert least == sorted(least)
    assert least[2] > least[0] + 1e-3


# What methods prepare before their first step, and how they end where there is nothing to gain.


def test_the_order_of_visits_is_worked_out_before_the_first_step(monkeypatch):
    """So that it counts as set-up, and every sweep takes the same time."""
    asked = []

    class Visits(single_node.VisitOrder):
        def groups(self, points, sweep):
            asked.append(sweep)
            return super().groups(points, sweep)

    monkeypatch.setattr(single_node, "VisitOrder", Visits)
    steps = METHODS["local-sd"]().steps(scrambled(grid(3), 0.2))
    next(steps)
    assert asked == [0]
    next(steps), next(steps)
    assert asked == [0, 0, 1]


# Cost of a sweep over nodes that have converged.


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
@pytest.mark.parametrize("name", ["local-nr", "local-mnr", "local-patch"])
def test_a_converged_node_costs_one_evaluation_a_sweep(name, boundary):
    """Its line search gives up after the first trial, since rounding hides the descent of any further one."""
    mesh = slid(ball(3), 0.2, 2) if boundary == "slide" else scrambled(ball(3), 0.3, 1)
    *_, last = itertools.islice(METHODS[name](boundary=boundary).steps(mesh), 100)
    assert 0 < last.diagnostics["energy_evaluations"] <= last.diagnostics["derivative_evaluations"]


# Sweeps are made again without the nodes that leave the room, and such a node stays for good after some of them.


class Wall:
    """A surface whose room ends at x = 1."""

    def nodes_outside_band(self, points):
        return np.flatnonzero(points[:, 0] > 1)


def to_the_right(told):
    """A sweep that moves all nodes that need not stay by 0.3 along x."""

    def sweep(moved, stays):
        told.append(stays.copy())
        moved[~stays] += [0.3, 0, 0]
        return len(told)

    return sweep


def test_a_sweep_is_made_again_with_the_nodes_staying_that_left():
    points, told = np.zeros((4, 3)), []
    points[3, 0] = 0.9
    moved, answer = Sweeps(Wall(), 4)(points, to_the_right(told))
    assert [one.tolist() for one in told] == [[False] * 4, [False, False, False, True]]
    assert answer == 2
    np.testing.assert_allclose(moved[:, 0], [0.3, 0.3, 0.3, 0.9])
    assert points[:, 0].tolist() == [0, 0, 0, 0.9]


def test_a_node_that_had_to_stay_often_stays_for_good():
    points, sweeps = np.zeros((2, 3)), Sweeps(Wall(), 2)
    points[1, 0] = 0.9
    counts = []
    for _ in range(PATIENCE + 2):
        told = []
        sweeps(points, to_the_right(told))
        counts.append(len(told))
    assert counts == [2] * PATIENCE + [1, 1]


def test_a_node_that_was_beyond_and_has_not_moved_holds_up_nothing():
    points, told = np.full((1, 3), 2.0), []
    moved, answer = Sweeps(Wall(), 1)(points, lambda moved, stays: told.append(1) or 7)
    assert (moved.tolist(), answer, told) == ([[2, 2, 2]], 7, [1])


def test_where_nothing_slides_a_sweep_is_a_sweep():
    moved, _ = Sweeps(None, 1)(np.full((1, 3), 5.0), to_the_right([]))
    assert moved[0, 0] == 5.3


@pytest.mark.parametrize("name", ["local-patch", "local-sd"])
def test_evaluations_of_nodes_that_slide_are_counted_too(name):
    mesh = slid(ball(3), 0.1, 1)
    diagnostics = []
    for boundary in ("fixed", "slide"):
        steps = METHODS[name](boundary=boundary).steps(mesh)
        next(steps)
        diagnostics.append(next(steps).diagnostics)
    assert diagnostics[1]["derivative_evaluations"] > diagnostics[0]["derivative_evaluations"] > 0
    assert diagnostics[1]["energy_evaluations"] > diagnostics[0]["energy_evaluations"] > 0


# Algorithm 5.1: its two decisions, in words.


General = METHODS["general"]


def test_sufficient_quality_ends_with_what_getme_reached():
    mesh = scrambled(grid(4), 0.3)
    result = smooth(mesh, "general")
    assert result.outcome is Outcome.SUFFICIENT
    assert result.after.q_min >= 0.9
    assert result.after.q_min < 1 - 1e-9  # no optimiser came after
    assert "sizes" not in result.message


CHOICES = [
    (make("five-side", size=150), 50, "similar sizes (ratio 2), no inverted hexes: Global Newton-Raphson"),
    (make("five-side", size=150, taper=0.05), 50, "different sizes (ratio 3.4), no inverted hexes: Local"),
    (make("five-side", size=150, scramble=1.5, seed=1), 0, "inverted hexes: Local steepest descent"),
]


@pytest.mark.parametrize(("mesh", "getme_iterations", "said"), CHOICES, ids=["similar", "different", "inverted"])
def test_what_it_chooses_and_why_is_in_the_message(mesh, getme_iterations, said):
    method = General(getme_iterations=getme_iterations)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=1000))
    assert "After GETMe: " in result.message
    assert said in result.message
    assert result.outcome is Outcome.CONVERGED
    assert result.after.inverted == 0
    reference = smooth(result.mesh, "local-mnr", StoppingCriteria(tolerance=1e-6)).after
    assert result.after.q_mean == pytest.approx(reference.q_mean, abs=2e-4)


def test_size_ratio_looks_past_one_hex_in_twenty():
    mesh = grid(6)
    assert edge_length_ratio(mesh.points, mesh.hexes) == pytest.approx(1)
    points = mesh.points.copy()
    points[:, 0] *= 5.0 ** np.arange(7)[points[:, 0].astype(int)]
    assert edge_length_ratio(points, mesh.hexes) > 100
    assert edge_length_ratio(np.zeros_like(points), mesh.hexes) == np.inf


def test_getme_comes_first_and_the_iterations_of_both_are_counted():
    mesh = make("five-side", size=150, scramble=0.2)
    run = smooth(mesh, General(getme_iterations=7), StoppingCriteria(max_iterations=9))
    assert run.iterations == 9
    getme = smooth(mesh, "getme", StoppingCriteria(max_iterations=7, tolerance=0))
    assert run.history[7]["objective"] == getme.history[7]["objective"]
    assert measure(run.mesh.points, mesh.hexes).n_inverted == 0


# A run never ends with more invalid hexes, and mend with a lower least scaled Jacobian while hexes stay inverted.


GOALS = ("balanced", "shape", "scaled-jacobian", "time-step")


def pinned_tangle(seed):
    """Make a tangled grid of 27 hexes with half of its inner nodes pinned, so that no method makes all hexes valid."""
    mesh = scrambled(grid(3), 1.0, seed)
    return mesh.replace(pinned=mesh.free & (np.random.default_rng(seed).random(mesh.n_nodes) < 0.5))


@pytest.mark.parametrize("seed", [3, 7])  # one with a locked hex, one without
@pytest.mark.parametrize(
    ("method", "options"),
    [*((name, {}) for name in METHODS if name != "mend"), *(("mend", {"goal": goal}) for goal in GOALS)],
)
def test_no_more_hexes_are_invalid_and_the_least_of_mend_is_not_lower(method, options, seed):
    result = hx.smooth(pinned_tangle(seed), method, max_iterations=40, **options)
    assert result.after.inverted > 0
    if method == "mend":
        assert result.after.scaled_jacobian_min >= result.before.scaled_jacobian_min - WORSE_BY
    assert result.after.invalid <= result.before.invalid


def named(base=Smoother, **texts):
    """A class of methods that says of itself what it is given."""
    said = {"name": "toy", "title": "Toy", "help": "Does nothing.", "source": "none"} | texts
    return dataclass(frozen=True)(type("Toy", (base,), {key: text for key, text in said.items() if text is not None}))


@pytest.fixture(autouse=True)
def nothing_stays(monkeypatch):
    """Registries are as they were afterwards."""
    before = dict(METHODS), dict(METRICS)
    yield
    assert (dict(METHODS), dict(METRICS)) == before


def test_a_class_that_is_no_smoother_is_refused():
    with pytest.raises(TypeError, match=r"Toy is not a hexmend\.Smoother"):
        method(named(object))


@pytest.mark.parametrize("word", ["name", "title", "help", "source"])
@pytest.mark.parametrize("text", [None, 3])
def test_a_method_without_a_text_is_refused(word, text):
    with pytest.raises(TypeError, match=f"Toy has no {word}: expected a text"):
        method(named(**{word: text}))


@pytest.mark.parametrize("word", ["name", "title"])
def test_a_method_that_a_run_could_not_name_is_refused_when_it_is_made(word):
    nameless = named(**{word: None})
    nameless.__abstractmethods__ = frozenset()
    with pytest.raises(TypeError, match=f"Toy has no {word}: expected a text"):
        nameless()


def announce(monkeypatch, module, *found):
    """Let the entry points of a module's group hold these objects."""

    def load(group, kind, take):
        assert (group, kind) in [("hexmend.smoothers", "method"), ("hexmend.metrics", "metric")]
        for one in found:
            take("any", one)

    monkeypatch.setattr(module, "load_entry_points", load)
    module.load_plugins()


def test_what_is_no_metric_is_refused(monkeypatch):
    with pytest.raises(TypeError, match=r"3 is not a hexmend\.quality\.Metric"):
        announce(monkeypatch, metrics, 3)


def test_a_class_of_another_distribution_is_announced_once_and_other_objects_are_not(monkeypatch):
    added, new = [], named()
    monkeypatch.setattr(smoother, "method", added.append)
    announce(monkeypatch, smoother, METHODS["mend"], new, "no class", 3)
    assert added == [new]


def test_a_method_moves_free_nodes_and_slides_none_unless_it_says_so():
    from tests.core.grids import grid

    mesh, toy = grid(2), named()
    toy.__abstractmethods__ = frozenset()
    assert not toy().slides
    assert toy().movable(mesh).tolist() == mesh.free.tolist()
