"""Names of earlier versions that are still read; nothing is written under them any more.

Each table maps an old name to the name that took its place:

- `MODULES`: modules and packages, for imports (``import hexmend.surface``).
- `NAMES`: what a module exports (``hx.Stop``), by the module; a new name with dots belongs to another module.
- `PARAMETERS`: parameters by the name of their owner (a method, or "stop"), in recipes, sessions, studies, records,
  on the command line, and as keywords and attributes in Python.
- `ATTRIBUTES`: attributes, and members of enumerations, by the dotted name of the class; attributes are keywords of
  its constructor too.
- `KEYWORDS`: keyword arguments of functions, by the function.
"""

from __future__ import annotations

import sys
from functools import wraps
from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from enum import Enum
    from importlib.machinery import ModuleSpec
    from types import ModuleType
    from typing import Any, ParamSpec, TypeVar

    E = TypeVar("E", bound=Enum)
    P = ParamSpec("P")
    T = TypeVar("T")

_NOW_IN_MESH = "cells edge_length fixing hexahedron orientation patches second_order structure tags topology"

MODULES = {
    **{f"hexmend.{name}": f"hexmend.mesh.{name}" for name in _NOW_IN_MESH.split()},
    "hexmend.io.format": "hexmend.io.base.format",
    "hexmend.io.recipes": "hexmend.run.recipe_files",
    "hexmend.io.session": "hexmend.io.formats.session",
    "hexmend.movement": "hexmend.boundary.displacement",
    "hexmend.optimise.figures": "hexmend.iteration.figures",
    "hexmend.optimise.iteration": "hexmend.iteration.result",
    "hexmend.optimise.stop": "hexmend.iteration.stopping",
    "hexmend.recipe": "hexmend.run.recipe",
    "hexmend.shape_functions": "hexmend.mesh.second_order.shape_functions",
    "hexmend.smoothers.smoother": "hexmend.smoothers.base",
    "hexmend.surface": "hexmend.boundary",
}

NAMES: dict[str, dict[str, str]] = {
    "hexmend": {"Stop": "hexmend.iteration.StoppingCriteria"},
    "hexmend.boundary": {
        "Kind": "NodeClass", "Skin": "SkinSurface", "Sliding": "SlidingBoundary", "distances": "mutual_distances",
        "sliding_boundary": "boundary_with_kept_corners",
    },
    "hexmend.boundary.displacement": {
        "Change": "DisplacementQuantity", "Counts": "DisplacementCounts", "MOVEMENTS": "DISPLACEMENT_QUANTITIES",
        "Moment": "ReferenceState", "Movement": "Displacement",
    },
    "hexmend.doctor": {"AILMENTS": "PROBLEMS", "Ailment": "Problem"},
    "hexmend.energy": {
        "Couplings": "BlockSparsity", "Power": "ObjectiveNorm",
        "corners_left_out": "hexmend.energy.hex_energy.as_omitted_corners",
    },
    "hexmend.io": {
        "left_out": "hexmend.io.files.unsupported_data", "read_recipe": "hexmend.run.recipe_files.read_recipe",
        "write_recipe": "hexmend.run.recipe_files.write_recipe",
    },
    "hexmend.io.base.format": {"Holds": "Capability"},
    "hexmend.io.formats.session": {
        "KeptSession": "hexmend.io.formats.session.session_file.SessionFolder",
        "Stored": "hexmend.io.formats.session.session_file.SessionContent",
        "VERSION": "hexmend.io.formats.session.session_file.VERSION",
        "read_session": "hexmend.io.formats.session.session_file.read_session",
        "write_session": "hexmend.io.formats.session.session_file.write_session",
    },
    "hexmend.io.surfaces": {"SURFACES": "SURFACE_FORMATS"},
    "hexmend.iteration": {"Limits": "ActiveSet", "Stop": "StoppingCriteria"},
    "hexmend.iteration.result": {"Limits": "hexmend.iteration.ActiveSet", "Step": "hexmend.iteration.Step"},
    "hexmend.iteration.stopping": {"Stop": "hexmend.iteration.StoppingCriteria"},
    "hexmend.mesh.fixing": {"with_region_free": "fix_outside", "with_sets_fixed": "fix"},
    "hexmend.mesh.topology": {"Rows": "CSR"},
    "hexmend.node_step": {"Verdict": "StepStatus"},
    "hexmend.optimise": {
        "Iteration": "hexmend.iteration.Iteration", "Limits": "hexmend.iteration.ActiveSet",
        "Outcome": "hexmend.iteration.Outcome", "Result": "hexmend.iteration.Result",
        "StageResult": "hexmend.iteration.StageResult", "Step": "hexmend.iteration.Step",
        "Stop": "hexmend.iteration.StoppingCriteria",
    },
    "hexmend.quality": {
        "Element": "HexDetails", "ElementFigure": "HexQuantity", "FIGURES": "SUMMARY_QUANTITIES",
        "JUDGED": "REGRESSION_KEYS", "Node": "NodeDetails", "SecondOrder": "SecondOrderSummary",
        "Spread": "MetricStatistics", "element": "describe_hex", "locked": "locked_hexes",
        "node": "describe_node",
        "spreads": "metric_statistics", "values": "metric_values", "worse": "hexmend.quality.regressions.regressions",
        "worse_in_words": "describe_regressions", "worst": "rank_worst",
    },
    "hexmend.report": {
        "made_folder": "hexmend.report.documents.output_folder", "table_of": "hexmend.report.comparison.record_table",
    },
    "hexmend.run": {"Stop": "hexmend.iteration.StoppingCriteria"},
}  # fmt: skip

