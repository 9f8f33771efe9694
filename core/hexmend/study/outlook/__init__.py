"""Experiments of section 5.2 of the thesis, its outlook."""
