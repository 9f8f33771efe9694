"""Meshes and results of runs in notebooks, and windows that show a mesh.

The core draws no meshes. Distributions that do provide functions in the entry-point group `hexmend.pictures`: `still`
is a `Still`, `view` and `plot` are a `View`.

HTML of meshes and results: tables and embedded pictures.

Jinja2 is not used: it would be a dependency of the core, and 0.02 s, for two short tables.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable, Sequence
from html import escape
from typing import Any

import numpy as np

from hexmend.errors import HexmendError
from hexmend.iteration import Result
from hexmend.mesh.mesh import Mesh
from hexmend.quality.summary import SUMMARY_QUANTITIES, Summary, summarise
from hexmend.quantity import Quantity
from hexmend.terminal_text import install_hint

__all__ = ["Still", "View", "html", "plot", "view"]

#: Draws a mesh with (width, height) pixels as the bytes of a PNG; raises `HexmendError` if it cannot.
Still = Callable[[Mesh, tuple[int, int]], bytes]
#: Shows a mesh that can be turned and zoomed, coloured by a metric; returns an object that a notebook displays.
View = Callable[..., Any]

#: Size of the picture in pixels: twice that on the page, for screens of high resolution.
_SIZE = (960, 640)


def html(value: object) -> str:
    """Return a mesh or a result as HTML: a picture if one can be drawn, a table, and the message of a run.

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
    raise TypeError(f"{type(value).__name__} cannot be shown: expected a Mesh or a Result")


def view(mesh: Mesh, metric: str = "q", **options: Any) -> Any:
    """Show a mesh that can be turned and zoomed in a notebook.

    Parameters
    ----------
    mesh : Mesh
    metric : str
        Name in `hexmend.METRICS` of the metric that colours it.
    **options
        Options of PyVista's `Plotter.show`, such as `jupyter_backend="trame"`, which draws where the notebook runs.

    Raises
    ------
    HexmendError
        If the viewer is not installed.
    """
    return _provided("view")(mesh, metric, **options)


def plot(mesh: Mesh, metric: str = "q", *, hexes: Sequence[int] | np.ndarray | None = None, **options: Any) -> Any:
    """Show a mesh in the viewer's colours by PyVista: inverted hexes are magenta.

    A script opens a window and continues when it is closed; a notebook shows a view that can be turned.

    Parameters
    ----------
    mesh : Mesh
    metric : str
        Name in `hexmend.METRICS` of the metric that colours it; underscores count as dashes.
    hexes : (k,) int or (m,) bool, optional
        Only these hexes, such as `mesh.region("inverted", rings=1)`; all by default.
    **options
        `show=False` returns the `pyvista.Plotter` for more to be added. `off_screen=True`, `window_size` and others of
        `pyvista.Plotter` are passed to it; `screenshot="mesh.png"` and others to its method `show`.

    Returns
    -------
    object
        What `pyvista.Plotter.show` returns, or the plotter.

    Raises
    ------
    ParameterError
        For a metric that does not exist.
    MeshError
        For hexes that do not exist.
    HexmendError
        If the viewer is not installed, or there is no screen for a window.
    """
    return _provided("plot")(mesh, metric, hexes=hexes, **options)


def _still(mesh: Mesh) -> tuple[bytes | None, str]:
    """Return a picture, or the reason why there is none."""
    try:
        return _provided("still")(mesh, _SIZE), ""
    except HexmendError as error:
        return None, f"No picture: {error}"


def _provided(name: str) -> Callable[..., Any]:
    from importlib.metadata import entry_points

    reason, extras = "the viewer, which draws meshes, is not installed", "app" if name == "plot" else "app,notebook"
    for entry in entry_points(group="hexmend.pictures", name=name):
        try:
            return entry.load()
        except ImportError as error:  # the libraries that it draws with are an extra
            reason = f"{reason} ({error})"
    raise HexmendError(f"{reason}: {install_hint(extras)}")


_ROW = "display: flex; flex-wrap: wrap; gap: 1.5em; align-items: flex-start"
_IMAGE = "width: 480px; max-width: 100%; border-radius: 4px"
_WORSE = "text-align: right; color: #b3261e; font-weight: 600"
_LEFT, _MESSAGE = "text-align: left", "max-width: 60em; margin: 0.3em 0"
_QUIET = "opacity: 0.7; font-size: 90%"


def of_mesh(mesh: Mesh, picture: bytes | None = None, problem: str = "") -> str:
    """Return the HTML of a mesh with its figures.

    Parameters
    ----------
    mesh : Mesh
    picture : bytes, optional
        A PNG.
    problem : str
        Reason why there is no picture.
    """
    summary = summarise(mesh)
    rows = [f"<tr>{_head(one)}{_cell(one, summary)}</tr>" for one in SUMMARY_QUANTITIES.values()]
    return _page(_title(mesh), picture, problem, f"<table>{''.join(rows)}</table>")


def of_result(result: Result, picture: bytes | None = None, problem: str = "") -> str:
    """Return the HTML of a run: figures before and after, worse ones in red."""
    head = "<tr><th></th><th>before</th><th>after</th></tr>"
    rows = [
        f"<tr>{_head(one)}{_cell(one, result.before)}{_cell(one, result.after, one.key in result.worse)}</tr>"
        for one in SUMMARY_QUANTITIES.values()
    ]
    table = f"<table>{head}{''.join(rows)}</table>"
    return _page(_title(result.mesh), picture, problem, table, f'<p style="{_MESSAGE}">{escape(result.message)}</p>')


def _title(mesh: Mesh) -> str:
    return escape(mesh.name or "A mesh without a name")


def _page(title: str, picture: bytes | None, problem: str, content: str, message: str = "") -> str:
    image = ""
    if picture is not None:
        data = b64encode(picture).decode("ascii")
        image = f'<img alt="{title}, coloured by q(H)" style="{_IMAGE}" src="data:image/png;base64,{data}"/>'
    note = f'<p style="{_QUIET}">{escape(problem)}</p>' if problem else ""
    return f'<div><strong>{title}</strong>{message}<div style="{_ROW}">{image}<div>{content}</div></div>{note}</div>'


def _head(figure: Quantity) -> str:
    return f'<th style="{_LEFT}"><span title="{escape(figure.help)}">{escape(figure.label)}</span></th>'


def _cell(figure: Quantity, summary: Summary, worse: bool = False) -> str:
    value = getattr(summary, figure.key)
    text = escape(figure.text(value)) if value is not None else "∞"
    return f'<td style="{_WORSE}">{text}</td>' if worse else f"<td>{text}</td>"
