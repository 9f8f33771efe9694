"""Text of a GRID card with other coordinates, in the layout that it has."""

from __future__ import annotations

from collections.abc import Sequence

#: Columns of a field in the small and in the large layout, and fields of a line.
_SMALL, _LARGE = (8, 8), (16, 4)
#: Index of the first coordinate among the fields of a card: number, coordinate system, x, y, z.
_FIRST = 2


def replace_in_card(lines: Sequence[str], texts: Sequence[str | None]) -> list[str]:
    """Replace coordinates in the lines of a GRID card.

    Parameters
    ----------
    lines : sequence of str
        Its line without a line end, and for a card in fields of 16 columns the one that continues it, if there is one.
    texts : sequence of str or None
        New texts of x, y and z, of up to 16 characters; None for those that stay.

    Returns
    -------
    list of str
        One line or two.

    Examples
    --------
    >>> replace_in_card(["GRID    7               0.      0.      1."], ["0.25", None, None])
    ['GRID    7               0.25    0.      1.']
    >>> replace_in_card(["GRID,7,,0.,0.,1."], ["0.123456789", None, None])
    ['GRID*,7,,0.123456789,0.', '*,1.']
    """
    first = lines[0]
    if is_large(first):
        for k in range(2):
            first = _with_field(first, _FIRST + k, texts[k])
        second = [_with_field(line, 0, texts[2]) for line in lines[1:] or ["*"]]
        return [first, *(second if lines[1:] or texts[2] is not None else [])]
    fields, free = _fields(first), "," in first.partition("$")[0]
    in_place = all(len(text) <= 8 for text in texts if text is not None)
    if in_place or (free and any(len(text) > 8 for text in fields[_FIRST : _FIRST + 3])):
        for k, text in enumerate(texts):
            first = _with_field(first, _FIRST + k, text)
        return [first]
    return _widened(first, fields, texts)


def is_large(line: str) -> bool:
    """Return True for fields of 16 columns: the name ends in a star, or the continuation begins with one."""
    body = line.partition("$")[0]
    head = (body.split(",")[0] if "," in body else body.expandtabs(8)[:8]).strip()
    return head.endswith("*") or head.startswith("*")


def _fields(line: str) -> list[str]:
    """Name, the fields of a line of the small layout, and the name of its continuation: ten stripped texts."""
    body = line.partition("$")[0]
    if "," in body:
        parts = body.split(",")
    else:
        body = body.expandtabs(8)
        parts = [body[k : k + 8] for k in range(0, 80, 8)]
    parts = [part.strip() for part in parts]
    return (parts + [""] * 10)[1:9] + [(parts + [""] * 10)[9], parts[0]]


def _with_field(line: str, k: int, text: str | None) -> str:
    """Line with a new text in field k, counted after the name."""
    if text is None:
        return line
    body, mark, comment = line.partition("$")
    if "," in body:
        parts = body.split(",")
        parts += [""] * (k + 2 - len(parts))
        old = parts[k + 1]
        blanks = len(old) - len(old.lstrip())
        parts[k + 1] = old[:blanks] + text + (old[len(old.rstrip()) :] if old.strip() else "")
        return ",".join(parts) + mark + comment
    body = body.expandtabs(8) if "\t" in body else body
    width = (_LARGE if is_large(line) else _SMALL)[0]
    begin = 8 + width * k
    old, after = body[begin : begin + width].ljust(width), body[begin + width :]
    right = old.strip() and not old.endswith(" ") and old.startswith(" ")
    new = text.rjust(width) if right else text.ljust(width)
    return (body[:begin].ljust(begin) + (new + after).rstrip()).ljust(len(body)) + mark + comment


def _widened(line: str, fields: Sequence[str], texts: Sequence[str | None]) -> list[str]:
    """Card of the small layout in the large one, two lines; a comment stays behind the second."""
    *values, marker, name = fields
    for k, text in enumerate(texts):
        values[_FIRST + k] = values[_FIRST + k] if text is None else text
    body, mark, comment = line.partition("$")
    if "," in body:
        lines = [",".join([f"{name}*", *values[:4]]), ",".join(["*", *values[4:], marker]).rstrip(",")]
    else:
        lines = [f"{name + '*':<8}" + "".join(f"{value:<16}" for value in values[:4])]
        lines += ["*       " + "".join(f"{value:<16}" for value in values[4:]) + marker]
    return [lines[0].rstrip(), lines[1].rstrip() + (" " + mark + comment if mark else "")]
