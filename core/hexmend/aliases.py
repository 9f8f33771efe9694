"""Names of earlier versions that are still read; nothing is written under them any more.

Each table maps an old name to the name that took its place:

- `MODULES`: modules and packages, for imports (``import hexmend.surface``).
- `NAMES`: what a module or package exports (``hx.Stop``, ``from hexmend.optimise import Outcome``).
- `PARAMETERS`: parameters by the name of their owner (a method, or "stop"), in recipes, sessions, studies, records,
  on the command line, and as keywords and attributes in Python.
- `ATTRIBUTES`: attributes by the name of their class, as keywords of its constructor too.
- `KEYWORDS`: keyword arguments of functions, by the function.
"""

from __future__ import annotations

import sys
from functools import wraps

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from importlib.machinery import ModuleSpec
    from types import ModuleType
    from typing import Any, TypeVar

    T = TypeVar("T")

MODULES = {
    "hexmend.cells": "hexmend.mesh.cells",
    "hexmend.edge_length": "hexmend.mesh.edge_length",
    "hexmend.fixing": "hexmend.mesh.fixing",
    "hexmend.hexahedron": "hexmend.mesh.hexahedron",
    "hexmend.io.format": "hexmend.io.base.format",
    "hexmend.io.recipes": "hexmend.run.recipe_files",
    "hexmend.io.session": "hexmend.io.formats.session",
    "hexmend.movement": "hexmend.boundary.displacement",
    "hexmend.optimise.figures": "hexmend.iteration.figures",
    "hexmend.optimise.iteration": "hexmend.iteration.result",
    "hexmend.optimise.stop": "hexmend.iteration.stopping",
    "hexmend.orientation": "hexmend.mesh.orientation",
    "hexmend.patches": "hexmend.mesh.patches",
    "hexmend.recipe": "hexmend.run.recipe",
    "hexmend.second_order": "hexmend.mesh.second_order",
    "hexmend.shape_functions": "hexmend.mesh.shape_functions",
    "hexmend.smoothers.smoother": "hexmend.smoothers.base",
    "hexmend.structure": "hexmend.mesh.structure",
    "hexmend.surface": "hexmend.boundary",
    "hexmend.tags": "hexmend.mesh.tags",
    "hexmend.topology": "hexmend.mesh.topology",
}

