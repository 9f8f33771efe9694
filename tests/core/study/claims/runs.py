"""Made-up runs, and tables of the thesis as if they were measured."""

from hexmend.gallery import make
from hexmend.quality import Summary
from hexmend.study.table_row import Row
from hexmend.study.thesis.experiment_result import ExperimentResult
from hexmend.study.thesis.experiments import load

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
    return ExperimentResult(experiment, MESH, summary(**{"hexes": 8} | initial), made)
