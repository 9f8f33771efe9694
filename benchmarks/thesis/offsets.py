"""Benchmark of the "-1" of (B.20): the optimum with and without it, on meshes of the thesis and of a folder."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from benchmarks.section import COUNTS, BenchSection, collection
from benchmarks.thesis.experiments import INITIAL, load
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.run import StoppingCriteria, smooth

#: Methods whose best result in the thesis is its optimum.
_OPTIMISERS = "global-nr", "local-nr", "local-sd"

#: Figures to compare.
_FIGURES = "scaled_jacobian_min", "q_min", "q_mean", "q_norm"

#: Offset of (B.20), and of chapter 4.
_OFFSETS = 1.0, 0.0


def _measure() -> dict[str, Any]:
    files = ((path.name, mesh, None) for path, mesh in collection())
    return {"runs": [_row(name, mesh, published) for name, mesh, published in (*_thesis(), *files)]}


def _thesis() -> Iterator[tuple[str, Mesh, dict[str, float] | None]]:
    """Yield the meshes of the thesis at full size, with its figures of the optimum."""
    seen = set()
    for experiment in load().experiments:
        best = [experiment.published[name] for name in _OPTIMISERS if experiment.published.get(name, {}).get("q_mean")]
        if experiment.start == INITIAL and best and (experiment.mesh, experiment.size) not in seen:
            seen.add((experiment.mesh, experiment.size))
            optimum = max(best, key=lambda figures: figures.get("q_norm", figures["q_mean"]))
            yield experiment.thesis_mesh, experiment.build(quick=False), dict(optimum)


def _row(name: str, mesh: Mesh, published: dict[str, float] | None) -> dict[str, Any]:
    stop = StoppingCriteria(max_iterations=1000)
    ends = [smooth(mesh, "mend", stop, progress=False, goal="shape", offset=offset) for offset in _OFFSETS]
    return {
        "mesh": name,
        "hexes": mesh.n_hexes,
        "before": _selected(summarise(mesh)),
        "after": [_selected(end.after) for end in ends],
        "seconds": [end.seconds for end in ends],
        "thesis": published,
    }


def _selected(figures: Summary) -> dict[str, float]:
    return {key: getattr(figures, key) for key in (*COUNTS, *_FIGURES)}


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [
        "| mesh | hexes | inverted | invalid | scaled Jacobian min | q min | q mean | q norm | s |",
        "|:---|" + "---:|" * 8,
    ]
    for row in figures["runs"]:
        one, zero = row["after"]
        cells = [row["mesh"], f"{row['hexes']:,}", *(f"{one[key]:,} · {zero[key]:,}" for key in COUNTS)]
        for key in _FIGURES:
            thesis = (row["thesis"] or {}).get(key)
            cells.append(f"{_pair(one[key], zero[key])}" + (f" ({thesis:.4f})" if thesis else ""))
        cells.append("{:.2f} · {:.2f}".format(*row["seconds"]))
        lines.append(f"| {' | '.join(cells)} |")
    higher = {
        key: [sum(row["after"][k][key] > row["after"][1 - k][key] + 1e-4 for row in figures["runs"]) for k in (0, 1)]
        for key in _FIGURES
    }
    text = "; ".join(f"{key.replace('_', ' ')} {one} and {zero}" for key, (one, zero) in higher.items())
    return [*lines, "", f"Of {len(figures['runs'])} meshes so many are higher with offset 1 and with 0: {text}."]


def _pair(one: float, zero: float) -> str:
    """Format both values, the higher in bold."""
    texts = f"{one:.4f}", f"{zero:.4f}"
    if abs(one - zero) <= 1e-4:
        return " · ".join(texts)
    return f"**{texts[0]}** · {texts[1]}" if one > zero else f"{texts[0]} · **{texts[1]}**"


_TITLE = 'The optimum with the "-1" of (B.20) · without it (in brackets the thesis\'s)'
OFFSETS = BenchSection("offsets", _TITLE, _measure, _lines)
