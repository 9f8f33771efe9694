"""Advice that readers of several formats give in their errors."""

#: For a file whose content contradicts itself or ends early.
DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."
