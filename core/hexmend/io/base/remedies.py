"""Advice that readers of several formats give in their errors."""

#: For a file whose content contradicts itself or ends early.
DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."


def check_suffix(kind: str) -> str:
    """Return the advice for a file that is not of the kind that its suffix says.

    >>> check_suffix("a Gmsh file")
    'Check that this is a Gmsh file; if not, correct its suffix.'
    """
    return f"Check that this is {kind}; if not, correct its suffix."
