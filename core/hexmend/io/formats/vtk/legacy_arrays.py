"""Arrays of VTK's legacy format: numbers of a type in decimals or bytes, and strings."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.cursor import ByteCursor, quoted

TYPES = {
    "bit": "u1", "char": "i1", "signed_char": "i1", "unsigned_char": "u1", "short": "i2", "unsigned_short": "u2",
    "int": "i4", "unsigned_int": "u4", "long": "i8", "unsigned_long": "u8", "vtktypeint64": "i8", "vtktypeuint64": "u8",
    "vtkidtype": "i4", "float": "f4", "double": "f8",
}  # fmt: skip
#: Types that are no numbers.
STRINGS = ("string", "utf8_string")


def unquoted(word: str) -> str:
    """A name or a string of the file, whose odd characters are written as %20."""
    from urllib.parse import unquote

    return unquote(word)


def array(source: ByteCursor, section: str, rows: int, width: int, kind: str) -> np.ndarray:
    """Numbers of a VTK type, in the machine's byte order."""
    code = TYPES.get(kind.lower())
    if code is None:
        raise source.error(f"{section} has the type {quoted(kind)}: expected {', '.join(TYPES)}")
    if source.is_text:
        wide = np.float64 if code[0] == "f" else np.uint64 if code == "u8" else np.int64
        values = source.read_numbers(section, rows, width, wide)
        if code[0] == "f":
            return values
        limit = np.iinfo(code)
        if values.size and (values.min() < limit.min or values.max() > limit.max):
            row, column = np.argwhere((values < limit.min) | (values > limit.max))[0]
            raise source.error(
                f"{section} holds {values[row, column]} in row {row + 1} of {rows}, which its type {kind} cannot"
            )
        return values.astype(code)
    if kind.lower() == "bit":
        bits = np.unpackbits(np.frombuffer(source.read_bytes((rows * width + 7) // 8, section), np.uint8))
        return bits[: rows * width].reshape(rows, width)
    return source.read_binary(section, rows, width, f">{code}").astype(code)


def whole_numbers(source: ByteCursor, section: str, rows: int, kind: str) -> np.ndarray:
    """The same in one column, of a type of whole numbers; (rows,)."""
    if TYPES.get(kind.lower(), "i8")[0] == "f":
        raise source.error(f"{section} has the type {kind}: expected whole numbers")
    return array(source, section, rows, 1, kind)[:, 0]


def strings_of(source: ByteCursor, count: int) -> list[str]:
    """Strings: a line for each, or its length and it."""
    if count > len(source.data) - source.pos:
        raise source.error(f"{count} strings are announced before {source.location}: the file ends before")
    if source.is_text:
        return [unquoted(source.rest_of_line()) for _ in range(count)]
    answer = []
    for _ in range(count):
        size = 8 >> source.read_bytes(1, "a string")[0] // 64  # 8, 4, 2 or 1 bytes hold the length, but for two bits
        source.pos -= 1
        head = int.from_bytes(source.read_bytes(size, "a string"), "big") & ((1 << 8 * size - 2) - 1)
        answer.append(source.read_bytes(head, "a string").decode("utf-8", errors="replace"))
    return answer
