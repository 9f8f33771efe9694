"""Pages of the views of a window."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from hexmend_app.picture import Camera, Page, PicturePanel, Scene, WipeLayout
from hexmend_app.scene.camera.vtk_pose import pose_of
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import PageRenderer, draw_page
from hexmend_app.scene.views.panes import Panes


def scene_of(
    panes: Panes, names: Sequence[str] = (), page: Page | None = None, cameras: Mapping[str, Camera] | None = None
) -> Scene:
    """Return a scene that describes views and their camera.

    Parameters
    ----------
    panes : Panes
    names : sequence of str
        Names in the captions of several views.
    page : Page, optional
        Its shading is that of the views.
    cameras : mapping, optional
        Additional cameras of the scene, by name.
    """
    pose = pose_of(panes.first.camera, panes.camera_controller.up)
    frame, selected = panes.first.frame, panes.first.overlay_layers.selection.hexes
    tables = {
        "cut": frame.look.cut.with_hexes(panes.first.filters.cut_left(frame)),
        "show": replace(frame.look.show, marked=frozenset(selected.tolist())),
        "page": replace(page or Page(), shading=frame.look.page.shading),
        "panels": _panels(panes, names),
        "cameras": dict(cameras or {}),
    }
    return Scene.of(frame.look, pose, **tables)


def page_meshes(panes: Panes, names: Sequence[str] = ()) -> list[PageMesh]:
    """Return the meshes of views, with the names for their captions."""
    named = names if len(panes.all) > 1 else [""]
    return [PageMesh(**vars(view.frame), name=name) for view, name in zip(panes.all, named, strict=True)]


def draw_views(scene: Scene, panes: Panes, names: Sequence[str] = ()) -> PageRenderer:
    """Draw a scene of views with their node step; see `draw_page`."""
    step = panes.first.overlay_layers.selection.node_step
    return draw_page(scene, page_meshes(panes, names), node_step=step)


def _panels(panes: Panes, names: Sequence[str]) -> tuple[PicturePanel, ...]:
    wipe = panes.wipe
    if wipe is not None:
        return (
            PicturePanel(
                mesh=wipe.left + 1,
                caption=names[wipe.left],
                wipe=WipeLayout(wipe.right + 1, wipe.at, names[wipe.right]),
            ),
        )
    if len(panes.all) == 1:
        return ()
    return tuple(PicturePanel(mesh=number, caption=name) for number, name in enumerate(names, 1))
