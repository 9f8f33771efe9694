"""Report on a small inverted mesh, and the browser of Debian to open it."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import cache
from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image

from hexmend import METHODS, StoppingCriteria, gallery
from hexmend_app.report.case import Case, run_methods
from tests.browsers import SOFTWARE, chromium

#: A promise that is fulfilled when some frames have been drawn.
_FRAMES = (
    "() => new Promise((done) => { let n = 4; const next = () => n-- ? requestAnimationFrame(next) : done(); next(); })"
)


@pytest.fixture(scope="session")
def case() -> Case:
    """A case with inverted hexes and the results of two methods."""
    mesh = gallery.make("bridge-sharp", size=864, scramble=0.4, seed=1)
    return run_methods(mesh, None, [METHODS["laplacian"](), METHODS["mend"]()], StoppingCriteria(max_iterations=20))


class Opened:
    """Page in the browser, with its errors and requests."""

    def __init__(self, page):
        self.page = page
        self.complaints: list[str] = []
        self.asked: list[str] = []
        page.on("console", lambda message: self.complaints.append(message.text))
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("request", lambda request: self.asked.append(request.url))

    def open(self, path: Path, alive: bool = True) -> None:
        """Open a file, and wait until its mesh is drawn."""
        self.page.goto(path.as_uri())
        self.page.wait_for_selector(".viewer.alive" if alive else ".viewer .cannot:not([hidden])", state="attached")
        self.drawn()

    def drawn(self) -> None:
        """Wait until changes are on the screen: faces are found in one frame and drawn in the next."""
        self.page.evaluate(_FRAMES)

    def canvas(self) -> bytes:
        """Return the pixels of the mesh, as RGB."""
        self.drawn()
        with Image.open(BytesIO(self.page.locator("canvas").first.screenshot())) as picture:
            return picture.convert("RGB").tobytes()

    def control(self, name: str):
        """Return a control of the first mesh."""
        return self.page.locator(f"[data-is={name}]").first

    def text(self, name: str) -> str:
        """Return the text of a control."""
        self.drawn()
        return self.control(name).inner_text()


@pytest.fixture(scope="module")
def browser(tmp_path_factory) -> Iterator[Callable[..., Opened]]:
    """Make pages, each in a new context; options are those of the context, and `arguments` those of the browser."""
    with chromium(tmp_path_factory.mktemp("browser")) as launch, ExitStack() as programs:

        @cache
        def program(*arguments: str):
            return programs.enter_context(launch(*arguments))

        @contextmanager
        def opened(arguments: tuple[str, ...] = SOFTWARE, **options) -> Iterator[Opened]:
            with program(*arguments).new_context(viewport={"width": 800, "height": 560}, **options) as context:
                yield Opened(context.new_page())

        yield opened
