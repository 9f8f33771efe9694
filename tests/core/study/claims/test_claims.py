"""Claims follow the figures: made-up runs reproduce each, contradict it, or leave it undecided."""

from dataclasses import replace

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend.study.claims import CLAIMS, delta, heuristics, local_methods, optimum
from hexmend.study.claims.claim import tally
from hexmend.study.claims.queries import objective
from hexmend.study.table_row import Row
from hexmend.study.thesis.experiment_result import ExperimentResult
from tests.core.study.claims.cases import JUDGED
from tests.core.study.claims.runs import MESH, THESIS, run, summary, table


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
    return ExperimentResult(experiment, MESH, replace(initial, inverted=experiment.inverted), rows)


def test_all_claims_hold_by_the_figures_of_the_thesis():
    tables = [published(one) for one in THESIS.experiments if "seconds" in one.published.get("local-sd", {})]
    heuristic = [published(one) for one in THESIS.experiments if one.table in ("4.11", "4.12", "4.13")]
    judgements = {claim: claim([*tables, *heuristic]).reproduced for claim in CLAIMS}
    del judgements[heuristics.laplacian_inverts]  # which looks at meshes
    assert not {claim for claim, judgement in judgements.items() if judgement is False}
    assert {claim for claim, judgement in judgements.items() if judgement is None} == {
        heuristics.sequential_raises_minimum, local_methods.modified_local, delta.delta_idle,
    }  # fmt: skip


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.__name__)
def test_every_claim_is_judged_without_figures(claim):
    answer = claim([])
    assert answer.reproduced is None
    assert answer.figures
    assert answer.section
    assert answer.record()["claim"] == answer.claim


def test_laplacian_must_invert_valid_hexes_on_both_meshes():
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


def test_without_an_optimal_run_other_converged_runs_are_the_result_of_optimisation():
    rows = {"laplacian": run(), "getme": run(q_min=0.1, q_mean=0.8)}
    rows["local-sd"] = run(q_min=0.2, q_mean=0.9, inverted=5, objective=None)
    claim = optimum.optimum_is_best([table("4.14", rows)])
    assert claim.reproduced is True
    assert "5 inverted" in claim.figures


def test_a_tally_requires_all_cases_or_most():
    cases = [(True, "a"), (True, "b"), (False, "c")]
    assert [tally(cases, "none", most=most)[0] for most in (False, True)] == [False, True]
    assert tally([], "none") == (None, "none")
