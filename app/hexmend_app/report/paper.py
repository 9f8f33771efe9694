"""The report as PDF: the page without scripts, on A4, by WeasyPrint."""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import HexmendError
from hexmend.io.storage.atomic import atomic_write


def write_paper(path: Path, text: str) -> None:
    """Write a page as PDF, atomically.

    Raises
    ------
    HexmendError
        If WeasyPrint or Pango is missing.
    FileError
        If the file cannot be written.
    """
    check_paper()
    from weasyprint import HTML
    from weasyprint.urls import URLFetcher

    fetcher = URLFetcher(allowed_protocols=["data"])  # the page is self-contained
    with atomic_write(path) as temporary:
        HTML(string=text, url_fetcher=fetcher).write_pdf(temporary)


def check_paper() -> None:
    """Raise `HexmendError` if no PDF can be written."""
    try:
        import weasyprint as _  # noqa: F401
    except ImportError:
        raise HexmendError(
            "a report as PDF needs WeasyPrint: run  pip install 'hexmend[app]'  or write .html, which a browser prints"
        ) from None
    except OSError as error:
        raise HexmendError(
            f"a report as PDF needs Pango: run  apt-get install libpangoft2-1.0-0  or write .html, which a browser "
            f"prints ({str(error).splitlines()[0]})"
        ) from None