NAMES = {
    "hexmend.Stop": "hexmend.iteration.StoppingCriteria",
    "hexmend.boundary.Kind": "hexmend.boundary.NodeClass",
    "hexmend.boundary.Skin": "hexmend.boundary.SkinSurface",
    "hexmend.boundary.Sliding": "hexmend.boundary.SlidingBoundary",
    "hexmend.boundary.displacement.Change": "hexmend.boundary.displacement.DisplacementQuantity",
    "hexmend.boundary.displacement.Counts": "hexmend.boundary.displacement.DisplacementCounts",
    "hexmend.boundary.displacement.MOVEMENTS": "hexmend.boundary.displacement.DISPLACEMENT_QUANTITIES",
    "hexmend.boundary.displacement.Moment": "hexmend.boundary.displacement.ReferenceState",
    "hexmend.boundary.displacement.Movement": "hexmend.boundary.displacement.Displacement",
    "hexmend.boundary.distances": "hexmend.boundary.mutual_distances",
    "hexmend.doctor.AILMENTS": "hexmend.doctor.PROBLEMS",
    "hexmend.doctor.Ailment": "hexmend.doctor.Problem",
    "hexmend.energy.Couplings": "hexmend.energy.BlockSparsity",
    "hexmend.energy.Power": "hexmend.energy.ObjectiveNorm",
    "hexmend.io.base.format.Holds": "hexmend.io.base.format.Capability",
    "hexmend.io.left_out": "hexmend.io.files.unsupported_data",
    "hexmend.io.formats.session.KeptSession": "hexmend.io.formats.session.session_file.SessionFolder",
    "hexmend.io.formats.session.Stored": "hexmend.io.formats.session.session_file.SessionContent",
    "hexmend.io.formats.session.VERSION": "hexmend.io.formats.session.session_file.VERSION",
    "hexmend.io.formats.session.read_session": "hexmend.io.formats.session.session_file.read_session",
    "hexmend.io.formats.session.write_session": "hexmend.io.formats.session.session_file.write_session",
    "hexmend.io.read_recipe": "hexmend.run.recipe_files.read_recipe",
    "hexmend.io.surfaces.SURFACES": "hexmend.io.surfaces.SURFACE_FORMATS",
    "hexmend.io.write_recipe": "hexmend.run.recipe_files.write_recipe",
    "hexmend.iteration.Limits": "hexmend.iteration.ActiveSet",
    "hexmend.iteration.Stop": "hexmend.iteration.StoppingCriteria",
    "hexmend.iteration.result.Limits": "hexmend.iteration.ActiveSet",
    "hexmend.iteration.result.Step": "hexmend.iteration.Step",
    "hexmend.iteration.stopping.Stop": "hexmend.iteration.StoppingCriteria",
    "hexmend.mesh.topology.Rows": "hexmend.mesh.topology.CSR",
    "hexmend.node_step.Verdict": "hexmend.node_step.StepStatus",
    "hexmend.optimise.Iteration": "hexmend.iteration.Iteration",
    "hexmend.optimise.Limits": "hexmend.iteration.ActiveSet",
    "hexmend.optimise.Outcome": "hexmend.iteration.Outcome",
    "hexmend.optimise.Result": "hexmend.iteration.Result",
    "hexmend.optimise.StageResult": "hexmend.iteration.StageResult",
    "hexmend.optimise.Step": "hexmend.iteration.Step",
    "hexmend.optimise.Stop": "hexmend.iteration.StoppingCriteria",
    "hexmend.quality.Element": "hexmend.quality.HexDetails",
    "hexmend.quality.ElementFigure": "hexmend.quality.HexQuantity",
    "hexmend.quality.FIGURES": "hexmend.quality.SUMMARY_QUANTITIES",
    "hexmend.quality.JUDGED": "hexmend.quality.REGRESSION_KEYS",
    "hexmend.quality.Node": "hexmend.quality.NodeDetails",
    "hexmend.quality.SecondOrder": "hexmend.quality.SecondOrderSummary",
    "hexmend.quality.Spread": "hexmend.quality.MetricStatistics",
    "hexmend.quality.element": "hexmend.quality.describe_hex",
    "hexmend.quality.node": "hexmend.quality.describe_node",
    "hexmend.quality.spreads": "hexmend.quality.metric_statistics",
    "hexmend.quality.values": "hexmend.quality.metric_values",
    "hexmend.quality.worse": "hexmend.quality.regressions.regressions",
    "hexmend.quality.worse_in_words": "hexmend.quality.describe_regressions",
    "hexmend.quality.worst": "hexmend.quality.rank_worst",
    "hexmend.report.made_folder": "hexmend.report.documents.output_folder",
    "hexmend.report.table_of": "hexmend.report.comparison.record_table",
    "hexmend.run.Stop": "hexmend.iteration.StoppingCriteria",
}

_LINE_SEARCH = {"first_step": "initial_step", "max_cuts": "max_backtracks", "shrink": "backtrack_factor"}

PARAMETERS: dict[str, dict[str, str]] = {
    **{f"global-{direction}": _LINE_SEARCH for direction in ("sd", "nr", "mnr")},
    **{f"local-{direction}": _LINE_SEARCH for direction in ("sd", "nr", "mnr", "patch")},
    "general": {"similar": "max_size_ratio", "sufficient": "q_target"},
    "getme-sequential": {"setback": "rejection_penalty"},
    "mend": {"highest_p": "max_p", "softness": "initial_epsilon"},
}

