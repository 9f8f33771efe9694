"""Files on disk: atomic writing, temporary files, TOML files, and reading in a subprocess."""
