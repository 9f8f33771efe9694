"""Names of sets and data in the form that a file allows, without duplicates."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import count


def make_unique(names: Iterable[str], form: Callable[[str, str], str]) -> dict[str, str]:
    """Choose the names under which sets or data are written.

    Parameters
    ----------
    names : iterable of str
    form : callable
        form(name, suffix) returns the name in the form that the file allows, with the suffix at its end.

    Returns
    -------
    dict of str to str
        The written name of each name. Valid names are kept; if two names become the same, the later one gets the
        suffix " 2", " 3"...

    Examples
    --------
    >>> make_unique(["a\'b", 'a"b'], lambda name, suffix: name.replace('"', "'") + suffix)
    {"a'b": "a'b", 'a"b': "a'b 2"}
    """
    names = list(dict.fromkeys(names))
    written = {name: name for name in names if form(name, "") == name}
    taken = set(written)
    for name in names:
        if name not in written:
            titles = (form(name, "" if k == 1 else f" {k}") for k in count(1))
            written[name] = next(title for title in titles if title not in taken)
            taken.add(written[name])
    return {name: written[name] for name in names}


def altered_names(titles: dict[str, str], of: str = "sets") -> list[str]:
    """Describe the names that are not written unchanged; empty if there are none.

    Parameters
    ----------
    titles : dict of str to str
        Written names, as from `make_unique`.
    of : str
        The things that have the names, in the message.
    """
    altered = sorted(name for name, title in titles.items() if name != title)
    return [f"names of {of} as they are ({', '.join(altered)})"] if altered else []
