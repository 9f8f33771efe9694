"""The page of what a window's views show."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from hexmend_app.scene.camera.pose import Pose
from hexmend_app.scene.export.sheet import Sheet, draw_sheet
from hexmend_app.scene.export.subject import Subject
from hexmend_app.scene.panes import Panes
from hexmend_app.state.scene import Camera, Page, Panel, Scene, Wiped
from hexmend_app.state.stand import Stand


def scene_of(
    panes: Panes, names: Sequence[str] = (), page: Page | None = None, cameras: Mapping[str, Camera] | None = None
) -> Scene:
    """The scene that shows what views show, from where they are seen.

    Parameters
    ----------
    panes : Panes
    names : sequence of str
        What the captions of several views call them.
    page : Page, optional
    cameras : mapping, optional
        What the scene names beside its own.
    """
    pose = Pose.of(panes.first.camera)
    stand = Stand(pose.position, pose.focal, pose.up, pose.parallel, pose.scale, panes.eye.up)
    tables = {"page": page or Page(), "panels": _panels(panes, names), "cameras": dict(cameras or {})}
    frame = panes.first.frame
    return Scene.of(replace(frame.look, left=panes.first.filters.cut_left(frame)), stand, **tables)


def subjects_of(panes: Panes, names: Sequence[str] = ()) -> list[Subject]:
    """The meshes that views show, under the names of their captions."""
    named = names if len(panes.all) > 1 else [""]
    return [Subject.shown(view.frame, name) for view, name in zip(panes.all, named, strict=True)]


def draw_views(scene: Scene, panes: Panes, names: Sequence[str] = ()) -> Sheet:
    """Draw a scene of what views show: the same elements are left by a cut, and a node's step is drawn."""
    step = panes.first.extras.selection.node_step
    return draw_sheet(scene, subjects_of(panes, names), filters=panes.first.filters.copied(), node_step=step)


def _panels(panes: Panes, names: Sequence[str]) -> tuple[Panel, ...]:
    wipe = panes.wipe
    if wipe is not None:
        return (
            Panel(mesh=wipe.left + 1, caption=names[wipe.left], wipe=Wiped(wipe.right + 1, wipe.at, names[wipe.right])),
        )
    if len(panes.all) == 1:
        return ()
    return tuple(Panel(mesh=number, caption=name) for number, name in enumerate(names, 1))
