"""The open mesh, its history and what is measured of it."""
