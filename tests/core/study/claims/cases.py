"""Runs by which each claim of the thesis holds, fails, and is not judged."""

from hexmend.study.claims import (
    cost,
    delta,
    global_methods,
    heuristics,
    local_methods,
    optimum,
    preconditioning,
    robustness,
)
from tests.core.study.claims.runs import late, run, stuck, table

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
    heuristics.getme_typically: (
        [
            table("4.11", {"laplacian": run(q_min=0.3), "getme": run(1, q_min=0.4, q_mean=0.5, q_norm=0.6)}),
            table("4.5", {"local-sd": run(20, q_norm=0.7), "global-nr": run(30, q_norm=0.7)}),
        ],
        [
            table("4.11", {"laplacian": run(q_min=0.3), "getme": run(1, q_min=0.4, q_mean=0.5, q_norm=0.6)}),
            table("4.5", {"local-sd": run(2, q_norm=0.7), "global-nr": run(30, q_norm=0.7)}),
        ],
        [table("4.11", {"laplacian": run(), "getme": run(2.5)}), table("4.5", {"local-sd": late()})],
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
        [
            table("4.1", {"local-sd": run(10)}),
            table("4.2", {"getme": run(3), "local-sd": run(8)}),
            table("4.3", {"laplacian": run(1), "local-sd": run(8)}),
        ],
        [table("4.1", {"local-sd": run(10)}), table("4.2", {"getme": run(3), "local-sd": run(6)})],
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
    delta.direct_solver: (
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
