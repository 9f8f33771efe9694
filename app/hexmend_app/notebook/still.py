"""Still picture of a mesh in a notebook."""

from __future__ import annotations

from io import BytesIO

from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.render.graphics import prepare_off_screen


def still(mesh: Mesh, size: tuple[int, int]) -> bytes:
    """Return a picture of a mesh, coloured by q(H), as the bytes of a PNG.

    Parameters
    ----------
    mesh : Mesh
    size : (int, int)
        Width and height in pixels.

    Raises
    ------
    GraphicsError
        If OpenGL is not available.
    """
    prepare_off_screen()
    from hexmend_app.picture import Page, Scene
    from hexmend_app.scene.page.page_mesh import PageMesh
    from hexmend_app.scene.page.page_renderer import draw_page

    scene = Scene(page=Page(pixels=size, background="transparent"))
    file = BytesIO()
    draw_page(scene, [PageMesh.of(mesh)]).image().save(file, format="PNG")
    return file.getvalue()