_LINE_SEARCH = {"first_step": "initial_step", "max_cuts": "max_backtracks", "shrink": "backtrack_factor"}

PARAMETERS: dict[str, dict[str, str]] = {
    **{f"global-{direction}": _LINE_SEARCH for direction in ("sd", "nr", "mnr")},
    **{f"local-{direction}": _LINE_SEARCH for direction in ("sd", "nr", "mnr", "patch")},
    "general": {"similar": "max_size_ratio", "sufficient": "q_target"},
    "getme-sequential": {"setback": "rejection_penalty"},
    "mend": {"highest_p": "max_p", "softness": "initial_epsilon"},
}

ATTRIBUTES: dict[str, dict[str, str]] = {
    "hexmend.advice.advice.Advice": {
        "held": "locked_below", "left": "state", "loose": "unlocked", "nothing": "no_suggestion", "why": "reason",
        "worse": "regressions",
    },
    "hexmend.boundary.classification.Boundary": {"part": "component"},
    "hexmend.boundary.sliding.sliding_boundary.SlidingBoundary": {
        "degrees": "feature_angle", "tolerance": "max_deviation",
    },
    "hexmend.energy.mesh_energy.MeshEnergy": {
        "but": "with_objective", "least": "cube_value", "left_out": "omitted", "placed": "to_mesh_units",
        "power": "norm", "scaled": "to_edge_units",
    },
    "hexmend.io.base.format.Capability": {"PINS": "FIXED_NODES"},
    "hexmend.io.base.format.Format": {
        "cannot": "limitations", "holds": "capabilities", "names": "stored_names", "recognised": "matches",
    },
    "hexmend.iteration.result.Iteration": {"figures": "quality", "notes": "diagnostics", "power": "norm"},
    "hexmend.iteration.result.Result": {"limits": "active"},
    "hexmend.iteration.step.Step": {
        "detour": "infeasible", "figures": "quality", "limits": "active", "more": "intermediate",
        "notes": "diagnostics", "power": "norm",
    },
    "hexmend.node_step.record.NodeStep": {
        "cuts": "backtracks", "notes": "diagnostics", "power": "norm", "verdict": "status", "whole": "is_global",
    },
    "hexmend.node_step.record.StepStatus": {
        "FLAT": "STATIONARY", "STAYS": "UNCHANGED", "TAKEN_BACK": "REJECTED", "THERE": "AT_TARGET",
    },
    "hexmend.node_step.sweep.Sweep": {"look": "preview", "over": "finished", "place": "position"},
    "hexmend.run.breakpoints.Breakpoints": {"cuts": "backtracks"},
    "hexmend.run.run.Run": {"go_on_with": "switch_method", "limit": "max_iterations", "reached": "best"},
    "hexmend.smoothers.base.Smoother": {"power": "norm"},
}  # fmt: skip

