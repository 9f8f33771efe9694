"""Jinja templates of a report: the elements and the page, in `resources/report`."""

from __future__ import annotations

import base64
from io import BytesIO
from pathlib import Path
from typing import Any

from jinja2 import Environment, FunctionLoader
from PIL import Image

from hexmend.terminal_text import WorsenedText
from hexmend_app.resources import resource

#: Options of embedded pictures: half the size of PNG without visible differences.
_WEBP = {"quality": 90, "method": 4}


def read(name: str) -> str:
    """Return the text of a file in `resources/report`."""
    return resource(f"report/{name}").read_text(encoding="utf-8")


def data_uri(path: Path) -> str:
    """Return a picture, SVG or PNG, as the address of an image that contains it; a PNG becomes WebP."""
    if path.suffix == ".svg":
        return f"data:image/svg+xml;base64,{base64.b64encode(path.read_bytes()).decode('ascii')}"
    with Image.open(path) as image, BytesIO() as file:
        image.save(file, "WEBP", **_WEBP)
        return f"data:image/webp;base64,{base64.b64encode(file.getvalue()).decode('ascii')}"


ENVIRONMENT = Environment(loader=FunctionLoader(read), autoescape=True)
ENVIRONMENT.filters["data_uri"] = data_uri
ENVIRONMENT.tests["worsened"] = lambda text: isinstance(text, WorsenedText)
ENVIRONMENT.policies["json.dumps_kwargs"] = {"allow_nan": False}

#: Elements of a report, macros of the template `parts.html`, which return escaped HTML.
html: Any = ENVIRONMENT.get_template("parts.html").module
