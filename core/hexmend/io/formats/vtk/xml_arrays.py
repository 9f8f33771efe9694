"""The arrays of VTK's XML files: in decimals, base64 or raw bytes; packed by zlib, LZ4, LZMA or not at all.

Uncompressed, an array is its size in bytes and its bytes. Compressed, it is the number of its blocks, the size of a
block and of the last one (0: as the others) before packing, and of each block after it; then the blocks. These numbers
are of the type `header_type`. In base64 the head of a compressed array is encoded by itself, the size of an
uncompressed one together with its bytes. (VTK's manual, "VTK XML Formats"; measured with VTK 9.7's writer.)
"""

from __future__ import annotations

import binascii
from collections.abc import Callable

import numpy as np

from hexmend.io.base.cursor import count_words, exceeds_dtype
from hexmend.io.formats.vtk.xml_document import TYPES, Document, XMLElement, array_title

#: How compressors are named.
COMPRESSORS = {"vtkZLibDataCompressor": "zlib", "vtkLZ4DataCompressor": "LZ4", "vtkLZMADataCompressor": "LZMA"}
_LZMA_MEMORY = 1 << 28


def read_values(document: Document, array: XMLElement, count: int | None = None) -> np.ndarray:
    """The numbers of an array.

    Parameters
    ----------
    document : Document
    array : XMLElement
    count : int, optional
        How many there must be; None where only the array knows it. It must have been told to `Document.budget`;
        without it that is done here.

    Returns
    -------
    (count,) array
        In the machine's byte order. Of type "String": the bytes, uint8.

    Raises
    ------
    FileError
        Where there are more or fewer, or they are no such numbers.
    """
    dtype = document.dtype(array)
    if array.get("format", "ascii") == "ascii":
        return _decimals(document, array, dtype, count)
    bits = array.get("type") == "Bit"
    size = None if count is None else (count + 7) // 8 if bits else count * dtype.itemsize
    data = _bytes(document, array, size)
    if len(data) % dtype.itemsize:
        raise document.error(f"{array_title(array)} has {len(data)} bytes: expected a multiple of {dtype.itemsize}")
    values = np.frombuffer(data, dtype)
    if bits:
        return np.unpackbits(values)[:count]
    return values.astype(dtype.newbyteorder("="), copy=False)


def read_strings(document: Document, array: XMLElement) -> list[str]:
    """The strings of an array of them, each of which ends with a zero."""
    data = read_values(document, array).astype(np.uint8).tobytes()
    if not data:
        return []
    return [part.decode("utf-8", errors="replace") for part in data.removesuffix(b"\0").split(b"\0")]


def _decimals(document: Document, array: XMLElement, dtype: np.dtype, count: int | None) -> np.ndarray:
    text = document.text(array)
    if array.get("type") == "String":
        dtype = np.dtype("i2")  # codes, some of them less than 0
    wide = np.dtype("f8") if dtype.kind == "f" else np.dtype("u8" if dtype == np.uint64 else "i8")
    try:
        values = np.fromstring(text, wide, sep=" ")
    except (ValueError, DeprecationWarning):  # NumPy before 2.3 only warns, and gives fewer
        values = np.empty(0, wide)
    found = count_words(text)
    if len(values) < found:
        raise document.error(f"{array_title(array)} holds words that are no numbers of its type")
    if count is not None and found != count:
        raise document.error(f"{array_title(array)} holds {found} numbers: expected {count}")
    if wide.kind == "f":
        return values.astype(dtype.newbyteorder("="), copy=False)
    limit = np.iinfo(dtype)
    outside = np.flatnonzero((values < limit.min) | (values > limit.max))
    if outside.size or exceeds_dtype(values, text):
        word = values[outside[0]] if outside.size else "a number"
        raise document.error(f"{array_title(array)} holds {word}, which is outside of its type {array.get('type')}")
    return values.astype(dtype.newbyteorder("="), copy=False)


def _bytes(document: Document, array: XMLElement, size: int | None) -> bytes | np.ndarray:
    """The bytes of an array, unpacked; `size` as `read_values` says."""
    where = array.get("format")
    stream: _Stored | _Encoded
    if where == "appended":
        begin, encoding = document.appended()
        begin += document.count(array, "offset")
        if encoding == "raw":
            stream = _Stored(document, begin)
        else:
            stream = _Encoded(lambda at, n: document.bytes(begin + at, n), document.size - begin)
    elif where == "binary":
        text = b"".join(document.text(array).split())
        stream = _Encoded(lambda at, n: text[at : at + n], len(text))
    else:
        raise document.error(f"{array_title(array)} has the format {where[:20]!r}: expected ascii, binary or appended")
    compressor = document.root.get("compressor")
    if compressor and compressor not in COMPRESSORS:
        known = ", ".join(COMPRESSORS)
        raise document.error(f"is packed by {compressor[:40]!r}: expected {known}", "Write it without compression.")
    try:
        if compressor:
            return _unpacked(document, array, stream, size, COMPRESSORS[compressor])
        return _plain(document, array, stream, size)
    except binascii.Error:
        raise document.error(f"{array_title(array)} is no base64") from None


