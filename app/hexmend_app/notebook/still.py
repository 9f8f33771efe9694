"""A mesh as a notebook shows it by itself."""

from __future__ import annotations

from io import BytesIO

from hexmend.mesh.mesh import Mesh


def still(mesh: Mesh, size: tuple[int, int]) -> bytes:
    """The bytes of a PNG of so many pixels, coloured by q(H).

    Raises
    ------
    GraphicsError
        Where nothing can be drawn here.
    """
    from hexmend_app.scene.graphics import prepare_off_screen

    prepare_off_screen()
    from hexmend_app.scene.export.sheet import draw_sheet
    from hexmend_app.scene.export.subject import Subject
    from hexmend_app.state.scene import Page, Scene

    scene = Scene(page=Page(pixels=size, background="transparent"))
    held = BytesIO()
    draw_sheet(scene, [Subject.of(mesh)]).image().save(held, format="PNG")
    return held.getvalue()
