"""The window on screens with a device pixel ratio above 1."""

import numpy as np
import pytest
from PIL import Image

from tests.programs import run_python

_SCALED = """
import sys
from pathlib import Path
import numpy as np
from PySide6.QtCore import QPointF, QSettings
from PySide6.QtTest import QTest
from tests.app.driving import LEFT, write_picture
from hexmend import gallery, io
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window

QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, sys.argv[2])
app = application()
window = Window()
window.setGeometry(0, 0, 1001, 651)
window.show()
window.build_features()
window.build_canvas()
path = sys.argv[2] + "/cube.vtu"
io.write(path, gallery.make("cube", size=512))
window.features["open"].open(path)
while window.canvas.colouring is None:
    QTest.qWait(20)
drawn = []
window.canvas.interactor.frameSwapped.connect(lambda: drawn.append(True))
window.canvas.interactor.update()
while not drawn:
    QTest.qWait(20)
view, mesh = window.canvas.interactor, window.session.document.now.mesh
ratio = view.devicePixelRatioF()
corner = view.mapTo(window, view.rect().topLeft()).toPointF() * ratio
assert (corner.x() % 1, corner.y() % 1) == (0, 0), corner
assert view.render_window.GetSize() == (view.width() * ratio, view.height() * ratio)
renderer = window.canvas.panes.pane.renderer
towards = -np.array(window.canvas.viewport.camera.GetDirectionOfProjection())
middles = mesh.points[mesh.topology.boundary_faces].mean(axis=1)
seen = 0
for middle in middles[np.argsort(middles @ towards)[-40:]]:
    renderer.SetWorldPoint(*middle, 1.0)
    renderer.WorldToDisplay()
    x, y, _ = renderer.GetDisplayPoint()
    QTest.mouseClick(view, LEFT, pos=QPointF(x / ratio, view.height() - y / ratio).toPoint())
    corners = mesh.points[mesh.hexes[window.session.selection.hex]]
    seen += bool((corners.min(axis=0) - 1e-9 <= middle).all() and (middle <= corners.max(axis=0) + 1e-9).all())
assert seen == 40, seen
assert write_picture(window, Path(sys.argv[1]), (640, 400))
window.close()
"""


@pytest.mark.slow
def test_clicks_select_the_hex_under_the_pointer(tmp_path):
    picture = tmp_path / "picture.png"
    done = run_python("-c", _SCALED, picture, tmp_path, variables={"QT_SCALE_FACTOR": "1.5"}, timeout=200)
    assert done.returncode == 0, done.stderr
    with Image.open(picture) as image:
        assert image.size == (640, 400)
        assert np.ptp(np.asarray(image.convert("RGB")), axis=(0, 1)).max() > 100
