"""Claims follow the figures: each is judged on a few made-up runs as reproduced, as not, and as not judged."""

from dataclasses import replace

import numpy as np
import pytest

from hexmend.gallery import make
from hexmend.quality import Summary, measure
from hexmend.study.claims import (
    CLAIMS,
    cost,
    delta,
    global_methods,
    heuristics,
    local_methods,
    optimum,
    preconditioning,
    robustness,
)
from hexmend.study.claims.claim import tally
from hexmend.study.claims.reading import objective
from hexmend.study.experiments import load
from hexmend.study.measured import Measured
from hexmend.study.row import Row

THESIS = load()

#: What made-up runs end with: one mesh, whatever its figures are said to be.
MESH = make("five-side", size=60)


def summary(**figures):
    values = dict.fromkeys(Summary.__dataclass_fields__, 0) | {"free_nodes": 100, "objective": 1.0}
    return Summary(**values | figures)


def run(seconds=1.0, iterations=1, outcome="converged", mesh=MESH, **figures):
    """What a method is said to have made: figures of its `Summary`, and of its run."""
    return seconds, iterations, outcome, mesh, summary(**figures)


def stuck(**how):
    """A run that ends away from the optimum."""
    return run(**{"outcome": "no-descent", "objective": 2.0} | how)


def late(**how):
    """A run that reaches the time limit."""
    return run(**{"outcome": "max-seconds", "objective": 2.0} | how)


def table(name, rows, thesis_mesh=None, **initial):
    """A table of the thesis as if measured: runs by method."""
    experiment = next(one for one in THESIS.experiments if one.table == name and thesis_mesh in (None, one.thesis_mesh))
    made = {
        method: Row(method, {}, outcome, "", mesh, after, iterations, seconds)
        for method, (seconds, iterations, outcome, mesh, after) in rows.items()
    }
    return Measured(experiment, MESH, summary(**{"hexes": 8} | initial), made)


PLANE_GETME = "Plane, GETMe smoothed"

