"""Arrays of VTK's XML files: in decimals, base64 or raw bytes; compressed by zlib, LZ4, LZMA or not at all.

An uncompressed array is its size in bytes and its bytes. A compressed array is a header and its blocks; the header is
the number of blocks, the size of a block and of the last block (0 if equal) before compression, and the size of each
block after it. These numbers are of the type `header_type`. In base64 the header of a compressed array is encoded
separately, the size of an uncompressed array together with its bytes. (VTK's manual, "VTK XML Formats"; measured with
VTK 9.7's writer.)
"""

from __future__ import annotations

import binascii
import zlib
from collections.abc import Callable
from itertools import accumulate

import numpy as np

from hexmend.io.base.decimals import count_words, exceeds_dtype, parse_numbers
from hexmend.io.formats.vtk.xml_document import TYPES, Document, XMLElement, array_title
from hexmend.io.storage.binary_rows import parallel_map
from hexmend.io.storage.file_progress import advance

#: Names of compressors.
COMPRESSORS = {"vtkZLibDataCompressor": "zlib", "vtkLZ4DataCompressor": "LZ4", "vtkLZMADataCompressor": "LZMA"}
#: Memory limit of LZMA in bytes.
_LZMA_MEMORY = 1 << 28
#: Share of the work on a file that reading its arrays is.
_SHARE = 0.75


def read_values(document: Document, array: XMLElement, count: int | None = None) -> np.ndarray:
    """Read the numbers of an array.

    Parameters
    ----------
    document : Document
    array : XMLElement
    count : int, optional
        Expected number, already charged to `Document.budget`. If None, the array gives it, and it is charged here.

    Returns
    -------
    (count,) array
        In the machine's byte order; for the type "String" its bytes, uint8.

    Raises
    ------
    FileError
        Where the number of values differs, or they are not of the type.
    """
    dtype = document.dtype(array)
    if array.get("format", "ascii") == "ascii":
        return _read_decimals(document, array, dtype, count)
    bits = array.get("type") == "Bit"
    size = None if count is None else (count + 7) // 8 if bits else count * dtype.itemsize
    stored = _StoredArray(document, array)
    if size is None:
        document.budget.charge(stored.length, array_title(array))
    elif stored.length != size:
        raise document.error(f"{array_title(array)} has {stored.length} bytes: expected {size}")
    data = stored.read(0, stored.length)
    if len(data) % dtype.itemsize:
        raise document.error(f"{array_title(array)} has {len(data)} bytes: expected a multiple of {dtype.itemsize}")
    values = np.frombuffer(data, dtype)
    if bits:
        return np.unpackbits(values)[:count]
    return values.astype(dtype.newbyteorder("="), copy=False)


def read_range(document: Document, array: XMLElement, begin: int, end: int) -> np.ndarray:
    """Read the numbers from `begin` to `end` of an array that is raw bytes behind the XML.

    Of a compressed array, only the blocks with these numbers are read.

    Parameters
    ----------
    document : Document
    array : XMLElement
        Its format is "appended", its type neither "String" nor "Bit".
    begin, end : int

    Returns
    -------
    (end - begin,) array
        In the machine's byte order.

    Raises
    ------
    FileError
        Where the array ends before.
    """
    dtype, stored = document.dtype(array), _StoredArray(document, array)
    low, high = begin * dtype.itemsize, end * dtype.itemsize
    if end < begin or high > stored.length:
        raise document.error(f"{array_title(array)} has {stored.length} bytes: expected {high} at least")
    return np.frombuffer(stored.read(low, high), dtype).astype(dtype.newbyteorder("="), copy=False)


def read_strings(document: Document, array: XMLElement) -> list[str]:
    """Read an array of strings that end with a zero each."""
    data = read_values(document, array).astype(np.uint8).tobytes()
    if not data:
        return []
    return [part.decode("utf-8", errors="replace") for part in data.removesuffix(b"\0").split(b"\0")]


def _read_decimals(document: Document, array: XMLElement, dtype: np.dtype, count: int | None) -> np.ndarray:
    text = document.text(array)
    advance(_SHARE * len(text), document.size)
    if array.get("type") == "String":
        dtype = np.dtype("i2")  # character codes, written as signed bytes by some programs
    wide = np.dtype("f8") if dtype.kind == "f" else np.dtype("u8" if dtype == np.uint64 else "i8")
    values, found = parse_numbers(text, wide), count_words(text)
    if found and (values is None or len(values) < found):
        raise document.error(f"{array_title(array)} holds words that are not numbers of its type")
    if count is not None and found != count:
        raise document.error(f"{array_title(array)} holds {found} numbers: expected {count}")
    if values is None or not found:
        values = np.empty(0, wide)
    if wide.kind == "f":
        return values.astype(dtype.newbyteorder("="), copy=False)
    limit = np.iinfo(dtype)
    outside = np.flatnonzero((values < limit.min) | (values > limit.max))
    if outside.size or exceeds_dtype(values, text):
        word = values[outside[0]] if outside.size else "a number"
        raise document.error(f"{array_title(array)} holds {word}, which is outside of its type {array.get('type')}")
    return values.astype(dtype.newbyteorder("="), copy=False)


