"""Hooks of MkDocs for `make site`: formulas as MathML, no access to a network.

Formulas stand in the pages as `$...$` and `$$...$$`, which GitHub shows too; the extension arithmatex marks them.
"""

from __future__ import annotations

import html
import re
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from latex2mathml.converter import convert
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files

_ROOT = Path(__file__).resolve().parents[1]
_FORMULA = re.compile(r'<(span|div) class="arithmatex">(.*?)</\1>', re.DOTALL)
#: Bars of norms, and slashes, which would get the space of operators.
_CLOSE = re.compile(r"<mo[^>]*>(&#x0007C;|&#x0002F;|\||/)</mo>")
_REMOTE = re.compile(r"""<(?:script|img|iframe|source)[^>]+src=["']?(?:https?:)?//|<link[^>]+stylesheet[^>]+//""")


def on_files(files: Files, config: Any) -> Files:
    """Add the program's icon and the letters of formulas."""
    ziamath = Path(find_spec("ziamath").origin).parent  # not imported: only its font is wanted
    added = {
        "icon.svg": _ROOT / "resources/icon.svg",
        "fonts/math.ttf": ziamath / "fonts/STIXTwoMath-Regular.ttf",
    }
    for name, path in added.items():
        files.append(File.generated(config, name, abs_src_path=str(path)))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Let the search find how-to pages before those of the API."""
    if page.file.src_uri.startswith("api/"):
        page.meta["search"] = {"boost": 0.3}
    return markdown


def on_page_content(page_html: str, page: Any, **_: Any) -> str:
    """Put MathML in the place of formulas.

    Raises
    ------
    PluginError
        For a formula that cannot be read.
    """

    def mathml(found: re.Match[str]) -> str:
        tex = html.unescape(found[2].strip())[2:-2]  # between \( and \), or \[ and \]
        try:
            made = convert(tex, display="block" if found[1] == "div" else "inline")
        except Exception as error:  # of whatever kind: latex2mathml has many
            raise PluginError(f"{page.file.src_uri}: the formula {tex!r} cannot be read: {error!r}") from None
        return _CLOSE.sub(r'<mo stretchy="false" lspace="0" rspace="0">\1</mo>', made)

    return _FORMULA.sub(mathml, page_html)


def on_post_page(output: str, page: Any, **_: Any) -> str:
    """Let no page need a network.

    Raises
    ------
    PluginError
        For a page that would fetch a script, a style or a picture from elsewhere.
    """
    if remote := _REMOTE.search(output):
        raise PluginError(f"{page.file.src_uri}: fetches from elsewhere: {remote[0]!r}")
    return output
