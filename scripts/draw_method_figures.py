"""Draw the figures of docs/mathematics/method.md: 2.1 to 2.3 and 3.1 of the thesis, in its letters.

Use: python scripts/draw_method_figures.py FOLDER
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Polygon

from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, EDGES, UNIT_CUBE
from hexmend_app.report.charts import new_figure, save_figure

#: Fonts as in a paper, the same in text and formulas.
LETTERS = {"font.family": "STIXGeneral", "mathtext.fontset": "stix", "font.size": 13}

#: Okabe and Ito's colours for e1, e2, e3, and the other colours.
EDGE_COLOURS = ("#D55E00", "#009E73", "#0072B2")
INK, GREY, PALE, FILL = "#1f2630", "#5a636d", "#9aa3ad", "#56B4E9"

#: The plane of the paper, (3, 2): x to the right, y away from the reader, z upwards.
PAPER = np.array([[1.0, 0.0], [0.42, 0.36], [0.0, 1.0]])

#: Tetrahedra, (4, 3): x1 and its neighbours.
REFERENCE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
REGULAR = np.array([[0, 0, 0], [0.940, -0.342, 0], [0.766, 0.643, 0], [0.569, 0.101, 0.816]])
PHYSICAL = np.array([[0, 0, 0], [1.25, 0.15, -0.3], [0.55, 1.35, 0.05], [0.2, 0.1, 1.15]])

#: Positions of the numbers of the two corners inside the cube's outline, clear of all edges of tetrahedra.
INNER = {3: np.array([0.03, -0.13]), 5: np.array([-0.03, 0.13])}

#: Four values of delta.
DELTAS = (0.0, 0.1, 0.3, 0.6)


def paper(points: np.ndarray) -> np.ndarray:
    """Places (..., 3) as they are on paper, (..., 2)."""
    return np.asarray(points) @ PAPER


def canvas(figure: Figure, *place: int) -> Axes:
    """Axes without axes, of one scale."""
    axes = figure.add_subplot(*place)
    axes.set_aspect("equal")
    axes.set_axis_off()
    return axes


def arrow(axes: Axes, start: np.ndarray, end: np.ndarray, colour: str, **how: object) -> None:
    """An arrow from place to place on paper."""
    style = {"arrowstyle": "-|>", "mutation_scale": 16, "linewidth": 2.0, "shrinkA": 0, "shrinkB": 3} | how
    axes.add_patch(FancyArrowPatch(start, end, color=colour, zorder=3, **style))


def write(axes: Axes, place: np.ndarray, text: str, size: float = 15, colour: str = INK, **how: object) -> None:
    """A word or formula in the middle of a place."""
    axes.text(*place, text, ha="center", va="center", fontsize=size, color=colour, **how)


def tetrahedron(
    axes: Axes,
    points: np.ndarray,
    at: tuple[float, float],
    letter: str,
    hidden: set[tuple[int, int]],
    *,
    named: bool = False,
    aside: float = 0.15,
    places: Mapping[int, tuple[float, float]] = MappingProxyType({}),
) -> None:
    """A tetrahedron with the edges from its first node as arrows, its first node at a place on paper.

    Parameters
    ----------
    axes : Axes
    points : (4, 3) float64
    at : tuple of 2 floats
    letter : str
        What its nodes are called, in LaTeX: a format that takes the number.
    hidden : set of pairs of int
        The edges that are behind the tetrahedron.
    named : bool
        Whether the arrows have names.
    aside : float
        How far a node's name is from it, away from the middle.
    places : mapping
        Where it is elsewhere, from the node.
    """
    flat = paper(points) + at
    middle = flat.mean(axis=0)
    axes.add_patch(Polygon(flat[_hull(flat)], facecolor=FILL, alpha=0.16, linewidth=0))
    for a, b in ((1, 2), (2, 3), (1, 3)):
        axes.plot(*flat[[a, b]].T, color=PALE, linewidth=1.3, linestyle="--" if (a, b) in hidden else "-", zorder=2)
    for k, colour in enumerate(EDGE_COLOURS, 1):
        arrow(axes, flat[0], flat[k], colour, linestyle=(0, (4, 2)) if (0, k) in hidden else "-")
        if named:
            along = (flat[k] - flat[0]) / np.linalg.norm(flat[k] - flat[0])
            across = np.array([-along[1], along[0]]) * (-1 if k == 1 else 1)
            write(axes, (flat[0] + flat[k]) / 2 + 0.08 * across, rf"$\mathbf{{e}}_{k}$", colour=colour)
    for k, place in enumerate(flat):
        away = aside * (place - middle) / np.linalg.norm(place - middle)
        axes.plot(*place, "o", color=INK, markersize=4.5, zorder=4)
        write(axes, place + places.get(k, away), f"${letter % (k + 1)}$")


def _hull(flat: np.ndarray) -> list[int]:
    """The corners of what a tetrahedron covers, (4, 2), in turn."""
    from scipy.spatial import ConvexHull

    return ConvexHull(flat).vertices.tolist()


def edges() -> Figure:
    """Figure 2.1: the edges that span a tetrahedron's vector space."""
    figure = new_figure(3.6, 3.0)
    axes = canvas(figure, 1, 1, 1)
    tetrahedron(axes, PHYSICAL, (0, 0), r"\mathbf{x}_%d", {(0, 2)}, named=True)
    _room(axes, 0.2)
    return figure