class _StoredArray:
    """Bytes of an array in base64 or raw: a header with sizes, then the numbers, in blocks where they are compressed.

    Parameters
    ----------
    document : Document
    array : XMLElement
        Its format is "binary" or "appended".

    Attributes
    ----------
    length : int
        Bytes of the numbers.
    """

    def __init__(self, document: Document, array: XMLElement):
        self._document, self._title, form = document, array_title(array), array.get("format")
        if form not in ("binary", "appended"):
            problem = f"{self._title} has the format {form[:20]!r}: expected ascii, binary or appended"
            raise document.error(problem)
        self._is_base64 = True
        if form == "appended":
            begin, encoding = document.appended()
            begin += document.count(array, "offset")
            self._is_base64, self._left = encoding != "raw", document.size - begin
            self._text: Callable[[int, int], bytes] = lambda at, n: document.bytes(begin + at, n)
        else:
            text = b"".join(document.text(array).split())
            self._text, self._left = (lambda at, n: text[at : at + n]), len(text)
        compressor = document.root.get("compressor")
        if compressor and compressor not in COMPRESSORS:
            known = ", ".join(COMPRESSORS)
            raise document.error(f"is packed by {compressor[:40]!r}: expected {known}", "Write it without compression.")
        kind = document.root.get("header_type", "UInt32")
        if kind not in ("UInt32", "UInt64"):
            raise document.error(f"its header_type is {kind[:20]!r}: expected UInt32 or UInt64")
        self._word = np.dtype(TYPES[kind]).newbyteorder(document.order)
        self._kind = COMPRESSORS.get(compressor)
        self.length = blocks = self._header(1)[0]
        if self._kind:
            _, whole, last, *self._packed = self._header(3 + blocks) if blocks else [0, 0, 0]
            self._whole, self._last = whole or last, last or whole
            self.length = self._whole * (blocks - 1) + self._last

    def read(self, low: int, high: int) -> bytes | np.ndarray:
        """Read the bytes from `low` to `high` of the numbers; of compressed ones the blocks that hold them."""
        size = self._word.itemsize
        if self._kind:
            return self._decompress(low, high) if high > low else b""
        advance(_SHARE * (high - low), self._document.size)
        if self._is_base64 and not self._text(0, self._stored(size)).endswith(b"="):  # the header is not padded
            return self._take(0, size + high)[size + low :]
        return self._take(self._stored(size) + low, high - low)

    def _decompress(self, low: int, high: int) -> np.ndarray:
        blocks, whole = len(self._packed), self._whole
        first, end = low // whole, (high - 1) // whole + 1
        begins = [0, *accumulate(self._packed)]
        place = self._stored((3 + blocks) * self._word.itemsize)
        data = memoryview(self._take(place + begins[first], begins[end] - begins[first]))
        answer = np.empty(min(whole * end, self.length) - whole * first, np.uint8)

        def unpack(k: int) -> None:
            block = data[begins[k] - begins[first] : begins[k + 1] - begins[first]]
            size, at = self._last if k == blocks - 1 else whole, (k - first) * whole
            answer[at : at + size] = np.frombuffer(self._unpacked(k, block, size), np.uint8)

        for k, _ in enumerate(parallel_map(unpack, range(first, end)), first):
            advance(_SHARE * self._packed[k], self._document.size)
        return answer[low - first * whole : high - first * whole]

    def _unpacked(self, k: int, data: memoryview, size: int) -> bytes:
        """Decompress block k to its size."""
        title = f"block {k + 1} of {len(self._packed)} of {self._title}"
        try:
            block = _decompressor(self._kind)(data, size)
        except MemoryError:
            raise
        except Exception as error:  # each of the three libraries raises its own type
            detail = " ".join(str(error).split())[:80]
            raise self._document.error(f"{title} is not valid {self._kind} ({detail})") from None
        if len(block) != size:
            raise self._document.error(f"{title} does not have the {size} bytes that it declares")
        return block

    def _header(self, count: int) -> list[int]:
        """Read the first numbers of the header."""
        return np.frombuffer(self._take(0, count * self._word.itemsize), self._word).tolist()

    def _stored(self, size: int) -> int:
        """Return the number of characters or bytes in which so many bytes are stored."""
        return -(-size // 3) * 4 if self._is_base64 else size

    def _take(self, at: int, size: int) -> bytes:
        """Return bytes that are stored at an offset."""
        data = self._text(at, self._stored(size)) if self._stored(size) <= self._left else b""
        try:
            data = binascii.a2b_base64(data)[:size] if self._is_base64 else data
        except binascii.Error:
            raise self._document.error(f"{self._title} is not valid base64") from None
        if len(data) != size:
            raise self._document.error(f"{self._title} continues past the end of the data")
        return data


def _decompressor(kind: str) -> Callable[[bytes, int], bytes]:
    """Return decompress(data, size), which stops at little more than `size` bytes."""
    if kind == "zlib":
        return lambda data, size: zlib.decompressobj().decompress(data, size + 1)
    if kind == "LZMA":
        import lzma

        return lambda data, size: lzma.LZMADecompressor(memlimit=_LZMA_MEMORY).decompress(data, size + 1)
    from lz4 import block

    return lambda data, size: block.decompress(data, uncompressed_size=size)
