"""The declaration of a method or of a generated mesh, as text."""

from __future__ import annotations

from hexmend.parameters import declared


def print_parameters(name: str, kind: type) -> None:
    """Print title, source and help of a class, and a line for each parameter that it declares.

    Parameters
    ----------
    name : str
        Its name on the command line.
    kind : type
        A smoother or a generator of the gallery.
    """
    print(f"{name}: {kind.title} ({kind.source})\n    {kind.help}")
    for one in declared(kind):
        unit = f" {one.unit}" if one.unit else ""
        print(f"      {one.name} = {one.default}{unit}  ({one.range})  {one.help}")
    print()