def transformations() -> Figure:
    """Figure 2.2: reference, ideal and physical element, and the transformations between them."""
    figure = new_figure(7.2, 5.0)
    axes = canvas(figure, 1, 1, 1)
    x, reference, ideal = r"\mathbf{x}", r"\mathbf{x}_{\mathrm{r}}", r"\mathbf{x}_{\mathrm{i}}"
    tetrahedron(
        axes, REFERENCE, (2.05, 0.0), r"\mathbf{x}_{\mathrm{r}%d}", {(0, 2), (1, 2), (2, 3)},
        aside=0.19, places={2: (0.33, 0.15)},
    )  # fmt: skip
    tetrahedron(axes, REGULAR, (0.0, 2.25), r"\mathbf{x}_{\mathrm{i}%d}", {(0, 2)}, aside=0.19)
    tetrahedron(axes, PHYSICAL, (4.0, 2.35), r"\mathbf{x}_%d", {(0, 2)})
    for place, words in (
        ((2.55, -0.42), "reference element"),
        ((0.60, 1.72), "ideal element"),
        ((4.70, 1.72), "physical element"),
    ):
        write(axes, place, words, 14)
    for letter, formula, start, end, bend, place in (
        ("W", f"{ideal} = \\mathbf{{W}}{reference}", (1.75, 0.65), (0.95, 1.45), 0.22, (0.62, 0.80)),
        ("A", f"{x} = \\mathbf{{A}}{reference} + {x}_1", (3.35, 0.65), (4.45, 1.45), -0.22, (4.75, 0.80)),
        ("S", f"{x} = \\mathbf{{S}}{ideal} + {x}_1", (1.75, 2.75), (3.6, 2.75), -0.22, (2.65, 2.68)),
    ):
        arrow(axes, start, end, INK, linewidth=1.6, connectionstyle=f"arc3,rad={bend}")
        across = np.subtract(end, start) @ np.array([[0, -1], [1, 0]])
        top = np.add(start, end) / 2 + bend / 2 * across
        write(axes, top + np.copysign(0.17, bend) * across / np.linalg.norm(across), rf"$\mathbf{{{letter}}}$", 18)
        write(axes, place, f"${formula}$", 13.5, GREY)
    _room(axes, 0.15)
    return figure


def tetrahedra() -> Figure:
    """Figure 2.3: the eight tetrahedra of a hexahedron, numbered as in Table 2.1."""
    figure = new_figure(8.4, 4.9)
    flat = paper(UNIT_CUBE)
    behind = 3  # the corner that no face in sight has
    for k, nodes in enumerate(CORNER_TETRAHEDRA):
        axes = canvas(figure, 2, 4, k + 1)
        for a, b in EDGES:
            style = {"linestyle": (0, (4, 3))} if behind in (a, b) else {}
            axes.plot(*flat[[a, b]].T, color=PALE, linewidth=1.0, zorder=1, **style)
        corners = flat[nodes]
        axes.add_patch(Polygon(corners[_hull(corners)], facecolor=FILL, alpha=0.30, linewidth=0))
        for a, b in ((1, 2), (2, 3), (1, 3)):
            axes.plot(*corners[[a, b]].T, color=INK, linewidth=1.0, zorder=2)
        for end, colour in zip(corners[1:], EDGE_COLOURS, strict=True):
            arrow(axes, corners[0], end, colour, linewidth=1.8, mutation_scale=11, shrinkB=2)
        middle = flat.mean(axis=0)
        for node, place in enumerate(flat):
            away = 0.13 * (place - middle) / np.linalg.norm(place - middle)
            how = {"colour": INK, "weight": "bold"} if node in nodes else {"colour": PALE}
            write(axes, place + INNER.get(node, away), str(node + 1), 12.5, **how)
        axes.set_title(f"Tet {k + 1}:  {' '.join(str(node + 1) for node in nodes)}", fontsize=13, color=INK, pad=8)
        _room(axes, 0.17)
    return figure


def softened() -> Figure:
    """Figure 3.1: h(sigma) for some delta, (3.2)."""
    figure = new_figure(6.0, 3.7)
    axes = figure.subplots()
    sigma = np.linspace(-2, 2, 401)
    for delta, colour in zip(DELTAS, (INK, *reversed(EDGE_COLOURS)), strict=True):
        h = (sigma + np.sqrt(sigma**2 + 4 * delta**2)) / 2  # (3.2)
        axes.plot(sigma, h, color=colour, linewidth=1.9, label=rf"$\delta = {delta:g}$")
    axes.axhline(0, color=PALE, linewidth=0.9, linestyle="--", zorder=1)
    axes.annotate(r"asymptote $h = 0$", (-1.97, -0.06), color=GREY, fontsize=12, va="top")
    axes.annotate(r"asymptote $h = \sigma$", (1.14, 1.05), color=GREY, fontsize=12, ha="left", va="top")
    axes.axvline(0, color=PALE, linewidth=0.9, zorder=1)
    axes.set(xlim=(-2, 2), ylim=(-0.3, 2.2), xlabel=r"$\sigma$", ylabel=r"$h(\sigma)$")
    axes.set_xticks([-2, -1, 0, 1, 2])
    axes.set_yticks([0, 1, 2])
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="upper left", frameon=False)
    return figure


def _room(axes: Axes, margin: float) -> None:
    """Show all that is drawn, with a margin in the unit of the drawing."""
    axes.relim()
    axes.autoscale_view()
    (left, right), (low, high) = axes.dataLim.intervalx, axes.dataLim.intervaly
    axes.set_xlim(left - margin, right + margin)
    axes.set_ylim(low - margin, high + margin)


#: Files, and the functions that draw them.
FIGURES = {
    "method-edges.svg": edges,
    "method-transformations.svg": transformations,
    "method-tetrahedra.svg": tetrahedra,
    "method-h.svg": softened,
}


def main(folder: Path) -> None:
    """Draw all into a folder."""
    with mpl.rc_context(LETTERS):
        for file, draw in FIGURES.items():
            save_figure(draw(), folder / file, outlines=True)
            print(f"{folder / file}: {(folder / file).stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
