"""What a mesh or the result of a run looks like in a notebook.

The core draws no meshes. Who does joins through the entry-point group `hexmend.pictures`: `still` is a function like
`Still`, and `view` one like `View`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hexmend.errors import HexmendError
from hexmend.iteration import Result
from hexmend.mesh.mesh import Mesh
from hexmend.notebook.html_tables import of_mesh, of_result

__all__ = ["Still", "View", "html", "view"]

#: Draws a mesh in so many pixels (width, height), as the bytes of a PNG; raises `HexmendError` where it cannot.
Still = Callable[[Mesh, tuple[int, int]], bytes]
#: Shows a mesh to be turned and zoomed, coloured by a metric: what a notebook displays.
View = Callable[..., Any]

#: Of the picture, in pixels: twice as many as it takes up, for sharp screens.
_SIZE = (960, 640)


def html(value: object) -> str:
    """A mesh or a result as HTML: a picture where one can be drawn, a table, and what became of a run.

    Raises
    ------
    TypeError
        For anything else.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> "<td>27</td>" in html(make("cube", size=27))
    True
    """
    if isinstance(value, Result):
        return of_result(value, *_still(value.mesh))
    if isinstance(value, Mesh):
        return of_mesh(value, *_still(value))
    raise TypeError(f"{type(value).__name__} has no look of its own: expected a Mesh or a Result")


def view(mesh: Mesh, metric: str = "q", **how: Any) -> Any:
    """Show a mesh in a notebook to be turned and zoomed.

    Parameters
    ----------
    mesh : Mesh
    metric : str
        The one that colours it: a name of `hexmend.METRICS`.
    **how
        For PyVista's `Plotter.show`, such as `jupyter_backend="trame"`, which draws where the notebook runs.

    Raises
    ------
    HexmendError
        Where what draws it is not installed.
    """
    return _joined("view")(mesh, metric, **how)


def _still(mesh: Mesh) -> tuple[bytes | None, str]:
    """A picture, or why there is none."""
    try:
        return _joined("still")(mesh, _SIZE), ""
    except HexmendError as error:
        return None, f"No picture: {error}"


def _joined(name: str) -> Callable[..., Any]:
    from importlib.metadata import entry_points

    why = "the viewer, which draws meshes, is not installed"
    for entry in entry_points(group="hexmend.pictures", name=name):
        try:
            return entry.load()
        except ImportError as error:  # what it draws with is an extra
            why = f"{why} ({error})"
    raise HexmendError(f'{why}: pip install "hexmend[app,notebook]"')