class _Stored:
    """Bytes of an array as they lie in the file from a place on, and how many there are at most (`left`)."""

    def __init__(self, document: Document, begin: int):
        self.document, self.begin, self.left = document, begin, document.size - begin

    def read(self, at: int, size: int) -> bytes:
        """Bytes from a place on; fewer at the end."""
        return self.document.bytes(self.begin + at, size)

    def after(self, size: int) -> int:
        """The place behind bytes that were stored by themselves."""
        return size

    def alone(self, size: int) -> bool:
        """Whether the first bytes are stored by themselves, so that others do not follow in the same quantum."""
        return False


class _Encoded:
    """The same of base64, of which `text` gives characters: from a place, a number of them."""

    def __init__(self, text: Callable[[int, int], bytes], length: int):
        self.text, self.left = text, length // 4 * 3

    def read(self, at: int, size: int) -> bytes:
        return binascii.a2b_base64(self.text(at, self.after(size)))[:size]

    def after(self, size: int) -> int:
        return -(-size // 3) * 4

    def alone(self, size: int) -> bool:
        return len(binascii.a2b_base64(self.text(0, self.after(size)))) == size


def _plain(document: Document, array: XMLElement, stream: _Stored | _Encoded, size: int | None) -> bytes:
    head = _header(document)
    length = _numbers(document, array, stream, 1)[0]
    _check_size(document, array, length, size)
    if stream.alone(head.itemsize):  # as some programs encode it
        return _taken(document, array, stream, stream.after(head.itemsize), length)
    return _taken(document, array, stream, 0, head.itemsize + length)[head.itemsize :]


def _unpacked(
    document: Document, array: XMLElement, stream: _Stored | _Encoded, size: int | None, kind: str
) -> np.ndarray:
    blocks = _numbers(document, array, stream, 1)[0]
    if blocks == 0:
        _check_size(document, array, 0, size)
        return np.empty(0, np.uint8)
    _, whole, last, *packed = _numbers(document, array, stream, 3 + blocks)
    length = whole * (blocks - 1) + (last or whole)
    _check_size(document, array, length, size)
    begin = stream.after((3 + blocks) * _header(document).itemsize)
    data = memoryview(_taken(document, array, stream, begin, sum(packed)))
    answer, unpack = np.empty(length, np.uint8), _unpacker(kind)
    at = to = 0
    for k, width in enumerate(packed):
        expected = whole if k < blocks - 1 else last or whole
        block_title = f"block {k + 1} of {blocks} of {array_title(array)}"
        try:
            block = unpack(data[at : at + width], expected)
        except MemoryError:
            raise
        except Exception as error:  # each of the three libraries has its own
            detail = " ".join(str(error).split())[:80]
            raise document.error(f"{block_title} is no {kind} ({detail})") from None
        if len(block) != expected:
            raise document.error(f"{block_title} has not the {expected} bytes announced")
        answer[to : to + expected] = np.frombuffer(block, np.uint8)
        at, to = at + width, to + expected
    return answer


def _numbers(document: Document, array: XMLElement, stream: _Stored | _Encoded, count: int) -> list[int]:
    """Numbers of an array's head."""
    head = _header(document)
    return np.frombuffer(_taken(document, array, stream, 0, count * head.itemsize), head).tolist()


def _taken(document: Document, array: XMLElement, stream: _Stored | _Encoded, at: int, size: int) -> bytes:
    data = stream.read(at, size) if size <= stream.left else b""
    if len(data) != size:
        raise document.error(f"{array_title(array)} goes on behind the end of the data")
    return data


def _unpacker(kind: str) -> Callable[[bytes, int], bytes]:
    """What unpacks a block to as many bytes as it should have, and hardly more."""
    if kind == "zlib":
        import zlib

        return lambda data, size: zlib.decompressobj().decompress(data, size + 1)
    if kind == "LZMA":
        import lzma

        return lambda data, size: lzma.LZMADecompressor(memlimit=_LZMA_MEMORY).decompress(data, size + 1)
    from lz4 import block

    return lambda data, size: block.decompress(data, uncompressed_size=size)


def _check_size(document: Document, array: XMLElement, length: int, size: int | None) -> None:
    if size is None:
        document.budget.charge(length, array_title(array))
    elif length != size:
        raise document.error(f"{array_title(array)} has {length} bytes: expected {size}")


def _header(document: Document) -> np.dtype:
    kind = document.root.get("header_type", "UInt32")
    if kind not in ("UInt32", "UInt64"):
        raise document.error(f"its header_type is {kind[:20]!r}: expected UInt32 or UInt64")
    return np.dtype(TYPES[kind]).newbyteorder(document.order)