#: A claim, and runs by which it holds, fails, and is not judged.
JUDGED = {
    optimum.same_optimum: (
        [table("4.1", {"local-sd": run(), "global-nr": run(objective=1.0001)})],
        [table("4.1", {"local-sd": run(), "global-nr": run(objective=1.01)})],
        [table("4.1", {"local-sd": run(), "global-nr": late()})],
    ),
    optimum.same_optimum_untangled: (
        [table("4.9", {"local-sd": run(), "global-nr": run()}, inverted=2)],
        [table("4.9", {"local-sd": run(), "global-nr": run(objective=1.01)}, inverted=2)],
        [table("4.9", {"local-sd": run(), "global-nr": run()})],
    ),
    optimum.norm_is_objective: (
        [table("4.1", {"local-sd": run(q_norm=0.9), "global-sd": stuck(q_norm=0.8)})],
        [table("4.1", {"local-sd": run(q_norm=0.8), "global-sd": stuck(q_norm=0.9)})],
        [table("4.1", {"local-sd": run(q_norm=0.8), "global-sd": stuck(q_norm=0.9, objective=None)})],
    ),
    optimum.one_quality: (
        [table("4.15", {"local-sd": run(q_min=0.606, q_mean=0.9), "local-nr": run(q_min=0.602, q_mean=0.9)})],
        [table("4.15", {"local-sd": run(q_min=0.62, q_mean=0.9), "local-nr": run(q_min=0.60, q_mean=0.9)})],
        [table("4.15", {"local-sd": run(q_min=0.62), "local-nr": late()})],
    ),
    optimum.optimum_is_best: (
        [table("4.14", {
            "laplacian": run(q_mean=0.7), "getme": run(q_min=0.5, q_mean=0.8), "local-sd": run(q_min=0.6, q_mean=0.9),
        }, q_mean=0.5)],
        [table("4.14", {
            "laplacian": run(q_mean=0.7), "getme": run(q_min=0.7, q_mean=0.8), "local-sd": run(q_min=0.6, q_mean=0.9),
        }, q_mean=0.5)],
        [table("4.14", {"laplacian": run(), "getme": run(), "local-sd": late()})],
    ),
    optimum.better_minimum: (
        [table("4.8", {"local-sd": run(q_min=0.6, q_norm=0.9), "global-sd": stuck(q_min=0.65, q_norm=0.8)})],
        [table("4.8", {"local-sd": run(q_min=0.6, q_norm=0.9), "global-sd": stuck(q_min=0.55, q_norm=0.8)})],
        [table("4.8", {"local-sd": late(), "global-sd": stuck()})],
    ),
    optimum.heuristics_not_optimal: (
        [table("4.11", {"laplacian": run(q_norm=0.7)}), table("4.5", {"local-sd": run(q_norm=0.8)})],
        [table("4.11", {"laplacian": run(q_norm=0.9)}), table("4.5", {"local-sd": run(q_norm=0.8)})],
        [table("4.11", {"laplacian": run(q_norm=0.7)}), table("4.5", {"local-sd": run(q_norm=0.8)}, hexes=9)],
    ),
    heuristics.getme_between: (
        [table("4.14", {"getme": run(q_min=0.5, q_mean=0.8), "local-sd": run(q_min=0.6, q_mean=0.9)}, q_mean=0.7)],
        [table("4.14", {"getme": run(q_min=0.7, q_mean=0.8), "local-sd": run(q_min=0.6, q_mean=0.9)}, q_mean=0.7)],
        [table("4.14", {"getme": run(), "local-sd": late()})],
    ),
    heuristics.heuristics_faster: (
        [table("4.15", {"laplacian": run(0.5), "getme": run(), "local-sd": run(11), "local-nr": run(20)})],
        [table("4.15", {"laplacian": run(0.5), "getme": run(), "local-sd": run(21), "local-nr": run(20)})],
        [table("4.15", {"laplacian": run(0.5), "getme": run()})],
    ),
    heuristics.laplacian_lowers_mean: (
        [table("4.14", {"laplacian": run(q_mean=0.6)}, q_mean=0.7)],
        [table("4.14", {"laplacian": run(q_mean=0.8)}, q_mean=0.7)],
        [table("4.14", {"getme": run(q_mean=0.8)}, q_mean=0.7)],
    ),
    heuristics.getme_against_laplacian: (
        [table("4.11", {"laplacian": run(), "getme": run(2, q_norm=0.9)}), table("4.13", {
            "laplacian": run(q_norm=0.5), "getme": run(2, q_norm=0.4),
        })],
        [table("4.11", {"laplacian": run(), "getme": run(0.5, q_norm=0.9)})],
        [table("4.11", {"getme": run()})],
    ),
    heuristics.getme_cheaper: (
        [table("4.11", {"getme": run(1)}), table("4.5", {"local-sd": run(2), "global-nr": run(3)})],
        [table("4.11", {"getme": run(2.5)}), table("4.5", {"local-sd": run(2), "global-nr": run(3)})],
        [table("4.11", {"getme": run(2.5)}), table("4.5", {"local-sd": late()})],
    ),
    heuristics.sequential_raises_minimum: (
        [table("4.11", {"getme-sequential": run(q_min=0.5)}, q_min=0.4)],
        [table("4.2", {"getme": run(q_min=0.4), "getme-sequential": run(q_min=0.4)})],
        [table("4.11", {"getme": run(q_min=0.5)})],
    ),
    preconditioning.preconditioning_speeds: (
        [
            table("4.1", {"local-sd": run(iterations=40)}),
            table("4.2", {"getme": run(), "local-sd": run(iterations=39)}),
            table("4.3", {"laplacian": run(), "local-sd": run(iterations=35)}),
        ],
        [
            table("4.1", {"local-sd": run(iterations=40)}),
            table("4.2", {"getme": run(), "local-sd": run(iterations=39)}),
            table("4.3", {"laplacian": run(), "local-sd": stuck(iterations=501)}),
        ],
        [table("4.1", {"local-sd": run()}), table("4.4", {"laplacian": run(), "local-sd": run()})],
    ),
    preconditioning.preconditioning_compensates: (
        [table("4.1", {"local-sd": run(10)}), table("4.2", {"getme": run(3), "local-sd": run(6)})],
        [table("4.1", {"local-sd": run(10)}), table("4.2", {"getme": run(3), "local-sd": run(8)})],
        [table("4.1", {"local-sd": stuck()}), table("4.2", {"getme": run(3), "local-sd": run(8)})],
    ),
    preconditioning.preconditioning_in_vain: (
        [table("4.15", {"local-sd": run(7)}), table("4.15", {"getme": run(), "local-sd": run(8)}, PLANE_GETME)],
        [table("4.15", {"local-sd": run(9)}), table("4.15", {"getme": run(), "local-sd": run(8)}, PLANE_GETME)],
        [table("4.15", {"local-sd": run(9)})],
    ),
    local_methods.local_sd_fastest: (
        [table("4.5", {"local-sd": run(1), "global-nr": run(2)})],
        [table("4.5", {"local-sd": run(1), "global-nr": run(2)}), table("4.6", {
            "local-sd": run(3), "global-nr": run(2),
        })],
        [table("4.5", {"local-sd": run(1), "global-nr": late()})],
    ),
    local_methods.local_sd_best_of_local: (
        [table("4.1", {"local-sd": run(1.5), "local-nr": run(2), "global-nr": run(1)})],
        [table("4.1", {"local-sd": run(3), "local-nr": run(2), "global-nr": run(1)})],
        [table("4.1", {"local-sd": run(3), "local-nr": late(), "global-nr": run(1)})],
    ),
    local_methods.modified_local: (
        [table("4.1", {"local-nr": run(iterations=50), "local-mnr": run(iterations=49)})],
        [table("4.1", {"local-nr": run(iterations=50), "local-mnr": run(iterations=40)})],
        [table("4.1", {"local-nr": stuck(), "local-mnr": run(iterations=40)})],
    ),
    local_methods.direct_solver: (
        [table("4.3", {"laplacian": run(), "local-nr": run()}), table("4.4", {"local-nr": stuck()})],
        [table("4.3", {"laplacian": run(), "local-nr": stuck(objective=None)})],
        [table("4.3", {"laplacian": run(), "local-nr": late()})],
    ),
    global_methods.newton_best_of_global: (
        [table("4.5", {"global-nr": run(1), "global-mnr": run(2)})],
        [table("4.5", {"global-nr": run(3), "global-mnr": run(2)})],
        [table("4.5", {"global-nr": stuck(), "local-sd": run()})],
    ),
    global_methods.modified_global: (
        [table("4.5", {"global-nr": run(1), "global-mnr": run(0.95)})],
        [table("4.5", {"global-nr": run(1), "global-mnr": run(0.5)})],
        [table("4.5", {"global-nr": late(), "global-mnr": run(2)})],
    ),
    global_methods.fewer_iterations: (
        [table("4.5", {"global-nr": run(iterations=4), "local-nr": run(iterations=16)})],
        [table("4.5", {"global-nr": run(iterations=24), "local-nr": run(iterations=16)})],
        [table("4.5", {"global-nr": late(), "local-nr": run(iterations=16)})],
    ),
    global_methods.competitive: (
        [table("4.5", {"local-sd": run(1), "global-nr": run(2), "global-sd": run(9)})],
        [table("4.5", {"local-sd": run(1), "global-nr": run(2), "global-sd": run(2)})],
        [table("4.5", {"local-sd": late(), "global-nr": run(2), "global-sd": run(2)})],
    ),
    global_methods.global_sd_slow: (
        [table("4.5", {"local-sd": run(), "global-sd": stuck()})],
        [table("4.5", {"local-sd": run(), "global-sd": run(iterations=4)})],
        [table("4.5", {"local-sd": late(), "global-sd": run(iterations=4)})],
    ),
    global_methods.global_sd_smallest: (
        [table("4.5", {"local-sd": run(), "global-sd": run()}), table("4.8", {"local-sd": run(), "global-sd": stuck()})],
        [table("4.5", {"local-sd": run(), "global-sd": run()}), table("4.8", {"local-sd": run(), "global-sd": run()})],
        [table("4.8", {"local-sd": run(), "global-sd": stuck()})],
    ),
    global_methods.global_sd_bridge: (
        [table("4.1", {"local-sd": run(), "global-sd": stuck()})],
        [table("4.1", {"local-sd": run(), "global-sd": run()})],
        [table("4.1", {"local-sd": run(2), "global-sd": late()})],
    ),
    global_methods.minres_suffices: (
        [table("4.5", {"local-sd": run(), "global-nr": run()})],
        [table("4.5", {"local-sd": run(), "global-nr": late()})],
        [table("4.5", {"local-sd": run(2), "global-nr": late()})],
    ),
    robustness.several_fail: (
        [table(name, {"local-sd": run(), "global-nr": stuck()}) for name in ("4.5", "4.6")],
        [table(name, {"local-sd": run(2), "global-nr": late()}) for name in ("4.5", "4.6")],
        [table("4.5", {"local-sd": run(), "global-nr": stuck()})],
    ),
    robustness.unsuitable_on_plane: (
        [table("4.15", {"local-sd": run(), "global-sd": stuck(), "global-nr": stuck()})],
        [table("4.15", {"local-sd": run(), "global-sd": stuck(), "global-nr": run()})],
        [table("4.15", {"local-sd": run(2), "global-sd": late(), "global-nr": late()})],
    ),
    robustness.less_robust: (
        [table("4.5", {"local-sd": run(), "local-nr": run(), "global-nr": run(), "global-sd": stuck()})],
        [table("4.5", {"local-sd": run(), "local-nr": stuck(), "global-nr": run()})],
        [table("4.5", {"local-sd": run(2), "global-nr": late()})],
    ),
    robustness.practical_issues: (
        [table("4.5", {"local-sd": run(), "global-nr": run()}), table("4.10", {"local-sd": run(), "global-nr": stuck()})],
        [table("4.5", {"local-sd": run(), "global-nr": run()}), table("4.10", {"local-sd": run(), "global-nr": run()})],
        [table("4.5", {"local-sd": run(), "global-nr": run()})],
    ),
    delta.small_delta_harms: (
        [table("4.3", {"global-nr": late(inverted=3)}), table("4.4", {"global-nr": run()})],
        [table("4.3", {"global-nr": run()}), table("4.4", {"global-nr": run()})],
        [table("4.3", {"global-nr": late(inverted=3)})],
    ),
    delta.large_delta_moves: (
        [table("4.3", {"global-nr": late()}), table("4.4", {"global-nr": run(inverted=2)})],
        [table("4.3", {"global-nr": late()}), table("4.4", {"global-nr": run()})],
        [table("4.3", {"global-nr": late()}), table("4.4", {"global-nr": late(inverted=2)})],
    ),
    delta.large_delta_local: (
        [table("4.3", {"local-sd": run()}), table("4.4", {"local-sd": run(inverted=2)})],
        [table("4.3", {"local-sd": run()}), table("4.4", {"local-sd": run()})],
        [table("4.3", {"global-nr": run()}), table("4.4", {"global-nr": run(inverted=2)})],
    ),
    delta.delta_idle: (
        [table("4.1", {"local-sd": run()}), table("4.1", {"local-sd": run(2)}, "bridgeSharpGiD, another delta")],
        [table("4.1", {"local-sd": run()}), table("4.1", {"local-sd": run(q_min=0.1)}, "bridgeSharpGiD, another delta")],
        [table("4.1", {"local-sd": run()})],
    ),
    cost.cost_constant: (
        [
            table("4.5", {"local-sd": run(1)}, free_nodes=100),
            table("4.6", {"local-sd": run(10, free_nodes=1000)}, free_nodes=1000),
        ],
        [
            table("4.5", {"local-sd": run(1)}, free_nodes=100),
            table("4.6", {"local-sd": run(100, free_nodes=1000)}, free_nodes=1000),
        ],
        [table("4.5", {"local-sd": run(1)}, free_nodes=100)],
    ),
    cost.scaling_alike: (
        [
            table("4.5", {"local-sd": run(1), "global-nr": run(5)}, free_nodes=100),
            table("4.6", {"local-sd": run(10), "global-nr": run(50)}, free_nodes=1000),
        ],
        [
            table("4.5", {"local-sd": run(1), "global-nr": run(5)}, free_nodes=100),
            table("4.6", {"local-sd": run(10), "global-nr": run(500)}, free_nodes=1000),
        ],
        [
            table("4.5", {"local-sd": run(1), "global-nr": run(5)}, free_nodes=100),
            table("4.6", {"local-sd": run(10), "global-nr": stuck()}, free_nodes=1000),
        ],
    ),
}  # fmt: skip


