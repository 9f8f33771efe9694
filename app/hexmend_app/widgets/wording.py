"""Texts of numbers and names in widgets."""

from __future__ import annotations

import math
import re
from pathlib import Path

from PySide6.QtCore import QLocale

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import HEXAHEDRON
from hexmend.parameters import Parameter
from hexmend.quantity import format_significant
from hexmend.summary import Summary
from hexmend_app.translation import tr

_GREEK = {"alpha": "α", "beta": "β", "delta": "δ", "eta": "η", "lambda": "λ", "rho": "ρ", "sigma": "σ", "tau": "τ"}
_SUBSCRIPT = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def name_in_words(name: str) -> str:
    """Return a declared name as a label.

    >>> name_in_words("initial_step"), name_in_words("c1"), name_in_words("delta"), name_in_words("p")
    ('Initial step', 'c₁', 'Delta (δ)', 'p')
    """
    if re.fullmatch(r"[a-z]\d*", name):
        return name.translate(_SUBSCRIPT)
    words = name.replace("_", " ").replace("-", " ").strip()
    words = words[:1].upper() + words[1:]
    return f"{words} ({_GREEK[name]})" if name in _GREEK else words


def label_of(parameter: Parameter) -> str:
    """Return the label of a declared parameter, in the language of the program."""
    return tr(parameter.label or name_in_words(parameter.name))


def short_number(value: float) -> str:
    """Return the shortest text that is parsed as `value`.

    >>> short_number(1e-4), short_number(2.0), short_number(1e-07), short_number(300)
    ('0.0001', '2', '1e-7', '300')
    """
    text = repr(value)
    if text.endswith(".0"):
        text = text[:-2]
    mantissa, mark, exponent = text.partition("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}" if mark else text


def figure(value: float | None, decimals: int = 4) -> str:
    """Return a number as text: counts with separators, fractions with fixed decimals, large values with six digits.

    >>> figure(32735), figure(0.5), figure(1325.2907), figure(None), figure(3.2e11), figure(-2.5e-7)
    ('32,735', '0.5000', '1,325.29', '–', '3.2e+11', '−2.5e−07')
    """
    if value is None or not math.isfinite(value):
        return "–"
    if isinstance(value, int):
        text = f"{value:,}"
    elif abs(value) >= 1e8:
        text = f"{value:.4g}"
    elif abs(value) >= 10:
        text = f"{value:,.{max(0, 5 - math.floor(math.log10(abs(value))))}f}"
    elif 0 < abs(value) < 0.5 * 10**-decimals:  # fixed decimals would show 0
        text = f"{value:.2g}"
    else:
        text = f"{value:.{decimals}f}"
    return text.replace("-", "−")


def with_minus(text: str) -> str:
    """Return a text with minus signs in place of the hyphens before numbers.

    >>> with_minus("0.16 → -0.8854, of local-sd 1e-07 and part-2")
    '0.16 → −0.8854, of local-sd 1e−07 and part-2'
    """
    return re.sub(r"(?<!\w)-(?=[\d.∞])|(?<=\de)-(?=\d)", "−", text)


def short_folder(path: Path, most: int = 40) -> str:
    """Return the folder of a file, with ~ for the home folder; of a long path, the end.

    >>> short_folder(Path("/data/meshes/bunny.vtu")), short_folder(Path("/data/meshes/bunny.vtu"), 8)
    ('/data/meshes', '…/meshes')
    """
    folder = path.parent
    text = f"~/{folder.relative_to(Path.home())}" if folder.is_relative_to(Path.home()) else str(folder)
    text = text.removesuffix("/.")
    while len(text) > most and "/" in text.removeprefix("…/"):
        text = "…/" + text.removeprefix("…/").split("/", 1)[1]
    return text


def position(place: float, extent: float, digits: int = 4) -> str:
    """Return a coordinate as text; 0 if it is smaller than a ten-thousandth of the extent of the body.

    >>> position(-1.25, 4.0), position(1e-5, 4.0)
    ('−1.25', '0')
    """
    return f"{0.0 if abs(place) < 1e-4 * extent else place:.{digits}g}".replace("-", "−")


def size(bytes: int) -> str:
    """Return an amount of memory as text.

    >>> size(123 << 20), size(1 << 30), size(3 << 29)
    ('123 MiB', '1 GiB', '1.5 GiB')
    """
    return QLocale.c().formattedDataSize(bytes, 1).replace(".0 ", " ")


def duration(seconds: float) -> str:
    """Return a time as text, in the form of the messages of runs.

    >>> duration(0.00127), duration(0.2764), duration(53.12)
    ('0.00127 s', '0.276 s', '53.1 s')
    """
    return f"{format_significant(seconds, 3)} s"


def counted(number: int, noun: str) -> str:
    """Return a number with a noun in singular or plural, in the language of the program.

    >>> counted(1, "node"), counted(1234, "node"), counted(2, "hex")
    ('1 node', '1,234 nodes', '2 hexes')
    """
    return f"{number:,} {tr(noun) if number == 1 else plural(noun)}"


def plural(noun: str) -> str:
    """Return the plural of a noun, in the language of the program.

    >>> plural("hex"), plural("tetrahedron")
    ('hexes', 'tetrahedra')
    """
    if noun.endswith("hedron"):
        return tr(noun.removesuffix("on") + "a")
    return tr(noun + ("es" if noun.endswith("x") else "s"))


def counted_cells(summary: Summary) -> str:
    """Return the numbers of cells of each kind of a mesh: "943 hexes, 515 pyramids, 7,949 tetrahedra"."""
    return ", ".join(counted(int(of["count"]), noun_of(kind)) for kind, of in summary.cells.items())


def noun_of_cells(mesh: Mesh) -> str:
    """Return the noun for the cells of a mesh: "hex" if there are no others, else "cell"."""
    return "cell" if mesh.n_elements > mesh.n_hexes else "hex"


def noun_of(kind: str) -> str:
    """Return the noun for cells of a kind of `hexmend.mesh.solid_cells`."""
    return "hex" if kind == HEXAHEDRON.name else kind
