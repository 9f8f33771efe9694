"""Colours and fonts of the program."""
