"""Benchmark of the layout: the share of the window that the 3D view has at two sizes of screen."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from hexmend.gallery import make
from hexmend.study.bench.section import BenchSection
from hexmend_app.bench.windows import measure_meshes, report, run_event_loop

if TYPE_CHECKING:
    from hexmend_app.shell.window import Window

#: Sizes of the window in pixels.
_SIZES = (1366, 768), (1920, 1080)


def _measure() -> dict[str, Any]:
    return measure_meshes((make("bridge-sharp"),), _row)


def _row(window: Window) -> dict[str, Any]:
    from hexmend_app.feature import PanelGroup

    shares = {}
    for width, height in _SIZES:
        for group in (None, PanelGroup.FIND):
            window.docks.reset()
            window.resize(width, height)
            run_event_loop(0.3)
            window.docks.place()
            if group is not None:
                window.docks.toggle_group(group)
            run_event_loop(0.3)
            view = window.canvas.interactor
            opened = "closed" if group is None else "open"
            shares[f"{opened}_{window.width()}x{window.height()}"] = (
                view.width() * view.height() / (window.width() * window.height())
            )
    return shares


def _lines(row: dict[str, Any]) -> list[str]:
    lines = [f"{row['mesh']}, {row['hexes']:,} hexes"]
    for key, share in row.items():
        opened, _, size = key.partition("_")
        if opened in ("closed", "open"):
            lines.append(f"  {size}, panels below the view {opened}: {share:.1%}")
    return lines


view_share = BenchSection("view-share", "View: its share of the window", _measure, partial(report, lines=_lines))