@pytest.mark.parametrize("claim", JUDGED, ids=lambda claim: claim.__name__)
def test_a_claim_follows_the_figures(claim):
    assert [claim(measured).reproduced for measured in JUDGED[claim]] == [True, False, None]


def test_every_claim_is_tested():
    assert set(CLAIMS) == {*JUDGED, heuristics.laplacian_inverts}
    assert len({claim([]).claim for claim in CLAIMS}) == len(CLAIMS)


def published(experiment):
    """A table of the thesis as if we had measured it: the objective is what q norm says, for which plane has q mean."""
    columns = {
        name: {"q_norm": figures.get("q_mean"), **figures} for name, figures in experiment.published.items() if figures
    }
    figures = {
        name: summary(
            **{key: one[key] for key in ("q_min", "q_mean", "q_norm")},
            hexes=experiment.hexes,
            free_nodes=experiment.free_nodes,
            inverted=int(one["q_min"] == 0),
            objective=experiment.hexes / one["q_norm"] ** 2 if one["q_min"] > 0 and one["q_norm"] > 0 else None,
        )
        for name, one in ((name, {"q_min": 0.1, "q_mean": one["q_norm"]} | one) for name, one in columns.items())
    }
    best = max(one.q_norm for name, one in figures.items() if name in experiment.methods)
    rows = {}
    for name, one in figures.items():
        if "seconds" in columns[name]:
            heuristic = name in ("laplacian", "getme")
            tangled = experiment.table == "4.4" and name.startswith("local-")  # 4.2.1: they converge to a tangled mesh
            there = heuristic or tangled or (one.q_norm > best - 6e-4 and columns[name]["iterations"] < 201)
            outcome = "converged" if there else "max-iterations"
            iterations, seconds = columns[name]["iterations"], columns[name]["seconds"]
            rows[name] = Row(name, {}, outcome, "", MESH, one, iterations, seconds)
    initial = figures.get("initial", summary(hexes=experiment.hexes))
    return Measured(experiment, MESH, replace(initial, inverted=experiment.inverted), rows)


