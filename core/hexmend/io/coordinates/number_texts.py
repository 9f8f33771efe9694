"""Texts of coordinates in the style of the file: shortest decimals, or mantissa and exponent."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from io import BytesIO

import numpy as np

from hexmend.io.base.decimals import format_rows
from hexmend.io.coordinates.edits import Edits, text_lengths, write_edited

_SCIENTIFIC = re.compile(rb"[+-]?[0-9]\.([0-9]+)([eE])[+-][0-9]{2,3}")
#: Decimals of a mantissa that give every float64 back.
_ENOUGH = 16


def scientific_style(words: Iterable[bytes]) -> str | None:
    """Find the format of words if all have a mantissa of one length and an exponent, such as 1.50000e+00.

    Parameters
    ----------
    words : iterable of bytes
        A sample of the file's numbers.

    Returns
    -------
    str or None
        For Python's operator %, with 16 decimals at least; None for words of another style.

    Examples
    --------
    >>> scientific_style([b"1.0000000000000000E+00", b"-2.5000000000000000E-01"])
    '%.16E'
    >>> scientific_style([b"1.5", b"1e-3"]) is None
    True
    """
    found = [_SCIENTIFIC.fullmatch(word) for word in words]
    styles = {(len(match[1]), match[2].decode()) for match in found if match}
    if not found or None in found or len(styles) > 1:
        return None
    ((decimals, letter),) = styles
    return f"%.{max(decimals, _ENOUGH)}{letter}"


def number_texts(values: np.ndarray, style: str | None = None, width: int = 0) -> bytes:
    """Format numbers, one a line.

    Parameters
    ----------
    values : (k,) float64
    style : str, optional
        From `scientific_style`; else the shortest decimals that give the same number back.
    width : int
        Most characters of a number, of which longer ones lose their last digits; 0 for no limit.

    Returns
    -------
    bytes
        k lines.

    Examples
    --------
    >>> number_texts(np.array([0.5, 2.0, -1.2345678901234567e-100]), width=20)
    b'0.5\\n2.0\\n-1.234567890123e-100\\n'
    """
    if not len(values):
        return b""
    if style is not None:
        return ((style + "\n") * len(values) % tuple(values.tolist())).encode()
    texts = format_rows(values[:, None])
    whole = np.abs(values) < 1e15
    whole[whole] = values[whole] == np.rint(values[whole])
    texts = replace_lines(texts, np.flatnonzero(whole), lambda k: b"%.1f" % values[k])
    if width:
        long = np.flatnonzero(text_lengths(texts) > width)
        texts = replace_lines(texts, long, lambda k: shortened(float(values[k]), width).encode())
    return texts


def shortened(value: float, width: int) -> str:
    """Format a number in at most `width` characters, with as many digits as fit.

    Parameters
    ----------
    value : float
    width : int
        At least 9.
    """
    for digits in range(width - 1, 0, -1):
        text = f"{value:.{digits}g}"
        if len(text) <= width:
            return text
    raise ValueError(f"{value} does not fit into {width} characters")


def replace_lines(texts: bytes, which: np.ndarray, text_of: Callable[[int], bytes]) -> bytes:
    """Replace some lines of a text; `text_of` gives the new text of a line by its index, ascending in `which`."""
    if not which.size:
        return texts
    ends = np.flatnonzero(np.frombuffer(texts, np.uint8) == ord("\n"))
    begins = np.append(0, ends[:-1] + 1)
    new = b"".join(text_of(k) + b"\n" for k in which.tolist())
    file = BytesIO()
    write_edited(file, texts, Edits(begins[which], ends[which], np.zeros(len(which), np.int64), new))
    return file.getvalue()
