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

import numpy as np

from hexmend.io.base.decimals import count_words, exceeds_dtype, parse_numbers
from hexmend.io.formats.vtk.xml_document import TYPES, Document, XMLElement, array_title
from hexmend.io.storage.file_progress import advance
from hexmend.io.storage.parallel_map import parallel_map

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
    data = _read_bytes(document, array, size)
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
    dtype, header_type = document.dtype(array), _header_type(document)
    low, high = begin * dtype.itemsize, end * dtype.itemsize
    stream = _RawStream(document, document.appended()[0] + document.count(array, "offset"))
    kind = COMPRESSORS.get(document.root.get("compressor"))
    length = blocks = _read_header(document, array, stream, 1)[0]
    if kind is None:
        at = header_type.itemsize + low
    elif blocks:
        _, whole, last, *packed = _read_header(document, array, stream, 3 + blocks)
        whole = whole or last  # of a single block
        length = whole * (blocks - 1) + (last or whole)
    if end < begin or high > length:
        raise document.error(f"{array_title(array)} has {length} bytes: expected {high} at least")
    if begin == end:
        return np.empty(0, dtype.newbyteorder("="))
    if kind is None:
        data = _take(document, array, stream, at, high - low)
    else:
        first, title = low // whole, array_title(array)
        begins = (3 + blocks) * header_type.itemsize + np.concatenate([[0], np.cumsum(packed, dtype=np.int64)])
        parts = []
        for k in range(first, (high - 1) // whole + 1):
            block = _take(document, array, stream, int(begins[k]), packed[k])
            parts.append(_unpack(document, title, kind, block, last or whole if k == blocks - 1 else whole))
        data = b"".join(parts)[low - first * whole : high - first * whole]
    return np.frombuffer(data, dtype).astype(dtype.newbyteorder("="), copy=False)


def _unpack(document: Document, title: str, kind: str, data: bytes | memoryview, size: int) -> bytes:
    """Decompress a block of an array to its size."""
    try:
        block = _decompressor(kind)(data, size)
    except MemoryError:
        raise
    except Exception as error:  # each of the three libraries raises its own type
        detail = " ".join(str(error).split())[:80]
        raise document.error(f"{title} is not valid {kind} ({detail})") from None
    if len(block) != size:
        raise document.error(f"{title} does not have the {size} bytes that it declares")
    return block


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


def _read_bytes(document: Document, array: XMLElement, size: int | None) -> bytes | np.ndarray:
    """Read and decompress the bytes of an array; `size` is the expected number, None if only the array gives it."""
    encoding = array.get("format")
    stream: _Stream
    problem = f"{array_title(array)} has the format {encoding[:20]!r}: expected ascii, binary or appended"
    if encoding == "appended":
        begin, appended_encoding = document.appended()
        begin += document.count(array, "offset")
        if appended_encoding == "raw":
            stream = _RawStream(document, begin)
        else:
            stream = _Base64Stream(lambda at, n: document.bytes(begin + at, n), document.size - begin)
    elif encoding == "binary":
        text = b"".join(document.text(array).split())
        stream = _Base64Stream(lambda at, n: text[at : at + n], len(text))
    else:
        raise document.error(problem)
    compressor = document.root.get("compressor")
    if compressor and compressor not in COMPRESSORS:
        known = ", ".join(COMPRESSORS)
        raise document.error(f"is packed by {compressor[:40]!r}: expected {known}", "Write it without compression.")
    try:
        if compressor:
            return _read_compressed(document, array, stream, size, COMPRESSORS[compressor])
        return _read_uncompressed(document, array, stream, size)
    except binascii.Error:
        raise document.error(f"{array_title(array)} is not valid base64") from None


class _RawStream:
    """Raw bytes of an array; `left` is the largest number that the file can hold."""

    def __init__(self, document: Document, begin: int):
        self.document, self.begin, self.left = document, begin, document.size - begin

    def read(self, at: int, size: int) -> bytes:
        """Read `size` bytes from an offset of the stream; fewer at the end."""
        return self.document.bytes(self.begin + at, size)

    def after(self, size: int) -> int:
        """Offset behind the first `size` bytes, if these are stored separately."""
        return size

    def alone(self, size: int) -> bool:
        """Return True if the first `size` bytes are encoded separately, with padding behind them."""
        return False


class _Base64Stream:
    """Bytes of an array in base64; text(offset, count) gives characters. Methods are those of `_RawStream`."""

    def __init__(self, text: Callable[[int, int], bytes], length: int):
        self.text, self.left = text, length // 4 * 3

    def read(self, at: int, size: int) -> bytes:
        return binascii.a2b_base64(self.text(at, self.after(size)))[:size]

    def after(self, size: int) -> int:
        return -(-size // 3) * 4

    def alone(self, size: int) -> bool:
        return len(binascii.a2b_base64(self.text(0, self.after(size)))) == size


_Stream = _RawStream | _Base64Stream


def _read_uncompressed(document: Document, array: XMLElement, stream: _Stream, size: int | None) -> bytes:
    header_type = _header_type(document)
    length = _read_header(document, array, stream, 1)[0]
    _check_size(document, array, length, size)
    advance(_SHARE * length, document.size)
    if stream.alone(header_type.itemsize):  # some programs encode the size separately
        return _take(document, array, stream, stream.after(header_type.itemsize), length)
    return _take(document, array, stream, 0, header_type.itemsize + length)[header_type.itemsize :]


def _read_compressed(document: Document, array: XMLElement, stream: _Stream, size: int | None, kind: str) -> np.ndarray:
    blocks = _read_header(document, array, stream, 1)[0]
    if blocks == 0:
        _check_size(document, array, 0, size)
        return np.empty(0, np.uint8)
    _, whole, last, *packed = _read_header(document, array, stream, 3 + blocks)
    length = whole * (blocks - 1) + (last or whole)
    _check_size(document, array, length, size)
    begin = stream.after((3 + blocks) * _header_type(document).itemsize)
    data = memoryview(_take(document, array, stream, begin, sum(packed)))
    answer = np.empty(length, np.uint8)
    begins = np.concatenate([[0], np.cumsum(packed, dtype=np.int64)]).tolist()

    def unpack(k: int) -> None:
        expected = whole if k < blocks - 1 else last or whole
        title = f"block {k + 1} of {blocks} of {array_title(array)}"
        block = _unpack(document, title, kind, data[begins[k] : begins[k + 1]], expected)
        answer[k * whole : k * whole + expected] = np.frombuffer(block, np.uint8)

    for k, _ in enumerate(parallel_map(unpack, range(blocks))):
        advance(_SHARE * packed[k], document.size)
    return answer


def _read_header(document: Document, array: XMLElement, stream: _Stream, count: int) -> list[int]:
    """Read the first `count` numbers of an array's header."""
    header_type = _header_type(document)
    return np.frombuffer(_take(document, array, stream, 0, count * header_type.itemsize), header_type).tolist()


def _take(document: Document, array: XMLElement, stream: _Stream, at: int, size: int) -> bytes:
    data = stream.read(at, size) if size <= stream.left else b""
    if len(data) != size:
        raise document.error(f"{array_title(array)} continues past the end of the data")
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


def _check_size(document: Document, array: XMLElement, length: int, size: int | None) -> None:
    if size is None:
        document.budget.charge(length, array_title(array))
    elif length != size:
        raise document.error(f"{array_title(array)} has {length} bytes: expected {size}")


def _header_type(document: Document) -> np.dtype:
    kind = document.root.get("header_type", "UInt32")
    if kind not in ("UInt32", "UInt64"):
        raise document.error(f"its header_type is {kind[:20]!r}: expected UInt32 or UInt64")
    return np.dtype(TYPES[kind]).newbyteorder(document.order)
