"""Hexmend: quality, smoothing and untangling of hexahedral meshes.

>>> import hexmend as hx
>>> mesh = hx.gallery.make("five-side", size=500)
>>> result = hx.smooth(mesh, "local-sd")
>>> result.after.q_mean > result.before.q_mean
True

Names are imported when they are first used: a command that computes nothing does not wait for NumPy. Beside those of
`__all__` the class of every registered method is here under its own name, such as `hx.LocalSteepestDescent`.
"""

from importlib import import_module

from hexmend import aliases, hooks

__version__ = "1.0.0"

TYPE_CHECKING = False  # which type checkers take for true; `typing` alone would cost as much as `--version` does
if TYPE_CHECKING:
    from hexmend import energy, gallery
    from hexmend.advice import advise
    from hexmend.errors import FileError, HexmendError, MeshError, ParameterError
    from hexmend.interop import from_meshio, from_pyvista, to_meshio, to_pyvista
    from hexmend.io import read, read_surface, write
    from hexmend.iteration import Iteration, Outcome, Result, Step
    from hexmend.layers import find_layers
    from hexmend.mesh.cells import Cells
    from hexmend.mesh.mesh import Mesh
    from hexmend.notebook import view
    from hexmend.padding import Padding, pad
    from hexmend.parameters import parameter
    from hexmend.quality import METRICS, Summary, measure, summarise
    from hexmend.run import Run, StoppingCriteria, iterate, smooth
    from hexmend.run.recipe import Recipe, Stage
    from hexmend.run.recipe_files import read_recipe, write_recipe
    from hexmend.smoothers import METHODS, Smoother, method
    from hexmend.study.compare import Comparison, compare
    from hexmend.target import make_target

aliases.install()
hooks.register_hooks(
    html="hexmend.notebook:html",
    quality="hexmend.quality:metric_values",
    with_rules="hexmend.mesh.rules.resolution:with_rules",
    worst_hexes="hexmend.quality:worst_hexes",
)

_HOMES = {
    "advice": ("advise",),
    "errors": ("FileError", "HexmendError", "MeshError", "ParameterError"),
    "interop": ("from_meshio", "from_pyvista", "to_meshio", "to_pyvista"),
    "io": ("read", "read_surface", "write"),
    "iteration": ("Iteration", "Outcome", "Result", "Step"),
    "layers": ("find_layers",),
    "mesh": ("Mesh",),
    "mesh.cells": ("Cells",),
    "notebook": ("view",),
    "padding": ("Padding", "pad"),
    "parameters": ("parameter",),
    "quality": ("METRICS", "Summary", "measure", "summarise"),
    "run": ("Run", "StoppingCriteria", "iterate", "smooth"),
    "run.recipe": ("Recipe", "Stage"),
    "run.recipe_files": ("read_recipe", "write_recipe"),
    "smoothers": ("METHODS", "Smoother", "method"),
    "study.compare": ("Comparison", "compare"),
    "target": ("make_target",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "METHODS",
    "METRICS",
    "Cells",
    "Comparison",
    "FileError",
    "HexmendError",
    "Iteration",
    "Mesh",
    "MeshError",
    "Outcome",
    "Padding",
    "ParameterError",
    "Recipe",
    "Result",
    "Run",
    "Smoother",
    "Stage",
    "Step",
    "StoppingCriteria",
    "Summary",
    "advise",
    "compare",
    "energy",
    "find_layers",
    "from_meshio",
    "from_pyvista",
    "gallery",
    "iterate",
    "make_target",
    "measure",
    "method",
    "pad",
    "parameter",
    "read",
    "read_recipe",
    "read_surface",
    "smooth",
    "summarise",
    "to_meshio",
    "to_pyvista",
    "view",
    "write",
    "write_recipe",
]


def __getattr__(name: str) -> object:
    if name in ("energy", "gallery"):
        return import_module(f"hexmend.{name}")
    if name in _HOME_OF:
        return getattr(import_module(f"hexmend.{_HOME_OF[name]}"), name)
    for smoother in () if name.startswith("_") else import_module("hexmend.smoothers").METHODS.values():
        if smoother.__name__ == name:
            return smoother
    return aliases.exports("hexmend")(name)


def __dir__() -> list[str]:
    from hexmend.smoothers import METHODS

    return sorted({*__all__, *(smoother.__name__ for smoother in METHODS.values())})
