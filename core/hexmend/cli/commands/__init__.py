"""Commands of the core, a folder each: the package declares the command, the module beside it does the work."""