def test_by_the_thesis_s_own_figures_its_claims_hold_but_for_one():
    """Its tables contradict it where GETMe's time is to be made up for: 202 s and 650 s against 800 s."""
    tables = [published(one) for one in THESIS.experiments if "seconds" in one.published.get("local-sd", {})]
    heuristic = [published(one) for one in THESIS.experiments if one.table in ("4.11", "4.12", "4.13")]
    verdicts = {claim: claim([*tables, *heuristic]).reproduced for claim in CLAIMS}
    del verdicts[heuristics.laplacian_inverts]  # which looks at meshes
    assert {claim for claim, verdict in verdicts.items() if verdict is False} == {
        preconditioning.preconditioning_compensates
    }
    assert {claim for claim, verdict in verdicts.items() if verdict is None} == {
        heuristics.sequential_raises_minimum, local_methods.modified_local, delta.delta_idle,
    }  # fmt: skip


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.__name__)
def test_every_claim_can_do_without_figures(claim):
    answer = claim([])
    assert answer.reproduced is None
    assert answer.figures
    assert answer.section
    assert answer.record()["claim"] == answer.claim


def test_laplacian_must_invert_sound_hexes_on_both_meshes():
    tangled = MESH.with_points(np.where(MESH.free[:, None], MESH.points[::-1], MESH.points))
    row = {"laplacian": run(mesh=tangled)}
    bridge = table("4.3", row)
    claim = heuristics.laplacian_inverts([bridge, table("4.14", row)])
    assert claim.reproduced is True
    assert "bridge-sharp, 8 hexes: " in claim.figures
    untouched = [table("4.14", {"laplacian": run()}), table("4.15", row, hexes=4)]
    assert heuristics.laplacian_inverts([bridge, *untouched]).reproduced is False  # the larger plane decides
    assert heuristics.laplacian_inverts([bridge]).reproduced is None


def test_the_objective_is_the_one_that_was_minimised():
    """With another offset in (3.3) a run is judged by the sum that it lowered, not by that of tables."""

    row = table("4.1", {"local-sd": run(objective=7.0)}).rows["local-sd"]
    assert objective(row) == 7.0
    eta = measure(MESH.points, MESH.hexes).eta
    assert objective(replace(row, parameters={"offset": 0.0})) == pytest.approx(np.square(eta + 1).sum())


def test_where_no_optimiser_arrives_one_that_converges_elsewhere_is_what_optimisation_ends_at():
    rows = {"laplacian": run(), "getme": run(q_min=0.1, q_mean=0.8)}
    rows["local-sd"] = run(q_min=0.2, q_mean=0.9, inverted=5, objective=None)
    claim = optimum.optimum_is_best([table("4.14", rows)])
    assert claim.reproduced is True
    assert "5 inverted" in claim.figures


def test_all_cases_must_hold_or_most_where_most_is_said():
    cases = [(True, "a"), (True, "b"), (False, "c")]
    assert [tally(cases, "none", most=most)[0] for most in (False, True)] == [False, True]
    assert tally([], "none") == (None, "none")