ATTRIBUTES: dict[str, dict[str, str]] = {
    "Advice": {"held": "locked_below", "loose": "unlocked", "nothing": "no_suggestion", "why": "reason"},
    "Format": {"cannot": "limitations", "holds": "capabilities", "names": "stored_names", "recognised": "matches"},
    "Iteration": {"figures": "quality", "notes": "diagnostics"},
    "MeshEnergy": {"but": "with_objective", "placed": "to_mesh_units", "scaled": "to_edge_units"},
    "NodeStep": {"verdict": "status", "whole": "is_global"},
    "Run": {"go_on_with": "switch_method", "reached": "best"},
    "Step": {"detour": "infeasible", "figures": "quality", "more": "intermediate", "notes": "diagnostics"},
    "Sweep": {"look": "preview", "over": "finished", "place": "position"},
}

KEYWORDS: dict[str, dict[str, str]] = {
    "read": {"nodes_without_place": "interpolate_missing"},
    "summarise": {"figures": "quality"},
}


def exports(module: str) -> Callable[[str], object]:
    """Make a `__getattr__` that gives what a module exported under names of earlier versions.

    Parameters
    ----------
    module : str
        The module's dotted name.

    Returns
    -------
    callable
        Takes an attribute's name; raises AttributeError for one that never was.
    """

    def __getattr__(name: str) -> object:
        now = NAMES.get(f"{module}.{name}")
        if now is None:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        from importlib import import_module

        home, _, attribute = now.rpartition(".")
        return getattr(import_module(home), attribute)

    return __getattr__


def renamed(values: Mapping[str, Any], table: Mapping[str, str]) -> dict[str, Any]:
    """Copy `values` with the keys of today; where old and new name are both there, the new one counts."""
    return {table.get(key, key): value for key, value in values.items() if table.get(key) not in values}


def reads_old_names(cls: type[T], table: Mapping[str, str] | None = None) -> type[T]:
    """Class decorator: the constructor takes keywords, and instances have attributes, under their old names too.

    Parameters
    ----------
    cls : type
    table : mapping, optional
        New name of each old one; of `ATTRIBUTES` by default.

    Returns
    -------
    type
        The same class.
    """
    names = ATTRIBUTES.get(cls.__name__, {}) if table is None else table
    if not names:
        return cls
    init = cls.__init__

    @wraps(init)
    def __init__(self: T, *args: Any, **values: Any) -> None:
        for old in names.keys() & values.keys():  # wins over the new name, which `dataclasses.replace` always gives
            values[names[old]] = values.pop(old)
        init(self, *args, **values)

    def __getattr__(self: T, name: str) -> Any:
        if name in names:
            return getattr(self, names[name])
        return object.__getattribute__(self, name)  # raises what had failed

    cls.__init__, cls.__getattr__ = __init__, __getattr__
    return cls


def old_keywords(owner: str) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Make a decorator of a function, which then also takes keywords under their names of earlier versions.

    Parameters
    ----------
    owner : str
        Key in `KEYWORDS`.
    """

    def decorate(function: Callable[..., T]) -> Callable[..., T]:
        @wraps(function)
        def call(*args: object, **keywords: object) -> T:
            return function(*args, **renamed(keywords, KEYWORDS[owner]))

        return call

    return decorate


class _OldModules:
    """Finder of modules under the names of earlier versions; the last in `sys.meta_path`."""

    @staticmethod
    def find_spec(name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        if name not in MODULES:
            return None
        from importlib.machinery import ModuleSpec

        return ModuleSpec(name, _OldModules())

    @staticmethod
    def create_module(spec: ModuleSpec) -> None:
        return None

    @staticmethod
    def exec_module(module: ModuleType) -> None:
        from importlib import import_module

        sys.modules[module.__name__] = import_module(MODULES[module.__name__])


def install() -> None:
    """Let `import` find the modules of `MODULES`."""
    if not any(isinstance(finder, _OldModules) for finder in sys.meta_path):
        sys.meta_path.append(_OldModules())