KEYWORDS: dict[str, dict[str, str]] = {
    "boundary_of": {"degrees": "feature_angle"},
    "iterate": {"smoother": "method"},
    "objective": {"power": "norm"},
    "read": {"nodes_without_place": "interpolate_missing"},
    "smooth": {"smoother": "method"},
    "summarise": {"figures": "quality"},
    "surface_change": {"degrees": "feature_angle"},
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
        now = NAMES.get(module, {}).get(name)
        if now is None:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        home, _, attribute = now.rpartition(".")
        return getattr(import_module(home or module), attribute)

    return __getattr__


def former_attributes(cls: type) -> dict[str, str]:
    """Return the entry of `ATTRIBUTES` for a class; empty if nothing of it has been renamed."""
    return ATTRIBUTES.get(f"{cls.__module__}.{cls.__qualname__}", {})


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
    names = former_attributes(cls) if table is None else table
    if not names:
        return cls
    init: Callable[..., None] = vars(cls).get("__init__") or cls.__init__

    @wraps(init)
    def __init__(self: T, *args: Any, **values: Any) -> None:
        for old in names.keys() & values.keys():  # wins over the new name, which `dataclasses.replace` always gives
            values[names[old]] = values.pop(old)
        init(self, *args, **values)

    def __getattr__(self: T, name: str) -> Any:
        if name in names:
            return getattr(self, names[name])
        return object.__getattribute__(self, name)  # raises what had failed

    for method in (__init__, __getattr__):
        setattr(cls, method.__name__, method)
    return cls


def reads_old_members(cls: type[E]) -> type[E]:
    """Class decorator of an enumeration: its members have their old names of `ATTRIBUTES` as aliases."""
    for old, new in former_attributes(cls).items():
        setattr(cls, old, cls[new])
        cls._member_map_[old] = cls[new]  # for `cls["OLD"]`; an attribute that is a member cannot be set any more
    return cls


def old_keywords(owner: str) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Make a decorator of a function, which then also takes keywords under their names of earlier versions.

    Parameters
    ----------
    owner : str
        Key in `KEYWORDS`.
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        @wraps(function)
        def call(*args: P.args, **keywords: P.kwargs) -> T:
            return function(*args, **renamed(keywords, KEYWORDS[owner]))

        return call

    return decorate


def _module_of(name: str) -> str | None:
    """Return the name of today of a module with an old name or in a package with one; None for any other."""
    package, _, rest = name.rpartition(".")
    if name in MODULES or not package:
        return MODULES.get(name)
    home = _module_of(package)
    return None if home is None else f"{home}.{rest}"


class _OldModules:
    """Finder and loader of modules under the names of earlier versions."""

    @staticmethod
    def find_spec(name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        if _module_of(name) is None:
            return None
        from importlib.machinery import ModuleSpec

        loader: Any = _OldModules()  # it need not derive from `Loader`, whose import takes time
        return ModuleSpec(name, loader)

    @staticmethod
    def create_module(spec: ModuleSpec) -> None:
        return None

    @staticmethod
    def exec_module(module: ModuleType) -> None:
        from importlib import import_module

        name = _module_of(module.__name__)
        assert name is not None  # a module that `find_spec` has found
        sys.modules[module.__name__] = import_module(name)


def install() -> None:
    """Let `import` find the modules of `MODULES`."""
    if not any(isinstance(finder, _OldModules) for finder in sys.meta_path):
        sys.meta_path.insert(0, _OldModules())  # a folder left by an older checkout would be taken for a package
