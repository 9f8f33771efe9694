"""Report as PDF on A4, written by WeasyPrint from the page without scripts."""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import HexmendError
from hexmend.io.storage.atomic import atomic_write
from hexmend.terminal_text import install_hint


def write_pdf(path: Path, text: str) -> None:
    """Write a page as PDF, atomically.

    Raises
    ------
    HexmendError
        If WeasyPrint or Pango is not installed.
    FileError
        If the file cannot be written.
    """
    check_pdf()
    from weasyprint import HTML
    from weasyprint.urls import URLFetcher

    fetcher = URLFetcher(allowed_protocols=["data"])  # the page is self-contained
    with atomic_write(path) as temporary:
        HTML(string=text, url_fetcher=fetcher).write_pdf(temporary)


def check_pdf() -> None:
    """Raise `HexmendError` if no PDF can be written."""
    try:
        import weasyprint as _  # noqa: F401
    except ImportError:
        raise HexmendError(
            f"a PDF report needs WeasyPrint: {install_hint('app')}, or write .html and print it in a browser"
        ) from None
    except OSError as error:
        raise HexmendError(
            f"a PDF report needs Pango: run  apt-get install libpangoft2-1.0-0  or write .html and print it in a "
            f"browser ({str(error).splitlines()[0]})"
        ) from None
