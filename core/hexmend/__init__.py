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

from hexmend import hooks

__version__ = "1.0.0"

TYPE_CHECKING = False  # which type checkers take for true; `typing` alone would cost as much as `--version` does
if TYPE_CHECKING:
    from hexmend import energy as energy
    from hexmend import gallery as gallery
    from hexmend.advice import advise as advise
    from hexmend.errors import FileError as FileError
    from hexmend.errors import HexmendError as HexmendError
    from hexmend.errors import MeshError as MeshError
    from hexmend.errors import ParameterError as ParameterError
    from hexmend.interop import from_meshio as from_meshio
    from hexmend.interop import from_pyvista as from_pyvista
    from hexmend.interop import to_meshio as to_meshio
    from hexmend.interop import to_pyvista as to_pyvista
    from hexmend.io import read as read
    from hexmend.io import read_surface as read_surface
    from hexmend.io import write as write
    from hexmend.iteration import Iteration as Iteration
    from hexmend.iteration import Outcome as Outcome
    from hexmend.iteration import Result as Result
    from hexmend.iteration import Step as Step
    from hexmend.layers import find_layers as find_layers
    from hexmend.mesh.cells import Cells as Cells
    from hexmend.mesh.element_target import Target as Target
    from hexmend.mesh.fixing import fix as fix
    from hexmend.mesh.fixing import fix_outside as fix_outside
    from hexmend.mesh.fixing import unfix as unfix
    from hexmend.mesh.linear_motion import LinearMotion as LinearMotion
    from hexmend.mesh.mesh import Mesh as Mesh
    from hexmend.mesh.rules import MotionRules as MotionRules
    from hexmend.mesh.tags import add_set as add_set
    from hexmend.mesh.tags import remove_set as remove_set
    from hexmend.notebook import view as view
    from hexmend.padding import Padding as Padding
    from hexmend.padding import pad as pad
    from hexmend.parameters import parameter as parameter
    from hexmend.quality import METRICS as METRICS
    from hexmend.quality import Summary as Summary
    from hexmend.quality import summarise as summarise
    from hexmend.quality.measure import ElementQuality as ElementQuality
    from hexmend.quality.measure import measure as measure
    from hexmend.run import Run as Run
    from hexmend.run import StoppingCriteria as StoppingCriteria
    from hexmend.run import iterate as iterate
    from hexmend.run import smooth as smooth
    from hexmend.run.recipe import Recipe as Recipe
    from hexmend.run.recipe import Stage as Stage
    from hexmend.run.recipe_files import read_recipe as read_recipe
    from hexmend.run.recipe_files import write_recipe as write_recipe
    from hexmend.smoothers import METHODS as METHODS
    from hexmend.smoothers import Smoother as Smoother
    from hexmend.smoothers import method as method
    from hexmend.smoothers.general import General as General
    from hexmend.smoothers.getme.sequential import SequentialGETMe as SequentialGETMe
    from hexmend.smoothers.getme.simultaneous import GETMe as GETMe
    from hexmend.smoothers.global_.newton import GlobalModifiedNewton as GlobalModifiedNewton
    from hexmend.smoothers.global_.newton import GlobalNewtonRaphson as GlobalNewtonRaphson
    from hexmend.smoothers.global_.steepest_descent import GlobalSteepestDescent as GlobalSteepestDescent
    from hexmend.smoothers.laplacian.laplacian import Laplacian as Laplacian
    from hexmend.smoothers.laplacian.smart_laplacian import SmartLaplacian as SmartLaplacian
    from hexmend.smoothers.local.newton import LocalModifiedNewton as LocalModifiedNewton
    from hexmend.smoothers.local.newton import LocalNewtonRaphson as LocalNewtonRaphson
    from hexmend.smoothers.local.patch import LocalPatch as LocalPatch
    from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent as LocalSteepestDescent
    from hexmend.smoothers.mend.mend import Mend as Mend
    from hexmend.study.compare import Comparison as Comparison
    from hexmend.study.compare import compare as compare
    from hexmend.target import make_target as make_target

hooks.register_hooks(
    fixed_sets="hexmend.mesh.fixing:fixed_sets",
    html="hexmend.notebook:html",
    plot="hexmend.notebook:plot",
    quality="hexmend.quality:metric_values",
    region="hexmend.quality.selection:region",
    summary="hexmend.quality:summarise",
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
    "mesh.element_target": ("Target",),
    "mesh.fixing": ("fix", "fix_outside", "unfix"),
    "mesh.linear_motion": ("LinearMotion",),
    "mesh.rules": ("MotionRules",),
    "mesh.tags": ("add_set", "remove_set"),
    "notebook": ("view",),
    "padding": ("Padding", "pad"),
    "parameters": ("parameter",),
    "quality": ("METRICS", "ElementQuality", "Summary", "measure", "summarise"),
    "run": ("Run", "StoppingCriteria", "iterate", "smooth"),
    "run.recipe": ("Recipe", "Stage"),
    "run.recipe_files": ("read_recipe", "write_recipe"),
    "smoothers": ("METHODS", "Smoother", "method"),
    "study.compare": ("Comparison", "compare"),
    "target": ("make_target",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [*_HOME_OF, "energy", "gallery"]


if not TYPE_CHECKING:  # else a type checker would accept any name

    def __getattr__(name: str) -> object:
        if name in ("energy", "gallery"):
            return import_module(f"hexmend.{name}")
        if name in _HOME_OF:
            return getattr(import_module(f"hexmend.{_HOME_OF[name]}"), name)
        for smoother in () if name.startswith("_") else import_module("hexmend.smoothers").METHODS.values():
            if smoother.__name__ == name:
                return smoother
        near = "" if name.startswith("_") else import_module("hexmend.parameters").suggestion(name, __all__)
        hint = f": {near.rstrip()}" if near else ""
        # named for its spec: for the module itself Python would add a hint
        raise AttributeError(f"module 'hexmend' has no attribute {name!r}{hint}", obj=__spec__)


def __dir__() -> list[str]:
    from hexmend.smoothers import METHODS

    return sorted({*__all__, *(smoother.__name__ for smoother in METHODS.values())})
