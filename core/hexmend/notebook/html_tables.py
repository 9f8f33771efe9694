"""HTML of meshes and results: tables and embedded pictures.

Jinja2 is not used: it would be a dependency of the core, and 0.02 s, for two short tables.
"""

from __future__ import annotations

from base64 import b64encode
from html import escape

from hexmend.iteration import Result
from hexmend.mesh.mesh import Mesh
from hexmend.quality.summary import SUMMARY_QUANTITIES, Summary, summarise
from hexmend.quantity import Quantity

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
