"""Settings that are stored between starts."""
